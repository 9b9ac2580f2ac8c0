"""Sensitivity of the length at the drop: every run against the base run of its height.

The base is the first run of each height. Comparing the parameters shows which of them a run varies,
so a study may vary any of them. Definitions of the extraction are varied on the base run itself.
"""

import dataclasses
import math
from collections import defaultdict
from collections.abc import Iterable, Iterator

import numpy as np
import xarray as xr

from nucleation.datasets.variables import Variable, some, table
from nucleation.extraction.definitions import ExtractionSettings
from nucleation.extraction.extraction import extract
from nucleation.extraction.record import Record
from nucleation.model.quantities import Quantity
from nucleation.run.names import parameters

from .convergence import LENGTH_OVER_THEORY
from .lengths import COLUMNS as LENGTHS
from .rows import Row

COLUMNS = {
    **some(LENGTHS, "id height"),
    "varied": Variable("", "parameter or definition that is varied"),
    "variation": Variable("", "how it is varied"),
    "length": LENGTHS["length"],
    "length_change": Variable("1", "relative change of L against the base"),
    "critical_length": LENGTHS["critical_length"],
    "length_over_theory": LENGTH_OVER_THEORY,
    "ratio_change": Variable("1", "relative change of L over the theory's length"),
    "onset_time": LENGTHS["onset_time"],
    "onset_change": Variable("1", "relative change of the onset time"),
    "status": LENGTHS["status"],
}

EDGE_THRESHOLDS = (0.5, 0.1, 1e-3)  # over V
DROPS = (0.005, 0.01, 0.05)  # fractions of |f_d|; the whole drop is less than a tenth of it

BASE = "base"
DROP_COMPLETE = "end of the drop"

NOT_PHYSICAL = (
    "n_x",
    "n_y",
    "grading",
    "end_time",
    "time_after_event",
    "longest_step",
)
"""Parameters that only follow another one: a longer block keeps its element length, a run may end
sooner, a faster front needs shorter steps."""

SAME_LENGTH = 1e-2  # block lengths over the theory's differ by less through rounding

Case = tuple[Row, xr.Dataset]
"""A run with the status at its end, and its record."""

Varied = tuple[str, str]
"""Names of the varied parameters, and how they are varied, in words."""


def variation(run: Row, base: Row) -> Varied:
    """The parameters that a run varies against its base.

    The block's length counts if it is another multiple of the theory's critical length. The start
    in uniform shear is named by its shear stress. With another friction law, only parameters that
    both laws have are compared.
    """
    values, usual = run["parameters"], base["parameters"]
    varied = {
        name
        for name, value in values.items()
        if value != usual.get(name, value) and name not in (*NOT_PHYSICAL, "block_length")
    }
    own = values["block_length"]
    others = usual["block_length"]
    ratio = own / run["critical_length"] * base["critical_length"] / others
    if abs(ratio - 1.0) > SAME_LENGTH:
        varied.add("block_length")
    if "initial_stress" in varied:
        varied.remove("initial_stress")
        varied.add("initial_shear_stress")
    known = parameters()
    words = [
        _words(
            known[name],
            name,
            values[name],
            usual.get(name),
        )
        for name in sorted(varied)
    ]
    return ", ".join(sorted(varied)) or BASE, ", ".join(words) or BASE


def _words(
    entry: Quantity,
    name: str,
    value: float | str | None,
    usual: float | str | None,
) -> str:
    """A changed value in words: a multiple of the usual one where there is one."""
    symbol = entry.symbol or name
    if value is None:
        return f"{symbol} as the first body's"
    if isinstance(value, str):
        return f"{symbol} = {value}"
    if value and usual:
        return f"{symbol} x {value / float(usual):.3g}"
    unit = "" if entry.unit == "1" or not value else f" {entry.unit}"
    return f"{symbol} = {value:g}{unit}"


def sensitivity_table(
    runs: Iterable[Row],
    simulations: Iterable[xr.Dataset],
    settings: ExtractionSettings = ExtractionSettings(),
) -> xr.Dataset:
    """Relative changes of L and onset, by the parameters that were varied."""
    heights: dict[float, list[Case]] = defaultdict(list)
    for run, simulation in zip(runs, simulations, strict=True):
        case = run | {"status": simulation.attrs["status"]}, simulation
        heights[run["parameters"]["height"]].append(case)
    rows: list[Row] = []
    for cases in heights.values():
        rows += _of_height(cases, settings)
    return table(rows, COLUMNS)


def _of_height(cases: list[Case], settings: ExtractionSettings) -> Iterator[Row]:
    """The rows of one height; the first case is the base."""
    base, simulation = cases[0]
    usual = extract(simulation, settings)
    for run, own in cases:
        found = extract(own, settings)
        yield _row(run, base, variation(run, base), found, usual)
    for varied, found in _redefined(simulation, usual, settings):
        yield _row(base, base, varied, found, usual)


def _redefined(
    simulation: xr.Dataset, usual: dict[str, float], settings: ExtractionSettings
) -> Iterator[tuple[Varied, dict[str, float]]]:
    """Length (m) and onset (s) of one run by other definitions of edge, drop and instant."""
    for threshold in EDGE_THRESHOLDS:
        changed = dataclasses.replace(settings, edge_threshold=threshold)
        varied = ("edge_threshold", f"edge at {threshold:g} V")
        yield varied, extract(simulation, changed)
    for drop in DROPS:
        changed = dataclasses.replace(settings, drop=drop)
        yield ("drop", f"drop by {drop:g}"), extract(simulation, changed)
    end = usual["onset_time_high"]
    if math.isfinite(end):
        record = Record(simulation, settings)
        frame = record.frames_at(np.array([end]))[0]
        length = float(record.lengths[frame])
        yield ("instant", DROP_COMPLETE), {"length": length, "onset_time": end}


def _row(
    run: Row, base: Row, varied: Varied, found: dict[str, float], usual: dict[str, float]
) -> Row:
    """Numbers of a run beside the usual ones of the base."""
    length = found["length"]
    change = length / usual["length"]
    return {
        "id": run["id"],
        "height": run["parameters"]["height"],
        "varied": varied[0],
        "variation": varied[1],
        "length": length,
        "length_change": change - 1.0,
        "critical_length": run["critical_length"],
        "length_over_theory": length / run["critical_length"],
        "ratio_change": change * base["critical_length"] / run["critical_length"] - 1.0,
        "onset_time": found["onset_time"],
        "onset_change": found["onset_time"] / usual["onset_time"] - 1.0,
        "status": run["status"],
    }
