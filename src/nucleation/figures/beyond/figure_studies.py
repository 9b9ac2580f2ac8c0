"""Any study's lengths: simulations against theory over what the study varies."""

from __future__ import annotations

import numpy as np
import xarray as xr
from matplotlib import ticker
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ...figures import style
from ...model.quantities import Quantity
from ..beyond import figure_sensitivity

Array = NDArray[np.float64]
Values = dict[str, list[float] | list[str]]
Look = tuple[str, str, str]

LOOKS = (
    ("o", style.AGING, "-"), ("s", style.SLIP, "--"), ("D", style.OLD_AGE, "-."),
    ("^", style.GREEN, ":"),
)  # fmt: skip
"""Marker and colour of simulations, and dashes of their theory, by the words of a study."""

WIDE = 4.0
"""Ratio of the largest to the smallest value from which an axis is logarithmic."""

SYMBOLS = figure_sensitivity.SYMBOLS | {
    "zeta/a": r"\zeta/a", "D": "D", "v*": "v_*", "v0": "v_0", "phi*": r"\phi_*", "theta": r"\theta",
    "xi": r"\xi",
}  # fmt: skip

WORDS = {"phi0": "Initial state", "zeta_over_a": "Weakening over direct effect"}
"""Names of parameters whose name in studies is a symbol."""

RATIO_MAP = "cividis"  # made to look alike to all colour vision


@style.styled
def draw(table: xr.Dataset, varied: Values, entries: dict[str, Quantity]) -> Figure:
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

    Returns
    -------
    Figure
        Critical lengths in m. With one number varied: simulations with error bars and theory over
        it; with two on a full grid: maps of the length and of its ratio to the theory's; otherwise
        simulations against theory. Words, such as the evolution law, tell markers apart. Runs
        without an event are marked.
    """
    numbers = [name for name, entry in entries.items() if not entry.choices]
    words = [name for name in entries if name not in numbers]
    if len(numbers) == 2 and not words:
        axes = [np.unique(varied[name]) for name in numbers]
        if axes[0].size * axes[1].size == table.sizes["run"]:
            return _maps(table, varied, entries, numbers, axes)
    figure = style.new_figure(style.SINGLE_COLUMN, 0.85 * style.SINGLE_COLUMN)
    axes = figure.subplots()  # type: ignore[assignment]
    for i, (kind, chosen) in enumerate(_kinds(varied, words, table.sizes["run"])):
        look = LOOKS[i % len(LOOKS)]
        part = table.isel(run=chosen)
        if len(numbers) == 1:
            x = np.asarray(varied[numbers[0]], dtype=float)[chosen]
            _curve(axes, part, x, kind, look)
        else:
            _points(axes, part, part["theory_length"].values, kind, look)
    if len(numbers) == 1:
        axes.set_xlabel(label(numbers[0], entries[numbers[0]]))  # type: ignore[attr-defined]
        _scale(axes, "x", np.asarray(varied[numbers[0]], dtype=float))
    else:
        _equality(axes, table)
    axes.set_ylabel("Critical length $L_c$ (m)")  # type: ignore[attr-defined]
    _scale(axes, "y", _lengths(table))
    axes.legend()  # type: ignore[attr-defined]
    return figure


def label(name: str, entry: Quantity) -> str:
    """Name, symbol and unit of a parameter, from its declaration."""
    words = WORDS.get(name, name.replace("_", " ").capitalize())
    symbol = SYMBOLS.get(entry.symbol, entry.symbol)
    text = f"{words} ${symbol}$" if symbol else words
    return text if entry.unit == "1" else f"{text} ({entry.unit})"


def _kinds(varied: Values, words: list[str], runs: int) -> list[tuple[str, NDArray[np.intp]]]:
    """Runs by the words they have: a label and the runs' indices."""
    marks = [", ".join(str(varied[word][i]) for word in words) for i in range(runs)]
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


def _curve(axes: Axes, part: xr.Dataset, x: Array, kind: str, look: Look) -> None:
    """Simulations and theory over one number."""
    order = np.argsort(x, kind="stable")
    suffix = f", {kind}" if kind else ""
    axes.plot(
        x[order], part["theory_length"].values[order], look[2], color=style.THEORY,
        label=f"theory{suffix}",
    )  # fmt: skip
    _points(axes, part, x, kind, look)


def _points(axes: Axes, part: xr.Dataset, x: Array, kind: str, look: Look) -> None:
    """Simulations with their error bars; those without an event as crosses at the theory's."""
    marker, colour, _ = look
    suffix = f", {kind}" if kind else ""
    length = part["length"].values
    event = np.isfinite(length)
    bars = np.abs(np.stack([part["length_low"].values, part["length_high"].values]) - length)
    if event.any():
        axes.errorbar(
            x[event], length[event], bars[:, event], fmt=marker, color=colour, markersize=4.0,
            elinewidth=0.8, label=f"simulation{suffix}",
        )  # fmt: skip
    if not event.all():
        theory = part["theory_length"].values
        axes.plot(
            x[~event], theory[~event], "x", color=colour, label=f"no event{suffix}", markersize=6.0
        )


def _equality(axes: Axes, table: xr.Dataset) -> None:
    """The line of equality and the label of theory."""
    values = _lengths(table)
    ends = [0.95 * values.min(), 1.05 * values.max()]
    axes.plot(ends, ends, color=style.GUIDE, linewidth=0.8, label="equality")
    axes.set_xlabel("Theory's critical length (m)")
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
        lost = ~np.isfinite(values)
        panel.plot(x[lost], y[lost], "x", color=style.VERMILLION, label="no event")
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
