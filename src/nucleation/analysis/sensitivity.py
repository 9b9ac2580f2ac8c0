"""Sensitivity of the critical length: every run against the base run of its height.

The base is the first run of each height. What a run varies is found by comparing parameters, so
that a study may vary any of them. Definitions of the extraction are varied on the base run itself.
"""

import dataclasses
import math
from collections import defaultdict
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ..datasets.variables import Variable, some, table
from ..model.parameters import ALIASES, Parameters, names
from ..model.quantities import Quantity
from .convergence import LENGTH_OVER_THEORY
from .definitions import ExtractionSettings
from .extraction import extract
from .lengths import COLUMNS as LENGTHS
from .record import Record
from .rows import Row

COLUMNS = {
    **some(LENGTHS, "id", "height"),
    "varied": Variable("", "parameter or definition that is varied"),
    "variation": Variable("", "how it is varied"),
    "length": LENGTHS["length"],
    "length_change": Variable("1", "relative change of L_c against the base"),
    "theory_length": LENGTHS["theory_length"],
    "length_over_theory": LENGTH_OVER_THEORY,
    "ratio_change": Variable("1", "relative change of L_c over the theory's length"),
    "onset_time": LENGTHS["onset_time"],
    "onset_change": Variable("1", "relative change of the onset time"),
    "status": LENGTHS["status"],
}

EDGE_THRESHOLDS = (0.5, 0.1, 1e-3)  # over V
DROPS = (0.005, 0.01, 0.05)  # fractions of |f_d|; the whole drop is less than a tenth of it

BASE = "base"
DROP_COMPLETE = "end of the drop"

NOT_PHYSICAL = (
    "mesh.n_x", "mesh.n_y", "mesh.grading", "stepping.end_time", "stepping.time_after_event",
    "stepping.longest_step",
)  # fmt: skip
"""Not varied for their own sake: a longer block keeps its element length, a run may end sooner, a
faster front needs shorter steps."""

SAME_LENGTH = 1e-2  # block lengths over the theory's differ by less through rounding


class Case(NamedTuple):
    """One run and what it is about."""

    id: str
    parameters: Parameters
    theory_length: float  # m
    simulation: xr.Dataset = xr.Dataset()


def variation(case: Case, base: Case) -> tuple[str, str]:
    """The parameters that a run varies against its base, and how, in words.

    The block's length counts where it is another multiple of the theory's critical length; the
    start in uniform shear is named by its shear stress. With another friction law, parameters
    that one of the two does not have are not compared.
    """
    values, usual = case.parameters.named(), base.parameters.named()
    own, others = case.parameters.geometry.length, base.parameters.geometry.length
    ratio = own / case.theory_length * base.theory_length / others
    varied = {
        name
        for name, value in values.items()
        if value != usual.get(name, value) and name not in (*NOT_PHYSICAL, "geometry.length")
    }
    if abs(ratio - 1.0) > SAME_LENGTH:
        varied.add("geometry.length")
    if "loading.initial_stress" in varied:
        varied = (varied - {"loading.initial_stress"}) | {"loading.initial_shear_stress"}
    known = names()
    by_field = {_field(name): name for name in varied}
    words = [
        _words(known[name], field, values[name], usual[name])
        for field, name in sorted(by_field.items())
    ]
    return ", ".join(sorted(by_field)) or BASE, ", ".join(words) or BASE


def _field(name: str) -> str:
    """The last part of a full name, if it is a short one; ``law`` is the evolution's."""
    last = name.rpartition(".")[2]
    return last if ALIASES.get(last, name) == name else name


def _words(entry: Quantity, name: str, value: Any, usual: Any) -> str:
    """A changed value in words: a multiple of the usual one where there is one."""
    symbol = entry.symbol or name
    if value is None:
        return f"{symbol} as the first body's"
    if isinstance(value, str):
        return f"{symbol} = {value}"
    if value and usual:
        return f"{symbol} x {value / usual:.3g}"
    return f"{symbol} = {value:g}" + ("" if entry.unit == "1" or not value else f" {entry.unit}")


def sensitivity_table(
    runs: Iterable[Row],
    simulations: Iterable[xr.Dataset],
    settings: ExtractionSettings = ExtractionSettings(),
) -> xr.Dataset:
    """Relative changes of L_c and onset, by what was varied: :data:`COLUMNS` on ``run``.

    Parameters
    ----------
    runs : from :meth:`nucleation.configuration.runs.Run.to_dict`; the first of each height is the
        base. ``ratio_change`` is of L_c over the theory's length for the run's own parameters.
    simulations : of the runs, in the same order; without an event their numbers are NaN.
    settings : the usual definitions.
    """
    cases = [
        Case(r["id"], Parameters.from_dict(r["parameters"]), r["theory_length"], simulation)
        for r, simulation in zip(runs, simulations, strict=True)
    ]
    heights: dict[float, list[Case]] = defaultdict(list)
    for case in cases:
        heights[case.parameters.geometry.height].append(case)
    return table([row for own in heights.values() for row in _of_height(own, settings)], COLUMNS)


def _of_height(cases: list[Case], settings: ExtractionSettings) -> Iterator[Row]:
    """The rows of one height, whose first case is the base."""
    base = cases[0]
    usual = extract(base.simulation, settings)
    for case in cases:
        found = extract(case.simulation, settings)
        yield _row(case, base, variation(case, base), found, usual)
    for what, found in _redefined(base, usual, settings):
        yield _row(base, base, what, found, usual)


def _redefined(
    base: Case, usual: dict[str, float], settings: ExtractionSettings
) -> Iterator[tuple[tuple[str, str], dict[str, float]]]:
    """Length (m) and onset (s) of one run by other definitions of edge, drop and instant."""
    for name, values, text in (
        ("edge_threshold", EDGE_THRESHOLDS, "edge at {:g} V"),
        ("drop", DROPS, "drop by {:g}"),
    ):
        for value in values:
            changed = dataclasses.replace(settings, **{name: value})
            yield (name, text.format(value)), extract(base.simulation, changed)
    end = usual["onset_time_high"]
    if math.isfinite(end):
        record = Record(base.simulation, settings)
        length = record.lengths[record.frames_at(np.array([end]))[0]]
        yield ("instant", DROP_COMPLETE), {"length": float(length), "onset_time": end}


def _row(
    case: Case, base: Case, what: tuple[str, str], found: dict[str, float], usual: dict[str, float]
) -> Row:
    """What was found of a case, beside what is usual of the base."""
    length, change = found["length"], found["length"] / usual["length"]
    return {
        "id": case.id,
        "height": case.parameters.geometry.height,
        "varied": what[0],
        "variation": what[1],
        "length": length,
        "length_change": change - 1.0,
        "theory_length": case.theory_length,
        "length_over_theory": length / case.theory_length,
        "ratio_change": change * base.theory_length / case.theory_length - 1.0,
        "onset_time": found["onset_time"],
        "onset_change": found["onset_time"] / usual["onset_time"] - 1.0,
        "status": case.simulation.attrs["status"],
    }
