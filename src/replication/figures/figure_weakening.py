"""Where slow slip begins and where it ends in an event, over the weakening of friction.

:func:`draw_patches`: which weakening patches creep, slip slowly or have events.
"""

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from nucleation.pictures import style

from . import laws

_LINES = {
    "curve_stability": (r"$L_s$: the patch turns unstable", style.STABILITY, "-"),
    "curve_runaway": (
        r"$L_{\mathrm{run}}$: slow slip has no end but an event",
        style.VERMILLION,
        "-.",
    ),
    "curve_law": ("law of the drop, median", style.GUIDE, "--"),
}
"""Label, colour and dashes of each length by theory."""

_SIMULATED = "simulated drop: mean and range of realisations"
_BASES = {"rigid": "rigid base", "deformable": "identical blocks"}
_FEWEST = 3  # zeta/a of a base and height for a panel
_TICKS = (0.2, 0.5, 1.0, 2.0, 5.0)  # of zeta/a
_RATIOS = (0.5, 1.0, 2.0)  # ticks of lengths over L_c


@style.styled
def draw(table: xr.Dataset) -> Figure:
    """Draw lengths over L_c against zeta/a, one panel for each base and height."""
    systems = []
    for system in laws.groups(table, "study", "below", "height"):
        if np.unique(system["zeta_over_a"]).size >= _FEWEST:
            systems.append(system)
    figure, panels = style.panels(1, len(systems), 7.5)
    panels = np.ravel(panels)
    for axes, letter, system in zip(panels, "abcdefgh", systems, strict=False):
        curves = _curves(table, system)
        _draw_system(axes, system, curves)
        height = f"$H$ = {float(system['height'][0]):g} m"
        text = f"{_BASES[str(system['below'].values[0])]}, {height}"
        if curves["curve_half_spaces"]:
            text = f"half-spaces (runs: {height})"
        axes.set_title(f"({letter}) {text}")
    panels[0].set_ylabel("Length over theory $L/L_c$")
    entries = style.entries(panels[0])
    entries[_SIMULATED] = style.key(_SIMULATED, "o", colour=style.BLACK)
    figure.legend(entries.values(), entries, loc="outside upper center", ncols=2)
    return figure


def _curves(table: xr.Dataset, system: xr.Dataset) -> xr.Dataset:
    """The theory's curves of a base and height."""
    same = np.ones(table.sizes["system"], dtype=bool)
    for name in ("study", "below", "height"):
        same &= table[f"curve_{name}"].values == system[name].values[0]
    return table.isel(system=np.flatnonzero(same)[0])


def _draw_system(axes: Axes, system: xr.Dataset, curves: xr.Dataset) -> None:
    """The lengths of one base and height."""
    for name, (label, colour, dashes) in _LINES.items():
        axes.plot(
            curves["curve_ratio"],
            curves[name],
            dashes,
            color=colour,
            label=label,
        )
    for fault in laws.groups(system.sortby("zeta_over_a"), "zeta_over_a"):
        simulated = (fault["length"] / fault["critical_length"]).values
        dropped = simulated[np.isfinite(simulated)]
        if dropped.size:
            look: style.Options = {"color": style.BLACK, "marker": "o", "markersize": 4.0}
            laws.draw_range(axes, fault["zeta_over_a"].values[0], dropped, **look)
    style.level(axes, 0.5, label="half of $L_c$")
    axes.set(xscale="log", xlabel=r"Weakening $\zeta/a$", xlim=(0.18, 7.0))
    axes.set(yscale="log", ylim=(0.4, 3.5))
    style.plain_numbers(axes.xaxis, _TICKS)
    style.plain_numbers(axes.yaxis, _RATIOS)


LOOKS = {
    "creep": ("creep", "o", style.BLUE),
    "slow slip": ("slow slip", "s", style.GREEN),
    "event": ("event", "^", style.VERMILLION),
    "undecided": ("undecided", "D", style.GUIDE),
}
"""Label, marker and colour of each outcome of a run."""

TICKS = (0.2, 0.5, 1.0, 2.3, 5.0)  # of zeta/a
APART = 0.08  # log of zeta/a over that of r, by which marks of one zeta/a are displaced


@style.styled
def draw_patches(table: xr.Dataset) -> Figure:
    """Draw outcomes of patches over zeta/a and W/W_c, one panel for each V, the largest first."""
    velocities = np.unique(table["velocity"])[::-1]
    figure, panels = style.panels(
        1,
        velocities.size,
        8.0,
        sharey=True,
        squeeze=False,
    )
    for axes, letter, velocity in zip(
        panels[0],
        "abcdefgh",
        velocities,
        strict=False,
    ):
        rows = laws.where(table, velocity=velocity)
        _draw_outcomes(axes, rows)
        rate = float(rows["dynamic_rate"][0])
        axes.set_title(rf"({letter}) $v_d$ = {rate:.3g} $V$")
    panels[0, 0].set_ylabel("Width of the patch $W/W_c$")
    entries = {
        label: style.key(label, marker, colour=colour, mfc="none")
        for label, marker, colour in LOOKS.values()
    }
    entries["other $a$"] = style.key("other $a$", "o", colour=style.GUIDE)
    figure.legend(
        entries.values(),
        entries,
        loc="outside upper center",
        ncols=len(entries),
    )
    return figure


def _draw_outcomes(axes: Axes, rows: xr.Dataset) -> None:
    """The runs with one V; filled where the surroundings have another a."""
    style.level(axes, 1.0)
    for name, (_, marker, colour) in LOOKS.items():
        for varies, face in (("zeta", "none"), ("a", colour)):
            own = laws.where(rows, outcome=name, varies=varies)
            place = own["zeta_over_a"] * own["strengthening"] ** APART
            axes.plot(
                place,
                own["width_ratio"],
                marker,
                color=colour,
                mfc=face,
                ls="none",
            )
    axes.set(xscale="log", xlabel=r"Weakening of the patch $\zeta/a$")
    style.plain_numbers(axes.xaxis, TICKS)
