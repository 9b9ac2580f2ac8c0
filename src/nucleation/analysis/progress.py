"""A simulation that someone watches: its progress, and how to interrupt it."""

import contextlib
import math
import signal
import sys
import threading
import time
from collections.abc import Callable
from typing import Any, TextIO

import numpy as np
import xarray as xr
from tqdm import tqdm

from ..fem.grid import Grid
from ..model.linearised import linearised
from ..model.parameters import Parameters
from ..simulation import run
from ..simulation.control import Instant, SimulationFailure
from ..simulation.event import Outcome
from ..theory.critical import NoInstability, run_length
from .definitions import Extent, ExtractionSettings

PAUSE = 10.0  # s of wall time between the lines of a log
PAUSE_ON_TERMINAL = 0.2
NEARLY = 0.99  # part of the way at the theory's length: the event is then at hand, or going on


class Progress:
    """Shows how far a run has come, called with every accepted step.

    The part of the way never falls: it is the simulated time over the end time, or the patch's
    length over the linear theory's if that is more. The event comes somewhat before that length,
    and takes many short steps: the wall time that is left can't be told, but the steps per second
    are. A terminal gets a bar, as does a notebook if `terminal` says so; a file gets lines, which
    begin with the `name` of the run if there is one.
    """

    def __init__(
        self, parameters: Parameters, stream: TextIO, terminal: bool = False, name: str = ""
    ) -> None:
        threshold = ExtractionSettings().edge_threshold * parameters.loading.velocity
        x = Grid.of(parameters.geometry, parameters.mesh).x
        self._patch = Extent(x, threshold, parameters.loading.kind)
        self._end = parameters.stepping.end_time
        interface = linearised(parameters.friction, parameters.loading)
        self._expected_length = math.inf  # of sliding that is stable by the theory
        with contextlib.suppress(NoInstability):
            self._expected_length = run_length(parameters, interface)
        self._stream = stream
        self._start_of_line = f"{name}: " if name else ""
        shown = terminal or stream.isatty()
        style = "{l_bar}{bar}|{postfix}"
        self._bar = tqdm(total=100, file=stream, bar_format=style, leave=False) if shown else None
        self._pause = PAUSE_ON_TERMINAL if shown else PAUSE
        self._began = time.monotonic()
        self._first_step: int | None = None  # of a run that goes on
        self._part = 0.0
        self._next = 0.0

    def __call__(self, instant: Instant) -> None:
        """Take note of one accepted step."""
        now, rate = time.monotonic(), instant.report.interface.slip_rate
        if now < self._next:
            return
        self._next = now + self._pause
        length = self._patch.reach(rate)
        part = self.part_done(instant.state.time, length)
        text = (
            f"t = {instant.state.time:.5g} s, dt = {instant.state.last_step:.3g} s, "
            f"max v = {float(np.abs(rate).max()):.3g} m/s, patch {length:.3g} m"
        )
        speed = self._speed(instant.control.steps, now)
        done, control = int(100.0 * part), instant.control
        if self._bar is not None:
            self._bar.n = done
            self._bar.set_postfix_str(f"{text}, {speed}")
        else:
            text += f", rejected {control.rejected}, {done} % of the way, {speed}"
            line = f"{self._start_of_line}step {control.steps}: {text}"
            print(line, file=self._stream, flush=True)

    def part_done(self, simulated: float, length: float) -> float:
        """Part of the way, from the simulated time (s) and the patch length (m); never falls.

        It is 1 at the end time alone: whether the event is over is not known before.
        """
        by_length = min(length / self._expected_length, NEARLY)
        self._part = min(max(self._part, simulated / self._end, by_length), 1.0)
        return self._part

    def close(self) -> None:
        """Remove the bar."""
        if self._bar is not None:
            self._bar.close()

    def _speed(self, steps: int, now: float) -> str:
        """Steps per second of wall time since the run began, or went on, as text."""
        if self._first_step is None:
            self._first_step, self._began = steps, now
        passed = now - self._began
        return f"{(steps - self._first_step) / passed:.3g} steps/s" if passed > 0.0 else "begun"


def simulate(
    parameters: Parameters, *, progress: bool | Callable[[Instant], object] = False, **more: Any
) -> xr.Dataset:
    """Run one simulation to its end, or until it is interrupted, and return its record.

    Parameters
    ----------
    parameters : Parameters
        Everything the result depends on.
    progress : bool or callable
        True shows a bar on a terminal or in a notebook; a callable is called with every step.
    **more
        `start` and `keep` of :func:`nucleation.simulation.run.simulate`.

    Returns
    -------
    Dataset
        That of :func:`nucleation.simulation.run.simulate`; its attribute ``completed`` is 0 also
        if it was interrupted (Ctrl-C, the notebook's stop button): the record then ends there.
    """
    bar = Progress(parameters, sys.stderr, "ipykernel" in sys.modules) if progress is True else None
    watch = bar or (progress if callable(progress) else None)
    asked: list[int] = []

    def after_step(instant: Instant) -> None:
        if watch is not None:
            watch(instant)
        if asked:
            raise SimulationFailure(Outcome.INTERRUPTED, instant.state, "by the user")

    main = threading.current_thread() is threading.main_thread()  # no other may handle signals
    before = signal.signal(signal.SIGINT, lambda *_: asked.append(1)) if main else None
    try:
        return run.simulate(parameters, progress=after_step, **more)
    finally:
        if main:
            signal.signal(signal.SIGINT, before)
        if bar is not None:
            bar.close()
