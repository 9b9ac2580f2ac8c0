"""Runs of the project's own solver with the time that their steps took."""

import time

import xarray as xr

from ...datasets.variables import DatasetError, annotate
from ...model.parameters import Parameters
from ...simulation.run import simulate
from .plan import TIMES


def simulate_timed(parameters: Parameters) -> xr.Dataset:
    """The record of the project's own solver, with the processor's ``elapsed_time`` (s)."""
    elapsed: list[float] = []
    began = time.process_time()
    record = simulate(parameters, progress=lambda _: elapsed.append(time.process_time() - began))
    return annotate(record.assign(elapsed_time=("step", elapsed)), TIMES)


def own(parameters: Parameters) -> xr.Dataset:
    """The step ``crosscheck_own``: :func:`simulate_timed`, refused if it is not complete.

    Raises
    ------
    DatasetError
        With the reason.
    """
    record = simulate_timed(parameters)
    if not record.attrs["completed"]:
        raise DatasetError(f"the run has no result: {record.attrs['status']}")
    return record
