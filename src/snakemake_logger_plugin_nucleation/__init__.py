"""Snakemake's output with one line that tells of all simulations: ``--logger nucleation``.

The Snakefile says before the first job which simulations are missing (``to_simulate``). What has
become of them is seen in the store and the logs, so it is the same for processes here, jobs of a
cluster and batches. On a terminal the line is rewritten in its place, and takes the place of what
Snakemake says of single jobs; elsewhere there is one at each tenth, and each minute.
"""

import contextlib
import os
import shutil
import sys
import threading
import time
from collections.abc import Mapping
from logging import Handler, LogRecord
from pathlib import Path
from typing import Any

from snakemake_interface_logger_plugins.base import LogHandlerBase
from snakemake_interface_logger_plugins.common import LogEvent

MANY = 5  # simulations from which on there is such a line
PAUSE, LINE_EVERY = 2.0, 60.0  # s between two looks; between two lines where there is no terminal
ERASE = "\r\x1b[K"
COLOURS = {"ERROR": 31, "INFO": 32, "WARNING": 33}
SINGLE = (LogEvent.JOB_INFO, LogEvent.JOB_STARTED, LogEvent.JOB_FINISHED, LogEvent.SHELLCMD,
          LogEvent.PROGRESS)  # fmt: skip
QUIET = "completed: the end time was reached"


class Runs:
    """The simulations to be made, from one look at `results` to the next.

    `jobs` has the names of the simulations of each job by their keys, by the job's log.
    """

    def __init__(self, results: str, jobs: Mapping[str, Mapping[str, str]]) -> None:
        self._store, self._unfinished = Path(results, "store"), Path(results, "unfinished")
        self._jobs, self._start = jobs, time.time()
        self.names = {key: name for runs in jobs.values() for key, name in runs.items()}
        self.total, self.running, self.quiet = len(self.names), 0, 0
        self.done: set[str] = set()
        self.failed: dict[str, str] = {}

    def look(self) -> None:
        """Look at the store, the records of runs that failed, and the logs."""
        there = {path.name for path in self._store.glob("*")}
        for key in self.names.keys() & there - self.done:
            known = _attributes(self._store / key / "result.nc")
            self.quiet += known.get("status") == QUIET
            self.failed.pop(key, None)
            self.done.add(key)
        for path in self._unfinished.glob("*.failed.nc"):
            key = path.name.removesuffix(".failed.nc").rpartition(".")[2]
            if key in self.names.keys() - self.done - self.failed.keys() and self._is_new(path):
                self.failed[key] = str(_attributes(path).get("status"))
        over = self.done | self.failed.keys()
        logs = [log for log, runs in self._jobs.items() if runs.keys() - over]
        self.running = sum(map(self._is_new, logs))

    def job_failed(self, log: str) -> None:
        """A job ended with an error: the run it was at failed, if no record names another."""
        self.look()
        rest = [key for key in self._jobs.get(log, ()) if key not in self.done]
        if rest and not self.failed.keys() & rest:
            said = Path(log).read_text(errors="replace").split("\n") if os.path.isfile(log) else []
            self.failed[rest[0]] = next(filter(str.strip, reversed(said)), "it says nothing")

    def _is_new(self, path: str | Path) -> bool:
        with contextlib.suppress(OSError):  # if it is not there
            return os.path.getmtime(path) >= self._start
        return False

    def text(self) -> str:
        """All of it in one line."""
        done = len(self.done)
        said = [f"{done} of {self.total} simulations done ({100 * done // self.total} %)"]
        counts = (self.running, len(self.failed), self.quiet)
        what = ("running", "failed", "without an event")
        said += [f"{n} {what}" for n, what in zip(counts, what, strict=True) if n]
        return ", ".join(said)


class LogHandler(LogHandlerBase):
    """Writes what Snakemake says, in its words, and the line."""

    writes_to_stream, writes_to_file = True, False
    has_filter = has_formatter = needs_rulegraph = False

    def __post_init__(self) -> None:
        Handler.__init__(self)  # which interfaces before 2.0 leave out
        self._stream = sys.stdout if self.common_settings.stdout else sys.stderr
        self._terminal, self._over = self._stream.isatty(), threading.Event()
        self._runs: Runs | None = None
        self._said, self._tenth, self._next = "", 0, time.monotonic() + LINE_EVERY

    def emit(self, record: LogRecord) -> None:
        """Write a message, unless the line says the same."""
        event, told = getattr(record, "event", None), getattr(record, "simulations", None)
        quiet = {level.name for level in self.common_settings.quiet or ()}
        if told and sum(map(len, told["jobs"].values())) >= MANY and "PROGRESS" not in quiet:
            self._runs = Runs(**told)
            threading.Thread(target=self._keep_looking, daemon=True).start()
        if self._runs and event == LogEvent.JOB_ERROR:
            for log in getattr(record, "log", None) or ():
                self._runs.job_failed(log)
        said, colour = self.format(record), COLOURS.get(record.levelname)
        single = event in SINGLE or said.startswith(("Select jobs", "Execute "))
        in_line = self._terminal and self._runs and not self._said and single
        if in_line or said in ("", "None"):
            return
        coloured = colour and self._terminal and not self.common_settings.nocolor
        self._write(f"\x1b[{colour}m{said}\x1b[0m\n" if coloured else f"{said}\n")

    def _write(self, text: str) -> None:
        self._stream.write(f"{ERASE}{text}" if self._terminal and self._runs else text)
        self._stream.flush()

    def _keep_looking(self) -> None:
        while self._runs and not self._over.wait(PAUSE):
            with self.lock or contextlib.nullcontext():  # as for a message
                self._show(self._runs)

    def _show(self, runs: Runs, last: bool = False) -> None:
        """Look at the runs, and show the line if it is time to; once each has ended, it stays."""
        runs.look()
        tenth, now, text = 10 * len(runs.done) // runs.total, time.monotonic(), runs.text()
        last |= len(runs.done) + len(runs.failed) == runs.total
        if self._terminal and not last:
            self._write(text[: shutil.get_terminal_size().columns - 1])
        elif text != self._said and (last or tenth > self._tenth or now >= self._next):
            self._write(f"{text}\n")
            self._tenth, self._next = tenth, now + LINE_EVERY
            self._said = text if last else ""

    def close(self) -> None:
        """Say how it ended, and which runs failed and why."""
        if self._runs and not self._over.is_set():
            self._over.set()
            self._show(self._runs, last=True)
            names, failed = self._runs.names, self._runs.failed
            lines = sorted(f"{names[key]}: {why}\n" for key, why in failed.items())
            self._write("".join(["Simulations that failed:\n"] * bool(lines) + lines))
        super().close()


def _attributes(path: Path) -> dict[str, Any]:
    from nucleation.datasets import netcdf  # not before: every start of Snakemake loads this file

    with contextlib.suppress(ValueError):  # of what can't be read
        return netcdf.attributes(path)
    return {}
