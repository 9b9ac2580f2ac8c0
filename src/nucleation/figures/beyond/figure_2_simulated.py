"""Figure 2 with simulations of high blocks beside its curves, for either sense of the contrast."""

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...figures import style
from ...patch.pairs import chosen, of_role, over_realisations
from ...theory.closed_forms import bimaterial_length_ratio

ROLE = "figure_2_simulated"
CONTRAST = np.linspace(-0.42, 0.42, 169)
MARKERS = ("o", "s", "D", "^", "v")


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw lengths over ``L_c^M``, at the drop and where the patch turns unstable.

    Parameters
    ----------
    table : Dataset
        From :func:`nucleation.patch.pairs.gather`.

    Returns
    -------
    Figure
        Two columns wide, two panels over the signed contrast: the stiffer body above on the left
        of each, below on the right. Bars are the range of the realisations.
    """
    rows = over_realisations(of_role(table, ROLE))
    figure = style.new_figure(style.DOUBLE_COLUMN, 8.4 * style.CENTIMETRE)
    axes = figure.subplots(1, 2, sharey=True)
    panels = (("length_ratio", "(a) at the drop"), ("stability_ratio", "(b) patch turns unstable"))
    for panel, (name, title) in zip(axes, panels, strict=True):
        _draw_lengths(panel, rows, name)
        panel.set_title(title, loc="left")
        panel.set_xlabel(r"Bimaterial contrast $f\beta$")
        panel.axvline(0.0, color=style.GUIDE, linewidth=0.6, linestyle=":")
        for place, side, which in ((0.02, "left", "above"), (0.98, "right", "below")):
            panel.text(place, 0.03, f"stiffer body {which}", transform=panel.transAxes, ha=side,
                       fontsize=style.SMALL)  # fmt: skip
    axes[0].set_ylim(bottom=0.0)
    axes[0].set_ylabel(r"Length over $L_c^{\mathcal{M}}$")
    handles = axes[0].get_legend_handles_labels()[0]
    half = len(handles) // 2  # curves, then points: a column has both of one zeta/a
    pairs = [handle for pair in zip(handles[:half], handles[half:], strict=True) for handle in pair]
    figure.legend(handles=pairs, loc="outside lower center", ncols=max(half, 1))
    return figure


def _draw_lengths(axes: Axes, rows: xr.Dataset, name: str) -> None:
    ratios = np.unique(np.round(rows["zeta_over_a"].values, 3))[::-1]
    shades = colormaps[style.SEQUENCE](np.linspace(0.0, 0.75, max(ratios.size, 1)))
    for ratio, shade, marker in zip(ratios, shades, MARKERS, strict=False):
        axes.plot(
            CONTRAST, bimaterial_length_ratio(np.abs(CONTRAST), ratio), color=shade, linewidth=1.1,
            label=rf"Eq. (9), $\zeta/a={ratio:.3g}$",
        )  # fmt: skip
        own = chosen(rows, np.abs(rows["zeta_over_a"].values - ratio) < 1e-2 * ratio)
        own = own.sortby("f_beta")
        # what the theory has for blocks of this height, in units of that without contrast
        unit = own["half_space_ratio"].values
        middle, low, high = (
            own[name + end].values * unit if name + end in own else own[name].values * unit
            for end in ("", "_low", "_high")
        )
        axes.errorbar(
            own["f_beta"].values, middle, yerr=(middle - low, high - middle), color=shade,
            marker=marker, markersize=3.8, linewidth=0.7, linestyle="--", elinewidth=0.9,
            capsize=1.8, label=rf"simulated, $\zeta/a={ratio:.3g}$",
        )  # fmt: skip
    axes.set_xlim(CONTRAST[0], CONTRAST[-1])
