"""Any study's lengths: simulations against theory over the varied parameters."""

import math
import textwrap
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from nucleation.model.quantities import Quantity
from nucleation.pictures import style
from nucleation.types import Array

from . import laws
from .study_axes import edges, label_of, named, set_scale, symbol_of

Values = dict[str, list[float] | list[str]]
Entries = dict[str, Quantity]
Curves = Mapping[str, Mapping[str, Sequence[float] | Array]]

_RATIO_MAP = "cividis"  # looks the same to all colour vision
_DASHES = ("-", "--", "-.", ":")  # of the theory's curves
_FEW_ROWS = 2  # of two varied numbers on a grid, one with so few values makes curves, not a map
_FEW = 6  # so few faults have a marker each, if no number is an axis
_STRIP = 0.09  # height of the strip of runs without an event, which have no length
_SHORT = 24  # characters of labels that leave room for two columns in the legend
_LINE = 0.16  # inches, of a line in the legend


@style.styled
def draw(
    table: xr.Dataset, varied: Values, entries: dict[str, dict[str, Any]], theory: Curves
) -> Figure:
    """Draw one study: a curve, two maps, or points about equality.

    If one number is varied, lengths (m) are drawn over it. If two numbers are varied on a full
    grid, the figure has a curve for each of two values, or maps of the length and of its ratio to
    the theory's. Otherwise simulations are drawn against theory, with the varied parameters in the
    title. Texts, such as the evolution law, have different markers. Runs without an event are in a
    separate strip.
    """
    declared = {name: Quantity(**fields) for name, fields in entries.items()}
    numbers = [name for name, entry in declared.items() if not entry.choices]
    words = [name for name in declared if name not in numbers]
    if len(numbers) == 2 and not words:
        grid = {name: np.unique(varied[name]) for name in numbers}
        along, other = sorted(numbers, key=lambda name: -grid[name].size)
        if grid[along].size * grid[other].size == table.sizes["run"]:
            if grid[other].size > _FEW_ROWS:
                return _draw_maps(table, varied, declared, grid)
            numbers = [along]
            words = [other]
    if len(numbers) == 1:
        rows = _rows(table, varied[numbers[0]], varied, words, declared)
        return _draw(
            rows,
            theory,
            label_of(numbers[0], declared[numbers[0]]),
        )
    words += _distinguishing(varied, words, numbers)
    rows = _rows(table, table["critical_length"].values, varied, words, declared)
    title = f"varied: {', '.join(map(named, declared))}" if declared else ""
    return _draw(rows, None, "Theory's critical length $L_c$ (m)", title)


def _rows(
    table: xr.Dataset, x: Sequence[Any] | Array, varied: Values, words: list[str], entries: Entries
) -> xr.Dataset:
    """The table with the abscissa ``x``, and ``kind``: a label by some varied parameters."""
    kinds = []
    for i in range(table.sizes["run"]):
        values = {name: varied[name][i] for name in words}
        texts = [
            _value_text(
                name,
                value,
                entries[name],
            )
            for name, value in values.items()
        ]
        kinds.append(", ".join(filter(None, texts)))
    return table.assign(x=("run", np.asarray(x, dtype=float)), kind=("run", kinds))


def _value_text(name: str, value: float | str | None, entry: Quantity) -> str:
    """A value with its parameter's symbol or name; empty if there is none."""
    if value is None or isinstance(value, str):
        return value or ""
    symbol = symbol_of(entry)
    text = f"${symbol}={value:.4g}$" if symbol else f"{named(name)} {value:.4g}"
    return text if entry.unit == "1" else f"{text} {entry.unit}"


def _draw(
    rows: xr.Dataset,
    theory: Curves | None,
    label: str,
    title: str = "",
) -> Figure:
    """Lengths over one number, or over the theory's lengths if `theory` is None."""
    figure = style.new_figure(7.31, style.SINGLE_COLUMN)
    axes, strip = _axes(figure, rows)
    names = ("length", "length_low", "length_high", "critical_length")
    lengths = np.concatenate([rows[name].values for name in names])
    lengths = lengths[np.isfinite(lengths)]
    if theory is not None:
        _draw_theory(axes, rows, theory)
    _draw_runs(axes, strip, rows)
    if theory is None and lengths.size:
        ends = [0.95 * lengths.min(), 1.05 * lengths.max()]
        axes.plot(
            ends,
            ends,
            color=style.GUIDE,
            linewidth=0.8,
            label="equality",
        )
    axes.set_title(textwrap.fill(title, 48), fontsize=style.SMALL)
    axes.set_ylabel("Length at the drop $L$ (m)")
    figure.axes[-1].set_xlabel(label)
    set_scale(axes, "x", lengths if theory is None else rows["x"].values)
    set_scale(axes, "y", lengths)
    _add_legend(figure, axes)
    return figure


