"""Simulated drops beside L_s, L_run and the law of the drop, one row for each run.

The runs cover faults from weak to strong weakening: where zeta/a is small the patch slips slowly
in a limit cycle up to L_run, and where it is large the law of the drop holds.
"""

from collections.abc import Iterable
from typing import Any

import xarray as xr

from ...analysis.lengths import COLUMNS as LENGTHS
from ...analysis.rows import RATIO_COLUMNS, Row, rows_of
from ...datasets.variables import Variable, some, table
from ...model.identity import fault
from ...model.parameters import Parameters
from ..expected_drop import NoDrop, expected_drop

MEASURED = some(
    LENGTHS,
    "study",
    "id",
    "evolution",
    "height",
    "below",
    "kind",
    "strength",
    "seed",
    "n_x",
    "n_y",
    "block_length",
    "onset_time",
    "length",
    "critical_length",
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


def expected(parameters: Parameters) -> Row:
    """The columns :data:`EXPECTED` of one fault under its perturbation; NaN without a drop."""
    try:
        known = expected_drop(parameters)
    except NoDrop as error:
        none = dict.fromkeys(EXPECTED, float("nan"))
        return none | {"runaway_status": error.status, "doubt": str(error)}
    return {
        "stability_length": known.stability_length,
        "runaway_length": known.runaway_length,
        "runaway_status": known.runaway_status,
        "law_length": known.drop.length,
        "expected_length": known.length,
        "expected_low": known.low,
        "expected_high": known.high,
        "doubt": known.doubt,
    }


def gather_weakening(
    drops: Iterable[xr.Dataset],
    runs: Iterable[dict[str, Any]],
) -> xr.Dataset:
    """The simulated drops of all runs beside the theory of their faults.

    Parameters
    ----------
    drops : iterable of Dataset
        Tables of lengths of the studies.
    runs : iterable of dict
        One run of each fault, from :meth:`nucleation.configuration.runs.Run.to_dict`.

    Returns
    -------
    Dataset
        :data:`COLUMNS` on ``run``.
    """
    by_fault = {}
    for run in runs:
        parameters = Parameters.from_dict(run["parameters"])
        by_fault[fault(parameters)] = expected(parameters)
    names = (*MEASURED, "zeta_over_a", "fault")
    rows = []
    for lengths in drops:
        ratio = lengths["zeta"] / lengths["a"]
        complete = lengths.assign(zeta_over_a=ratio)
        for row in rows_of(complete, names=names):
            rows.append(row | by_fault[row["fault"]])
    return table(rows, COLUMNS)
