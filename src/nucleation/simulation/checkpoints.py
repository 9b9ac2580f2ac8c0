"""Checkpoints: a simulation that is killed loses at most the last minute.

A checkpoint holds arrays from which a run goes on to the last bit as if it had never stopped, and
a fingerprint of the parameters and the code that made them. It is plain numbers: loading one
executes nothing.
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
from numpy.typing import NDArray

from ..datasets.files import replacing
from ..model.quantities import ParameterError

Arrays = dict[str, NDArray]

EVERY = 60.0  # wall time (s) between checkpoints, unless the variable says otherwise
VARIABLE = "NUCLEATION_CHECKPOINT_EVERY"
SIGNALS = (signal.SIGTERM, signal.SIGINT, signal.SIGHUP)
"""What asks a run to stop: a scheduler's time limit or pre-emption, Ctrl-C, a closed terminal."""


class Stopped(Exception):
    """A run was asked to stop and has left a checkpoint."""


class Checkpoint:
    """The checkpoint of one run, beside the place of its result.

    Parameters
    ----------
    path : file of the checkpoint.
    fingerprint : identifies the parameters and the code; a checkpoint of others is refused.
    every : wall time (s) between checkpoints, by default that of :func:`interval`.
    log : where messages go.
    """

    def __init__(
        self,
        path: str | os.PathLike[str],
        fingerprint: str,
        *,
        every: float | None = None,
        log: TextIO | None = None,
    ) -> None:
        self.path, self._fingerprint = Path(path), fingerprint
        self._every = interval() if every is None else every
        self._log, self._last = log or sys.stderr, time.monotonic()
        self.asked: str | None = None  # name of the signal that has asked to stop

    def load(self) -> Arrays | None:
        """The stored arrays, or None if there are none of this run; says why it goes on or not."""
        if not self.path.exists():
            return None
        try:
            with np.load(self.path, allow_pickle=False) as stored:
                if any(part.compress_type != zipfile.ZIP_STORED for part in stored.zip.infolist()):
                    raise ValueError("it is compressed, and may be larger than the memory")
                arrays = {name: stored[name] for name in stored.files}
            fingerprint, content = str(arrays.pop("fingerprint")), str(arrays.pop("content"))
            if content != _digest(arrays):
                raise ValueError("its content is not what was stored")
        except Exception as error:  # of damaged bytes, the archive's reader raises all sorts
            self._say(f"{self.path} is damaged ({error}): the run starts at the beginning")
            return None
        if fingerprint != self._fingerprint:
            self._say(
                f"{self.path} is of other code or parameters: the run starts at the beginning"
            )
            return None
        self._say(f"the run goes on from {self.path}")
        return arrays

    def keep(self, arrays: Callable[[], Arrays]) -> None:
        """Store what `arrays` returns if it is time to, or if a signal has asked to stop.

        Raises
        ------
        Stopped
            After a checkpoint that a signal has asked for.
        """
        if self.asked is None and time.monotonic() - self._last < self._every:
            return
        stored = arrays()
        labels = {"fingerprint": self._fingerprint, "content": _digest(stored)}
        with replacing(self.path) as temporary, temporary.open("wb") as file:
            np.savez(file, **{name: np.array(text) for name, text in labels.items()}, **stored)  # type: ignore[arg-type]
        self._last = time.monotonic()
        if self.asked is not None:
            raise Stopped(f"stopped by {self.asked}; a further run goes on from {self.path}")

    def remove(self) -> None:
        """Delete the checkpoint, once the result is safe."""
        self.path.unlink(missing_ok=True)

    @contextlib.contextmanager
    def listening(self) -> Iterator[None]:
        """While this lasts a signal of :data:`SIGNALS` stops the run after its present step."""
        before = {number: signal.signal(number, self._ask) for number in SIGNALS}
        try:
            yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)

    def _ask(self, number: int, _: FrameType | None) -> None:
        self.asked = signal.Signals(number).name

    def _say(self, message: str) -> None:
        print(message, file=self._log, flush=True)


def interval() -> float:
    """Wall time (s) between checkpoints, by the environment: it is no part of what a run is.

    Raises
    ------
    ParameterError
        If the variable is not a number of seconds.
    """
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
