"""Any study's lengths: simulations against theory over the varied parameters."""

import re
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from nucleation.model.quantities import Quantity
from nucleation.pictures import style
from nucleation.run.run import Run
from nucleation.types import Array

from ..tables.drops import expected
from ..tables.lengths import stability_of
from . import laws

Curves = Sequence[Mapping[str, Any]]

_DASHES = ("--", "-.", ":", (0.0, (6.0, 1.0)))  # of L_c and L_s, one for each kind; L is solid
_BETWEEN = ("stability_length", "expected_length", "expected_low", "expected_high")
_FEW = 24  # so many kinds have marks and places in the legend
_WIDE = 4.0  # ratio of the largest to the smallest value above which an axis is logarithmic

_GREEK = "epsilon|mu|nu|phi|rho|sigma|tau|theta|xi|zeta"

_WORDS = {
    "initial_state": "initial state",
    "zeta_over_a": "weakening over direct effect",
    "n_x": "elements along x",
    "n_y": "elements along y",
}
"""Names of parameters with a symbol for a name in studies."""


@style.styled()
def draw(
    table: xr.Dataset,
    varied: dict[str, list[float] | list[str]],
    entries: dict[str, dict[str, Any]],
    theory: Curves,
) -> Figure:
    """Draw lengths (m) of one study over the number with most values, marked by all others.

    If there are too many kinds of runs, the title names the others. If no number is varied, the
    theory's length is the abscissa. `theory` has closely spaced curves with their runs; without one
    the theory of the runs is connected. L_s and, under a declared perturbation, the expected L with
    its range are curves too. Runs without an event are crosses at the lower edge.
    """
    # realisations of one fault have the same mark
    declared = {name: Quantity(**own) for name, own in entries.items() if name != "seed"}
    numbers = [name for name, entry in declared.items() if not entry.choices]
    numbers.sort(key=lambda name: -len(set(varied[name])))
    title = ""
    others = [name for name in declared if name not in numbers[:1]]
    kinds = _kinds(varied, declared, others)
    if len(set(kinds)) > _FEW:
        title = f"also varied: {', '.join(map(_named, others))}"
        kinds, theory = [""] * len(kinds), []
    x = varied[numbers[0]] if numbers else table["critical_length"].values
    rows = table.assign(x=("run", np.asarray(x, dtype=float)), kind=("run", kinds))
    names = list(dict.fromkeys(kinds))
    figure, axes = style.panels(7.7 + 0.4 * len(names), style.SINGLE_COLUMN)
    curves = {kinds[curve["members"][0]]: curve for curve in theory}
    shown = [rows["critical_length"].values]
    for number, kind in enumerate(names):
        own = laws.where(rows, kind=kind).sortby("x")
        marker, colour = style.look(number)
        look: style.Options = {"color": colour}
        dashes = _DASHES[number % len(_DASHES)]
        curve = curves.get(kind)
        critical = (own["x"], own["critical_length"])
        if curve is not None:
            critical = (curve["x"], curve["length"])
        shown += _draw_curve(axes, *critical, dashes, color=style.THEORY, label="$L_c$, theory")
        between = {name: own[name].values for name in _BETWEEN if name in own}
        along = own["x"].values
        if curve is not None:
            between = _along(curve)
            along = np.asarray(curve["x"])[:: _step(curve)]
        if "stability_length" in between:
            line: style.Options = {"color": style.STABILITY, "label": "$L_s$, theory"}
            shown += _draw_curve(axes, along, between["stability_length"], dashes, **line)
        if np.isfinite(between.get("expected_length", np.nan)).any():
            ends = between["expected_low"], between["expected_high"]
            axes.fill_between(along, *ends, color=colour, alpha=0.2, lw=0.0)
            line = {"color": colour, "label": "expected $L$ and its range"}
            if len(names) > 1:  # the colour is that of one kind
                axes.plot([], [], color=style.GUIDE, label=line.pop("label"))
            shown += [*_draw_curve(axes, along, between["expected_length"], "-", **line), *ends]
        known = np.isfinite(own["length"].values)
        label = f"simulation, {kind}" if kind else "simulation"
        if known.any():
            dropped = laws.where(own, known)
            laws.draw(axes, "x", dropped, "length", marker=marker, label=label, **look)
        if not known.all():
            lost = own["x"].values[~known]
            label = f"no event ({np.isnan(rows['length'].values).sum()} of {len(kinds)})"
            edge = axes.get_xaxis_transform()
            axes.plot(lost, np.full(lost.size, 0.03), "x", transform=edge, label=label, **look)
    label = "Theory's critical length $L_c$ (m)"
    if numbers:
        entry, words = declared[numbers[0]], _named(numbers[0])
        unit = "" if entry.unit == "1" else f" ({entry.unit})"
        symbol = f" ${_symbol(entry)}$" if _symbol(entry) else ""
        label = words[0].upper() + words[1:] + symbol + unit
    axes.set_xlabel(label)
    axes.set_ylabel("Length at the drop $L$ (m)")
    axes.set_title(title, fontsize=style.SMALL, wrap=True)
    _scale(axes, "x", rows["x"].values)
    _scale(axes, "y", np.concatenate([rows["length"].values, *shown]))
    style.legend(figure, axes, loc="outside lower center", fontsize=style.SMALL)
    return figure


