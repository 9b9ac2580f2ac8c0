"""Where slow slip begins and where it ends in an event, over the weakening of friction."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter, StrMethodFormatter

from ...figures import laws, style

_LINES = {
    "stability_length": (
        r"$L_s$: the patch turns unstable",
        style.BLUE,
        "-",
    ),
    "runaway_length": (
        r"$L_{run}$: slow slip has no end but an event",
        style.VERMILLION,
        "-",
    ),
    "law_length": ("law of the drop, median", style.GUIDE, "--"),
}
"""Label, colour and dashes of each length by theory."""

_SIMULATED = "simulated drop: mean and range of realisations"
_BASES = {"rigid": "rigid base", "deformable": "identical blocks"}
_FEWEST = 3  # zeta/a of a base and height for a panel
_TICKS = (0.2, 0.5, 1.0, 2.0, 5.0)  # of zeta/a


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw lengths over L_c against zeta/a, one panel for each base and height.

    Parameters
    ----------
    table : Dataset
        From :func:`nucleation.patch.tables.weakening.gather_weakening`.

    Returns
    -------
    Figure
        A panel for each base and height.
    """
    systems = []
    for system in laws.groups(table, "study", "below", "height"):
        if np.unique(system["zeta_over_a"]).size >= _FEWEST:
            systems.append(system)
    figure, panels = style.panels(1, len(systems), 7.5)
    panels = np.ravel(panels)
    for axes, letter, system in zip(panels, "abcdefgh", systems, strict=False):
        _draw_system(axes, system)
        base = _BASES[str(system["below"].values[0])]
        height = float(system["height"][0])
        axes.set_title(f"({letter}) {base}, $H$ = {height:g} m", loc="left")
    panels[0].set_ylabel("Length over theory $L/L_c$")
    entries = style.entries(panels[0])
    entries[_SIMULATED] = style.key(_SIMULATED, "o", colour=style.BLACK)
    figure.legend(entries.values(), entries, loc="outside upper center", ncols=2)
    return figure


def _draw_system(axes: Axes, system: xr.Dataset) -> None:
    """The lengths of one base and height."""
    faults = list(laws.groups(system.sortby("zeta_over_a"), "zeta_over_a"))
    weakening = np.array([float(fault["zeta_over_a"][0]) for fault in faults])
    for name, (label, colour, dashes) in _LINES.items():
        ratios = [float(fault[name][0] / fault["critical_length"][0]) for fault in faults]
        axes.plot(weakening, ratios, dashes, color=colour, label=label)
    for at, fault in zip(weakening, faults, strict=True):
        simulated = (fault["length"] / fault["critical_length"]).values
        dropped = simulated[np.isfinite(simulated)]
        if dropped.size:
            mean = dropped.mean()
            bars = [[mean - dropped.min()], [dropped.max() - mean]]
            axes.errorbar(
                at,
                mean,
                bars,
                fmt="o",
                color=style.BLACK,
                markersize=4.0,
            )
    style.level(axes, 0.5, label="half of $L_c$")
    axes.set(xscale="log", xlabel=r"Weakening $\zeta/a$", xlim=(0.25, 7.0), ylim=(0.4, 1.6))
    axes.set_xticks(_TICKS)
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
