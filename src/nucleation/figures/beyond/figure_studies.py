"""Any study's lengths: simulations against theory over what the study varies."""

import textwrap
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib import ticker
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ...figures import style
from ...model.quantities import Quantity
from ...types import Array
from ..beyond import figure_sensitivity

Values = dict[str, list[float] | list[str]]
Curves = Mapping[str, Mapping[str, Sequence[float]]]

DASHES = ("-", "--", "-.", ":")
"""Of the theory's curves, by the words of a study."""

FEW = 6
"""Faults of which each has its own marker where no number is an axis."""

WIDE = 4.0
"""Ratio of the largest to the smallest value from which an axis is logarithmic."""

SYMBOLS = figure_sensitivity.SYMBOLS | {
    "zeta/a": r"\zeta/a", "zeta": r"\zeta", "D": "D",
    "v*": "v_*", "v0": "v_0", "phi*": r"\phi_*", "theta": r"\theta",
    "xi": r"\xi",
}  # fmt: skip

WORDS = {
    "phi0": "initial state", "zeta_over_a": "weakening over direct effect",
    "n_x": "elements along x", "n_y": "elements along y",
}  # fmt: skip
"""Names of parameters whose name in studies is a symbol."""

RATIO_MAP = "cividis"  # made to look alike to all colour vision

STRIP = 0.09
"""Height of the strip of runs without an event, which have no place on the axis of lengths."""


@style.styled
def draw(
    table: xr.Dataset, varied: Values, entries: dict[str, Quantity],
    theory: Curves | None = None,
) -> Figure:  # fmt: skip
    """Draw one study: a curve, two maps, or points about equality, by what it varies.

    Parameters
    ----------
    table : Dataset
        The study's table of lengths, see :func:`nucleation.analysis.lengths.gather`.
    varied : dict
        Each parameter of which the study has several values, with its value in every run, in the
        order of the table.
    entries : dict
        Declarations of these parameters.
    theory : mapping
        With one number varied, by the words of the runs: the number (``x``) and the theory's
        lengths there (``length``, m), closely spaced. Without, the theory is drawn from run to run.

    Returns
    -------
    Figure
        Critical lengths in m. With one number varied: simulations with error bars and theory over
        it; with two on a full grid: maps of the length and of its ratio to the theory's; otherwise
        simulations against theory, with what is varied above. Words, such as the evolution law,
        tell markers apart. Runs without an event stand in a strip of their own, counted.
    """
    numbers = [name for name, entry in entries.items() if not entry.choices]
    words = [name for name in entries if name not in numbers]
    if len(numbers) == 2 and not words:
        grid = [np.unique(varied[name]) for name in numbers]
        if grid[0].size * grid[1].size == table.sizes["run"]:
            return _maps(table, varied, entries, numbers, grid)
    figure = style.new_figure(style.SINGLE_COLUMN, 0.85 * style.SINGLE_COLUMN)
    quiet = ~np.isfinite(table["length"].values)
    axes, strip = _axes(figure, int(quiet.sum()), quiet.size)
    if len(numbers) == 1:
        across = np.asarray(varied[numbers[0]], dtype=float)
    else:
        across = table["theory_length"].values
    told = words if len(numbers) == 1 else [*words, *_telling(varied, words, numbers)]
    kinds = _kinds(varied, told, entries, table.sizes["run"])
    if len(numbers) == 1:
        given = theory or {}
        _curves(axes, {kind: given.get(kind, _between(table.isel(run=chosen), across[chosen]))
                       for kind, chosen in kinds})  # fmt: skip
    for i, (kind, chosen) in enumerate(kinds):
        look = style.look(i)
        part, x = table.isel(run=chosen), across[chosen]
        _points(axes, part, x, kind, look)
        if strip is not None:
            lost = x[quiet[chosen]]
            strip.plot(lost, np.zeros(lost.size), look[0], color=look[1], mfc="white")
    if len(numbers) == 1:
        (strip or axes).set_xlabel(label(numbers[0], entries[numbers[0]]))
        _scale(axes, "x", across)
    else:
        _equality(axes, table)
        (strip or axes).set_xlabel("Theory's critical length (m)")
        if varied:
            axes.set_title(textwrap.fill(f"varied: {', '.join(map(named, entries))}", 48),
                           loc="left", fontsize=style.SMALL)  # fmt: skip
    axes.set_ylabel("Critical length $L_c$ (m)")
    if _lengths(table).size:
        _scale(axes, "y", _lengths(table))
    axes.legend()
    return figure


