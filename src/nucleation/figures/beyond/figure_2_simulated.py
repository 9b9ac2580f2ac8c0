"""Figure 2 with simulations of high blocks beside its curves, for either sense of the contrast."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...figures import laws, style
from ...patch.tables.pairs import over_realisations
from ...theory.closed_forms import bimaterial_length_ratio

_CONTRAST = np.linspace(-0.42, 0.42, 169)
_PANELS = (
    ("length_ratio", "(a) at the drop"),
    ("stability_ratio", "(b) patch turns unstable"),
)


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw lengths over ``L_c^M``, at the drop and where the patch becomes unstable.

    The stiffer body is the upper one in the left half of each panel, and the lower one in the right
    half; bars are the range of the realisations.

    Parameters
    ----------
    table : Dataset
        From :func:`nucleation.patch.tables.pairs.gather_pairs`.

    Returns
    -------
    Figure
        Two panels.
    """
    rows = over_realisations(laws.where(table, role="figure_2_simulated"))
    figure, panels = style.panels(1, 2, 8.4, sharey=True)
    for axes, (name, title) in zip(panels, _PANELS, strict=True):
        _draw_lengths(axes, rows, name)
        axes.set_title(title, loc="left")
        axes.set_xlabel(r"Bimaterial contrast $f\beta$")
        axes.axvline(0.0, color=style.GUIDE, linewidth=0.6, linestyle=":")
        for place, side, which in (
            (0.02, "left", "above"),
            (0.98, "right", "below"),
        ):
            axes.text(
                place,
                0.03,
                f"stiffer body {which}",
                transform=axes.transAxes,
                ha=side,
                fontsize=style.SMALL,
            )
    panels[0].set_ylim(bottom=0.0)
    panels[0].set_ylabel(r"Length over $L_c^{\mathcal{M}}$")
    handles = panels[0].get_legend_handles_labels()[0]
    # curves, then points; each column of the legend has both of one zeta/a
    half = len(handles) // 2
    pairs = []
    for curve, points in zip(handles[:half], handles[half:], strict=True):
        pairs += [curve, points]
    figure.legend(handles=pairs, loc="outside lower center", ncols=max(half, 1))
    return figure


def _draw_lengths(axes: Axes, rows: xr.Dataset, name: str) -> None:
    ratios = np.unique(np.round(rows["zeta_over_a"].values, 3))[::-1]
    for end in ("_low", "_high"):
        if name + end not in rows:
            rows = rows.assign({name + end: rows[name]})
    rows = rows.sortby("f_beta")
    shades = style.shades(ratios.size, 0.75)
    for ratio, shade, marker in zip(ratios, shades, "osD^v", strict=False):
        curve = bimaterial_length_ratio(np.abs(_CONTRAST), ratio)
        label = rf"Eq. (9), $\zeta/a={ratio:.3g}$"
        axes.plot(_CONTRAST, curve, color=shade, linewidth=1.1, label=label)
        own = laws.where(
            rows,
            np.abs(rows["zeta_over_a"].values - ratio) < 1e-2 * ratio,
        )
        # the theory's length for blocks of this height without contrast
        unit = 1.0 / own["half_space_ratio"].values
        laws.draw(
            axes,
            own["f_beta"].values,
            own,
            name,
            unit,
            color=shade,
            marker=marker,
            ms=3.8,
            linewidth=0.7,
            linestyle="--",
            capsize=1.8,
            label=rf"simulated, $\zeta/a={ratio:.3g}$",
        )
    axes.set_xlim(_CONTRAST[0], _CONTRAST[-1])
