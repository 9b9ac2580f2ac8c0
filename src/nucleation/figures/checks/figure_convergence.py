"""Refinement of mesh and steps, and why the drop waits on a finer mesh."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import xarray as xr
from matplotlib import colormaps
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import NullLocator

from ...figures import style

MILLI = 1e3
LOOKS = (("o", style.VERMILLION), ("s", style.BLUE), ("D", style.BLACK), ("^", style.GREEN))
SHORT_STEPS = {"fillstyle": "top", "markerfacecoloralt": "white", "linestyle": (0, (1.0, 1.2))}
"""How a sequence is drawn beside one of the same height with longer steps."""
SHOWN_TIME = (-5.0, 0.12)  # s about the onset
SHOWN_RATE = 1.25  # largest slip rate shown over V, above which curves would cross
SHIFT = 1.1  # between the curves of slip rate, over V
ORDER = 3  # of the scheme while the body is quasi-static
QUANTITIES = {
    "length_over_theory": "$L_c$ over the theory's",
    "onset_time_high": "Time of the drop $t$ (s)",
}
REFINED = {
    "n_x": "Elements along $x$",
    "n_y": "Elements along $y$",
    "longest_step": r"Longest step $\times V/D$",
    "tolerance": "Tolerance per step",
}


@style.styled
def draw(table: xr.Dataset, hops: Sequence[xr.Dataset], patch: xr.Dataset) -> Figure:
    """Draw length and time of the drop against refinement, and the hops of the front.

    Parameters
    ----------
    table : Dataset
        From :func:`nucleation.analysis.convergence.refinement_table`.
    hops : sequence of Dataset
        From :func:`nucleation.patch.hops.follow_hops`, of one height, from coarse to fine along x.
    patch : Dataset
        The stability of that height's patch: ``patch_length`` (m), ``oscillation_frequency``
        (1/s) on ``instant``, and ``stability_length`` (m).

    Returns
    -------
    Figure
        Two columns wide: lengths, times, and two rows on what makes the difference.
    """
    figure = style.new_figure(style.DOUBLE_COLUMN, 22.0 * style.CENTIMETRE)
    grid = figure.add_gridspec(4, 4)
    for row, (name, label) in enumerate(QUANTITIES.items()):
        panels: list[Axes] = []
        for i, (refined, meaning) in enumerate(REFINED.items()):
            shared = panels[0] if panels else None
            axes = figure.add_subplot(grid[row, i], sharey=shared)
            _draw_refinement(axes, table, refined, name)
            axes.tick_params(labelleft=not i, labelbottom=row == 1)
            axes.set_xlabel(meaning if row == 1 else "")
            panels.append(axes)
        panels[0].set_ylabel(label)
    _draw_slip_rates(figure.add_subplot(grid[2, :3]), hops)
    _draw_orders(figure.add_subplot(grid[2, 3]), table)
    _draw_amplitudes(figure.add_subplot(grid[3, :2]), hops)
    _draw_frequencies(figure.add_subplot(grid[3, 2:]), hops, patch)
    for axes, letter in zip(figure.axes, "abcdefghijkl", strict=True):
        axes.set_title(f"({letter})", loc="left")
    _add_legend(figure, table)
    return figure


def _sequences(table: xr.Dataset, refined: str) -> Iterator[tuple[xr.Dataset, float, int]]:
    """The sequences of one refined parameter, each with its height (m) and n_x."""
    rows = table.isel(run=np.flatnonzero(table["refinement"].values == refined))
    keys = ["height", *(name for name in REFINED if name != refined)]
    seen = dict.fromkeys(zip(*(rows[key].values.tolist() for key in keys), strict=True))
    for key in seen:
        of_it = np.all([rows[k].values == v for k, v in zip(keys, key, strict=True)], axis=0)
        sequence = rows.isel(run=np.flatnonzero(of_it))
        yield sequence, float(key[0]), int(sequence["n_x"].values.min())


def _looks(table: xr.Dataset) -> dict[float, tuple[str, str]]:
    """Marker and colour of each height."""
    heights = np.unique(table["height"].values).tolist()
    return {height: LOOKS[i % len(LOOKS)] for i, height in enumerate(heights)}


def _line(table: xr.Dataset, height: float, coarse: bool) -> dict[str, object]:
    """How a sequence is drawn: by its height, and open on the coarsest mesh along x."""
    marker, colour = _looks(table)[height]
    return {
        "marker": marker, "color": colour, "markersize": 4.0, "linewidth": 1.0,
        "linestyle": "--" if coarse else "-", "markerfacecolor": "white" if coarse else colour,
    }  # fmt: skip


def _step(sequence: xr.Dataset) -> float:
    """The longest step over D/V that the runs of a sequence have in common."""
    return float(sequence["longest_step"].values.max())


def _short_steps(table: xr.Dataset, refined: str) -> set[tuple[float, float]]:
    """Heights (m) and steps of sequences of which there is one with longer steps beside them."""
    if refined == "longest_step":
        return set()
    found = [(height, _step(runs)) for runs, height, _ in _sequences(table, refined)]
    longest: dict[float, float] = {}
    for height, step in found:
        longest[height] = max(longest.get(height, 0.0), step)
    return {(height, step) for height, step in found if step < longest[height]}


def _draw_refinement(axes: Axes, table: xr.Dataset, refined: str, name: str) -> None:
    """One measured quantity against what is refined."""
    coarsest, short = int(table["n_x"].values.min()), _short_steps(table, refined)
    axes.set_xscale("log")
    sizes: set[float] = set()
    for sequence, height, n_x in _sequences(table, refined):
        size = sequence[refined].values
        sizes.update(size.tolist())
        look = _line(table, height, refined != "n_x" and n_x == coarsest)
        if (height, _step(sequence)) in short:
            look |= SHORT_STEPS
        axes.plot(size, sequence[name].values, **look)
    axes.set_xticks(sorted(sizes), [_brief(size) for size in sorted(sizes)])
    axes.xaxis.set_minor_locator(NullLocator())
    if refined in ("longest_step", "tolerance"):
        axes.invert_xaxis()  # finer to the right, as in the other panels


def _brief(size: float) -> str:
    """A number for narrow axes, ``.04``."""
    return f"{size:g}".removeprefix("0")


def _draw_slip_rates(axes: Axes, hops: Sequence[xr.Dataset]) -> None:
    """Slip rate half-way along the last patch, curves of different meshes one above another."""
    for i, (run, colour) in enumerate(zip(hops, _shades(len(hops)), strict=True)):
        onset = float(run["onset_time"])
        time, rate = run["time"].values - onset, run["inner_slip_rate"].values
        scaled = rate / float(run["velocity"])
        shown = (time > SHOWN_TIME[0]) & (time < SHOWN_TIME[1]) & (scaled < SHOWN_RATE)
        axes.plot(time[shown], scaled[shown] + i * SHIFT, color=colour, linewidth=1.0)
        hop = run["hop_time"].values - onset
        hop = hop[hop > SHOWN_TIME[0]]
        axes.plot(
            hop, np.full(hop.size, i * SHIFT - 0.02), "|", color=colour, markersize=4.5,
            markeredgewidth=0.7,
        )  # fmt: skip
        axes.text(
            SHOWN_TIME[0] + 0.1, i * SHIFT + 0.72, f"$N_x={int(run['n_x'])}$", color=colour,
            fontsize=style.SMALL,
        )  # fmt: skip
    axes.set_xlim(*SHOWN_TIME)
    axes.set_ylim(-0.2, (len(hops) - 1) * SHIFT + SHOWN_RATE + 0.1)
    axes.set_xlabel("Time from the onset (s)")
    axes.set_ylabel("Slip rate $v/V$, shifted")


def _draw_amplitudes(axes: Axes, hops: Sequence[xr.Dataset]) -> None:
    """Amplitude of the slip rate's oscillation against time."""
    for run, colour in zip(hops, _shades(len(hops)), strict=True):
        amplitude = run["oscillation_amplitude"].values / float(run["velocity"])
        axes.plot(run["sample_time"].values, amplitude, color=colour, linewidth=1.0)
    axes.set_yscale("log")
    axes.set_xlabel("Time $t$ (s)")
    axes.set_ylabel("Oscillation of $v/V$")


