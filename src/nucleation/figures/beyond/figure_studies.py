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

from ...figures import laws, style
from ...model.quantities import Quantity
from ...types import Array
from ..beyond import figure_sensitivity

Values = dict[str, list[float] | list[str]]
Curves = Mapping[str, Mapping[str, Sequence[float] | Array]]

DASHES = ("-", "--", "-.", ":")  # of the theory's curves, by the words of a study
FEW_ROWS = 2  # values of one of two numbers up to which each is a curve, not a row of a map
FEW = 6  # faults of which each has its own marker where no number is an axis
WIDE = 4.0  # ratio of the largest to the smallest value from which an axis is logarithmic
STRIP = 0.09  # height of the strip of runs without an event, which have no length
RATIO_MAP = "cividis"  # made to look alike to all colour vision

GREEK = {"zeta/a": r"\zeta/a", "zeta": r"\zeta", "phi*": r"\phi_*", "theta": r"\theta"}
SYMBOLS = figure_sensitivity.SYMBOLS | GREEK | {"v*": "v_*", "v0": "v_0", "xi": r"\xi"}

WORDS = {
    "phi0": "initial state",
    "zeta_over_a": "weakening over direct effect",
    "n_x": "elements along x",
    "n_y": "elements along y",
}
"""Names of parameters whose name in studies is a symbol."""


@style.styled
def draw(
    table: xr.Dataset, varied: Values, entries: dict[str, Quantity], theory: Curves | None = None
) -> Figure:
    """Draw one study: a curve, two maps, or points about equality, by what it varies.

    With one number varied: lengths (m) over it; with two on a full grid: a curve for each of two
    values, or maps of the length and of its ratio to the theory's; otherwise simulations against
    theory, with what is varied above. Words, such as the evolution law, tell markers apart. Runs
    without an event stand in a strip of their own, counted.

    Parameters
    ----------
    table : Dataset
        The study's table of lengths, see :func:`nucleation.analysis.lengths.lengths_table`.
    varied : dict
        Each parameter of which the study has several values, with its value in every run, in the
        order of the table.
    entries : dict
        Declarations of these parameters.
    theory : mapping
        With one number varied, by the words of the runs: the number (``x``) and the theory's
        lengths there (``length``, m), closely spaced. Without, the theory is drawn from run to run.
    """
    numbers = [name for name, entry in entries.items() if not entry.choices]
    words = [name for name in entries if name not in numbers]
    if len(numbers) == 2 and not words:
        grid = {name: np.unique(varied[name]) for name in numbers}
        along, other = sorted(numbers, key=lambda name: -grid[name].size)
        if grid[along].size * grid[other].size == table.sizes["run"]:
            if grid[other].size > FEW_ROWS:
                return _maps(table, varied, entries, numbers, list(grid.values()))
            numbers, words = [along], [other]
    figure = style.new_figure(style.SINGLE_COLUMN, 0.85 * style.SINGLE_COLUMN)
    quiet = ~np.isfinite(table["length"].values)
    axes, strip = _axes(figure, int(quiet.sum()), quiet.size)
    over = len(numbers) == 1
    across = np.asarray(varied[numbers[0]] if over else table["theory_length"], dtype=float)
    told = words if over else [*words, *_telling(varied, words, numbers)]
    kinds = _kinds(varied, told, entries, table.sizes["run"])
    if over:
        given = theory or {}
        _curves(axes, {kind: given.get(kind, _between(table, across, own)) for kind, own in kinds})
    for i, (kind, own) in enumerate(kinds):
        marker, colour = style.look(i)
        happened, lost = own[~quiet[own]], across[own[quiet[own]]]
        if happened.size:
            label = f"simulation, {kind}" if kind else "simulation"
            look: Any = {"marker": marker, "color": colour, "ms": 4.0, "label": label}
            laws.draw(axes, across[happened], table.isel(run=happened), "length", **look)
        if strip is not None:
            strip.plot(lost, np.zeros(lost.size), marker, color=colour, **style.OPEN)
    (strip or axes).set_xlabel(
        label_of(numbers[0], entries[numbers[0]]) if over else "Theory's critical length (m)"
    )
    lengths = _lengths(table)
    if not over and varied:
        title = textwrap.fill(f"varied: {', '.join(map(named, entries))}", 48)
        axes.set_title(title, loc="left", fontsize=style.SMALL)
    if not over and lengths.size:
        ends = [0.95 * lengths.min(), 1.05 * lengths.max()]
        axes.plot(ends, ends, color=style.GUIDE, linewidth=0.8, label="equality")
    _scale(axes, "x", across if over else lengths)
    axes.set_ylabel("Critical length $L_c$ (m)")
    _scale(axes, "y", lengths)
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


def label_of(name: str, entry: Quantity) -> str:
    """Name, symbol and unit of a parameter, from its declaration."""
    words = named(name)
    symbol = SYMBOLS.get(entry.symbol, entry.symbol)
    text = words[0].upper() + words[1:] + (f" ${symbol}$" if symbol else "")
    return text if entry.unit == "1" else f"{text} ({entry.unit})"


