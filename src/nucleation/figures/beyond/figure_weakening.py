"""Where slow slip begins and where it ends in an event, over how much friction weakens."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter, StrMethodFormatter

from ...figures import laws, style

LINES = {
    "stability_length": (r"$L_s$: the patch turns unstable", style.BLUE, "-"),
    "runaway_length": (r"$L_{run}$: slow slip has no end but an event", style.VERMILLION, "-"),
    "law_length": ("law of the drop, median", style.GUIDE, "--"),
}
"""Label, colour and dashes of each length by theory."""

SIMULATED = "simulated drop: mean and range of realisations"
BASES = {"rigid": "rigid base", "deformable": "identical blocks"}
FEWEST = 3  # zeta/a of a base and height that are drawn as curves
TICKS = (0.2, 0.5, 1.0, 2.0, 5.0)  # of zeta/a


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw lengths over L_c against zeta/a, one panel for each base and height.

    Parameters
    ----------
    table : Dataset
        From :func:`nucleation.patch.tables.weakening.gather_weakening`.
    """
    systems = [
        system
        for system in laws.groups(table, "study", "below", "height")
        if np.unique(system["zeta_over_a"]).size >= FEWEST
    ]
    figure, panels = style.panels(1, len(systems), 7.5)
    for axes, letter, system in zip(np.ravel(panels), "abcdefgh", systems, strict=False):
        _draw_system(axes, system)
        base = BASES[str(system["below"].values[0])]
        height = float(system["height"][0])
        axes.set_title(f"({letter}) {base}, $H$ = {height:g} m", loc="left")
    first = np.ravel(panels)[0]
    first.set_ylabel("Length over theory $L/L_c$")
    entries = style.entries(first)
    entries[SIMULATED] = style.key(SIMULATED, "o", colour=style.BLACK)
    figure.legend(entries.values(), entries, loc="outside upper center", ncols=2)
    return figure


def _draw_system(axes: Axes, system: xr.Dataset) -> None:
    """The lengths of one base and height."""
    faults = list(laws.groups(system.sortby("zeta_over_a"), "zeta_over_a"))
    weakening = np.array([float(fault["zeta_over_a"][0]) for fault in faults])
    for name, (label, colour, dashes) in LINES.items():
        ratios = [float(fault[name][0] / fault["theory_length"][0]) for fault in faults]
        axes.plot(weakening, ratios, dashes, color=colour, label=label)
    for at, fault in zip(weakening, faults, strict=True):
        simulated = (fault["length"] / fault["theory_length"]).values
        dropped = simulated[np.isfinite(simulated)]
        if dropped.size:
            mean = dropped.mean()
            bars = [[mean - dropped.min()], [dropped.max() - mean]]
            axes.errorbar(at, mean, bars, fmt="o", color=style.BLACK, markersize=4.0)
    style.level(axes, 0.5)
    axes.set(xscale="log", xlabel=r"Weakening $\zeta/a$", ylim=(0.4, 1.6))
    axes.set_xticks(TICKS)
    axes.xaxis.set_major_formatter(StrMethodFormatter("{x:g}"))
    axes.xaxis.set_minor_formatter(NullFormatter())
