"""Figure 2 with simulations of high blocks beside its curves, for either sense of the contrast."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from nucleation.pictures import style
from nucleation.theory.closed_forms import bimaterial_length_ratio

from ...tables.pairs import over_realisations
from .. import laws
from ..paper import figure_2

_CONTRAST = np.linspace(-0.42, 0.42, 169)
_PANELS = (("length_ratio", "(a) at the drop"), ("stability_ratio", "(b) patch turns unstable"))
_MARKERS = "osD^v"
_UNKNOWN = 0.14  # ordinate of runs without the length


@style.styled
def draw(table: xr.Dataset, theory: xr.Dataset) -> Figure:
    """Draw lengths over ``L_c^M``, at the drop and where the patch becomes unstable.

    The stiffer body is the upper one in the left half of each panel, and the lower one in the right
    half; bars are the range of the realisations. Crosses are runs without the length.

    Parameters
    ----------
    table : Dataset
        From :func:`replication.tables.pairs.gather_pairs`.
    theory : Dataset
        That of Figure 2, for its colours: with ``zeta_over_a``.

    Returns
    -------
    Figure
        Two panels.
    """
    rows = over_realisations(laws.where(table, role="figure_2_simulated"))
    rows = rows.assign(zeta_over_a=rows["zeta_over_a"].round(3)).sortby("f_beta")
    figure, panels = style.panels(1, 2, 8.8, sharey=True)
    simulated = np.unique(rows["zeta_over_a"].values)
    looks = figure_2.looks(np.union1d(theory["zeta_over_a"].values, simulated))
    for axes, (name, title) in zip(panels, _PANELS, strict=True):
        _draw_lengths(axes, rows, name, looks)
        axes.set(title=title, xlabel=r"Bimaterial contrast $f\beta$")
        style.vertical(axes, 0.0, ":", 0.6)
        look: style.Options = {"transform": axes.transAxes, "fontsize": style.SMALL}
        axes.text(0.02, 0.03, "stiffer body above", ha="left", **look)
        axes.text(0.98, 0.03, "stiffer body below", ha="right", **look)
    panels[0].set(ylim=(0.0, None), ylabel=r"Length over $L_c^{\mathcal{M}}$")
    entries = style.entries(*panels)
    figure.legend(
        entries.values(),
        entries,
        loc="outside lower center",
        ncols=max(simulated.size, 1),
        handlelength=figure_2.HANDLE,
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
        laws.draw(
            axes,
            "f_beta",
            own,
            name,
            color=colour,
            marker=marker,
            ms=3.8,
            linewidth=0.5,
            linestyle="-",
            capsize=1.8,
            label=f"simulated, {weakening}",
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
