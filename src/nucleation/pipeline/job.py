"""One job of a workflow: a simulation from its checkpoint, if there is one, into its file."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import xarray as xr

from ..datasets import netcdf, provenance
from ..model.parameters import Parameters
from ..simulation.checkpoints import (
    Checkpoint,
)
from ..simulation.control import Instant
from ..simulation.run import simulate


def run_to_file(
    parameters: Parameters,
    output: Path,
    code_digest: str,
    command: str,
    *,
    checkpoint: Checkpoint,
    progress: Callable[[Instant], None],
) -> tuple[xr.Dataset, Path]:
    """Simulate, from the checkpoint if there is one, and write the record.

    Parameters
    ----------
    parameters : of the run.
    output : place of the result; the record of a failed run goes beside it, as ``.failed.nc``.
    code_digest, command : for :func:`nucleation.datasets.provenance.attributes`.
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
    attributes = provenance.attributes(parameters.to_dict(), code_digest, command)
    netcdf.write(dataset, path, **attributes)
    checkpoint.remove()
    if path == output:
        failed.unlink(missing_ok=True)
    return dataset, path


def checkpoint_of(parameters: Parameters, output: Path, code_digest: str) -> Checkpoint:
    """The checkpoint of a run, beside the place of its result."""
    fingerprint = provenance.fingerprint(parameters.to_dict(), code_digest)
    return Checkpoint(output.with_suffix(".checkpoint.npz"), fingerprint)
