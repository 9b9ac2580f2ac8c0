"""Progress of a simulation on a terminal or in a log, and how the user interrupts it."""

import signal
import sys
import threading
import time
from collections.abc import Callable
from typing import Any, TextIO

import numpy as np
import xarray as xr

from ..run.run import Run
from . import run as single
from .event import SLIPPING, Outcome, patch_lengths
from .run import Instant, SimulationFailure
from .start import grid_of

PAUSE = 10.0  # s of wall time between the lines of a log
PAUSE_ON_TERMINAL = 0.2
NEARLY = 0.99  # largest part of the way that is shown: nobody knows whether the event is over


class Progress:
    """Shows how far a run has come; it is called with every accepted step.

    A terminal, or a notebook's output, shows one line that changes; any other file gets lines,
    which begin with the `name` of the run. The part of the way is the time over the end time, or
    the patch's length over that of the linear theory if that is more. The event comes somewhat
    before and takes many short steps, so the remaining wall time cannot be predicted.
    """

    def __init__(
        self, run: Run, stream: TextIO, terminal: bool | None = None, name: str = ""
    ) -> None:
        self._fault = run.fault
        self._x = grid_of(run.upper).x
        self._length = 0.0  # m, of the patch
        self._critical_length = run.critical_length
        self._end = run.stepping.end_time
        self._stream = stream
        self._start_of_line = f"{name}: " if name else ""
        self._terminal = stream.isatty() if terminal is None else terminal
        self._shown = 0  # characters of the terminal's line
        self._next = 0.0  # s, wall time

    def __call__(self, instant: Instant) -> None:
        """Show an accepted step, unless another one was shown a moment ago."""
        now = time.monotonic()
        if now < self._next:
            return
        self._next = now + (PAUSE_ON_TERMINAL if self._terminal else PAUSE)
        state, control = instant.state, instant.control
        rate = instant.report.interface.slip_rate
        edge = SLIPPING * self._fault.velocity
        (length,) = patch_lengths(self._fault.loading, self._x, rate[None], edge)
        self._length = max(self._length, float(length))
        part = max(state.time / self._end, self._length / self._critical_length)
        line = (
            f"{self._start_of_line}step {control.steps}: t = {state.time:.5g} s, "
            f"dt = {state.last_step:.3g} s, max v = {float(np.abs(rate).max()):.3g} m/s, "
            f"patch {self._length:.3g} m, rejected {control.rejected}, "
            f"{int(100.0 * min(part, NEARLY))} % of the way"
        )
        if self._terminal:
            print(f"\r{line:<{self._shown}}", end="", file=self._stream, flush=True)
            self._shown = len(line)
        else:
            print(line, file=self._stream, flush=True)

    def close(self) -> None:
        """Remove the terminal's line."""
        if self._terminal:
            print(f"\r{'':<{self._shown}}", end="\r", file=self._stream, flush=True)


def simulate(
    run: Run, *, progress: bool | Callable[[Instant], object] | None = None, **more: Any
) -> xr.Dataset:
    """Run one simulation until it ends or the user interrupts it, and return its record.

    Parameters
    ----------
    run : Run
    progress : bool or callable
        True shows a line that changes on a terminal or in a notebook, and lines elsewhere; by
        default there are no lines, and False shows nothing. A callable is called with every step.
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
    >>> run = Run.sized(PAPER, block_length=0.9, n_x=16, n_y=2, end_time=0.02)
    >>> record = simulate(run)
    >>> record.sizes["x"], round(float(record["step_time"][-1]), 6)
    (17, 0.021013)
    """
    line = None
    watch = progress if callable(progress) else None
    terminal = "ipykernel" in sys.modules or (sys.stderr is not None and sys.stderr.isatty())
    if progress is True or (progress is None and terminal and sys.stderr is not None):
        line = watch = Progress(run, sys.stderr, terminal)
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
        if line is not None:
            line.close()
