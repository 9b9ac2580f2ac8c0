"""Runs of the project's own solver, in full."""

import xarray as xr

from ...datasets.variables import DatasetError
from ...model.parameters import Parameters
from ...simulation.run import simulate


def of_run(parameters: Parameters) -> xr.Dataset:
    """The step ``crosscheck_own``: a record; DatasetError, with the reason, if not complete."""
    record = simulate(parameters)
    if not record.attrs["completed"]:
        raise DatasetError(f"the run has no result: {record.attrs['status']}")
    return record