def _draw_curve(axes: Axes, x: Any, length: Any, dashes: Any, **look: Any) -> list[Array]:
    """Draw a theory's length (m), a single one as a dash; return the lengths."""
    marker = "_" if np.size(x) == 1 else ""
    axes.plot(x, length, ls=dashes, lw=1.0, ms=9.0, marker=marker, **look)
    return [np.asarray(length, dtype=float)]


def _step(curve: Mapping[str, Any]) -> int:
    """Every which point of a curve has a run."""
    return int((len(curve["x"]) - 1) // (len(curve["between"]) - 1))


def _along(curve: Mapping[str, Any]) -> dict[str, Array]:
    """L_s and, under a declared perturbation, the expected L with its range (m) along a curve."""
    lengths = curve["length"][:: _step(curve)]
    found = []
    for parameters, critical in zip(curve["between"], lengths, strict=True):
        row = stability_of({"parameters": parameters, "critical_length": critical})
        run = Run.from_dict(parameters)
        uniform = run.fault.loading == "edge" and run.heterogeneity.varies == "none"
        if uniform and run.perturbation.acts:  # the law of the drop is of no other ones
            row |= expected(run)
        found.append([row.get(name, np.nan) for name in _BETWEEN])
    return dict(zip(_BETWEEN, np.array(found, dtype=float).T, strict=True))


def _kinds(
    varied: Mapping[str, Sequence[Any]], declared: Mapping[str, Quantity], names: list[str]
) -> list[str]:
    """The values of some varied parameters of each run, with their symbols or names."""
    texts: list[list[str]] = [[""] * max(map(len, varied.values()), default=1)]
    for name in names:
        entry = declared[name]
        symbol = _symbol(entry)
        before = f"${symbol}=" if symbol else f"{_named(name)} $"
        after = "$" if entry.unit == "1" else f"$ {entry.unit}"
        own = []
        for value in varied[name]:
            word = value is None or isinstance(value, str)
            own.append(value or "" if word else before + style.number(value) + after)
        texts.append(own)
    return [", ".join(filter(None, row)) for row in zip(*texts, strict=True)]


def _symbol(entry: Quantity) -> str:
    """The TeX of a symbol; empty if there is none, or for the block's L, as L is measured here."""
    greek = re.sub(_GREEK, r"\\\g<0>", entry.symbol.replace("eps", "epsilon"))
    return "" if greek == "L" else re.sub("[0*]$", r"_\g<0>", greek)


def _named(name: str) -> str:
    """A parameter's name in words, as within a sentence."""
    words = _WORDS.get(name, name.rpartition(".")[2].replace("_", " "))
    return words[0].lower() + words[1:]


def _scale(axes: Axes, which: str, values: Array) -> None:
    """Set the scale of an axis, with plain numbers at its ticks if it has less than two decades."""
    known = values[np.isfinite(values)]
    if known.size and known.min() > 0.0 and known.max() > _WIDE * known.min():
        axes.set(**{f"{which}scale": "log"})
        if known.max() < 100.0 * known.min():
            style.plain_numbers({"x": axes.xaxis, "y": axes.yaxis}[which])
