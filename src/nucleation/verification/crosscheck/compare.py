"""Two independent solvers on the same runs: which runs, and by how much their results differ.

Both solvers get the same parameters and the same nodes along x. Differences are relative to the
project's own solver. They are measured over the creep before the event: from the time when the
patch is some elements long until the growing oscillation of the patch, which every hop of the
front from node to node shakes, begins to tell the two apart.
"""

from collections.abc import Iterable, Sequence

import numpy as np
import xarray as xr

from ...analysis.definitions import ExtractionSettings
from ...analysis.extraction import extract
from ...analysis.lengths import COLUMNS as LENGTHS
from ...analysis.record import Record
from ...datasets.variables import DatasetError, Variable, some, table
from ...types import Array

SETTLED = 20.0  # start of the comparison, in units of D/V
BEFORE_ONSET = 0.9  # end of the comparison, as a part of the earlier onset
INSTANTS = 2000  # at which two records are compared
COLUMNS = {
    **some(LENGTHS, "id", "height", "n_x", "n_y", "onset_time"),
    "onset_time_freefem": Variable("s", "onset of the event, by FreeFem++", "t"),
    "length": LENGTHS["length"],
    "length_freefem": Variable("m", "critical nucleation length, by FreeFem++", "L_c"),
    "patch_length_rms": Variable("1", "relative difference of L(t), root mean square"),
    "patch_length_largest": Variable("1", "relative difference of L(t), largest"),
    "patch_length_elements": Variable("1", "largest difference of L(t) over the element's length"),
    "driving_force_rms": Variable("1", "relative difference of f_d(t), root mean square"),
    "driving_force_largest": Variable("1", "relative difference of f_d(t), largest"),
    "steps": LENGTHS["steps"],
    "steps_freefem": Variable("1", "number of time steps of FreeFem++"),
}


def compare(
    own: xr.Dataset, theirs: xr.Dataset, settings: ExtractionSettings = ExtractionSettings()
) -> dict[str, float]:
    """The numbers of one row of the table: onset, critical length, differences.

    Parameters
    ----------
    own, theirs : records of the same run by :func:`nucleation.simulation.run.simulate` and
        :func:`nucleation.verification.crosscheck.freefem.run`.
    settings : edge of the patch and drop of the force.

    Returns
    -------
    All of :data:`COLUMNS` but ``id``. Times in s, lengths in m. Root mean squares and largest
    differences of L(t) and f_d(t) are relative; the largest of L(t) is given in elements as well.
    NaN where a run has no event or is too short, or has no patch before 0.9 of the onset.
    """
    runs, records = (own, theirs), [Record(run, settings) for run in (own, theirs)]
    parameters, measured = records[0].parameters, [extract(run, settings) for run in runs]
    end = BEFORE_ONSET * np.min([found["onset_time"] for found in measured])
    instants = np.linspace(SETTLED * parameters.memory_time, end, INSTANTS)
    patch, patch_freefem = (np.interp(instants, run.time, run.lengths) for run in records)
    force, force_freefem = (
        np.interp(instants, run["step_time"].values, run["driving_force"].values) for run in runs
    )
    there = (patch > 0.0) & (patch_freefem > 0.0)
    patch, patch_freefem = patch[there], patch_freefem[there]
    mesh, dx = parameters.mesh, parameters.geometry.length / parameters.mesh.n_x
    row = {"height": parameters.geometry.height, "n_x": mesh.n_x, "n_y": mesh.n_y}
    row["patch_length_elements"] = _largest((patch_freefem - patch) / dx)
    differences = {"patch_length": patch_freefem / patch, "driving_force": force_freefem / force}
    for name, ratio in differences.items():
        rms = np.sqrt(np.mean((ratio - 1.0) ** 2)) if ratio.size else np.nan
        row |= {f"{name}_rms": float(rms), f"{name}_largest": _largest(ratio - 1.0)}
    for whose, found, run in zip(("", "_freefem"), measured, runs, strict=True):
        row |= {f"{name}{whose}": found[name] for name in ("onset_time", "length")}
        row[f"steps{whose}"] = run.attrs["steps"]
    return row


def _largest(values: Array) -> float:
    return float(np.abs(values).max()) if values.size else np.nan


def compared(
    ids: Sequence[str], own: Iterable[xr.Dataset], freefem: Iterable[xr.Dataset],
    settings: ExtractionSettings,
) -> xr.Dataset:  # fmt: skip
    """:data:`COLUMNS` on ``run``, each run by both solvers."""
    own = list(own)
    for id, run in zip(ids, own, strict=True):
        if not run.attrs["completed"]:
            raise DatasetError(f"the run {id} has no result: {run.attrs['status']}")
    rows = [
        {"id": id, **compare(one, other, settings)}
        for id, one, other in zip(ids, own, freefem, strict=True)
    ]
    return table(rows, COLUMNS)
