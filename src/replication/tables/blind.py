"""Blind faults: L predicted before it was simulated, the simulated drops, and how many are inside.

The faults are drawn by a stated rule (benchmarks/blind_faults.py). Their predictions were kept
before the simulations; `expected` columns have today's theory. Even faults of the first set
calibrated ranges and doubts, odd ones tested an earlier rule; the second set tests today's.
"""

import csv
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
import xarray as xr

from nucleation.datasets.variables import Column, columns, table, to_csv
from nucleation.extraction import definitions
from nucleation.run.derived import ensemble
from nucleation.run.run import Run

from . import columns as col
from .drops import expected
from .rows import Row, rows_of

SET = Column(
    "set", "", "set of the fault: the even or odd half of the first one, or the second one"
)
PREDICTED_INSIDE = Column(
    "predicted_inside", "1", "number of realisations in the range predicted before"
)

PREDICTED = columns(
    Column("number", "1", "number of the fault in the drawing"),
    SET,
    col.FRICTION_LAW,
    col.EVOLUTION,
    col.PLANE,
    col.BELOW,
    col.FAR_SIDE,
    col.ZETA_OVER_A,
    col.HEIGHT,
    col.STRENGTH,
    col.CRITICAL_LENGTH,
    definitions.STABILITY_LENGTH,
    col.RUNAWAY_LENGTH,
    col.RUNAWAY_STATUS,
    col.LAW_LENGTH,
    col.EXPECTED_LENGTH,
    col.EXPECTED_LOW,
    col.EXPECTED_HIGH,
    col.DOUBT,
)
"""The faults with today's predictions, which are kept before they are simulated."""

BLIND = {
    **PREDICTED,
    **columns(
        col.ID,
        col.SEED,
        col.STATUS,
        definitions.LENGTH,
        col.REACHED_LENGTH,
        col.SIMULATED_TIME,
        Column("predicted_length", "m", "L as predicted before the simulation", "L"),
        Column("predicted_low", "m", "lower end of its range"),
        Column("predicted_high", "m", "upper end of its range"),
        Column("predicted_doubt", "", "why that prediction was said to be uncertain"),
        PREDICTED_INSIDE,
        col.INSIDE,
    ),
}
"""One realisation: simulated L, its prediction, and today's theory."""

COVERAGE = columns(
    SET,
    Column("regime", "", "faults that are counted"),
    col.REALISATIONS,
    PREDICTED_INSIDE,
    col.INSIDE,
    Column("predicted_width", "1", "mean width of the range predicted before, over L"),
    Column("expected_width", "1", "mean width of today's range, over L"),
)

FIRST = 72
"""Number of faults of the first set."""

SETS = ("calibrate", "test", "second")
KEPT = ("length", "low", "high", "doubt")

STRONG_NOISE = 3e-4
WEAK = 2.0  # zeta/a


def _faults(runs: Iterable[Row]) -> Iterator[Row]:
    """The columns :data:`PREDICTED` of the faults, in the order of the drawing."""
    for number, run in enumerate(runs):
        parameters = Run.from_dict(run["parameters"])
        fault, below = parameters.fault, parameters.below
        equal = below is not None and below == parameters.upper._replace(far_side=below.far_side)
        _, a, zeta = parameters.law.expansion(fault.velocity)
        yield {
            "number": number,
            "set": SETS[number % 2] if number < FIRST else SETS[2],
            "friction_law": parameters.law.law,
            "evolution": parameters.law.evolution,
            "plane": fault.plane,
            "below": "rigid" if below is None else "equal" if equal else "different",
            "far_side": "" if below is None else below.far_side,
            "zeta_over_a": zeta / a,
            "height": fault.height,
            "strength": parameters.perturbation.strength,
            "critical_length": run["critical_length"],
            **expected(parameters),
        }


def blind_predictions(runs: Iterable[Row]) -> dict[str, Any]:
    """:data:`PREDICTED` of one run of each fault."""
    rows = table(list(_faults(runs)), PREDICTED)
    return {".csv": to_csv(rows), ".nc": rows}


def blind_files(
    drops: xr.Dataset, predictions: xr.Dataset, predicted: Path, runs: Iterable[Row]
) -> dict[str, Any]:
    """:data:`BLIND` of all realisations; `predicted` is the file that was kept before."""
    with predicted.open(newline="") as lines:
        before = {row["number"]: row for row in csv.DictReader(lines)}
    today = rows_of(predictions)
    faults = [Run.from_dict(run["parameters"]) for run in runs]
    ensembles = {ensemble(run): number for number, run in enumerate(faults)}
    rows = []
    for drop in rows_of(drops):
        number = ensembles[drop["ensemble"]]
        kept = before.get(str(number), {})
        row = drop | today[number]
        for name in KEPT:
            text = kept.get("doubt" if name == "doubt" else f"expected_{name}", "")
            row[f"predicted_{name}"] = text if name == "doubt" else float(text or "nan")
        length = drop["length"]
        row["predicted_inside"] = int(row["predicted_low"] <= length <= row["predicted_high"])
        row["inside"] = int(row["expected_low"] <= length <= row["expected_high"])
        rows.append(row)
    found = table(rows, BLIND)
    return {".csv": to_csv(found), ".nc": found}


REGIMES = {
    "all": lambda row: True,
    "no doubt": lambda row: not row["doubt"],
    "doubt": lambda row: bool(row["doubt"]),
    "weak": lambda row: row["zeta_over_a"] < WEAK,
    "strong": lambda row: row["zeta_over_a"] >= WEAK,
    "strong noise": lambda row: row["strength"] >= STRONG_NOISE,
    "rigid base": lambda row: row["below"] == "rigid",
    "equal pairs": lambda row: row["below"] == "equal",
    "different pairs": lambda row: row["below"] == "different",
    "slip law": lambda row: row["evolution"] == "slip",
    "antiplane": lambda row: row["plane"] == "antiplane",
}
"""Faults that are counted together, by their row."""


def answered(row: Row) -> bool:
    """Whether the theory gave a length."""
    return bool(np.isfinite(row["predicted_length"]))


def coverage(blind: xr.Dataset) -> xr.Dataset:
    """:data:`COVERAGE` of each set, by regime, where the theory gives a length."""
    rows = []
    for of_set in SETS:
        for regime, belongs in REGIMES.items():
            own = [
                row
                for row in rows_of(blind)
                if row["set"] == of_set and belongs(row) and answered(row)
            ]
            if not own:
                continue
            widths = {
                kind: np.mean(
                    [
                        (row[f"{kind}_high"] - row[f"{kind}_low"]) / row[f"{kind}_length"]
                        for row in own
                    ]
                )
                for kind in ("predicted", "expected")
            }
            rows.append(
                {
                    "set": of_set,
                    "regime": regime,
                    "realisations": len(own),
                    "predicted_inside": sum(row["predicted_inside"] for row in own),
                    "inside": sum(row["inside"] for row in own),
                    "predicted_width": float(widths["predicted"]),
                    "expected_width": float(widths["expected"]),
                }
            )
    return table(rows, COVERAGE)


def coverage_files(blind: xr.Dataset) -> dict[str, Any]:
    """:func:`coverage` as CSV."""
    return {".csv": to_csv(coverage(blind))}
