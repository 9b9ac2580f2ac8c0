"""Simulations of jobs and commands: from a checkpoint on, to a record in a file."""

import sys
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any

import xarray as xr

from ..datasets import netcdf, provenance
from ..model.friction.registry import plugins
from ..model.parameters import Parameters
from ..simulation.checkpoints import Checkpoint, Stopped
from ..simulation.progress import Progress
from ..simulation.run import simulate
from . import code
from .recipes import PartFailed, Recipe

SIMULATE = "nucleation.simulation.run:simulate"
UNFINISHED = "unfinished"  # directory with checkpoints, and records of runs that failed


def run_of(
    recipe: Recipe, put: Callable[[Recipe, xr.Dataset], None], origin: Mapping[str, str]
) -> xr.Dataset:
    """The record of a simulation, made from its checkpoint on if there is one, and put away.

    A signal ends the process, after a checkpoint.

    Parameters
    ----------
    recipe : of the simulation.
    put : puts the record of a finished run into the store.
    origin : attributes of the record of one that has failed.

    Raises
    ------
    PartFailed
        If the run has failed; its record is among the unfinished.
    """
    name = recipe.name.rpartition("/")[2]
    parameters = Parameters.from_dict(recipe.values["parameters"])
    place = Path(recipe.results, UNFINISHED, f"{name}.nc")
    checkpoint = checkpoint_of(parameters, place, recipe.code)

    def write(dataset: xr.Dataset, path: Path) -> None:
        if path == place:
            put(recipe, dataset)
        else:
            netcdf.write(dataset, path, **origin)

    progress = Progress(parameters, sys.stderr, name=name)
    try:
        with checkpoint.listening():
            dataset, path = run_to_file(simulate, parameters, place, write, checkpoint, progress)
    except Stopped as stopped:
        sys.exit(f"{name}: {stopped}")
    if path != place:
        raise PartFailed(f"{name}: {dataset.attrs['status']}; its record is in {path}")
    print(f"{name}: {dataset.attrs['status']}", file=sys.stderr)
    return dataset


def run_to_file(
    simulate: Callable[..., xr.Dataset],
    parameters: Parameters,
    output: Path,
    write: Callable[[xr.Dataset, Path], None],
    checkpoint: Checkpoint,
    progress: Callable[[Any], None],
) -> tuple[xr.Dataset, Path]:
    """Simulate, from the checkpoint if there is one, and write the record; it, and where it is.

    The record of a failed run goes beside `output`, as ``.failed.nc``. The checkpoint is removed
    once the record is written; a signal that stops the run leaves it, and raises Stopped.
    """
    dataset = simulate(parameters, progress=progress, start=checkpoint.load(), keep=checkpoint.keep)
    failed = output.with_suffix(".failed.nc")
    path = output if dataset.attrs["completed"] else failed
    write(dataset, path)
    checkpoint.remove()
    if path == output:
        failed.unlink(missing_ok=True)
    return dataset, path


def checkpoint_of(parameters: Parameters, output: Path, code_digest: str) -> Checkpoint:
    """The checkpoint of a run, beside the place of its result."""
    fingerprint = provenance.fingerprint(parameters.to_dict(), code_digest)
    return Checkpoint(output.with_suffix(".checkpoint.npz"), fingerprint)


def simulation_code(parameters: Parameters) -> str:
    """Digest of the code that a simulation runs, as in the workflow."""
    return code.digest(SIMULATE.partition(":")[0], *code.ALWAYS, *plugins(parameters))
