"""Batches: work on several cores."""

import multiprocessing
import os
import signal
import sys
import traceback
from collections.abc import Callable, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from threading import Thread
from types import FrameType
from typing import Any

from nucleation.simulation.checkpoints import SIGNALS

_TASK: list[Any] = []  # the work of the pool, and an event that ends the job


def side_by_side(work: Callable[[int], Any], names: Sequence[str], cores: int) -> list[Any]:
    """The values of a function of 0, 1, ..., computed by a forked process for each core.

    If a call fails, those that have begun are finished, no other one begins, and SystemExit has the
    reasons. Signals that stop a job are passed on to its processes.
    """
    processes = min(len(names), cores)
    if processes < 2:
        return [work(i) for i in range(len(names))]
    context = multiprocessing.get_context("fork")
    _TASK[:] = [work, context.Event()]
    pool = ProcessPoolExecutor(processes, context, initializer=_begin)

    def pass_on(number: int, _frame: FrameType | None) -> None:
        for process in multiprocessing.active_children():
            with suppress(ProcessLookupError):
                os.kill(process.pid or 0, number)

    before = {number: signal.signal(number, pass_on) for number in SIGNALS}
    try:
        with pool:
            calls = [pool.submit(_call, i) for i in range(len(names))]
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
    reasons = []
    for call, name in zip(calls, names, strict=True):
        match call.exception():
            case SystemExit(code=reason):
                reasons.append(str(reason))
            case BrokenProcessPool():
                reasons.append(f"{name} is not made: a process was killed")
            case Exception() as error:
                reasons.append(f"{type(error).__name__}: {error}")
    if reasons:
        sys.exit("\n".join(filter(None, dict.fromkeys(reasons))))
    return [call.result() for call in calls]


def _begin() -> None:
    """In a process of the pool, before its first call: it ends when the job is killed."""

    def end_with_job() -> None:
        parent = multiprocessing.parent_process()
        if parent is not None:
            parent.join()
        os._exit(1)

    for number in SIGNALS:
        signal.signal(number, signal.SIG_DFL)
    Thread(target=end_with_job, daemon=True).start()


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
