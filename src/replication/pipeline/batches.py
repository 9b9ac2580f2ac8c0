"""Batches: work on several cores, and how many parts are made."""

import multiprocessing
import os
import signal
import sys
import time
import traceback
from collections.abc import Callable, Sequence
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from threading import Thread
from types import FrameType
from typing import Any

from nucleation.simulation.checkpoints import SIGNALS

from . import LOGGER, PROGRESS

PAUSE = 60.0  # s between two lines of progress
_TASK: list[Any] = []  # of this process of the pool: the work, and an event that ends the job


def tally(number: int) -> Callable[[int], None]:
    """A function that counts parts of a batch, and reports now and then how many are made."""
    made: set[int] = set()
    last = [time.monotonic()]

    def done(part: int) -> None:
        made.add(part)
        now = time.monotonic()
        if len(made) < number and now >= last[0] + PAUSE:
            last[0] = now
            LOGGER.log(PROGRESS, f"{len(made)} of {number} runs done")

    return done


def side_by_side(
    work: Callable[[int], Any],
    names: Sequence[str],
    cores: int,
    done: Callable[[int], object] = bool,
) -> list[Any]:
    """The values of a function of 0, 1, ..., computed by a forked process for each core.

    If a call fails, those that have begun are finished, no other one begins, and SystemExit has the
    reasons. Signals that stop a job are passed on to its processes. After each call this process
    calls `done` with the number.
    """
    if min(len(names), cores) < 2:
        values = []
        for i in range(len(names)):
            values.append(work(i))
            done(i)
        return values
    context = multiprocessing.get_context("fork")
    pool = ProcessPoolExecutor(
        min(len(names), cores), context, initializer=_begin, initargs=(work, context.Event())
    )

    def pass_on(number: int, _frame: FrameType | None) -> None:
        for process in multiprocessing.active_children():
            with suppress(ProcessLookupError):
                os.kill(process.pid or 0, number)

    before = {number: signal.signal(number, pass_on) for number in SIGNALS}
    try:
        with pool:
            calls: dict[Future[Any], int] = {pool.submit(_call, i): i for i in range(len(names))}
            for call in calls:
                call.add_done_callback(lambda ended: done(calls[ended]))
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
    reasons = []
    for call, i in calls.items():
        match call.exception():
            case SystemExit(code=reason):
                reasons.append(str(reason))
            case BrokenProcessPool():
                reasons.append(f"{names[i]} is not made: a process was killed")
            case Exception() as error:
                reasons.append(f"{type(error).__name__}: {error}")
    if reasons:
        sys.exit("\n".join(filter(None, dict.fromkeys(reasons))))
    return [call.result() for call in calls]


def _begin(work: Callable[[int], Any], ended: Any) -> None:
    """In a process of the pool, before its first call: it ends when the job is killed."""

    def end_with_job() -> None:
        parent = multiprocessing.parent_process()
        if parent is not None:
            parent.join()
        os._exit(1)

    for number in SIGNALS:
        signal.signal(number, signal.SIG_DFL)
    Thread(target=end_with_job, daemon=True).start()
    _TASK[:] = [work, ended]


def _call(number: int) -> Any:
    work, ended = _TASK
    if ended.is_set():
        sys.exit("")
    try:
        return work(number)
    except BaseException as error:
        ended.set()
        if not isinstance(error, SystemExit):
            traceback.print_exc()  # into the log
        raise
