"""Simulated drops beside L_s, L_run and the law of the drop, one row for each run.

The runs cover faults from weak to strong weakening: where zeta/a is small the patch slips slowly
in a limit cycle up to L_run, and where it is large the law of the drop holds.
"""

from collections.abc import Iterable
from typing import Any

import numpy as np
import xarray as xr

from nucleation.datasets.variables import Variable, annotate, some, table, to_csv
from nucleation.run.drop import drop_of_run
from nucleation.run.identity import ensemble, fault
from nucleation.run.run import Run
from nucleation.theory.status import NoLength

from .lengths import COLUMNS as LENGTHS
from .rows import RATIO_COLUMNS, Row, rows_of

MEASURED = some(
    LENGTHS,
    "study id evolution height below kind strength seed n_x n_y block_length onset_time "
    "length critical_length",
)

EXPECTED = {
    "stability_length": LENGTHS["stability_length"],
    "runaway_length": Variable("m", "runaway length by theory, NaN where zeta/a > 2", "L_run"),
    "runaway_status": Variable("", "value, or why there is none: stable, beyond or unknown"),
    "law_length": Variable("m", "length at the drop by the law, median", "L"),
    "expected_length": Variable("m", "expected length at the drop", "L"),
    "expected_low": Variable("m", "least length at the drop that is expected", "L"),
    "expected_high": Variable("m", "largest length at the drop that is expected", "L"),
    "doubt": Variable("", "why the expected length should not be relied upon"),
}

COLUMNS = {
    **MEASURED,
    "zeta_over_a": RATIO_COLUMNS["zeta_over_a"],
    **EXPECTED,
    "fault": LENGTHS["fault"],
}


CURVES = {
    "curve_study": LENGTHS["study"],
    "curve_below": LENGTHS["below"],
    "curve_height": LENGTHS["height"],
    "curve_half_spaces": Variable("1", "whether the curves are those of half-spaces"),
    "curve_ratio": Variable("1", "weakening over direct effect", "zeta/a"),
    "curve_stability": Variable("1", "L_s over L_c", "L_s/L_c"),
    "curve_runaway": Variable("1", "L_run over L_c, NaN where zeta/a > 2", "L_run/L_c"),
    "curve_law": Variable("1", "length at the drop by the law over L_c, median", "L/L_c"),
}
"""The theory over zeta/a for each pair of study, base and height."""

CURVE = np.geomspace(0.2, 6.0, 22)  # zeta/a of the curves
AS_HALF_SPACES = 100.0  # factor of a height that makes a block a half-space

_OVER_CRITICAL = ("stability_length", "runaway_length", "law_length")


def expected(parameters: Run) -> Row:
    """The columns :data:`EXPECTED` of one fault under its perturbation; NaN without a drop."""
    try:
        known = drop_of_run(parameters)
    except NoLength as error:
        none = dict.fromkeys(EXPECTED, float("nan"))
        return none | {"runaway_status": error.status, "doubt": str(error)}
    return {
        "stability_length": known.stability_length,
        "runaway_length": known.runaway_length,
        "runaway_status": known.runaway_status,
        "law_length": known.law.length,
        "expected_length": known.length,
        "expected_low": known.low,
        "expected_high": known.high,
        "doubt": known.doubt,
    }


def gather_weakening(drops: Iterable[xr.Dataset], runs: Iterable[Row]) -> xr.Dataset:
    """The simulated drops of all runs beside the theory of their faults."""
    by_fault = {}
    for run in runs:
        parameters = Run.from_dict(run["parameters"])
        by_fault[fault(parameters)] = expected(parameters)
    names = (*MEASURED, "zeta_over_a", "fault")
    rows = []
    for lengths in drops:
        ratio = lengths["zeta"] / lengths["a"]
        complete = lengths.assign(zeta_over_a=ratio)
        for row in rows_of(complete, names=names):
            rows.append(row | by_fault[row["fault"]])
    return table(rows, COLUMNS)


def weakening_files(drops: Iterable[xr.Dataset], runs: Iterable[Row]) -> dict[str, Any]:
    """The table of :func:`gather_weakening` as CSV, and with :data:`CURVES`."""
    runs = list(runs)
    rows = gather_weakening(drops, runs)
    return {".nc": rows.merge(weakening_curves(runs)), ".csv": to_csv(rows)}


