"""Figure 2 with simulations of high blocks beside its curves, for either sense of the contrast."""

from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...figures import laws, style
from ...patch.tables.pairs import over_realisations
from ...theory.closed_forms import bimaterial_length_ratio

CONTRAST = np.linspace(-0.42, 0.42, 169)
PANELS = (("length_ratio", "(a) at the drop"), ("stability_ratio", "(b) patch turns unstable"))


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw lengths over ``L_c^M``, at the drop and where the patch turns unstable.

    The stiffer body is above on the left of each panel, below on the right; bars are the range of
    the realisations. `table` is that of :func:`nucleation.patch.tables.pairs.gather_pairs`.
    """
    rows = over_realisations(laws.where(table, role="figure_2_simulated"))
    figure, axes = style.panels(1, 2, 8.4, sharey=True)
    for panel, (name, title) in zip(axes, PANELS, strict=True):
        _draw_lengths(panel, rows, name)
        panel.set_title(title, loc="left")
        panel.set_xlabel(r"Bimaterial contrast $f\beta$")
        panel.axvline(0.0, color=style.GUIDE, linewidth=0.6, linestyle=":")
        for place, side, which in ((0.02, "left", "above"), (0.98, "right", "below")):
            look: Any = {"transform": panel.transAxes, "ha": side, "fontsize": style.SMALL}
            panel.text(place, 0.03, f"stiffer body {which}", **look)
    axes[0].set_ylim(bottom=0.0)
    axes[0].set_ylabel(r"Length over $L_c^{\mathcal{M}}$")
    handles = axes[0].get_legend_handles_labels()[0]
    half = len(handles) // 2  # curves, then points: a column has both of one zeta/a
    pairs = [handle for pair in zip(handles[:half], handles[half:], strict=True) for handle in pair]
    figure.legend(handles=pairs, loc="outside lower center", ncols=max(half, 1))
    return figure


def _draw_lengths(axes: Axes, rows: xr.Dataset, name: str) -> None:
    ratios = np.unique(np.round(rows["zeta_over_a"].values, 3))[::-1]
    ends = {
        name + end: rows[name + end if name + end in rows else name] for end in ("_low", "_high")
    }
    rows = rows.assign(ends).sortby("f_beta")
    shades = style.shades(ratios.size, 0.75)
    for ratio, shade, marker in zip(ratios, shades, "osD^v", strict=False):
        curve = bimaterial_length_ratio(np.abs(CONTRAST), ratio)
        label = rf"Eq. (9), $\zeta/a={ratio:.3g}$"
        axes.plot(CONTRAST, curve, color=shade, linewidth=1.1, label=label)
        own = laws.where(rows, np.abs(rows["zeta_over_a"].values - ratio) < 1e-2 * ratio)
        # what the theory has for blocks of this height, in units of that without contrast
        unit = 1.0 / own["half_space_ratio"].values
        look: Any = {"color": shade, "marker": marker, "ms": 3.8, "linewidth": 0.7}
        look |= {"linestyle": "--", "capsize": 1.8, "label": rf"simulated, $\zeta/a={ratio:.3g}$"}
        laws.draw(axes, own["f_beta"].values, own, name, unit, **look)
    axes.set_xlim(CONTRAST[0], CONTRAST[-1])
