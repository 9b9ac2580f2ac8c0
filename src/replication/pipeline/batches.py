"""Batches: the results of one job, made on several cores and shown one by one."""

import multiprocessing
import os
import signal
import sys
import time
import traceback
from collections.abc import Callable, Collection, Sequence
from concurrent.futures import ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from functools import partial
from threading import Thread
from types import FrameType
from typing import Any

from nucleation.simulation.checkpoints import SIGNALS

from .messages import LOGGER, PROGRESS
from .recipes import Recipe
from .views import show

PAUSE = 60.0  # s between two lines of progress
_TASK: list[Any] = []  # of this process of the pool: the work, and an event that ends the job


class PartFailed(Exception):
    """A part of a batch has failed; the other parts are made."""


class Inputs(Sequence[Any]):
    """The sources of one role; each is read when it is needed."""

    def __init__(self, open: Callable[[str], Any], paths: list[str]) -> None:
        self._open = open
        self._paths = paths

    def __len__(self) -> int:
        return len(self._paths)

    def __getitem__(self, i: Any) -> Any:
        return self._open(self._paths[i])


class Batch:
    """The results of a batch, each made from its recipe by a function, on some cores."""

    def __init__(
        self,
        result: Callable[[Recipe], Any],
        parts: Sequence[Recipe],
        cores: int,
    ):
        self._result = result
        self._parts = parts
        self._cores = cores

    def map(self, function: Callable[[int, Any], Any] | None = None) -> list[Any]:
        """Make all results, and return the values of a function of each one's number and result.

        It is called in the process that makes the result. If parts have failed, SystemExit names
        them once all were tried.
        """
        names = [part.name for part in self._parts]
        kept = {i for i, part in enumerate(self._parts) if part.is_in(part.store)}
        made = side_by_side(
            lambda i: self._one(i, function),
            names,
            self._cores,
            Tally(len(names), kept),
        )
        failures = [failure for failure, _ in made if failure]
        if failures and len(names) == 1:
            sys.exit(failures[0])
        if failures:
            count = f"{len(failures)} of {len(names)} runs failed, the others are kept:"
            sys.exit("\n  ".join([count, *failures]))
        return [value for _, value in made]

    def _one(self, number: int, function: Callable[[int, Any], Any] | None) -> tuple[str, Any]:
        """Why a part has failed, and the value of the function if it has not."""
        part = self._parts[number]
        try:
            result = self._result(part)
        except PartFailed as error:
            LOGGER.info(error)
            return str(error), None
        show(part)
        return "", None if function is None else function(number, result)


class Tally:
    """Tells now and then how many parts of a batch are done, and about how long the others take.

    Parts that were `kept` before take no time.
    """

    def __init__(self, number: int, kept: Collection[int] = ()) -> None:
        self._waiting = set(range(number))
        self._number = number
        self._kept = frozenset(kept)
        self._made = 0
        self._began = time.monotonic()
        self._next = self._began + PAUSE

    def __call__(self, part: int) -> None:
        """Count a part that is done."""
        self._waiting.discard(part)
        self._made += part not in self._kept
        now = time.monotonic()
        if now < self._next or not self._made or not self._waiting:
            return
        self._next = now + PAUSE
        left = (now - self._began) / self._made * len(self._waiting - self._kept)
        done = self._number - len(self._waiting)
        text = f"{left / 60.0:.0f} min" if left > 90.0 else f"{left:.0f} s"
        LOGGER.log(PROGRESS, f"{done} of {self._number} runs done, about {text} left")


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
            calls = [pool.submit(_call, i) for i in range(len(names))]
            for i, call in enumerate(calls):
                call.add_done_callback(partial(_tell, done, i))
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
    reasons = []
    for name, call in zip(names, calls, strict=True):
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


def _tell(done: Callable[[int], object], number: int, _call: Any) -> None:
    done(number)


def _begin(work: Callable[[int], Any], ended: Any) -> None:
    """In a process of the pool, before its first call: it ends when the job is killed."""
    for number in SIGNALS:
        signal.signal(number, signal.SIG_DFL)
    Thread(target=_end_with_job, daemon=True).start()
    _TASK[:] = [work, ended]


def _end_with_job() -> None:
    parent = multiprocessing.parent_process()
    if parent is not None:
        parent.join()
    os._exit(1)


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
