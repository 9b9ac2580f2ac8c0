"""What has become of many runs is read from the files that they leave."""

import io
import logging
import os
from pathlib import Path
from types import SimpleNamespace

import pytest
import xarray as xr
from nucleation.pipeline.all_runs import AllRuns, Work, in_words, last_line, planned
from nucleation.pipeline.watch import Line, Watch
from snakemake_interface_logger_plugins.common import LogEvent

from nucleation.datasets import netcdf
from nucleation.pipeline import watch
from nucleation.simulation.outcome import Outcome

BEGAN = 1000.0


class Jobs:
    """A directory of results in which jobs begin and end, and the time."""

    def __init__(self, directory: Path, *sizes: int) -> None:
        self.now, number = BEGAN, 0
        self.work = []
        for job, size in enumerate(sizes):
            runs = [directory / f"simulations/run{number + i}.{number + i:016x}.nc"
                    for i in range(size)]  # fmt: skip
            number += size
            self.work.append(Work(tuple(runs), directory / f"logs/job{job}.log"))
        self.runs = [run for one in self.work for run in one.runs]
        (directory / "simulations").mkdir()
        (directory / "logs").mkdir()

    def clock(self) -> float:
        return self.now

    def write(self, path: Path, moment: float) -> None:
        os.utime(path, (moment, moment))

    def begin(self, job: int, moment: float) -> None:
        self.work[job].log.write_text("begun\n")
        self.write(self.work[job].log, moment)

    def end(self, run: int, moment: float, seconds: float, status: str, failed=False) -> None:
        path = self.runs[run].with_suffix(".failed.nc") if failed else self.runs[run]
        record = xr.Dataset(attrs={"status": status, "wall_seconds": seconds})
        netcdf.write(record, path)
        self.write(path, moment)


GOOD, QUIET = Outcome.AFTER_EVENT.value, Outcome.END_TIME.value
FAILED = Outcome.TENSION.value


def test_single_jobs_from_beginning_to_end(tmp_path):
    jobs = Jobs(tmp_path, *[1] * 10)
    jobs.begin(9, BEGAN - 5.0)  # a log of an earlier workflow
    runs = AllRuns(jobs.work, clock=jobs.clock)
    runs.look()
    assert runs.text() == "0 of 10 simulations done (0 %)"
    jobs.begin(0, BEGAN)
    jobs.begin(1, BEGAN)
    jobs.now = BEGAN + 1.0
    runs.look()
    assert runs.text() == "0 of 10 simulations done (0 %), 2 running"
    jobs.end(0, BEGAN + 20.0, 20.0, GOOD)
    jobs.end(1, BEGAN + 20.0, 20.0, QUIET)
    jobs.begin(2, BEGAN + 20.0)
    jobs.begin(3, BEGAN + 20.0)
    jobs.now = BEGAN + 20.0
    runs.look()
    expected = "2 of 10 simulations done (20 %), 2 running, 1 without an event, 80 s left"
    assert runs.text() == expected
    jobs.end(2, BEGAN + 30.0, 10.0, FAILED, failed=True)
    jobs.work[3].log.write_text("a step\nKilled\n\n")
    runs.job_failed(jobs.work[3].log)
    runs.job_failed(jobs.work[3].log)  # said once more
    runs.look()
    assert "2 failed" in runs.text() and "running" not in runs.text()
    assert runs.failures() == ["2 of 10 simulations failed:", f"run2: {FAILED}", "run3: Killed"]
    jobs.end(3, BEGAN + 50.0, 10.0, GOOD)  # in another attempt
    jobs.runs[0].unlink()  # Snakemake removes the result of a failed job's partner
    runs.look()
    assert runs.text().startswith("3 of 10 simulations done (30 %), 1 failed")
    for run in range(4, 10):
        jobs.end(run, BEGAN + 60.0, 10.0, GOOD)
    runs.look()
    assert runs.over and runs.text() == (
        "9 of 10 simulations done (90 %), 1 failed, 1 without an event"
    )


def test_jobs_of_many_runs_have_one_at_work(tmp_path):
    jobs = Jobs(tmp_path, 3, 3)
    runs = AllRuns(jobs.work, clock=jobs.clock)
    jobs.begin(0, BEGAN)
    jobs.now += 1.0
    runs.look()
    assert "1 running" in runs.text()
    jobs.end(0, BEGAN + 10.0, 10.0, GOOD)
    jobs.now = BEGAN + 10.0
    runs.look()
    assert runs.text() == "1 of 6 simulations done (17 %), 1 running, 50 s left"
    jobs.end(1, BEGAN + 15.0, 5.0, FAILED, failed=True)  # the next one goes on
    runs.look()
    assert "1 running, 1 failed" in runs.text()


def test_runs_that_were_there_before_are_done_and_tell_nothing_of_time(tmp_path):
    jobs = Jobs(tmp_path, 4)
    jobs.end(0, BEGAN - 100.0, 3.0, GOOD)  # of a batch that was killed and goes on
    runs = AllRuns(jobs.work, clock=jobs.clock)
    jobs.begin(0, BEGAN)
    runs.look()
    assert runs.text() == "1 of 4 simulations done (25 %), 1 running"
    jobs.end(1, BEGAN + 10.0, 10.0, GOOD)
    jobs.now = BEGAN + 10.0
    runs.look()
    assert runs.text() == "2 of 4 simulations done (50 %), 1 running, 20 s left"


