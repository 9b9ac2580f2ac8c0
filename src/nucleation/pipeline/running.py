"""Simulations of jobs: from their file, from under their key, or made, from a checkpoint on."""

from __future__ import annotations

import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import xarray as xr

from ..datasets import netcdf, provenance
from ..model.friction.registry import plugins
from ..model.parameters import Parameters
from ..simulation.checkpoints import Checkpoint
from . import code
from .job import Job, Result
from .progress import Progress

Simulate = Callable[..., xr.Dataset]


class Failed(Exception):
    """A run ended without its result, and has left a record."""


def record_of(job: Job, simulate: Simulate, parameters: Parameters, result: Result) -> xr.Dataset:
    """The record of a run, found or made, and now in its place.

    Parameters
    ----------
    job : which asks for it.
    simulate : :func:`nucleation.simulation.run.simulate`. The caller imports it, so that it counts
        as code that the caller's result depends on.
    parameters : of the run.
    result : where it belongs, its key and code.

    Raises
    ------
    DatasetError
        If what is there is damaged or of another key.
    Failed
        If the run ends before its end time or event; its record is beside the place of the result.
    Stopped
        If a signal has stopped the run, which has left a checkpoint.
    """
    if result.path.is_file() or job.fetched(result):
        return job.read(str(result.path), result.key)
    checkpoint = checkpoint_of(parameters, result.path, result.code)
    checkpoint.listen()
    dataset, path = run_to_file(
        simulate,
        parameters,
        result.path,
        job.attributes(parameters.to_dict(), result),
        checkpoint=checkpoint,
        progress=Progress(parameters, sys.stderr),
    )
    if path != result.path:
        raise Failed(f"{result.path.stem}: {dataset.attrs['status']}; its record is in {path}")
    job.keep(result)
    return dataset


def run_to_file(
    simulate: Simulate,
    parameters: Parameters,
    output: Path,
    attributes: Mapping[str, Any],
    *,
    checkpoint: Checkpoint,
    progress: Callable[[Any], None],
) -> tuple[xr.Dataset, Path]:
    """Simulate, from the checkpoint if there is one, and write the record.

    Parameters
    ----------
    simulate, parameters : as of :func:`record_of`.
    output : place of the result; the record of a failed run goes beside it, as ``.failed.nc``.
    attributes : of the dataset, from :func:`nucleation.datasets.provenance.attributes`.
    checkpoint : of :func:`checkpoint_of`; it is removed once the record is written.
    progress : called with every accepted step.

    Returns
    -------
    The record, and where it was written.

    Raises
    ------
    Stopped
        If a signal has stopped the run, which has left a checkpoint.
    """
    dataset = simulate(parameters, progress=progress, start=checkpoint.load(), keep=checkpoint.keep)
    failed = output.with_suffix(".failed.nc")
    path = output if dataset.attrs["completed"] else failed
    netcdf.write(dataset, path, **attributes)
    checkpoint.remove()
    if path == output:
        failed.unlink(missing_ok=True)
    return dataset, path


def checkpoint_of(parameters: Parameters, output: Path, code_digest: str) -> Checkpoint:
    """The checkpoint of a run, beside the place of its result."""
    fingerprint = provenance.fingerprint(parameters.to_dict(), code_digest)
    return Checkpoint(output.with_suffix(".checkpoint.npz"), fingerprint)


def simulation_code(parameters: Parameters) -> str:
    """Digest of the code that a simulation runs, outside of the workflow."""
    return code.digest("nucleation.simulation.run", *code.ALWAYS, *plugins(parameters))