def _telling(varied: Values, words: list[str], numbers: list[str]) -> list[str]:
    """The first numbers that tell faults apart, none if there are more than :data:`FEW`."""

    def faults(number: int) -> int:
        names = (*words, *numbers[:number])
        return len(set(zip(*(varied[name] for name in names), strict=True)))

    every = faults(len(numbers))
    if not numbers or every > FEW:
        return []
    return numbers[: next(n for n in range(len(numbers) + 1) if faults(n) == every)]


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
    return [(mark, np.flatnonzero([own == mark for own in marks])) for mark in dict.fromkeys(marks)]


def _lengths(table: xr.Dataset) -> Array:
    """Every length of a table that is a number (m)."""
    names = ("length", "length_low", "length_high", "theory_length")
    values = np.concatenate([table[name].values for name in names])
    return values[np.isfinite(values)]


def _wide(values: Array) -> bool:
    """Whether values are shown on a logarithmic axis."""
    return bool(values.size and values.min() > 0.0 and values.max() > WIDE * values.min())


def _scale(axes: Axes, which: str, values: Array) -> None:
    """The scale of an axis, with plain numbers at its ticks where there would be few."""
    if _wide(values):
        axis = {"x": axes.xaxis, "y": axes.yaxis}[which]
        axes.set(**{f"{which}scale": "log"})
        if values.max() < 100.0 * values.min():
            axis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0)))
            axis.set_major_formatter(ticker.StrMethodFormatter("{x:g}"))
            axis.set_minor_formatter(ticker.NullFormatter())


def _between(table: xr.Dataset, x: Array, runs: NDArray[np.intp]) -> Mapping[str, Array]:
    """The theory's lengths of some runs, in the order of a number."""
    order = runs[np.argsort(x[runs], kind="stable")]
    return {"x": x[order], "length": table["theory_length"].values[order]}


def _curves(axes: Axes, theory: Curves) -> None:
    """The theory over one number, by the words of the runs; once if it is the same for all."""
    first = next(iter(theory.values()))
    if all(np.array_equal(curve[n], first[n]) for curve in theory.values() for n in first):
        theory = {"": first}
    for i, (kind, curve) in enumerate(theory.items()):
        look: Any = {"color": style.THEORY, "label": f"theory, {kind}" if kind else "theory"}
        axes.plot(curve["x"], curve["length"], DASHES[i % len(DASHES)], **look)


def _maps(
    table: xr.Dataset,
    varied: Values,
    entries: dict[str, Quantity],
    names: list[str],
    axes: list[Array],
) -> Figure:
    """Maps of the length and of its ratio to the theory's over two numbers."""
    x, y = (np.asarray(varied[name], dtype=float) for name in names)
    at = np.searchsorted(axes[1], y), np.searchsorted(axes[0], x)
    figure, (left, right) = style.panels(1, 2, 7.476, sharex=True, sharey=True)
    length = table["length"].values
    lost = ~np.isfinite(length)
    label = f"no event ({lost.sum()} of {lost.size})"
    for panel, values, title, colours in (
        (left, length, "(a) Critical length of simulations (m)", style.SEQUENCE),
        (right, length / table["theory_length"].values, "(b) Simulations over theory", RATIO_MAP),
    ):
        image = np.full((axes[1].size, axes[0].size), np.nan)
        image[at] = values
        mesh = panel.pcolormesh(*map(_edges, axes), np.ma.masked_invalid(image), cmap=colours)
        panel.plot(x[lost], y[lost], "x", color=style.VERMILLION, label=label)
        figure.colorbar(mesh, ax=panel, pad=0.02)
        panel.set_title(title, loc="left")
        panel.set_xlabel(label_of(names[0], entries[names[0]]))
        _scale(panel, "x", axes[0])
        _scale(panel, "y", axes[1])
        panel.tick_params(which="both", direction="out", top=False, right=False)
    if lost.any():
        left.legend(frameon=True, framealpha=1.0)
    left.set_ylabel(label_of(names[1], entries[names[1]]))
    return figure


def _edges(values: Array) -> Array:
    """Borders of cells about values, between neighbours in the axis's own scale."""
    places = np.log(values) if _wide(values) else values
    middle = 0.5 * (places[1:] + places[:-1])
    borders = np.r_[2.0 * places[0] - middle[0], middle, 2.0 * places[-1] - middle[-1]]
    return np.asarray(np.exp(borders) if _wide(values) else borders)


def draw_study(
    table: xr.Dataset, varied: Values, entries: dict[str, dict[str, Any]], theory: Curves
) -> Figure:
    """The step ``draw_study``: :func:`draw` with plain declarations of what is varied."""
    return draw(table, varied, {name: Quantity(**own) for name, own in entries.items()}, theory)
