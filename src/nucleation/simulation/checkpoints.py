"""Simulations that are kept in files; one that is killed loses at most the last minute.

A run resumes from the arrays of a checkpoint and gives the same result to the last bit as if it had
never stopped. A checkpoint also holds a fingerprint of the parameters and of the code. It consists
of plain numbers: loading it executes nothing.
"""

import contextlib
import json
import math
import os
import signal
import sys
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING

import numpy as np

from ..datasets import code
from ..datasets.files import refuse_pipe, replacing
from ..model.friction import plugins
from ..model.quantities import ParameterError
from ..run.run import Run
from ..types import Arrays

if TYPE_CHECKING:
    import xarray as xr

    from .run import Instant

EVERY = 60.0  # wall time (s) between checkpoints, unless the variable gives another
VARIABLE = "NUCLEATION_CHECKPOINT_EVERY"
SIMULATION = code.Root(
    "nucleation.simulation.run",
    unused=(
        "nucleation.lengths",
        "nucleation.drop",
        "nucleation.theory.creep",
        "nucleation.theory.weakening_patch",
    ),
)
"""A simulation needs a fault, and none of its answers; a test runs one without this code."""

SIGNALS = (signal.SIGTERM, signal.SIGINT, signal.SIGHUP)
"""Signals that stop a run: a scheduler's time limit or pre-emption, Ctrl-C, a closed terminal."""


class Stopped(Exception):
    """A signal stopped the run, which has left a checkpoint."""


class _Checkpoint:
    """The checkpoint of one run, in a file beside that of its result.

    One with another fingerprint, of parameters and code, is refused, and so is a damaged one: the
    archive has a checksum of each array, and the label their number.
    """

    def __init__(self, path: Path, fingerprint: str) -> None:
        self.path = path
        self._fingerprint = fingerprint
        self._every = interval()
        self._last = time.monotonic()
        self._signal: str | None = None  # name of the signal that stops the run

    def load(self) -> Arrays | None:
        """Read the stored arrays; None if there is no valid checkpoint of this run.

        The log says whether the run resumes, or why it does not.
        """
        if not self.path.exists():
            return None
        refuse_pipe(self.path)
        resumes = False
        try:
            with np.load(self.path, allow_pickle=False) as stored:
                arrays = dict(stored)
            fingerprint, number = arrays.pop("fingerprint").tolist()
            if len(arrays) != int(number):
                raise ValueError("it lacks some of its arrays")
            resumes = fingerprint == self._fingerprint
            state = "belongs to other code or parameters"
        except Exception as error:  # damaged bytes make the archive's reader raise all sorts
            state = f"is damaged ({error})"
        message = f"{self.path} {state}: the run starts at the beginning"
        if resumes:
            message = f"the run resumes from {self.path}"
        print(message, file=sys.stderr, flush=True)
        return arrays if resumes else None

    def keep(self, arrays: Callable[[], Arrays]) -> None:
        """Store a checkpoint if the interval is over, or if a signal stops the run.

        Then it raises Stopped.
        """
        if self._signal is None and time.monotonic() - self._last < self._every:
            return
        stored = arrays()
        label = np.array([self._fingerprint, str(len(stored))])
        with replacing(self.path) as temporary, temporary.open("wb") as file:
            np.savez(file, fingerprint=label, **stored)  # type: ignore[arg-type]
        self._last = time.monotonic()
        if self._signal is not None:
            raise Stopped(f"stopped by {self._signal}; a further run resumes from {self.path}")

    @contextlib.contextmanager
    def listening(self) -> Iterator[None]:
        """In this context a signal of :data:`SIGNALS` stops the run after its present step."""

        def stop(number: int, _: FrameType | None) -> None:
            self._signal = signal.Signals(number).name

        before = {number: signal.signal(number, stop) for number in SIGNALS}
        try:
            yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)


def interval() -> float:
    """Wall time (s) between checkpoints, which the environment may set; no result depends on it."""
    text = os.environ.get(VARIABLE, "")
    if not text:
        return EVERY
    try:
        seconds = float(text)
    except ValueError:
        seconds = math.nan
    if not seconds >= 0.0:
        raise ParameterError(f"{VARIABLE} = {text!r} is not allowed: a time in s, 0 or longer")
    return seconds


def run_to_file(
    run: Run,
    output: Path,
    write: "Callable[[xr.Dataset, Path], None]",
    code_digest: str,
    progress: "Callable[[Instant], None]",
) -> "tuple[xr.Dataset, Path]":
    """Run a simulation from its checkpoint and write its record; return the record and its file.

    The record of a failed run is in `output` with the suffix ``.failed.nc``. A signal raises
    Stopped and leaves a checkpoint beside the output; one of other code or parameters is refused.
    """
    from .run import simulate

    fingerprint = json.dumps([run.to_dict(), code_digest], sort_keys=True)
    checkpoint = _Checkpoint(output.with_suffix(".checkpoint.npz"), fingerprint)
    failed = output.with_suffix(".failed.nc")
    with checkpoint.listening():
        start = checkpoint.load()
        dataset = simulate(run, progress=progress, start=start, keep=checkpoint.keep)
        path = output if dataset.attrs["completed"] else failed
        write(dataset, path)
        checkpoint.path.unlink(missing_ok=True)
        if path == output:
            failed.unlink(missing_ok=True)
    return dataset, path


def simulation_code(run: Run) -> str:
    """Digest of the code of a simulation, as in the workflow."""
    return code.digest(SIMULATION, code.ALWAYS, *map(code.Root, plugins(run.law)))
