"""What has become of all simulations of a workflow: done, running, failed, without an event.

It is read from the results themselves, their logs and the records of failures, so it is the same
for processes here, jobs of a cluster and jobs with many runs in them. Costs of a look: the names in
two directories, and some bytes of each dataset that is new.
"""

from __future__ import annotations

import dataclasses
import os
import time
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

from ..datasets import netcdf
from ..datasets.variables import DatasetError
from ..simulation.outcome import Outcome
from . import keys
from .time_left import TimeLeft

LOST = "ended without a record"
"""What is said of a run whose log is empty."""


@dataclasses.dataclass(frozen=True)
class Work:
    """A job's simulations, one after the other, and its log, which is there once it begins."""

    runs: tuple[Path, ...]
    log: Path


def planned(jobs: Iterable[Any]) -> list[Work]:
    """The simulations among Snakemake's jobs.

    A job makes the runs that are its outputs, or that its parameter `places` names: pairs of a
    path and the digest of the code that makes it.
    """
    found = []
    for job in jobs:
        paths = dict.fromkeys(map(str, (*job.output, *_named(job))))
        runs = tuple(Path(path) for path in paths if _is_run(path))
        if runs and job.log:
            found.append(Work(runs, Path(job.log[0])))
    return found


def _named(job: Any) -> list[str]:
    """What a job's parameter names; those of other rules, which take time, are not computed."""
    names = set(job.rule.params.keys())
    return [path for path, _ in job.params.places] if "places" in names else []


def _is_run(path: str) -> bool:
    return Path(path).parent.name == "simulations" and keys.key_in(path) is not None


class AllRuns:
    """The simulations of a workflow, from one look at the results to the next.

    Parameters
    ----------
    work : from :func:`planned`; of runs that are still to be made.
    costs : predicted, by path of the dataset; 1 for those that are not named.
    clock : the time (s) that files bear.
    """

    def __init__(
        self, work: Sequence[Work], costs: Mapping[str, float] | None = None,
        clock: Callable[[], float] = time.time,
    ) -> None:  # fmt: skip
        self._work, self._clock, self._start = list(work), clock, clock()
        self._begun: dict[Path, float] = {}  # first sight of a job's log
        costs, runs = costs or {}, {str(run) for one in work for run in one.runs}
        self._left = TimeLeft({run: costs.get(run, 1.0) for run in runs})
        self.total = len(runs)
        self.done: set[Path] = set()
        self.failed: dict[Path, str] = {}
        self.quiet = 0

    def look(self) -> None:
        """Look at the results; what was done stays done."""
        now = self._clock()
        results = _listed({run.parent for one in self._work for run in one.runs})
        logs = _listed({one.log.parent for one in self._work})
        for one in self._work:
            self._look_at(one, self._beginning(one.log, logs, now), results)
        self._work = [one for one in self._work if not self.done.issuperset(one.runs)]

    def _beginning(self, log: Path, there: set[Path], now: float) -> float | None:
        """When a job was first seen to have begun; logs of earlier workflows don't count."""
        if log not in self._begun and log in there and _written(log) >= self._start:
            self._begun[log] = now
        return self._begun.get(log)

    def _look_at(self, one: Work, begun: float | None, results: set[Path]) -> None:
        for run in one.runs:
            record = run.with_suffix(".failed.nc")
            if run in self.done:
                continue
            if run in results:
                self._finish(run)
            elif begun is not None and run not in self.failed:
                if record not in results or _written(record) < self._start:
                    self._left.begins_once(str(run), self._clock())
                    return  # the others of the job wait for it
                self._fail(run, _attributes(record).get("status", LOST))

    def _finish(self, run: Path) -> None:
        """A run is done; it began as long before its end as it says that it took.

        One that was there before, of a batch that goes on, tells nothing of the time.
        """
        end, known = _written(run), _attributes(run)
        if end >= self._start:
            seconds = min(float(known.get("wall_seconds", 0.0)), end - self._start)
            self._left.begins(str(run), end - seconds)
        self._left.ends(str(run), end)
        self.quiet += known.get("status") == Outcome.END_TIME.value
        self.failed.pop(run, None)
        self.done.add(run)

    def _fail(self, run: Path, reason: str) -> None:
        self._left.ends(str(run), self._clock())
        self.failed[run] = reason

    def job_failed(self, log: Path) -> None:
        """A job has ended with an error: the run that it was at has failed, as its log tells."""
        for one in self._work:
            if one.log == log:
                rest = [run for run in one.runs if run not in self.done and not run.exists()]
                for run in [run for run in rest if run not in self.failed][:1]:
                    status = _attributes(run.with_suffix(".failed.nc")).get("status")
                    self._fail(run, status or last_line(log) or LOST)

    @property
    def part(self) -> float:
        """Part of the runs that are done; it never falls."""
        return len(self.done) / self.total if self.total else 1.0

    @property
    def over(self) -> bool:
        """Whether each run is done or has failed."""
        return len(self.done) + len(self.failed) >= self.total

    def text(self) -> str:
        """All of it in one line."""
        said = [f"{len(self.done)} of {self.total} simulations done ({100.0 * self.part:.0f} %)"]
        for count, what in (
            (self._left.running, "running"),
            (len(self.failed), "failed"),
            (self.quiet, "without an event"),
        ):
            if count:
                said.append(f"{count} {what}")
        seconds = self._left.seconds(self._clock())
        if seconds is not None and not self.over:
            said.append(f"{in_words(seconds)} left")
        return ", ".join(said)

    def failures(self) -> list[str]:
        """A line for each run that failed, with its reason, below one that counts them."""
        if not self.failed:
            return []
        head = f"{len(self.failed)} of {self.total} simulations failed:"
        return [head, *(f"{_name(run)}: {why}" for run, why in sorted(self.failed.items()))]


def in_words(seconds: float) -> str:
    """A time as people say it, to some percent: 40 s, 12 min, 3 h 20 min, 2 d 4 h."""
    minutes = round(seconds / 60.0)
    if seconds < 90.0:
        return f"{seconds:.0f} s"
    if minutes < 90:
        return f"{minutes} min"
    hours = round(seconds / 3600.0)
    if hours < 10:
        return f"{minutes // 60} h {minutes % 60} min"
    return f"{hours} h" if hours < 48 else f"{hours // 24} d {hours % 24} h"


def last_line(log: Path) -> str:
    """The last line of a log that has words, nothing if there is none."""
    try:
        text = log.read_bytes()[-4096:].decode(errors="replace")
    except OSError:
        return ""
    return next((line.strip() for line in reversed(text.splitlines()) if line.strip()), "")


def _name(run: Path) -> str:
    """What a dataset is called before its key."""
    return run.name.removesuffix(f".{keys.key_in(run)}.nc")


def _attributes(path: Path) -> dict[str, Any]:
    """A dataset's attributes, none of one that can't be read."""
    try:
        return netcdf.attributes(path)
    except DatasetError:
        return {}


def _listed(directories: set[Path]) -> set[Path]:
    """The files in some directories."""
    found: set[Path] = set()
    for directory in directories:
        if directory.is_dir():
            found.update(directory / name for name in os.listdir(directory))
    return found


def _written(path: Path) -> float:
    """When a file was last written (s); the beginning of time if it isn't there any more."""
    try:
        return path.stat().st_mtime
    except OSError:
        return 0.0
