"""Any study's lengths: simulations against theory over the varied parameters."""

import textwrap
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from numpy.typing import NDArray

from ...figures import laws, style
from ...model.quantities import Quantity
from ...types import Array
from .parameter_axes import label_of, named, set_scale, symbol_of
from .study_maps import draw_maps

Values = dict[str, list[float] | list[str]]
Curves = Mapping[str, Mapping[str, Sequence[float] | Array]]
_Runs = NDArray[np.intp]

_DASHES = ("-", "--", "-.", ":")  # of the theory's curves
_FEW_ROWS = 2  # of two varied numbers on a grid, one with so few values makes curves, not a map
_FEW = 6  # so few faults have a marker each, if no number is an axis
_STRIP = 0.09  # height of the strip of runs without an event, which have no length


@style.styled
def draw(
    table: xr.Dataset,
    varied: Values,
    entries: dict[str, Quantity],
    theory: Curves | None = None,
) -> Figure:
    """Draw one study: a curve, two maps, or points about equality.

    If one number is varied, lengths (m) are drawn over it. If two numbers are varied on a full
    grid, the figure has a curve for each of two values, or maps of the length and of its ratio to
    the theory's. Otherwise simulations are drawn against theory, with the varied parameters in the
    title. Texts, such as the evolution law, have different markers. Runs without an event are in a
    separate strip.

    Parameters
    ----------
    table : Dataset
        The study's table of lengths, from :func:`nucleation.analysis.lengths.lengths_table`.
    varied : dict
        Each parameter with several values in the study, and its value in every run, in the order of
        the table.
    entries : dict
        Declarations of these parameters.
    theory : mapping, optional
        If one number is varied: closely spaced values of it (``x``) and the theory's lengths there
        (``length``, m), by the label of the runs' texts. Without it, lines connect the theory's
        lengths of the runs.

    Returns
    -------
    Figure
        One panel, or two maps.
    """
    numbers = [name for name, entry in entries.items() if not entry.choices]
    words = [name for name in entries if name not in numbers]
    if len(numbers) == 2 and not words:
        grid = {name: np.unique(varied[name]) for name in numbers}
        along, other = sorted(numbers, key=lambda name: -grid[name].size)
        if grid[along].size * grid[other].size == table.sizes["run"]:
            if grid[other].size > _FEW_ROWS:
                return draw_maps(table, varied, entries, grid)
            numbers = [along]
            words = [other]
    figure = style.new_figure(style.SINGLE_COLUMN, 0.85 * style.SINGLE_COLUMN)
    if len(numbers) == 1:
        kinds = _kinds(varied, words, entries, table.sizes["run"])
        _draw_curves(
            figure,
            table,
            np.asarray(varied[numbers[0]], dtype=float),
            kinds,
            theory,
        )
        label = label_of(numbers[0], entries[numbers[0]])
    else:
        words = [*words, *_distinguishing(varied, words, numbers)]
        kinds = _kinds(varied, words, entries, table.sizes["run"])
        _draw_equality(figure, table, kinds, list(entries))
        label = "Theory's critical length (m)"
    figure.axes[0].set_ylabel("Length at the drop $L$ (m)")
    figure.axes[-1].set_xlabel(label)
    set_scale(figure.axes[0], "y", _lengths(table))
    figure.axes[0].legend()
    return figure


def _draw_curves(
    figure: Figure,
    table: xr.Dataset,
    x: Array,
    kinds: list[tuple[str, _Runs]],
    theory: Curves | None,
) -> None:
    """Lengths over one number."""
    axes, strip = _axes(figure, table)
    given = theory or {}
    curves = {kind: given.get(kind, _between(table, x, runs)) for kind, runs in kinds}
    _draw_theory(axes, curves)
    _draw_runs(axes, strip, table, x, kinds)
    set_scale(axes, "x", x)


def _draw_equality(
    figure: Figure,
    table: xr.Dataset,
    kinds: list[tuple[str, _Runs]],
    varied: list[str],
) -> None:
    """Simulated lengths over the theory's."""
    axes, strip = _axes(figure, table)
    _draw_runs(
        axes,
        strip,
        table,
        np.asarray(table["critical_length"], dtype=float),
        kinds,
    )
    lengths = _lengths(table)
    if varied:
        title = textwrap.fill(f"varied: {', '.join(map(named, varied))}", 48)
        axes.set_title(title, loc="left", fontsize=style.SMALL)
    if lengths.size:
        ends = [0.95 * lengths.min(), 1.05 * lengths.max()]
        axes.plot(
            ends,
            ends,
            color=style.GUIDE,
            linewidth=0.8,
            label="equality",
        )
    set_scale(axes, "x", lengths)