def test_a_run_of_two_jobs_is_one_run(tmp_path):
    """Two studies may have the same run, one of them in a batch."""
    jobs = Jobs(tmp_path, 1, 2)
    (own,), (_, last) = (one.runs for one in jobs.work)
    jobs.work[1] = Work((own, last), jobs.work[1].log)
    runs = AllRuns(jobs.work, clock=jobs.clock)
    jobs.begin(0, BEGAN)
    jobs.begin(1, BEGAN)
    jobs.now += 1.0
    runs.look()
    assert runs.text() == "0 of 2 simulations done (0 %), 1 running"
    jobs.end(0, BEGAN + 10.0, 10.0, GOOD)
    jobs.end(2, BEGAN + 20.0, 10.0, GOOD)
    runs.look()
    assert runs.over and runs.text() == "2 of 2 simulations done (100 %)"


def test_predicted_costs_are_used(tmp_path):
    jobs = Jobs(tmp_path, 1, 1)
    costs = {str(jobs.runs[0]): 2.0, str(jobs.runs[1]): 6.0}
    runs = AllRuns(jobs.work, costs, clock=jobs.clock)
    jobs.end(0, BEGAN + 10.0, 10.0, GOOD)
    jobs.now = BEGAN + 10.0
    runs.look()
    assert "30 s left" in runs.text()


def test_planned_jobs_make_their_outputs_or_name_their_runs():
    def job(output, log, **params):
        return SimpleNamespace(
            output=output, log=log, params=SimpleNamespace(**params),
            rule=SimpleNamespace(params=params),
        )  # fmt: skip

    run, other = (f"results/simulations/{n}.{'0' * 16}.nc" for n in "ab")
    jobs = [
        job([run], ["one.log"]),
        job(["results/batches/b.csv"], ["batch.log"], places=[(run, "code"), (other, "code")]),
        job(["results/lengths.csv"], ["lengths.log"]),
        job(["results/patches/p.0123456789abcdef.nc"], ["patch.log"]),
    ]
    assert planned(jobs) == [
        Work((Path(run),), Path("one.log")), Work((Path(run), Path(other)), Path("batch.log"))
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(3.2, "3 s"), (89.0, "89 s"), (600.0, "10 min"), (5400.0, "1 h 30 min"),
     (12 * 3600.0, "12 h"), (50 * 3600.0, "2 d 2 h")],
)  # fmt: skip
def test_times_in_words(seconds, words):
    assert in_words(seconds) == words


def test_the_last_line_of_a_log(tmp_path):
    assert last_line(tmp_path / "none.log") == ""


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_elsewhere_there_is_a_line_at_each_tenth_and_each_minute():
    now, stream = [0.0], io.StringIO()
    line = Line(stream, lambda: now[0])
    for hundredth in range(35):
        now[0] += 1.0
        line.show(f"{hundredth} %", hundredth / 100.0)
    assert stream.getvalue().split("\n") == ["10 %", "20 %", "30 %", ""]
    now[0] += 60.0
    line.show("34 %", 0.34)
    line.show("35 %", 0.35)
    assert stream.getvalue().endswith("30 %\n34 %\n")


def test_on_a_terminal_the_line_is_written_anew_and_makes_room(tmp_path, monkeypatch):
    stream, said = Terminal(), io.StringIO()
    jobs = Jobs(tmp_path, 1, 1)
    runs = AllRuns(jobs.work, clock=jobs.clock)
    handler = logging.StreamHandler(said)
    logger = logging.getLogger("made-up")
    logger.propagate = False
    logger.setLevel(logging.INFO)
    logger.addHandler(handler)
    monkeypatch.setattr(watch, "logger", logger)
    monkeypatch.setattr(watch, "PAUSE", 0.01)
    found = Watch(runs, Line(stream))
    found.begin()
    while not stream.getvalue():
        pass
    assert stream.getvalue().startswith("\r\x1b[K0 of 2 simulations done (0 %)")
    jobs.begin(0, BEGAN)
    jobs.work[0].log.write_text("No space left on device\n")
    logger.info("a job", extra={"event": LogEvent.JOB_INFO})
    logger.info("an error", extra={"event": LogEvent.JOB_ERROR, "log": [str(jobs.work[0].log)]})
    assert said.getvalue() == "an error\n", "single jobs are not told of"
    assert "1 failed" in runs.text()
    jobs.end(1, BEGAN + 2.0, 2.0, GOOD)
    found.end()
    ended = stream.getvalue()
    assert ended.count("1 of 2 simulations done (50 %), 1 failed") >= 1
    assert ended.endswith("\n1 of 2 simulations failed:\nrun0: No space left on device\n")
    logger.info("a job", extra={"event": LogEvent.JOB_INFO})
    assert said.getvalue().endswith("a job\n"), "it is over"
