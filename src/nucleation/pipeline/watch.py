"""One line on the terminal that tells of all simulations of a workflow (:mod:`.all_runs`).

On a terminal the line is written anew in its place, and takes the place of what Snakemake says of
each single simulation; elsewhere there is a line at each tenth, and each minute.
"""

from __future__ import annotations

import logging
import shutil
import sys
import threading
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import Any, TextIO

import snakemake.api  # noqa: F401  first: its parts import each other
from snakemake.logging import logger
from snakemake.settings.enums import Quietness
from snakemake_interface_logger_plugins.common import LogEvent

from .all_runs import AllRuns, planned

MANY = 5
"""Simulations from which on there is such a line."""

PAUSE = 2.0  # s between two looks
LINE_EVERY = 60.0  # s, where there is no terminal
ERASE = "\r\x1b[K"

SINGLE = (LogEvent.JOB_INFO, LogEvent.JOB_FINISHED, LogEvent.JOB_STARTED, LogEvent.PROGRESS,
          LogEvent.SHELLCMD)  # fmt: skip
"""What Snakemake says of single jobs."""

SELECTING = "Select jobs"
"""With what it begins to say that it is about to choose some."""


class Line:
    """Shows a text that changes: in its place on a terminal, else now and then.

    Parameters
    ----------
    stream : a terminal, or a file.
    clock : time (s).
    """

    def __init__(self, stream: TextIO, clock: Callable[[], float] = time.monotonic) -> None:
        self._stream, self._clock = stream, clock
        self.rewritten = stream.isatty()
        self._next, self._tenth = clock() + LINE_EVERY, 0
        self._shown = ""

    def show(self, text: str, part: float) -> None:
        """Show the text of how things are, a part of which is done."""
        if self.rewritten:
            width = shutil.get_terminal_size().columns - 1
            self._stream.write(f"{ERASE}{text[:width]}")
            self._stream.flush()
            self._shown = text
        elif int(10.0 * part) > self._tenth or self._clock() >= self._next:
            self.say(text)
            self._tenth = int(10.0 * part)

    def say(self, text: str) -> None:
        """Write a line that stays."""
        self.clear()
        self._next = self._clock() + LINE_EVERY
        print(text, file=self._stream, flush=True)

    def clear(self) -> None:
        """Make room for what others write."""
        if self._shown:
            self._stream.write(ERASE)
            self._stream.flush()
            self._shown = ""


class Watch(logging.Filter):
    """Looks at the simulations now and then, in a thread, until it is told to end.

    It also hears what Snakemake says: of jobs that failed, and to make room for it.
    """

    def __init__(self, runs: AllRuns, line: Line) -> None:
        super().__init__()
        self._runs, self._line = runs, line
        self._over, self._lock, self._said = threading.Event(), threading.Lock(), False
        self._thread = threading.Thread(target=self._keep_looking, daemon=True)

    def begin(self) -> None:
        """Look from now on."""
        for handler in logger.handlers:
            handler.addFilter(self)
        self._thread.start()

    def end(self) -> None:
        """Look once more; say how it ended, and which runs failed and why."""
        self._over.set()
        self._thread.join()
        for handler in logger.handlers:
            handler.removeFilter(self)
        if not self._said:
            self._runs.look()
            self._line.say(self._runs.text())
        for text in self._runs.failures():
            self._line.say(text)

    def filter(self, record: logging.LogRecord) -> bool:
        """Whether what Snakemake says is shown."""
        event = getattr(record, "event", None)
        with self._lock:
            if event == LogEvent.JOB_ERROR:
                for log in getattr(record, "log", None) or []:
                    self._runs.job_failed(Path(log))
            single = event in SINGLE or record.getMessage().startswith(SELECTING)
            if self._line.rewritten and single and not self._said:
                return False
            self._line.clear()
        return True

    def _keep_looking(self) -> None:
        while not (self._said or self._over.wait(PAUSE)):
            with self._lock:
                self._look()

    def _look(self) -> None:
        self._runs.look()
        if self._runs.over:
            self._line.say(self._runs.text())
            self._said = True
        else:
            self._line.show(self._runs.text(), self._runs.part)


_watches: list[Watch] = []


def begin(workflow: Any, costs: Callable[[], Mapping[str, float]]) -> None:
    """Show how all simulations of a workflow are, if there are many.

    Parameters
    ----------
    workflow : Snakemake's, before its first job.
    costs : gives what the runs are predicted to cost, by path; called if there are many.
    """
    quiet = workflow.output_settings.quiet or set()
    work = planned(workflow.dag.needrun_jobs())
    if sum(len(one.runs) for one in work) < MANY or quiet & {Quietness.ALL, Quietness.PROGRESS}:
        return
    _watches.append(Watch(AllRuns(work, costs()), Line(sys.stderr)))
    _watches[-1].begin()


def end() -> None:
    """Say how they ended."""
    while _watches:
        _watches.pop().end()
