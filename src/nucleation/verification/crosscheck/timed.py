"""Runs of the project's own solver with the time that their steps took."""

from __future__ import annotations

import time

import xarray as xr

from ...datasets.variables import annotate
from ...model.parameters import Parameters
from ...simulation.run import simulate
from .plan import TIMES


def simulate_timed(parameters: Parameters) -> xr.Dataset:
    """The record of the project's own solver, with the processor's ``elapsed_time`` (s)."""
    elapsed: list[float] = []
    began = time.process_time()
    record = simulate(parameters, progress=lambda _: elapsed.append(time.process_time() - began))
    return annotate(record.assign(elapsed_time=("step", elapsed)), TIMES)
