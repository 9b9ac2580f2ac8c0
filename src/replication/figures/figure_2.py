"""Figure 2: the critical length of bimaterial interfaces against the contrast (Eq. 9).

:func:`draw_simulated` has simulations of high blocks beside it, for either sense of the contrast.
"""

from itertools import cycle

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from nucleation.pictures import style
from nucleation.theory.closed_forms import bimaterial_length_ratio
from nucleation.types import Array

from ..tables.ratios import pairs_over_realisations
from . import laws

DASHES = ("-", (0, (5, 1.5)), (0, (5, 1.5, 1, 1.5)), (0, (1.2, 1.2)), (0, (9, 1.5, 1, 1.5, 1, 1.5)))
HANDLE = 4.0  # length of the legend's lines over the font size: each pattern is shown entirely

_CONTRAST = np.linspace(-0.42, 0.42, 169)
_PANELS = (("length_ratio", "(a) at the drop"), ("stability_ratio", "(b) patch turns unstable"))
_MARKERS = "osD^v"
_UNKNOWN = 0.14  # ordinate of runs without the length


def looks(weakenings: Array) -> dict[float, style.Options]:
    """Colour and dashes by zeta/a, from the highest to the lowest."""
    values = np.sort(np.unique(weakenings))[::-1].tolist()
    found = {}
    for value, shade, dashes in zip(
        values, style.shades(len(values), 0.82), cycle(DASHES), strict=False
    ):
        found[value] = {"color": shade, "linestyle": dashes}
    return found


@style.styled
def draw(theory: xr.Dataset) -> Figure:
    """Draw ``L_c / L_c^M`` against ``f beta``, one curve for each ``zeta / a``."""
    figure, axes = style.column(6.6)
    ratio = theory["bimaterial_length_ratio"]
    f_beta = ratio["f_beta"]
    for value, look in looks(ratio["zeta_over_a"].values).items():
        curve = ratio.sel(zeta_over_a=value).transpose("f_beta").values
        axes.plot(f_beta, curve, label=f"${value:.3g}$", **look)
    axes.set_xlabel(r"Bimaterial contrast $f\beta$")
    axes.set_ylabel(r"Critical length $L_c/L_c^{\mathcal{M}}$")
    axes.set_xlim(float(f_beta.min()), float(f_beta.max()))
    axes.set_ylim(0.0, 1.04)
    axes.minorticks_on()
    # the curves decrease from one, the highest zeta/a on top: the legend has their order
    title: style.Options = {"title": r"$\zeta/a$", "title_fontsize": 9.0}
    axes.legend(loc="lower left", labelspacing=0.3, handlelength=HANDLE, **title)
    return figure


@style.styled
def draw_simulated(table: xr.Dataset, theory: xr.Dataset) -> Figure:
    """Draw lengths over ``L_c^M``, at the drop and where the patch becomes unstable.

    The stiffer body is the upper one in the left half of each panel, and the lower one in the right
    half; bars are the range of the realisations. Crosses are runs without the length.
    """
    rows = pairs_over_realisations(laws.where(table, role="figure_2_simulated"))
    rows = rows.assign(zeta_over_a=rows["zeta_over_a"].round(3)).sortby("f_beta")
    figure, panels = style.panels(1, 2, 8.8, sharey=True)
    simulated = np.unique(rows["zeta_over_a"].values)
    own_looks = looks(np.union1d(theory["zeta_over_a"].values, simulated))
    for axes, (name, title) in zip(panels, _PANELS, strict=True):
        _draw_lengths(axes, rows, name, own_looks)
        axes.set(title=title, xlabel=r"Bimaterial contrast $f\beta$")
        style.vertical(axes, 0.0, ":", 0.6)
        look: style.Options = {"transform": axes.transAxes, "fontsize": style.SMALL}
        axes.text(0.02, 0.03, "stiffer body above", ha="left", **look)
        axes.text(0.98, 0.03, "stiffer body below", ha="right", **look)
    panels[0].set(ylim=(0.0, None), ylabel=r"Length over $L_c^{\mathcal{M}}$")
    entries = style.entries(*panels)
    below: style.Options = {"loc": "outside lower center", "handlelength": HANDLE}
    figure.legend(
        entries.values(),
        entries,
        ncols=max(simulated.size, 1),
        **below,
    )
    return figure


def _draw_lengths(
    axes: Axes, rows: xr.Dataset, name: str, looks: dict[float, style.Options]
) -> None:
    """Curves of Eq. (9) and the simulated lengths of one panel, for each zeta/a."""
    ratios = np.unique(rows["zeta_over_a"].values)[::-1]
    for ratio, marker in zip(ratios, _MARKERS, strict=False):
        look = looks[float(ratio)]
        weakening = rf"$\zeta/a={ratio:.3g}$"
        curve = bimaterial_length_ratio(np.abs(_CONTRAST), ratio)
        axes.plot(_CONTRAST, curve, linewidth=1.1, label=f"Eq. (9), {weakening}", **look)
        own = laws.where(rows, zeta_over_a=ratio)
        # the theory's length for blocks of this height without contrast
        unit = 1.0 / own["half_space_ratio"]
        own = own.assign({key: own[key] / unit for key in own if str(key).startswith(name)})
        colour = look["color"]
        line: style.Options = {"linestyle": "-", "linewidth": 0.5, "capsize": 1.8}
        label = f"simulated, {weakening}"
        laws.draw(
            axes, "f_beta", own, name, color=colour, marker=marker, ms=3.8, label=label, **line
        )
        unknown = own["f_beta"].values[np.isnan(own[name].values)]
        if unknown.size:
            label = f"{weakening}, no length found"
            axes.plot(
                unknown,
                np.full(unknown.size, _UNKNOWN),
                "x",
                color=colour,
                label=label,
            )
    axes.set_xlim(_CONTRAST[0], _CONTRAST[-1])
