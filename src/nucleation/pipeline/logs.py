"""The log of a job: what it says while it works, and in its last line how it ended."""

from __future__ import annotations

import contextlib
import os
import time
import traceback
from collections.abc import Iterator
from pathlib import Path
from typing import TextIO


@contextlib.contextmanager
def logged(path: str | os.PathLike[str], what: str) -> Iterator[TextIO]:
    """Send what a job says to its log, which ends with a line on how the job ended.

    A log without that line is one of a job that was killed, or that still works.

    Parameters
    ----------
    path : path
        The rule's ``log``; earlier attempts in it stay.
    what : str
        What is made, such as the name of a run.

    Yields
    ------
    TextIO
        The log, which ``sys.stderr`` is meanwhile.
    """
    Path(path).parent.mkdir(parents=True, exist_ok=True)
    began = time.monotonic()
    with open(path, "a", buffering=1, encoding="utf-8") as log, contextlib.redirect_stderr(log):
        print(f"{_now()} {what}: begun by process {os.getpid()}", file=log)
        try:
            yield log
        except SystemExit as end:
            _last_line(log, what, "stopped" if end.code else "finished", began, end.code)
            raise
        except BaseException as error:
            traceback.print_exc(file=log)
            _last_line(log, what, "failed", began, f"{type(error).__name__}: {error}")
            raise
        _last_line(log, what, "finished", began)


def _last_line(log: TextIO, what: str, end: str, began: float, reason: object = None) -> None:
    seconds = time.monotonic() - began
    said = f"{_now()} {what}: {end} after {seconds:.1f} s"
    with contextlib.suppress(OSError):  # a full disk is not to hide what the job ended with
        print(f"{said}, {reason}" if reason else said, file=log)


def _now() -> str:
    return time.strftime("%Y-%m-%d %H:%M:%S")