def _axes(figure: Figure, quiet: int, runs: int) -> tuple[Axes, Axes | None]:
    """Axes of lengths; below a strip of the runs without an event, if there are any."""
    if not quiet:
        return figure.subplots(), None
    axes, strip = figure.subplots(2, 1, sharex=True, height_ratios=[1.0, STRIP])
    strip.set_yticks([0.0], [f"no event\n({quiet} of {runs})"], fontsize=style.SMALL)
    strip.set_ylim(-1.0, 1.0)
    strip.tick_params(which="both", left=False, right=False, top=False)
    return axes, strip


def named(name: str) -> str:
    """A parameter's name in words, as within a sentence."""
    words = WORDS.get(name, name.rpartition(".")[2].replace("_", " "))
    return words[0].lower() + words[1:]


def label(name: str, entry: Quantity) -> str:
    """Name, symbol and unit of a parameter, from its declaration."""
    words = named(name)
    words = words[0].upper() + words[1:]
    symbol = SYMBOLS.get(entry.symbol, entry.symbol)
    text = f"{words} ${symbol}$" if symbol else words
    return text if entry.unit == "1" else f"{text} ({entry.unit})"


def _telling(varied: Values, words: list[str], numbers: list[str]) -> list[str]:
    """The first numbers that tell faults apart, none if there are more than :data:`FEW`."""

    def faults(names: list[str]) -> int:
        return len(set(zip(*(varied[name] for name in (*words, *names)), strict=True)))

    if not numbers or faults(numbers) > FEW:
        return []
    enough = (n for n in range(len(numbers)) if faults(numbers[:n]) == faults(numbers))
    return numbers[: next(enough, len(numbers))]


def _kinds(
    varied: Values, names: list[str], entries: dict[str, Quantity], runs: int
) -> list[tuple[str, NDArray[np.intp]]]:
    """Runs by some of what is varied: a label and the runs' indices."""

    def said(name: str, value: float | str) -> str:
        entry = entries[name]
        if isinstance(value, str):
            return value
        symbol = SYMBOLS.get(entry.symbol, entry.symbol)
        text = f"${symbol}={value:.4g}$" if symbol else f"{named(name)} {value:.4g}"
        return text if entry.unit == "1" else f"{text} {entry.unit}"

    given = [[(name, varied[name][i]) for name in names] for i in range(runs)]
    marks = [", ".join(said(*one) for one in row if one[1] is not None) for row in given]
    return [
        (mark, np.array([i for i in range(runs) if marks[i] == mark]))
        for mark in dict.fromkeys(marks)
    ]


def _lengths(table: xr.Dataset) -> Array:
    """Every length of a table that is a number (m)."""
    names = ("length", "length_low", "length_high", "theory_length")
    values = np.concatenate([table[name].values for name in names])
    return values[np.isfinite(values)]


def _wide(values: Array) -> bool:
    """Whether values are shown on a logarithmic axis."""
    return bool(values.min() > 0.0 and values.max() > WIDE * values.min())


def _scale(axes: Axes, which: str, values: Array) -> None:
    """The scale of an axis, with plain numbers at its ticks where there would be few."""
    if _wide(values):
        axis = {"x": axes.xaxis, "y": axes.yaxis}[which]
        axes.set(**{f"{which}scale": "log"})
        if values.max() < 100.0 * values.min():
            axis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
            axis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
            axis.set_minor_formatter(ticker.NullFormatter())


def _between(part: xr.Dataset, x: Array) -> Mapping[str, Array]:
    """The theory's lengths of some runs, in the order of a number."""
    order = np.argsort(x, kind="stable")
    return {"x": x[order], "length": part["theory_length"].values[order]}


