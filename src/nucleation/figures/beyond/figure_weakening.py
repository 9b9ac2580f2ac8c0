"""Where slow slip begins and where it ends in an event, over the weakening of friction."""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullFormatter, StrMethodFormatter

from ...figures import laws, style

_LINES = {
    "stability_length": (
        "curve_stability",
        r"$L_s$: the patch turns unstable",
        style.BLUE,
        "-",
    ),
    "runaway_length": (
        "curve_runaway",
        r"$L_{\mathrm{run}}$: slow slip has no end but an event",
        style.VERMILLION,
        "-.",
    ),
    "law_length": ("curve_law", "law of the drop, median", style.GUIDE, "--"),
}
"""Name of the curve, label, colour and dashes of each length by theory."""

_SIMULATED = "simulated drop: mean and range of realisations"
_BASES = {"rigid": "rigid base", "deformable": "identical blocks"}
_FEWEST = 3  # zeta/a of a base and height for a panel
_TICKS = (0.2, 0.5, 1.0, 2.0, 5.0)  # of zeta/a
_RATIOS = (0.5, 1.0, 2.0)  # ticks of lengths over L_c


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw lengths over L_c against zeta/a, one panel for each base and height.

    Parameters
    ----------
    table : Dataset
        From :func:`nucleation.patch.tables.weakening.weakening_files`. Without its curves, lines
        connect the theory's lengths of the runs.

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
        curves = _curves(table, system)
        _draw_system(axes, system, curves)
        bodies = _BASES[str(system["below"].values[0])]
        height = f"$H$ = {float(system['height'][0]):g} m"
        text = f"{bodies}, {height}"
        if curves is not None and curves["curve_half_spaces"]:
            text = f"half-spaces (runs: {height})"
        axes.set_title(f"({letter}) {text}", loc="left")
    panels[0].set_ylabel("Length over theory $L/L_c$")
    entries = style.entries(panels[0])
    entries[_SIMULATED] = style.key(_SIMULATED, "o", colour=style.BLACK)
    figure.legend(entries.values(), entries, loc="outside upper center", ncols=2)
    return figure


def _curves(table: xr.Dataset, system: xr.Dataset) -> xr.Dataset | None:
    """The theory's curves of a base and height, None if the table has none."""
    if "curve_study" not in table:
        return None
    same = np.ones(table.sizes["system"], dtype=bool)
    for name in ("study", "below", "height"):
        same &= table[f"curve_{name}"].values == system[name].values[0]
    return table.isel(system=np.flatnonzero(same)[0]) if same.any() else None


def _draw_system(axes: Axes, system: xr.Dataset, curves: xr.Dataset | None) -> None:
    """The lengths of one base and height."""
    faults = list(laws.groups(system.sortby("zeta_over_a"), "zeta_over_a"))
    weakening = np.array([float(fault["zeta_over_a"][0]) for fault in faults])
    for name, (curve, label, colour, dashes) in _LINES.items():
        if curves is None:
            ratios = [float(fault[name][0] / fault["critical_length"][0]) for fault in faults]
            x, y = weakening, np.array(ratios)
        else:
            x, y = curves["curve_ratio"].values, curves[curve].values
        axes.plot(x, y, linestyle=dashes, color=colour, label=label)
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
    axes.set(xscale="log", xlabel=r"Weakening $\zeta/a$", xlim=(0.18, 7.0))
    axes.set(yscale="log", ylim=(0.4, 2.8))
    axes.set_xticks(_TICKS)
    axes.set_yticks(_RATIOS)
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(StrMethodFormatter("{x:g}"))
        axis.set_minor_formatter(NullFormatter())
