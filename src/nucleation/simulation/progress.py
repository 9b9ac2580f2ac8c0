"""Progress of a simulation on a terminal or in a log, and how the user interrupts it."""

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

from ..run.run import Run
from ..types import Array
from . import run as single
from .bodies import grid_of
from .control import Instant, SimulationFailure
from .event import SLIPPING, Outcome
from .patch import patch_lengths

PAUSE = 10.0  # s of wall time between the lines of a log
PAUSE_ON_TERMINAL = 0.2
NEARLY = 0.99  # largest part done by the patch: the event is then at hand, or under way


class Progress:
    """Shows how far a run has come; it is called with every accepted step.

    The part done is the simulated time over the end time, or the length of the patch over that of
    the linear theory if that is more. It never falls. The event comes somewhat before the theory's
    length and takes many short steps, so the remaining wall time cannot be predicted. The steps per
    second are shown instead.

    Parameters
    ----------
    run : Run
    stream : file
        A terminal shows a bar, any other file gets lines.
    terminal : bool
        Whether the stream shows a bar although it is no terminal, as in a notebook.
    name : str
        Name of the run, with which each line of a log begins.
    """

    def __init__(
        self,
        run: Run,
        stream: TextIO,
        terminal: bool = False,
        name: str = "",
    ) -> None:
        self._fault = run.fault
        self._x = grid_of(run.upper).x
        self._length = 0.0  # m, of the patch
        self._end = run.stepping.end_time
        critical = run.critical_length
        self._critical_length = math.inf if math.isnan(critical) else critical
        self._stream = stream
        self._start_of_line = f"{name}: " if name else ""
        self._bar = None
        self._pause = PAUSE
        if terminal or stream.isatty():
            style = "{l_bar}{bar}|{postfix}"
            self._bar = tqdm(
                total=100,
                file=stream,
                bar_format=style,
                leave=False,
            )
            self._pause = PAUSE_ON_TERMINAL
        self._began = time.monotonic()
        self._first_step: int | None = None  # a resumed run does not begin at step 0
        self._part = 0.0
        self._next = 0.0

    def __call__(self, instant: Instant) -> None:
        """Show an accepted step, unless another one was shown a moment ago."""
        now = time.monotonic()
        if now < self._next:
            return
        self._next = now + self._pause
        state, control = instant.state, instant.control
        rate = instant.report.interface.slip_rate
        length = self._reached(rate)
        done = int(100.0 * self.part_done(state.time, length))
        speed = self._speed(control.steps, now)
        text = (
            f"t = {state.time:.5g} s, dt = {state.last_step:.3g} s, "
            f"max v = {float(np.abs(rate).max()):.3g} m/s, patch {length:.3g} m"
        )
        if self._bar is not None:
            self._bar.n = done
            self._bar.set_postfix_str(f"{text}, {speed}")
            return
        line = (
            f"{self._start_of_line}step {control.steps}: {text}, "
            f"rejected {control.rejected}, {done} % of the way, {speed}"
        )
        print(line, file=self._stream, flush=True)

    def part_done(
        self,
        simulated: float,
        length: float,
    ) -> float:
        """Part of the run that is done; it never falls.

        It is 1 at the end time only: before that nobody knows whether the event is over.

        Parameters
        ----------
        simulated : float
            Simulated time (s).
        length : float
            Length of the patch (m).

        Returns
        -------
        float
            Between 0 and 1.
        """
        by_length = min(length / self._critical_length, NEARLY)
        by_time = simulated / self._end
        self._part = min(max(self._part, by_time, by_length), 1.0)
        return self._part

    def _reached(self, slip_rate: Array) -> float:
        """Largest length (m) of the patch so far, with the slip rates (m/s) of this step."""
        edge = SLIPPING * self._fault.velocity
        (now,) = patch_lengths(
            self._fault.loading,
            self._x,
            slip_rate[None],
            edge,
        )
        self._length = max(self._length, float(now))
        return self._length

    def close(self) -> None:
        """Remove the bar."""
        if self._bar is not None:
            self._bar.close()

    def _speed(
        self,
        steps: int,
        now: float,
    ) -> str:
        """Steps per second of wall time since this process began or resumed the run, as text."""
        if self._first_step is None:
            self._first_step = steps
            self._began = now
        passed = now - self._began
        if passed <= 0.0:
            return "begun"
        return f"{(steps - self._first_step) / passed:.3g} steps/s"


def simulate(
    run: Run,
    *,
    progress: bool | Callable[[Instant], object] | None = None,
    **more: Any,
) -> xr.Dataset:
    """Run one simulation until it ends or the user interrupts it, and return its record.

    Parameters
    ----------
    run : Run
    progress : bool or callable
        True shows a bar on a terminal or in a notebook, and lines elsewhere; by default there are
        no lines, and False shows nothing. A callable is called with every step.
    **more
        `start` and `keep` of :func:`nucleation.simulation.run.simulate`.

    Returns
    -------
    Dataset
        Record of :func:`nucleation.simulation.run.simulate`. If the user interrupts the run (Ctrl-C
        or the notebook's stop button), the record ends there and its attribute ``completed`` is 0.

    Examples
    --------
    >>> from nucleation.api import PAPER, Run
    >>> run = Run(PAPER, block_length=0.9, n_x=16, n_y=2, end_time=0.02)
    >>> record = simulate(run)
    >>> record.sizes["x"], round(float(record["step_time"][-1]), 6)
    (17, 0.021013)
    """
    bar = None
    watch = progress if callable(progress) else None
    notebook = "ipykernel" in sys.modules
    shown = sys.stderr is not None and (notebook or sys.stderr.isatty())
    if progress is True or (progress is None and shown):
        bar = watch = Progress(run, sys.stderr, terminal=notebook)
    interrupts: list[int] = []

    def after_step(instant: Instant) -> None:
        if watch is not None:
            watch(instant)
        if interrupts:
            raise SimulationFailure(Outcome.INTERRUPTED, instant.state, "by the user")

    # only the main thread may handle signals
    main = threading.current_thread() is threading.main_thread()
    if main:
        before = signal.signal(signal.SIGINT, lambda number, _: interrupts.append(number))
    try:
        return single.simulate(run, progress=after_step, **more)
    finally:
        if main:
            signal.signal(signal.SIGINT, before)
        if bar is not None:
            bar.close()