def _add_legend(figure: Figure, axes: Axes) -> None:
    """The legend below the axes, as runs may be anywhere within them."""
    labels = axes.get_legend_handles_labels()[1]
    columns = 2 if max(map(len, labels)) <= _SHORT else 1
    rows = math.ceil(len(labels) / columns)
    figure.set_figheight(figure.get_figheight() + rows * _LINE)
    figure.legend(loc="outside lower center", ncols=columns, fontsize=style.SMALL)


def _axes(figure: Figure, rows: xr.Dataset) -> tuple[Axes, Axes | None]:
    """Axes of lengths; below it a strip of the runs without an event, if there are any."""
    lost = int(np.isnan(rows["length"]).sum())
    if not lost:
        return figure.subplots(), None
    axes, strip = figure.subplots(
        2,
        1,
        sharex=True,
        height_ratios=[1.0, _STRIP],
    )
    label = f"no event\n({lost} of {rows.sizes['run']})"
    strip.set_yticks([0.0], [label], fontsize=style.SMALL)
    strip.set_ylim(-1.0, 1.0)
    strip.tick_params(which="both", left=False, right=False, top=False)
    return axes, strip


def _draw_runs(axes: Axes, strip: Axes | None, rows: xr.Dataset) -> None:
    """Points with bars for the runs with an event, open markers in the strip for the others."""
    for i, same in enumerate(laws.groups(rows, "kind")):
        marker, colour = style.look(i)
        kind = str(same["kind"].values[0])
        label = f"simulation, {kind}" if kind else "simulation"
        look: style.Options = {"marker": marker, "color": colour}
        known = np.isfinite(same["length"].values)
        if known.any():
            happened = laws.where(same, known)
            laws.draw(
                axes,
                "x",
                happened,
                "length",
                ms=4.0,
                label=label,
                **look,
            )
        if strip is not None:
            lost = same["x"].values[~known]
            strip.plot(
                lost,
                np.zeros(lost.size),
                linestyle="none",
                **look,
                **style.OPEN,
            )


def _distinguishing(varied: Values, words: list[str], numbers: list[str]) -> list[str]:
    """The first numbers that distinguish the faults; none if there are too many faults."""

    def faults(number: int) -> int:
        names = (*words, *numbers[:number])
        return len(set(zip(*(varied[name] for name in names), strict=True)))

    every = faults(len(numbers))
    fewest = next(number for number in range(len(numbers) + 1) if faults(number) == every)
    return numbers[:fewest] if every <= _FEW else []


def _draw_theory(axes: Axes, rows: xr.Dataset, theory: Curves) -> None:
    """The theory over one number, a curve for each label, or one if all are the same."""
    curves: dict[str, Mapping[str, Sequence[float] | Array]] = {}
    for same in laws.groups(rows, "kind"):
        kind = str(same["kind"].values[0])
        rising = same.sortby("x")
        connected = {"x": rising["x"].values, "length": rising["critical_length"].values}
        curves[kind] = theory.get(kind, connected)
    first, *others = curves.values()
    if all(np.array_equal(curve[n], first[n]) for curve in others for n in first):
        curves = {"": first}
    for i, (kind, curve) in enumerate(curves.items()):
        axes.plot(
            curve["x"],
            curve["length"],
            _DASHES[i % len(_DASHES)],
            color=style.THEORY,
            label=f"theory, {kind}" if kind else "theory",
        )


def _draw_maps(
    table: xr.Dataset,
    varied: Mapping[str, Sequence[float] | Sequence[str]],
    entries: Mapping[str, Quantity],
    grid: Mapping[str, Array],
) -> Figure:
    """Draw maps of the length and of its ratio to the theory's."""
    along, up = grid
    x = np.asarray(varied[along], dtype=float)
    y = np.asarray(varied[up], dtype=float)
    at = np.searchsorted(grid[up], y), np.searchsorted(grid[along], x)
    figure, (left, right) = style.panels(
        1,
        2,
        7.476,
        sharex=True,
        sharey=True,
    )
    length = table["length"].values
    ratio = length / table["critical_length"].values
    lost = ~np.isfinite(length)
    label = f"no event ({lost.sum()} of {lost.size})"
    for axes, values, title, colours in (
        (left, length, "(a) Length at the drop, simulated (m)", style.SEQUENCE),
        (right, ratio, "(b) Simulations over theory", _RATIO_MAP),
    ):
        image = np.full((grid[up].size, grid[along].size), np.nan)
        image[at] = values
        mesh = axes.pcolormesh(
            edges(grid[along]),
            edges(grid[up]),
            image,
            cmap=colours,
        )
        axes.plot(
            x[lost],
            y[lost],
            "x",
            color=style.VERMILLION,
            label=label,
        )
        figure.colorbar(mesh, ax=axes, pad=0.02)
        axes.set_title(title)
        axes.set_xlabel(label_of(along, entries[along]))
        set_scale(axes, "x", grid[along])
        set_scale(axes, "y", grid[up])
        axes.tick_params(which="both", direction="out", top=False, right=False)
    if lost.any():
        left.legend(frameon=True, framealpha=1.0)
    left.set_ylabel(label_of(up, entries[up]))
    return figure
