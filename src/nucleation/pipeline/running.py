"""Simulations of jobs: from a store, or made, from a checkpoint on."""

import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import xarray as xr

from ..analysis.progress import Progress
from ..datasets import netcdf, provenance
from ..model.friction.registry import plugins
from ..model.parameters import Parameters
from ..simulation.checkpoints import Checkpoint, Stopped
from .job import Job, end, running
from .steps import LINKS, Task
from .store import path_in

SIMULATE = "nucleation.simulation.run:simulate"
UNFINISHED = "unfinished"  # directory with checkpoints, and records of runs that failed


def task_of_run(run: dict[str, Any], results: Path) -> Task:
    """The task to simulate a run, from :meth:`nucleation.configuration.runs.Run.to_dict`."""
    loads = plugins(Parameters.from_dict(run["parameters"]))
    task = Task("", SIMULATE, loads, {"parameters": run["parameters"]}, {})
    return task._replace(link=f"{results}/{LINKS}/simulations/{run['id']}.{task.key}.nc")


def _record(job: Job, task: Task, failures: list[str]) -> xr.Dataset | None:
    """The record of a run, found or made, and now in the store; None of one that failed.

    A run that fails is noted, and has left its record among the unfinished. A signal that stops it,
    or came in the run before, ends the job; what has begun has left a checkpoint.
    """
    name = Path(task.link).stem
    if job.listener is not None and job.listener.asked is not None:
        end(f"{name}: not begun, since the job was stopped by {job.listener.asked}")
    if job.found(task.key):
        dataset: xr.Dataset = job.open(str(path_in(job.store.entry(task.key), ".nc")))
        return dataset
    from ..simulation.run import simulate

    parameters = Parameters.from_dict(task.values["parameters"])
    place = job.results / UNFINISHED / f"{name}.nc"
    job.listener = checkpoint = checkpoint_of(parameters, place, task.code)
    checkpoint.listen()

    def write(dataset: xr.Dataset, path: Path) -> None:
        if path == place:
            job.put(task, dataset)
        else:
            netcdf.write(dataset, path, **job.origin(task))

    progress = Progress(parameters, sys.stderr)
    try:
        dataset, path = run_to_file(simulate, parameters, place, write, checkpoint, progress)
    except Stopped as stopped:
        end(f"{name}: {stopped}")
    if path == place:
        return dataset
    failures.append(f"{name}: {dataset.attrs['status']}; its record is in {path}")
    print(failures[-1], file=sys.stderr)
    return None


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
    return Task("", SIMULATE, plugins(parameters), {}, {}).code


def run(snakemake: Any) -> None:
    """Make the simulations of a job, or the table of a batch of them; link what is made.

    One that fails does not keep the others.
    """
    with running(snakemake) as job:
        failures: list[str] = []
        for task in job.tasks:
            if task.call == SIMULATE:
                _record(job, task, failures)
            elif not job.found(task.key):
                runs = [task_of_run(one, job.results) for one in task.values["runs"]]
                table = job.called(task, records=(_record(job, one, failures) for one in runs))
                _stop_on(failures, len(runs))  # before a table without them is kept
                job.put(task, table)
            job.leave_link(task)
        _stop_on(failures, len(job.tasks))


def _stop_on(failures: list[str], number: int) -> None:
    if failures and number == 1:
        end(failures[0])
    if failures:
        count = f"{len(failures)} of {number} runs failed"
        end("\n  ".join([f"{count}, the others are kept:", *failures]))
