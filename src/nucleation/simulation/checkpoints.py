"""Checkpoints: a simulation that is killed loses at most the last minute.

A run resumes from the arrays of a checkpoint and gives the same result to the last bit as if it had
never stopped. A checkpoint also holds a fingerprint of the parameters and of the code. It consists
of plain numbers: loading it executes nothing.
"""

import contextlib
import hashlib
import math
import os
import signal
import sys
import time
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path
from types import FrameType
from typing import TextIO

import numpy as np

from ..datasets.files import replacing
from ..model.quantities import ParameterError
from ..types import Arrays

EVERY = 60.0  # wall time (s) between checkpoints, unless the variable gives another
VARIABLE = "NUCLEATION_CHECKPOINT_EVERY"
SIGNALS = (signal.SIGTERM, signal.SIGINT, signal.SIGHUP)
"""Signals that stop a run: a scheduler's time limit or pre-emption, Ctrl-C, a closed terminal."""


class Stopped(Exception):
    """A signal stopped the run, which has left a checkpoint."""


class Checkpoint:
    """The checkpoint of one run, in a file beside that of its result.

    One with another fingerprint, of parameters and code, is refused. `every` is the wall time (s)
    between checkpoints, by default :func:`interval`.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        fingerprint: str,
        *,
        every: float | None = None,
        log: TextIO | None = None,
    ) -> None:
        self.path = Path(path)
        self._fingerprint = fingerprint
        self._every = interval() if every is None else every
        self._log = log or sys.stderr
        self._last = time.monotonic()
        self._signal: str | None = None  # name of the signal that stops the run

    def load(self) -> Arrays | None:
        """Read the stored arrays; None if there is no valid checkpoint of this run.

        The log says whether the run resumes, or why it does not.
        """
        if not self.path.exists():
            return None
        try:
            arrays = self._read()
            fingerprint = str(arrays.pop("fingerprint"))
            content = str(arrays.pop("content"))
            if content != _digest(arrays):
                raise ValueError("its content has changed since it was stored")
        except Exception as error:  # damaged bytes make the archive's reader raise all sorts
            self._report(f"{self.path} is damaged ({error}): the run starts at the beginning")
            return None
        if fingerprint != self._fingerprint:
            self._report(
                f"{self.path} belongs to other code or parameters: the run starts at the beginning"
            )
            return None
        self._report(f"the run resumes from {self.path}")
        return arrays

    def _read(self) -> Arrays:
        """All arrays of the file, with fingerprint and digest."""
        with np.load(self.path, allow_pickle=False) as stored:
            for part in stored.zip.infolist():
                if part.compress_type != zipfile.ZIP_STORED:
                    raise ValueError("it is compressed, and may be larger than the memory")
            return {name: stored[name] for name in stored.files}

    def keep(self, arrays: Callable[[], Arrays]) -> None:
        """Store a checkpoint if the interval is over, or if a signal stops the run.

        Then it raises Stopped.
        """
        if self._signal is None and time.monotonic() - self._last < self._every:
            return
        stored = arrays()
        labels = {
            "fingerprint": np.array(self._fingerprint),
            "content": np.array(_digest(stored)),
        }
        with replacing(self.path) as temporary, temporary.open("wb") as file:
            np.savez(file, **labels, **stored)  # type: ignore[arg-type]
        self._last = time.monotonic()
        if self._signal is not None:
            raise Stopped(f"stopped by {self._signal}; a further run resumes from {self.path}")

    def remove(self) -> None:
        """Delete the checkpoint, once the result is safe."""
        self.path.unlink(missing_ok=True)

    @contextlib.contextmanager
    def listening(self) -> Iterator[None]:
        """In this context a signal of :data:`SIGNALS` stops the run after its present step."""
        before = {number: signal.signal(number, self._stop) for number in SIGNALS}
        try:
            yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)

    def _stop(
        self,
        number: int,
        _: FrameType | None,
    ) -> None:
        self._signal = signal.Signals(number).name

    def _report(self, message: str) -> None:
        print(message, file=self._log, flush=True)


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


def _digest(arrays: Arrays) -> str:
    """Digest of names, types, shapes and values."""
    summary = hashlib.sha256()
    for name, values in sorted(arrays.items()):
        summary.update(f"{name} {values.dtype} {values.shape}\n".encode())
        summary.update(np.ascontiguousarray(values).tobytes())
    return summary.hexdigest()