def _axes(figure: Figure, table: xr.Dataset) -> tuple[Axes, Axes | None]:
    """Axes of lengths; below it a strip of the runs without an event, if there are any."""
    quiet = int(_quiet(table).sum())
    if not quiet:
        return figure.subplots(), None
    axes, strip = figure.subplots(2, 1, sharex=True, height_ratios=[1.0, _STRIP])
    label = f"no event\n({quiet} of {table.sizes['run']})"
    strip.set_yticks([0.0], [label], fontsize=style.SMALL)
    strip.set_ylim(-1.0, 1.0)
    strip.tick_params(which="both", left=False, right=False, top=False)
    return axes, strip


def _quiet(table: xr.Dataset) -> NDArray[np.bool_]:
    return ~np.isfinite(table["length"].values)


def _draw_runs(
    axes: Axes,
    strip: Axes | None,
    table: xr.Dataset,
    x: Array,
    kinds: list[tuple[str, _Runs]],
) -> None:
    """Points with bars for the runs with an event, open markers in the strip for the others."""
    quiet = _quiet(table)
    for i, (kind, runs) in enumerate(kinds):
        marker, colour = style.look(i)
        happened = runs[~quiet[runs]]
        if happened.size:
            laws.draw(
                axes,
                x[happened],
                table.isel(run=happened),
                "length",
                marker=marker,
                color=colour,
                ms=4.0,
                label=f"simulation, {kind}" if kind else "simulation",
            )
        if strip is not None:
            lost = x[runs[quiet[runs]]]
            strip.plot(
                lost,
                np.zeros(lost.size),
                marker,
                color=colour,
                **style.OPEN,
            )


def _distinguishing(varied: Values, words: list[str], numbers: list[str]) -> list[str]:
    """The first numbers that distinguish the faults; none if there are too many faults."""

    def faults(number: int) -> int:
        names = (*words, *numbers[:number])
        return len(set(zip(*(varied[name] for name in names), strict=True)))

    every = faults(len(numbers))
    if not numbers or every > _FEW:
        return []
    for number in range(len(numbers)):
        if faults(number) == every:
            return numbers[:number]
    return numbers


def _kinds(
    varied: Values,
    names: list[str],
    entries: dict[str, Quantity],
    runs: int,
) -> list[tuple[str, _Runs]]:
    """Labels by some of the varied parameters, and the runs with each label."""
    labels = []
    for i in range(runs):
        values = [(name, varied[name][i]) for name in names]
        labels.append(
            ", ".join(
                _value_text(name, value, entries[name])
                for name, value in values
                if value is not None
            )
        )
    found = []
    for label in dict.fromkeys(labels):
        found.append((label, np.flatnonzero([own == label for own in labels])))
    return found


def _value_text(name: str, value: float | str, entry: Quantity) -> str:
    if isinstance(value, str):
        return value
    symbol = symbol_of(entry)
    text = f"${symbol}={value:.4g}$" if symbol else f"{named(name)} {value:.4g}"
    return text if entry.unit == "1" else f"{text} {entry.unit}"


def _lengths(table: xr.Dataset) -> Array:
    """All finite lengths of a table (m)."""
    names = ("length", "length_low", "length_high", "critical_length")
    values = np.concatenate([table[name].values for name in names])
    return values[np.isfinite(values)]


def _between(table: xr.Dataset, x: Array, runs: _Runs) -> Mapping[str, Array]:
    """The theory's lengths of some runs, in the order of a number."""
    order = runs[np.argsort(x[runs], kind="stable")]
    return {
        "x": x[order],
        "length": table["critical_length"].values[order],
    }


def _draw_theory(axes: Axes, curves: Curves) -> None:
    """The theory over one number, a curve for each label, or one if all are the same."""
    first = next(iter(curves.values()))
    if all(np.array_equal(curve[n], first[n]) for curve in curves.values() for n in first):
        curves = {"": first}
    for i, (kind, curve) in enumerate(curves.items()):
        axes.plot(
            curve["x"],
            curve["length"],
            _DASHES[i % len(_DASHES)],
            color=style.THEORY,
            label=f"theory, {kind}" if kind else "theory",
        )


def draw_study(
    table: xr.Dataset,
    varied: Values,
    entries: dict[str, dict[str, Any]],
    theory: Curves,
) -> Figure:
    """Draw a study with plain declarations of the varied parameters (rule ``draw_study``).

    Parameters
    ----------
    table, varied, theory
        As of :func:`draw`.
    entries : dict
        Fields of :class:`~nucleation.model.quantities.Quantity`, by parameter.

    Returns
    -------
    Figure
        As of :func:`draw`.
    """
    declared = {name: Quantity(**own) for name, own in entries.items()}
    return draw(table, varied, declared, theory)
