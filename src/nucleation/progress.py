"""Progress of a simulation, as a line in its log now and then."""

from __future__ import annotations

import time
from typing import TextIO

import numpy as np

from .simulation import Instant


class LogProgress:
    """Writes a line to a stream at the first step and then every so many seconds of wall time."""

    def __init__(self, stream: TextIO, every: float = 10.0) -> None:
        self.stream = stream
        self.every = every
        self._next = 0.0
        self._steps = 0

    def __call__(self, instant: Instant) -> None:
        """Take note of one accepted step."""
        self._steps += 1
        now = time.monotonic()
        if now < self._next:
            return
        self._next = now + self.every
        fastest = float(np.abs(instant.report.interface.slip_rate).max())
        print(
            f"step {self._steps}: t = {instant.state.time:.6g} s, "
            f"dt = {instant.state.last_step:.3g} s, max v = {fastest:.3g} m/s, "
            f"rejected {instant.rejected}",
            file=self.stream,
            flush=True,
        )