def _draw_frequencies(axes: Axes, hops: Sequence[xr.Dataset], patch: xr.Dataset) -> None:
    """Frequency of the hops on each mesh, and the patch's own, against the patch's length."""
    for run, colour in zip(hops, _shades(len(hops)), strict=True):
        axes.plot(
            run["hop_length"].values, run["hop_frequency"].values, color=colour,
        )  # fmt: skip
    own = patch["oscillation_frequency"].values
    seen = own > 0.0  # a short patch has no oscillating mode
    axes.plot(
        patch["patch_length"].values[seen], own[seen], ".", color=style.BLACK, markersize=2.0,
        rasterized=True,
    )  # fmt: skip
    axes.axvline(float(patch["stability_length"]), color=style.GUIDE, linewidth=0.8, linestyle=":")
    axes.text(0.96, 0.05, "the patch's own", transform=axes.transAxes, ha="right",
              fontsize=style.SMALL)  # fmt: skip
    axes.set_yscale("log")
    axes.set_ylim(5.0, 300.0)
    axes.set_yticks([10.0, 100.0], ["10", "100"])
    axes.set_xlabel("Patch length $L$ (m)")
    axes.set_ylabel("Angular frequency (1/s)")


def _draw_orders(axes: Axes, table: xr.Dataset) -> None:
    """Change of the drop's time with each refinement of the step."""
    coarsest, largest = int(table["n_x"].values.min()), 0.0
    steps: set[float] = set()
    for sequence, height, n_x in _sequences(table, "longest_step"):
        step = sequence["longest_step"].values[1:]
        change = np.abs(sequence["drop_time_change"].values[1:])
        axes.plot(step, change, **_line(table, height, n_x == coarsest))
        steps.update(step.tolist())
        if n_x == coarsest:
            largest = max(largest, float(change[0]))
    axes.set_xscale("log")
    axes.set_yscale("log")
    if steps:
        ends = np.array([max(steps) / 4, max(steps)])
        guide = 3.0 * largest * (ends / ends[1]) ** ORDER
        axes.plot(ends, guide, ":", color=style.GUIDE)
        axes.text(
            ends[0], guide[0], f"slope {ORDER} ", color=style.GUIDE, fontsize=style.SMALL,
            ha="left", va="bottom",
        )  # fmt: skip
        axes.set_xticks(sorted(steps), [_brief(step) for step in sorted(steps)])
    axes.xaxis.set_minor_locator(NullLocator())
    axes.invert_xaxis()
    axes.set_xlabel(REFINED["longest_step"])
    axes.set_ylabel("Change of the drop's time (s)")


def _shades(number: int) -> list[tuple[float, ...]]:
    """Colours of meshes, from coarse to fine."""
    return [colormaps[style.SEQUENCE](0.85 * i / max(number - 1, 1)) for i in range(number)]


def _add_legend(figure: Figure, table: xr.Dataset) -> None:
    """Heights, and open markers for the coarsest mesh along x."""
    axes = figure.axes[1]
    handles = [
        axes.plot([], [], label=f"$H={height:g}$ m", **_line(table, height, False))[0]
        for height in _looks(table)
    ]
    guide = {"color": style.GUIDE, "marker": "o", "markersize": 4.0, "linewidth": 1.0}
    coarsest = int(table["n_x"].values.min())
    handles += axes.plot([], [], label=f"on $N_x={coarsest}$", linestyle="--",
                         markerfacecolor="white", **guide)  # fmt: skip
    steps = {step for refined in REFINED for _, step in _short_steps(table, refined)}
    if steps:
        words = " and ".join(f"{step:g}" for step in sorted(steps))
        label = f"steps of {words} $D/V$"
        handles += axes.plot([], [], label=label, **guide | SHORT_STEPS)
    figure.legend(
        handles=handles, loc="outside upper center", ncols=len(handles), columnspacing=1.2
    )
