"""Figure 2 with simulations of high blocks upon its curves, for either sense of the contrast."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...figures import style
from ...patch.pairs import chosen, of_role
from ...theory.closed_forms import bimaterial_length_ratio

ROLE = "figure_2_simulated"
CONTRAST = np.linspace(0.0, 0.42, 85)
SENSES = ((1.0, "v", "stiff below"), (-1.0, "^", "stiff above"))


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
        Two columns wide, two panels.
    """
    rows = of_role(table, ROLE)
    figure = style.new_figure(style.DOUBLE_COLUMN, 7.6 * style.CENTIMETRE)
    axes = figure.subplots(1, 2, sharey=True)
    panels = (("length", "(a) at the drop"), ("stability_length", "(b) patch turns unstable"))
    for panel, (name, title) in zip(axes, panels, strict=True):
        _draw_lengths(panel, rows, name)
        panel.set_title(title, loc="left")
        panel.set_xlabel(r"Bimaterial contrast $f|\beta|$")
    longest = max(np.nanmax(line.get_ydata(), initial=1.0) for line in axes[0].lines)
    axes[0].set_ylim(0.0, 1.06 * longest)
    axes[0].set_ylabel(r"Length over $L_c^{\mathcal{M}}$")
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="outside lower center", ncols=len(handles))
    return figure


def _draw_lengths(axes: Axes, rows: xr.Dataset, name: str) -> None:
    ratios = np.unique(np.round(rows["zeta_over_a"].values, 3))[::-1]
    shades = colormaps[style.SEQUENCE](np.linspace(0.0, 0.75, max(ratios.size, 1)))
    for ratio, shade in zip(ratios, shades, strict=False):
        axes.plot(
            CONTRAST, bimaterial_length_ratio(CONTRAST, ratio), color=shade, linewidth=1.1,
            label=rf"Eq. (9), $\zeta/a={ratio:.3g}$",
        )  # fmt: skip
        own = chosen(rows, np.abs(rows["zeta_over_a"].values - ratio) < 1e-2 * ratio)
        # what the theory has for blocks of this height, in units of that without contrast
        unit = own["theory_length"].values / own["half_space_ratio"].values
        contrast = own["f_beta"].values
        for sign, marker, _ in SENSES:
            of_sense = sign * contrast >= 0.0
            axes.plot(
                np.abs(contrast[of_sense]), (own[name].values / unit)[of_sense], marker,
                color=shade, markersize=5.0,
                markerfacecolor="none" if sign < 0.0 else shade,
            )  # fmt: skip
    for sign, marker, words in SENSES:
        axes.plot(
            [], [], marker, color=style.BLACK, label=words,
            markerfacecolor="none" if sign < 0.0 else style.BLACK,
        )  # fmt: skip
    axes.set_xlim(-0.01, CONTRAST[-1])
