"""Work on several cores: a process for each core, forked from a job after its code is loaded."""

import contextlib
import multiprocessing
import os
import signal
import sys
import traceback
from collections.abc import Callable, Iterator, Sequence
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from types import FrameType
from typing import Any, TypeVar, cast

from nucleation.simulation.checkpoints import SIGNALS

_Value = TypeVar("_Value")
_Workers = dict[Connection, BaseProcess]


def side_by_side(
    work: Callable[[int], _Value],
    names: Sequence[str],
    cores: int,
) -> list[_Value]:
    """Call a function with 0, 1, ..., in one process for each core.

    If a call raises SystemExit or any other error, the other processes finish the calls that they
    have begun, and this process exits with the same reason. Signals that stop a job are passed on
    to the processes.

    Parameters
    ----------
    work : callable
        Its values must be picklable.
    names : sequence of str
        A name for each value, for messages.
    cores : int
        Number of processes; with one, or with one value, no process is started.

    Returns
    -------
    list
        The values in the order of the names.

    Raises
    ------
    SystemExit
        If a call fails or a process is killed.
    """
    count = len(names)
    if min(count, cores) < 2:
        return [work(i) for i in range(count)]
    workers = _started(work, min(count, cores))
    found: dict[int, Any] = {}
    begun: dict[Connection, int] = {}
    waiting = iter(range(count))
    reasons: list[str] = []
    with _signals_passed_on(workers):
        for connection in list(workers):
            begun[connection] = next(waiting)
            _send(connection, begun[connection], workers)
        while workers:
            for connection in cast(list[Connection], wait(list(workers))):
                number = begun[connection]
                try:
                    value, reason = connection.recv()
                except (EOFError, OSError):
                    reasons.append(f"{names[number]}: its process was killed")
                    workers.pop(connection).join()
                    continue
                if reason:
                    reasons.append(reason)
                found[number] = value
                following = None if reasons else next(waiting, None)
                if following is not None:
                    begun[connection] = following
                _send(connection, following, workers)
    if reasons:
        sys.exit("\n".join(dict.fromkeys(reasons)))
    return [found[number] for number in range(count)]


def _started(work: Callable[[int], Any], count: int) -> _Workers:
    """Start the processes."""
    context = multiprocessing.get_context("fork")
    workers: _Workers = {}
    for _ in range(count):
        ours, theirs = context.Pipe()
        foreign = [ours, *workers]
        process = context.Process(target=_serve, args=(work, theirs, foreign))
        workers[ours] = process
        process.start()
        theirs.close()
    return workers


def _send(connection: Connection, number: int | None, workers: _Workers) -> None:
    """Send the next number to a process, or None to end it."""
    with contextlib.suppress(OSError):  # it has been killed
        connection.send(number)
    if number is None:
        workers.pop(connection).join()


def _serve(
    work: Callable[[int], Any],
    connection: Connection,
    foreign: list[Connection],
) -> None:
    """In a process: work on each number that arrives, until None arrives or the job has ended."""
    for other in foreign:
        other.close()
    for number in SIGNALS:
        signal.signal(number, signal.SIG_DFL)
    while True:
        try:
            wanted = connection.recv()
        except EOFError:
            return
        if wanted is None:
            return
        value = None
        reason = ""
        try:
            value = work(wanted)
        except SystemExit as end:
            reason = str(end)
        except BaseException as error:
            traceback.print_exc()
            reason = f"{type(error).__name__}: {error}"
        connection.send((value, reason))


@contextlib.contextmanager
def _signals_passed_on(workers: _Workers) -> Iterator[None]:
    """Within this context, signals that stop the job go to its processes, which report the end."""

    def pass_on(number: int, _frame: FrameType | None) -> None:
        for process in workers.values():
            if process.pid is not None:
                with contextlib.suppress(ProcessLookupError):
                    os.kill(process.pid, number)

    before = {number: signal.signal(number, pass_on) for number in SIGNALS}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
