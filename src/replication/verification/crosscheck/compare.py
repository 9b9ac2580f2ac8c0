"""Two independent solvers on the same runs: by how much their results differ.

Both solvers have the same parameters and the same nodes along x. Differences are relative to the
project's own solver. They are measured over the creep before the event. The comparison begins when
the patch is some elements long. It ends before the patch oscillates: each hop of the front from
node to node perturbs the growing oscillation, and the two solvers separate.
"""

from collections.abc import Iterable, Sequence

import numpy as np
import xarray as xr

from nucleation.datasets.variables import DatasetError, Variable, some, table
from nucleation.extraction.definitions import ExtractionSettings
from nucleation.extraction.extraction import extract
from nucleation.extraction.record import Record
from nucleation.types import Array

from ...tables.lengths import COLUMNS as LENGTHS

SETTLED = 20.0  # start of the comparison, in units of D/V
BEFORE_ONSET = 0.9  # end of the comparison, as a part of the earlier onset
INSTANTS = 2000  # at which two records are compared
COLUMNS = {
    **some(LENGTHS, "id", "height", "n_x", "n_y", "onset_time"),
    "onset_time_freefem": Variable("s", "onset of the event, by FreeFem++", "t"),
    "length": LENGTHS["length"],
    "length_freefem": Variable("m", "length at the drop, by FreeFem++", "L"),
    "patch_length_rms": Variable("1", "relative difference of L(t), root mean square"),
    "patch_length_largest": Variable("1", "relative difference of L(t), largest"),
    "patch_length_elements": Variable("1", "largest difference of L(t) over the element's length"),
    "driving_force_rms": Variable("1", "relative difference of f_d(t), root mean square"),
    "driving_force_largest": Variable("1", "relative difference of f_d(t), largest"),
    "steps": LENGTHS["steps"],
    "steps_freefem": Variable("1", "number of time steps of FreeFem++"),
}


def compare(
    own: xr.Dataset,
    theirs: xr.Dataset,
    settings: ExtractionSettings = ExtractionSettings(),
) -> dict[str, float]:
    """Compute one row of the table: onset, critical length, differences.

    Parameters
    ----------
    own, theirs : Dataset
        Records of the same run by :func:`nucleation.simulation.run.simulate` and
        :func:`replication.verification.crosscheck.freefem.solve`.
    settings : ExtractionSettings
        Edge of the patch and drop of the force.

    Returns
    -------
    dict
        All of :data:`COLUMNS` but ``id``. Times in s, lengths in m. Root mean squares and largest
        differences of L(t) and f_d(t) are relative; the largest of L(t) is given in elements as
        well. NaN where a run has no event or is too short, or has no patch before 0.9 of the onset.
    """
    record = Record(own, settings)
    record_freefem = Record(theirs, settings)
    parameters = record.parameters
    found = extract(own, settings)
    found_freefem = extract(theirs, settings)
    onsets = [found["onset_time"], found_freefem["onset_time"]]
    end = BEFORE_ONSET * np.min(onsets)
    instants = np.linspace(SETTLED * parameters.memory_time, end, INSTANTS)
    patch = np.interp(instants, record.time, record.lengths)
    patch_freefem = np.interp(instants, record_freefem.time, record_freefem.lengths)
    exists = (patch > 0.0) & (patch_freefem > 0.0)
    patch = patch[exists]
    patch_freefem = patch_freefem[exists]
    force = _driving_force(own, instants)
    force_freefem = _driving_force(theirs, instants)
    element = parameters.geometry.length / parameters.mesh.n_x
    return {
        "height": parameters.geometry.height,
        "n_x": parameters.mesh.n_x,
        "n_y": parameters.mesh.n_y,
        "patch_length_elements": _largest((patch_freefem - patch) / element),
        "patch_length_rms": _root_mean_square(patch_freefem / patch - 1.0),
        "patch_length_largest": _largest(patch_freefem / patch - 1.0),
        "driving_force_rms": _root_mean_square(force_freefem / force - 1.0),
        "driving_force_largest": _largest(force_freefem / force - 1.0),
        "onset_time": found["onset_time"],
        "length": found["length"],
        "steps": own.attrs["steps"],
        "onset_time_freefem": found_freefem["onset_time"],
        "length_freefem": found_freefem["length"],
        "steps_freefem": theirs.attrs["steps"],
    }


def _driving_force(run: xr.Dataset, instants: Array) -> Array:
    """f_d (N/m) at some instants (s)."""
    return np.interp(
        instants,
        run["step_time"].values,
        run["driving_force"].values,
    )


def _root_mean_square(values: Array) -> float:
    if values.size == 0:
        return np.nan
    mean_square = np.mean(values**2)
    return float(np.sqrt(mean_square))


def _largest(values: Array) -> float:
    if values.size == 0:
        return np.nan
    return float(np.abs(values).max())


def compared(
    ids: Sequence[str],
    own: Iterable[xr.Dataset],
    freefem: Iterable[xr.Dataset],
    settings: ExtractionSettings,
) -> xr.Dataset:
    """Compare runs by both solvers.

    Parameters
    ----------
    ids : sequence of str
        Identifiers of the runs.
    own, freefem : iterable of Dataset
        Their records by the two solvers, in the same order.
    settings : ExtractionSettings
        Edge of the patch and drop of the force.

    Returns
    -------
    Dataset
        :data:`COLUMNS` on ``run``.

    Raises
    ------
    DatasetError
        If a run of the own solver has failed.
    """
    records = list(own)
    for id, record in zip(ids, records, strict=True):
        if not record.attrs["completed"]:
            raise DatasetError(f"the run {id} has no result: {record.attrs['status']}")
    rows = [
        {"id": id, **compare(record, other, settings)}
        for id, record, other in zip(ids, records, freefem, strict=True)
    ]
    return table(rows, COLUMNS)
