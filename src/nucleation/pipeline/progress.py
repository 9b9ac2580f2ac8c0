"""Progress of a simulation: a bar on a terminal, a line now and then in a log."""

from __future__ import annotations

import math
import time
from typing import TextIO

import numpy as np
from tqdm import tqdm

from ..analysis.definitions import Extent, ExtractionSettings
from ..fem.grid import Grid
from ..model.linearised import linearised
from ..model.parameters import Parameters
from ..simulation.control import Instant
from ..theory.critical import NoInstability, run_length

PAUSE = 10.0  # s of wall time between the lines of a log
PAUSE_ON_TERMINAL = 0.2


class Progress:
    """Shows how far a run has come, called with every accepted step.

    What is left is estimated from the growing patch: the event is expected when it reaches the
    linear theory's length, unless the end time comes first. It is an upper estimate, since the
    event comes somewhat before that length, and a guess, since the event takes many short steps.

    Parameters
    ----------
    parameters : of the run.
    stream : a terminal, which gets a bar, or a file, which gets lines.
    """

    def __init__(self, parameters: Parameters, stream: TextIO) -> None:
        threshold = ExtractionSettings().edge_threshold * parameters.loading.velocity
        self._patch = Extent(Grid.of(parameters.geometry, parameters.mesh).x, threshold)
        self._end = parameters.stepping.end_time
        self._expected_length = _expected_length(parameters)
        self._stream = stream
        self._bar = (
            tqdm(total=100, file=stream, bar_format="{l_bar}{bar}|{postfix}", leave=False)
            if stream.isatty()
            else None
        )
        self._pause = PAUSE_ON_TERMINAL if self._bar is not None else PAUSE
        self._began = time.monotonic()
        self._first_part: float | None = None  # done before a run that goes on
        self._next = 0.0

    def __call__(self, instant: Instant) -> None:
        """Take note of one accepted step."""
        now, rate = time.monotonic(), instant.report.interface.slip_rate
        length = self._patch.reach(rate)
        if now < self._next:
            return
        self._next = now + self._pause
        part = self.part_done(instant.state.time, length)
        text = (
            f"t = {instant.state.time:.5g} s, dt = {instant.state.last_step:.3g} s, "
            f"max v = {float(np.abs(rate).max()):.3g} m/s, patch {length:.3g} m"
        )
        left = self._left(part, now)
        if self._bar is not None:
            self._bar.n = round(100.0 * part)
            self._bar.set_postfix_str(f"{text}, {left}")
        else:
            control = instant.control
            print(
                f"step {control.steps}: {text}, rejected {control.rejected}, "
                f"{100.0 * part:.0f} % done, {left}",
                file=self._stream,
                flush=True,
            )

    def part_done(self, simulated: float, length: float) -> float:
        """Part of the run that is done, from the simulated time (s) and the patch length (m)."""
        parts = [simulated / self._end]
        if self._expected_length is not None:
            parts.append(length / self._expected_length)
        return min(max(parts), 1.0)

    def close(self) -> None:
        """Remove the bar."""
        if self._bar is not None:
            self._bar.close()

    def _left(self, part: float, now: float) -> str:
        """Wall time that is left, as text."""
        if self._first_part is None:
            self._first_part, self._began = part, now
        done = part - self._first_part
        if done < 0.01:
            return "time left not known yet"
        seconds = (now - self._began) * (1.0 - part) / done
        if part >= 1.0:
            return "in the event"
        return f"about {_duration(seconds)} left"


def _expected_length(parameters: Parameters) -> float | None:
    """The linear theory's critical length (m), None if it knows no instability."""
    interface = linearised(parameters.friction, parameters.loading)
    try:
        return run_length(parameters, interface)
    except NoInstability:
        return None


def _duration(seconds: float) -> str:
    """A duration in the largest unit that fits: ``40 s``, ``3 min``, ``2.5 h``."""
    if seconds < 100.0:
        return f"{math.ceil(seconds)} s"
    return f"{math.ceil(seconds / 60)} min" if seconds < 6000.0 else f"{seconds / 3600:.1f} h"
