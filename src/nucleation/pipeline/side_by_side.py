"""Work on several cores: one process for each, forked from a job once its code is loaded."""

import contextlib
import multiprocessing
import os
import signal
import sys
import traceback
from collections.abc import Callable, Iterator, Sequence
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from typing import Any, cast

from ..simulation.checkpoints import SIGNALS

Workers = dict[Connection, BaseProcess]


def side_by_side(work: Callable[[int], Any], names: Sequence[str], cores: int) -> list[Any]:
    """The values of `work` for 0, 1, ..., from one process for each core.

    `names` say what each value is of, for messages.

    If one of them ends its process (SystemExit), the others finish what they have begun, and this
    process ends for the same reason. Signals that ask a job to stop are passed on to the processes.
    """
    count = len(names)
    if min(count, cores) < 2:
        return [work(i) for i in range(count)]
    context = multiprocessing.get_context("fork")
    found: list[Any] = [None] * count
    workers: Workers = {}
    given: dict[Connection, int] = {}
    for _ in range(min(count, cores)):
        ours, theirs = context.Pipe()
        workers[ours] = context.Process(target=_serve, args=(work, theirs, [ours, *workers]))
        workers[ours].start()
        theirs.close()
    waiting = iter(range(count))
    reasons: list[str] = []
    with _signals_passed_on(workers):
        for connection in list(workers):
            given[connection] = next(waiting)
            _give(connection, given[connection], workers)
        while workers:
            for connection in cast(list[Connection], wait(list(workers))):
                try:
                    value, reason = connection.recv()
                except (EOFError, OSError):
                    reasons.append(f"{names[given[connection]]}: its process was killed")
                    workers.pop(connection).join()
                    continue
                if reason:
                    reasons.append(reason)
                else:
                    found[given[connection]] = value
                following = None if reasons else next(waiting, None)
                if following is not None:
                    given[connection] = following
                _give(connection, following, workers)
    if reasons:
        sys.exit("\n".join(dict.fromkeys(reasons)))
    return found


def _give(connection: Connection, number: int | None, workers: Workers) -> None:
    """Give a process more work, or have it end."""
    with contextlib.suppress(OSError):  # it has been killed
        connection.send(number)
    if number is None:
        workers.pop(connection).join()


def _serve(work: Callable[[int], Any], connection: Connection, foreign: list[Connection]) -> None:
    """A process: do what is asked for until there is no more, or until the job is no more."""
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
        value, reason = None, ""
        try:
            value = work(wanted)
        except SystemExit as end:
            reason = str(end)
        except BaseException as error:
            traceback.print_exc()
            reason = f"{type(error).__name__}: {error}"
        connection.send((value, reason))


@contextlib.contextmanager
def _signals_passed_on(workers: Workers) -> Iterator[None]:
    """While this lasts, what asks this process to stop asks its workers, which then say so."""

    def pass_on(number: int, _: Any) -> None:
        for process in workers.values():
            with contextlib.suppress(ProcessLookupError, TypeError):
                os.kill(process.pid, number)  # type: ignore[arg-type]

    before = {number: signal.signal(number, pass_on) for number in SIGNALS}
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
