"""Simulations of jobs and commands: start from a checkpoint, write the record to a file."""

import sys
from collections.abc import Callable, Mapping
from pathlib import Path

import xarray as xr

from nucleation.datasets import netcdf, provenance
from nucleation.model.friction.registry import plugins
from nucleation.model.parameters import Parameters
from nucleation.simulation.checkpoints import Checkpoint, Stopped
from nucleation.simulation.control import Instant
from nucleation.simulation.progress import Progress
from nucleation.simulation.run import simulate

from . import code
from .messages import LOGGER
from .recipes import PartFailed, Recipe

SIMULATE = "nucleation.simulation.run:simulate"
UNFINISHED = "unfinished"  # directory of checkpoints, and of records of runs that failed


def run_of(
    recipe: Recipe,
    put: Callable[[Recipe, xr.Dataset], None],
    origin: Mapping[str, str],
) -> xr.Dataset:
    """Make the record of a simulation, from its checkpoint if there is one.

    A signal ends the process after it has written a checkpoint.

    Parameters
    ----------
    recipe : Recipe
        Recipe of the simulation.
    put : callable
        Puts the record of a finished run into the store.
    origin : mapping
        Attributes for the record of a failed run.

    Returns
    -------
    Dataset
        The record.

    Raises
    ------
    PartFailed
        If the run has failed; its record is among the unfinished ones.
    SystemExit
        If a signal stops the run.
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
    status = dataset.attrs["status"]
    if path != place:
        raise PartFailed(f"{name}: {status}; its record is in {path}")
    LOGGER.info(f"{name}: {status}")
    return dataset


def run_to_file(
    simulate: Callable[..., xr.Dataset],
    parameters: Parameters,
    output: Path,
    write: Callable[[xr.Dataset, Path], None],
    checkpoint: Checkpoint,
    progress: Callable[[Instant], None],
) -> tuple[xr.Dataset, Path]:
    """Run a simulation, from the checkpoint if there is one, and write its record.

    The checkpoint is removed after the record was written. A signal that stops the run leaves it.

    Parameters
    ----------
    simulate : callable
        Runs the simulation, as :func:`nucleation.simulation.run.simulate`.
    parameters : Parameters
        Its parameters.
    output : Path
        File for the record; that of a failed run has the suffix ``.failed.nc`` instead.
    write : callable
        Writes a record to a path.
    checkpoint : Checkpoint
        State of an earlier, unfinished run, and the place for new ones.
    progress : callable
        It is called after every step.

    Returns
    -------
    Dataset
        The record.
    Path
        Its file.

    Raises
    ------
    Stopped
        If a signal stops the run.
    """
    dataset = simulate(
        parameters,
        progress=progress,
        start=checkpoint.load(),
        keep=checkpoint.keep,
    )
    failed = output.with_suffix(".failed.nc")
    path = output if dataset.attrs["completed"] else failed
    write(dataset, path)
    checkpoint.remove()
    if path == output:
        failed.unlink(missing_ok=True)
    return dataset, path


def checkpoint_of(parameters: Parameters, output: Path, code_digest: str) -> Checkpoint:
    """The checkpoint of a run.

    Parameters
    ----------
    parameters : Parameters
        Parameters of the run.
    output : Path
        File for its record; the checkpoint is in the same directory.
    code_digest : str
        Digest of its code; a checkpoint of other code is refused.

    Returns
    -------
    Checkpoint
        Its file need not exist.
    """
    fingerprint = provenance.fingerprint(parameters.to_dict(), code_digest)
    return Checkpoint(output.with_suffix(".checkpoint.npz"), fingerprint)


def simulation_code(parameters: Parameters) -> str:
    """Digest of the code of a simulation, as in the workflow."""
    module = SIMULATE.partition(":")[0]
    return code.digest(module, *code.ALWAYS, *plugins(parameters))
