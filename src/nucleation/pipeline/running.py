"""A simulation from its checkpoint, if there is one, into its file."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import xarray as xr

from ..datasets import netcdf, provenance
from ..model.friction.registry import plugins
from ..model.parameters import Parameters
from ..simulation.checkpoints import Checkpoint
from . import code

Simulate = Callable[..., xr.Dataset]


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
    simulate : :func:`nucleation.simulation.run.simulate`. The caller imports it, so that it counts
        as code that the caller's result depends on.
    parameters : of the run.
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
