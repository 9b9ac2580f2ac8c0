"""A simulation that starts from its checkpoint and writes its record to a file."""

from collections.abc import Callable
from pathlib import Path

import xarray as xr

from ..datasets import code, provenance
from ..model.friction import plugins
from ..run.run import Run
from .checkpoints import Checkpoint
from .control import Instant
from .run import simulate


def run_to_file(
    run: Run,
    output: Path,
    write: Callable[[xr.Dataset, Path], None],
    checkpoint: Checkpoint,
    progress: Callable[[Instant], None],
) -> tuple[xr.Dataset, Path]:
    """Run a simulation and write its record; return both the record and its file.

    The record of a failed run is in `output` with the suffix ``.failed.nc``. A signal raises
    Stopped and leaves the checkpoint.
    """
    dataset = simulate(
        run,
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


def checkpoint_of(run: Run, output: Path, code_digest: str) -> Checkpoint:
    """The checkpoint of a run, beside its output; one of other code or parameters is refused."""
    fingerprint = provenance.fingerprint(run.to_dict(), code_digest)
    return Checkpoint(output.with_suffix(".checkpoint.npz"), fingerprint)


def simulation_code(run: Run) -> str:
    """Digest of the code of a simulation, as in the workflow."""
    return code.digest("nucleation.simulation.run", *code.ALWAYS, *plugins(run.law))