def _curves(axes: Axes, theory: Mapping[str, Mapping[str, Sequence[float] | Array]]) -> None:
    """The theory over one number, by the words of the runs; once if it is the same for all."""
    first = next(iter(theory.values()))
    if all(np.array_equal(curve[n], first[n]) for curve in theory.values() for n in first):
        theory = {"": first}
    for i, (kind, curve) in enumerate(theory.items()):
        axes.plot(
            curve["x"], curve["length"], DASHES[i % len(DASHES)], color=style.THEORY,
            label=f"theory, {kind}" if kind else "theory",
        )  # fmt: skip


def _points(axes: Axes, part: xr.Dataset, x: Array, kind: str, look: tuple[str, str]) -> None:
    """Simulations with their error bars."""
    marker, colour = look
    length = part["length"].values
    event = np.isfinite(length)
    bars = np.abs(np.stack([part["length_low"].values, part["length_high"].values]) - length)
    if event.any():
        axes.errorbar(
            x[event], length[event], bars[:, event], fmt=marker, color=colour, markersize=4.0,
            elinewidth=0.8, label=f"simulation, {kind}" if kind else "simulation",
        )  # fmt: skip


def _equality(axes: Axes, table: xr.Dataset) -> None:
    """The line of equality, over the lengths of the theory and those of simulations."""
    values = _lengths(table)
    if values.size:
        ends = [0.95 * values.min(), 1.05 * values.max()]
        axes.plot(ends, ends, color=style.GUIDE, linewidth=0.8, label="equality")
        _scale(axes, "x", values)


def _maps(
    table: xr.Dataset, varied: Values, entries: dict[str, Quantity], names: list[str],
    axes: list[Array],
) -> Figure:  # fmt: skip
    """Maps of the length and of its ratio to the theory's over two numbers."""
    x, y = (np.asarray(varied[name], dtype=float) for name in names)
    at = np.searchsorted(axes[1], y), np.searchsorted(axes[0], x)
    figure = style.new_figure(style.DOUBLE_COLUMN, 0.42 * style.DOUBLE_COLUMN)
    left, right = figure.subplots(1, 2, sharex=True, sharey=True)
    length = table["length"].values
    for panel, values, title, colours in (
        (left, length, "(a) Critical length of simulations (m)", style.SEQUENCE),
        (right, length / table["theory_length"].values, "(b) Simulations over theory", RATIO_MAP),
    ):
        image = np.full((axes[1].size, axes[0].size), np.nan)
        image[at] = values
        mesh = panel.pcolormesh(*_edges(axes), np.ma.masked_invalid(image), cmap=colours)
        lost = ~np.isfinite(length)
        panel.plot(
            x[lost], y[lost], "x", color=style.VERMILLION,
            label=f"no event ({lost.sum()} of {lost.size})",
        )  # fmt: skip
        figure.colorbar(mesh, ax=panel, pad=0.02)
        panel.set_title(title, loc="left")
        panel.set_xlabel(label(names[0], entries[names[0]]))
        _scale(panel, "x", axes[0])
        _scale(panel, "y", axes[1])
        panel.tick_params(which="both", direction="out", top=False, right=False)
    if lost.any():
        left.legend(frameon=True, framealpha=1.0)
    left.set_ylabel(label(names[1], entries[names[1]]))
    return figure


def _edges(axes: list[Array]) -> list[Array]:
    """Borders of cells about values, between neighbours in the axis's own scale."""
    found = []
    for values in axes:
        log = _wide(values)
        places = np.log(values) if log else values
        middle = 0.5 * (places[1:] + places[:-1])
        ends = 2.0 * places[[0, -1]] - middle[[0, -1]]
        borders = np.concatenate([ends[:1], middle, ends[1:]])
        found.append(np.exp(borders) if log else borders)
    return found


def draw_study(
    table: xr.Dataset, varied: Values, entries: dict[str, dict[str, Any]], theory: Curves
) -> Figure:
    """The step ``draw_study``: :func:`draw` with plain declarations of what is varied."""
    declared = {name: Quantity(**entry) for name, entry in entries.items()}
    return draw(table, varied, declared, theory)
