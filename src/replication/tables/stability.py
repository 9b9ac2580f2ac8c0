"""The table of the lengths at which patches of many runs turn unstable."""

from collections.abc import Iterable

import xarray as xr

from nucleation.datasets.variables import Variable, some, table
from nucleation.extraction.growth import FITTED

from .lengths import COLUMNS, description
from .rows import RATIO_COLUMNS, Row

STABILITY = {
    **some(
        COLUMNS,
        "id study role evolution height initial_state n_x n_y grading tolerance longest_step",
    ),
    **FITTED,
    "critical_length": COLUMNS["critical_length"],
    "stability_ratio": RATIO_COLUMNS["stability_ratio"],
    "stability_change": Variable("1", "L_s over that of the converged run, minus one"),
    "fault": COLUMNS["fault"],
}


def gather_stability(runs: Iterable[Row], patches: Iterable[xr.Dataset]) -> xr.Dataset:
    """The lengths at which the frozen patches turn unstable."""
    rows = []
    for run, patch in zip(runs, patches, strict=True):
        fitted = {name: float(patch[name]) for name in FITTED}
        rows.append(description(run) | fitted)
    converged = {
        row["fault"]: row["stability_length"] for row in rows if row["role"] == "converged"
    }
    for row in rows:
        reference = converged.get(row["fault"], float("nan"))
        row["stability_ratio"] = row["stability_length"] / row["critical_length"]
        row["stability_change"] = row["stability_length"] / reference - 1.0
    return table(rows, STABILITY)
