"""The crosscheck: the same runs by the project's solver and by FreeFem++, side by side."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from nucleation.extraction.definitions import ExtractionSettings
from nucleation.extraction.record import Record
from nucleation.model.parameters import Parameters
from nucleation.pictures import style
from nucleation.types import Array

_KILO = 1e3
_PERCENT = 1e2
_FIRST = 0.5  # s; before, the patch has few elements
_LARGEST_DIFFERENCE = 8.0  # per cent, shown
_OWN: style.Options = {"color": style.BLACK, "lw": 1.5, "label": "this project"}
_FREEFEM: style.Options = {
    "color": style.VERMILLION,
    "ls": (0, (3, 2)),
    "lw": 1.1,
    "label": "FreeFem++",
}
_SOLVERS = (("", _OWN, "o"), ("_freefem", _FREEFEM, "s"))
"""Suffix of the columns, line, and mark of the onset."""

_Curves = list[tuple[Array, Array]]
"""Time (s) and a quantity, by this project and by FreeFem++."""


@style.styled
def draw(
    own: Sequence[xr.Dataset],
    freefem: Sequence[xr.Dataset],
    table: xr.Dataset,
    settings: ExtractionSettings,
) -> Figure:
    """Draw L(t), the driving force and their relative differences, one column for each run.

    The column of two blocks has a legend that describes the lower one.

    Parameters
    ----------
    own, freefem : sequence of Dataset
        Their records by the project's solver and by FreeFem++: ``slip_rate(time, x)`` (m/s),
        ``driving_force(step)`` (N/m), and the attribute ``parameters``.
    table : Dataset
        On ``run``, in the same order: ``onset_time`` and ``onset_time_freefem`` (s), ``length``
        and ``length_freefem`` (m).
    settings : ExtractionSettings
        Definition of the patch's edge.

    Returns
    -------
    Figure
        Three panels for each run.
    """
    figure, panels = style.panels(
        3, len(own), 13.2, sharex="col", squeeze=False, height_ratios=(1.35, 1.35, 1.0)
    )
    for i, column in enumerate(panels.T):
        _draw_column(column, (own[i], freefem[i]), table.isel(run=i), settings)
    names = ("Patch length $L$ (m)", "Applied force $-f_d$ (kN/m)", "Difference (%)")
    for axes, name in zip(panels[:, 0], names, strict=True):
        axes.set_ylabel(name)
    panels[0, 0].legend(loc="lower right")
    panels[2, 0].legend(
        loc="lower left",
        ncols=2,
        columnspacing=1.0,
        handlelength=1.0,
    )
    style.letters(*panels.flat, minor=True, pad=3.0)
    figure.align_ylabels(panels[:, 0])
    return figure


def _draw_column(
    panels: Sequence[Axes],
    runs: tuple[xr.Dataset, xr.Dataset],
    row: xr.Dataset,
    settings: ExtractionSettings,
) -> None:
    length, force, difference = panels
    records = [Record(run, settings) for run in runs]
    lengths = [(record.time, record.lengths) for record in records]
    forces = [(run["step_time"].values, -run["driving_force"].values / _KILO) for run in runs]
    for axes, curves in ((length, lengths), (force, forces)):
        for (time, values), (_, line, _) in zip(curves, _SOLVERS, strict=True):
            axes.plot(time, values, **line)
        axes.set_xlim(0.0, 1.02 * max(time[-1] for time, _ in curves))
        axes.set_ylim(0.0, None)
    for suffix, line, marker in _SOLVERS:
        onset = row[f"onset_time{suffix}"]
        onset_length = row[f"length{suffix}"]
        length.plot(onset, onset_length, marker, color=line["color"], ms=4.5, **style.OPEN)
    _draw_differences(difference, lengths, forces, row)
    title, below = _described(records[0].parameters)
    length.set_title(title, loc="center", pad=3.0)
    if below:
        look: style.Options = {"title_fontsize": style.SMALL, "loc": "lower right"}
        length.legend([], [], title=below, **look)


def _described(parameters: Parameters) -> tuple[str, str]:
    """The title of a run's column, and a description of a pair's lower block."""
    height = parameters.geometry.height
    below = parameters.below
    if below is None:
        return f"$H={height:g}$ m", ""
    second = below.geometry.height
    heights = f"{height:g}$ m" if second == height else f"{height:g}$ on {second:g} m"
    ratio = below.material.shear_modulus / parameters.material.shear_modulus
    return (f"$H={heights}", f"two blocks,\nlower {below.far_side},\n$\\mu_2={ratio:.3g}\\,\\mu$")


def _draw_differences(
    axes: Axes,
    lengths: _Curves,
    forces: _Curves,
    row: xr.Dataset,
) -> None:
    """FreeFem++ over this project, minus one, up to the earlier onset."""
    end = min(float(row["onset_time"]), float(row["onset_time_freefem"]))
    time = np.linspace(_FIRST, end, 1500)
    kinds = ((lengths, style.GREEN, "$L(t)$"), (forces, style.BLUE, "$f_d(t)$"))
    for curves, colour, name in kinds:
        own, freefem = (np.interp(time, *curve) for curve in curves)
        own[own == 0.0] = np.nan  # no patch yet
        difference = _PERCENT * (freefem / own - 1.0)
        axes.plot(time, difference, color=colour, linewidth=0.9, label=name)
    style.level(axes, 0.0, width=0.6, zorder=0)
    axes.set(ylim=(-_LARGEST_DIFFERENCE, _LARGEST_DIFFERENCE), xlabel="Time $t$ (s)")
