"""The crosscheck: the same runs by the project's solver and by FreeFem++, side by side."""

from collections.abc import Sequence

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ...analysis.definitions import ExtractionSettings
from ...analysis.record import Record
from ...figures import style
from ...model.parameters import Parameters
from ...verification.crosscheck import plan

OWN, FREEFEM = style.BLACK, style.VERMILLION
KILO = 1e3
PERCENT = 1e2
DASHES = (0, (3.0, 2.0))  # of FreeFem++, over the other solver's line
FIRST = 0.5  # s; before, the patch has few elements
LARGEST_DIFFERENCE = 8.0  # per cent, shown


@style.styled
def draw(
    pairs: Sequence[tuple[xr.Dataset, xr.Dataset]],
    table: xr.Dataset,
    settings: ExtractionSettings = ExtractionSettings(),
) -> Figure:
    """Draw L(t), the driving force and their relative differences, one column for each run.

    The column of two blocks says in a legend of its own what the lower one is.

    Parameters
    ----------
    pairs : sequence
        Of the records of a run by the project's solver and by FreeFem++: ``slip_rate(time, x)``
        (m/s), ``driving_force(step)`` (N/m), and the attribute ``parameters``.
    table : Dataset
        On ``run``, in the same order: ``onset_time`` and ``onset_time_freefem`` (s), ``length``
        and ``length_freefem`` (m).
    settings : ExtractionSettings
        The slip rate at the edge of the patch.

    Returns
    -------
    Figure
        Two columns wide.
    """
    figure = style.new_figure(style.DOUBLE_COLUMN, 13.2 * style.CENTIMETRE)
    panels = figure.subplots(
        3, len(pairs), sharex="col", squeeze=False, height_ratios=(1.35, 1.35, 1.0)
    )
    for i, (column, (own, freefem)) in enumerate(zip(panels.T, pairs, strict=True)):
        records, row = (Record(own, settings), Record(freefem, settings)), table.isel(run=i)
        lengths = [(run.time, run.lengths) for run in records]
        forces = [
            (run["step_time"].values, -run["driving_force"].values / KILO) for run in (own, freefem)
        ]
        _draw_both(column[0], lengths, row, "length")
        _draw_both(column[1], forces, row)
        _draw_differences(column[2], lengths, forces, row)
        title, below = described(records[0].parameters)
        column[0].set_title(title, pad=3.0)
        if below:
            place = "center" if "top" in below else "lower right"
            column[0].legend([], [], title=below, title_fontsize=style.SMALL, loc=place)
        column[2].set_xlabel("Time $t$ (s)")
    _label(panels)
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


def _draw_both(
    axes: Axes,
    curves: Sequence[tuple[np.ndarray, np.ndarray]],
    row: xr.Dataset,
    marked: str | None = None,
) -> None:
    """Both solvers' curves; open marks at the onsets if the table has the value there."""
    kinds = (
        ("", OWN, "-", 1.5, "this project", "o"),
        ("_freefem", FREEFEM, DASHES, 1.1, "FreeFem++", "s"),
    )
    for (time, values), (end, colour, dashes, width, name, marker) in zip(
        curves, kinds, strict=True
    ):
        axes.plot(time, values, color=colour, linestyle=dashes, linewidth=width, label=name)
        if marked:
            axes.plot(
                row[f"onset_time{end}"], row[f"{marked}{end}"], marker, color=colour,
                markerfacecolor="white", markersize=4.5,
            )  # fmt: skip
    axes.set_xlim(0.0, 1.02 * max(time[-1] for time, _ in curves))
    axes.set_ylim(0.0, None)
    axes.minorticks_on()


def _draw_differences(
    axes: Axes,
    lengths: Sequence[tuple[np.ndarray, np.ndarray]],
    forces: Sequence[tuple[np.ndarray, np.ndarray]],
    row: xr.Dataset,
) -> None:
    """FreeFem++ over this project, minus one, up to the earlier onset."""
    end = min(float(row["onset_time"]), float(row["onset_time_freefem"]))
    time = np.linspace(FIRST, end, 1500)
    for curves, colour, name in (
        (lengths, style.GREEN, "$L(t)$"),
        (forces, style.BLUE, "$f_d(t)$"),
    ):
        own, freefem = (np.interp(time, *curve) for curve in curves)
        own[own == 0.0] = np.nan  # no patch yet
        axes.plot(time, PERCENT * (freefem / own - 1.0), color=colour, linewidth=0.9, label=name)
    axes.axhline(0.0, color=style.GUIDE, linewidth=0.6, zorder=0)
    axes.set_ylim(-LARGEST_DIFFERENCE, LARGEST_DIFFERENCE)
    axes.minorticks_on()


def _label(panels: np.ndarray) -> None:
    """Names of the axes in the first column, legends in it, panel letters."""
    names = ("Patch length $L$ (m)", "Applied force $-f_d$ (kN/m)", "Difference (%)")
    for axes, name in zip(panels[:, 0], names, strict=True):
        axes.set_ylabel(name)
    panels[0, 0].legend(loc="lower right")
    panels[2, 0].legend(loc="lower left", ncols=2, columnspacing=1.0, handlelength=1.0)
    for axes, letter in zip(panels.flat, "abcdefghijklmnopqrstuvwxyz", strict=False):
        axes.set_title(f"({letter})", loc="left", pad=3.0)
    figure = panels[0, 0].figure
    figure.align_ylabels(panels[:, 0])


def draw_runs(
    ids: Sequence[str], own: Sequence[xr.Dataset], freefem: Sequence[xr.Dataset],
    table: xr.Dataset, settings: ExtractionSettings,
) -> Figure:  # fmt: skip
    """The step ``draw_figure_crosscheck``: all runs but the one that times steps."""
    shown = [i for i, name in enumerate(ids) if name != plan.TIMING]
    records = [(own[i], freefem[i]) for i in shown]
    return draw(records, table.isel(run=np.array(shown)), settings)