def weakening_curves(runs: Iterable[Row], ratios: Iterable[float] = CURVE) -> xr.Dataset:
    """Lengths by theory over zeta/a, of each study, base and height.

    Blocks on a deformable base that are higher than L_c in all their runs are as good as
    half-spaces; they have the curves of half-spaces.
    """
    systems: dict[tuple[str, str, float], list[Row]] = {}
    for run in runs:
        parameters = Run.from_dict(run["parameters"])
        below = "rigid" if parameters.below is None else "deformable"
        key = run["study"], below, parameters.fault.height
        systems.setdefault(key, []).append(run)
    ratios = list(ratios)
    high = []
    lengths = []
    for (_, below, height), own in systems.items():
        longest = max(run["critical_length"] for run in own)
        is_high = below == "deformable" and height > longest
        parameters = Run.from_dict(own[0]["parameters"])
        if is_high:
            parameters = _as_half_spaces(parameters)
        high.append(is_high)
        lengths.append([_over_critical(parameters, ratio) for ratio in ratios])
    studies, bases, heights = zip(*systems, strict=True)
    stability, runaway, law = np.moveaxis(
        np.array(lengths),
        -1,
        0,
    )
    along = ("system", "curve")
    found = xr.Dataset(
        {
            "curve_study": ("system", list(studies)),
            "curve_below": ("system", list(bases)),
            "curve_height": ("system", list(heights)),
            "curve_half_spaces": ("system", high),
            "curve_ratio": ("curve", ratios),
            "curve_stability": (along, stability),
            "curve_runaway": (along, runaway),
            "curve_law": (along, law),
        }
    )
    return annotate(found, CURVES)


def _as_half_spaces(parameters: Run) -> Run:
    """The same pair of blocks, much higher."""
    below = parameters.below
    assert below is not None
    heights = {
        "height": AS_HALF_SPACES * parameters.fault.height,
        "second_height": AS_HALF_SPACES * below.height,
    }
    return parameters.replaced(**heights)


def _over_critical(parameters: Run, ratio: float) -> list[float]:
    """L_s, L_run and the law's length over L_c, of the fault with another zeta/a."""
    own = parameters.replaced(zeta_over_a=ratio)
    critical = own.critical_length
    known = expected(own)
    return [known[name] / critical for name in _OVER_CRITICAL]


OF_FAULT = some(
    LENGTHS,
    "friction_law evolution height below far_side shear_modulus second_shear_modulus kind "
    "strength critical_length",
)

_SIMULATED = {
    "realisations": Variable("1", "number of realisations"),
    "length": LENGTHS["length"],  # the mean of the realisations
    "length_least": Variable("m", "least length at the drop of a realisation", "L"),
    "length_largest": Variable("m", "largest length at the drop of a realisation", "L"),
    "reached_length": LENGTHS["reached_length"],  # the largest of the realisations
    "inside": Variable("1", "number of realisations in the expected range"),
}

OF_FAULTS = {"zeta_over_a": RATIO_COLUMNS["zeta_over_a"], **OF_FAULT, **EXPECTED, **_SIMULATED}


def gather_other_faults(drops: xr.Dataset, runs: Iterable[Row]) -> xr.Dataset:
    """The simulated drops of each fault beside the theory."""
    rows = []
    for run in runs:
        parameters = Run.from_dict(run["parameters"])
        own = drops.isel(run=np.flatnonzero(drops["ensemble"].values == ensemble(parameters)))
        rows.append(_of_fault(own, expected(parameters)))
    return table(rows, OF_FAULTS)


def _of_fault(own: xr.Dataset, theory: Row) -> Row:
    """One fault's row, of the lengths (m) of its realisations and its :data:`EXPECTED`."""
    (row,) = rows_of(
        own,
        [0],
        (*OF_FAULT, "zeta", "a"),
    )
    lengths = own["length"].values
    is_inside = (lengths >= theory["expected_low"]) & (lengths <= theory["expected_high"])
    simulated = {
        "zeta_over_a": row["zeta"] / row["a"],
        "realisations": lengths.size,
        "length": float(lengths.mean()),
        "length_least": float(lengths.min()),
        "length_largest": float(lengths.max()),
        "reached_length": float(own["reached_length"].max()),
        "inside": int(is_inside.sum()),
    }
    return row | theory | simulated
