"""A simulation that someone watches: it shows how far it is and can be interrupted."""

import signal
import sys
import threading
from collections.abc import Callable
from typing import Any

import xarray as xr

from ..model.parameters import Parameters
from ..simulation import run
from ..simulation.control import Instant, SimulationFailure
from ..simulation.outcome import Outcome
from .progress import Progress


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
