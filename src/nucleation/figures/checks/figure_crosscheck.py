"""The crosscheck: the same runs by the project's solver and by FreeFem++, side by side."""

from collections.abc import Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...analysis.definitions import ExtractionSettings
from ...analysis.record import Record
from ...figures import style
from ...model.parameters import Parameters

KILO = 1e3
PERCENT = 1e2
FIRST = 0.5  # s; before, the patch has few elements
LARGEST_DIFFERENCE = 8.0  # per cent, shown
OWN: Any = {"color": style.BLACK, "lw": 1.5, "label": "this project"}
FREEFEM: Any = {"color": style.VERMILLION, "ls": (0, (3, 2)), "lw": 1.1, "label": "FreeFem++"}
SOLVERS = (("", OWN, "o"), ("_freefem", FREEFEM, "s"))
"""End of a column's name, line, and mark of the onset."""

Curves = list[tuple[np.ndarray, np.ndarray]]


@style.styled
def draw(
    own: Sequence[xr.Dataset],
    freefem: Sequence[xr.Dataset],
    table: xr.Dataset,
    settings: ExtractionSettings,
) -> Figure:
    """Draw L(t), the driving force and their relative differences, one column for each run.

    The column of two blocks says in a legend of its own what
    the lower one is.

    Parameters
    ----------
    own, freefem : sequence of Dataset
        Their records by the project's solver and by FreeFem++: ``slip_rate(time, x)`` (m/s),
        ``driving_force(step)`` (N/m), and the attribute ``parameters``.
    table : Dataset
        On ``run``, in the same order: ``onset_time`` and ``onset_time_freefem`` (s), ``length``
        and ``length_freefem`` (m).
    settings : ExtractionSettings
        The slip rate at the edge of the patch.
    """
    layout: Any = {"sharex": "col", "squeeze": False, "height_ratios": (1.35, 1.35, 1.0)}
    figure, panels = style.panels(3, len(own), 13.2, **layout)
    for i, (length, force, difference) in enumerate(panels.T):
        runs, row = (own[i], freefem[i]), table.isel(run=i)
        records = [Record(run, settings) for run in runs]
        lengths = [(record.time, record.lengths) for record in records]
        forces = [(run["step_time"].values, -run["driving_force"].values / KILO) for run in runs]
        for axes, curves in ((length, lengths), (force, forces)):
            for (time, values), (_, line, _) in zip(curves, SOLVERS, strict=True):
                axes.plot(time, values, **line)
            axes.set_xlim(0.0, 1.02 * max(time[-1] for time, _ in curves))
            axes.set_ylim(0.0, None)
        for end, line, marker in SOLVERS:
            onset = row[f"onset_time{end}"], row[f"length{end}"]
            length.plot(*onset, marker, color=line["color"], ms=4.5, **style.OPEN)
        _draw_differences(difference, lengths, forces, row)
        title, below = described(records[0].parameters)
        length.set_title(title, pad=3.0)
        if below:
            place = "center" if "top" in below else "lower right"
            length.legend([], [], title=below, title_fontsize=style.SMALL, loc=place)
    names = ("Patch length $L$ (m)", "Applied force $-f_d$ (kN/m)", "Difference (%)")
    for axes, name in zip(panels[:, 0], names, strict=True):
        axes.set_ylabel(name)
    panels[0, 0].legend(loc="lower right")
    panels[2, 0].legend(loc="lower left", ncols=2, columnspacing=1.0, handlelength=1.0)
    style.letters(*panels.flat, minor=True, pad=3.0)
    figure.align_ylabels(panels[:, 0])
    return figure


def described(parameters: Parameters) -> tuple[str, str]:
    """What a run is: the title of its column, and what a pair's lower block is, if there is one."""
    height, below = parameters.geometry.height, parameters.below
    if below is None:
        return f"$H={height:g}$ m", ""
    second = below.geometry.height
    heights = f"{height:g}$ m" if second == height else f"{height:g}$ on {second:g} m"
    if parameters.loading.kind == "top":
        return f"$H={heights}", "two blocks,\nmoved at\nthe top"
    ratio = below.material.shear_modulus / parameters.material.shear_modulus
    return f"$H={heights}", f"two blocks,\nlower {below.bottom},\n$\\mu_2={ratio:.3g}\\,\\mu$"


def _draw_differences(axes: Axes, lengths: Curves, forces: Curves, row: xr.Dataset) -> None:
    """FreeFem++ over this project, minus one, up to the earlier onset."""
    end = min(float(row["onset_time"]), float(row["onset_time_freefem"]))
    time = np.linspace(FIRST, end, 1500)
    kinds = ((lengths, style.GREEN, "$L(t)$"), (forces, style.BLUE, "$f_d(t)$"))
    for curves, colour, name in kinds:
        own, freefem = (np.interp(time, *curve) for curve in curves)
        own[own == 0.0] = np.nan  # no patch yet
        axes.plot(time, PERCENT * (freefem / own - 1.0), color=colour, linewidth=0.9, label=name)
    style.level(axes, 0.0, width=0.6, zorder=0)
    axes.set(ylim=(-LARGEST_DIFFERENCE, LARGEST_DIFFERENCE), xlabel="Time $t$ (s)")
