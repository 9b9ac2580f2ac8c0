"""The line that tells of all simulations is read from the files that these leave."""

import io
import logging
import os
import time
from types import SimpleNamespace

import pytest
import xarray as xr
from snakemake_interface_logger_plugins.common import LogEvent
from snakemake_interface_logger_plugins.tests import TestLogHandlerBase as OfInterface

import snakemake_logger_plugin_nucleation as plugin
from nucleation.datasets import netcdf
from nucleation.simulation.outcome import Outcome


class Results:
    """Three jobs, the last of four runs: run0 to run5, with keys k0 to k5."""

    def __init__(self, directory):
        self.directory = directory
        runs = [[0], [1], [2, 3, 4, 5]]
        self.logs = [str(directory / f"logs/{job}.log") for job in range(3)]
        self.jobs = {log: {f"k{i}": f"run{i}" for i in of}
                     for log, of in zip(self.logs, runs, strict=True)}  # fmt: skip
        for name in ("logs", "store", "unfinished"):
            (directory / name).mkdir()

    def told(self):
        return {"results": str(self.directory), "jobs": self.jobs}

    def begin(self, job, text="begun\n", earlier=0.0):
        with open(self.logs[job], "w") as log:
            log.write(text)
        os.utime(self.logs[job], (time.time() - earlier,) * 2)

    def end(self, run, outcome):
        path = self.directory / f"store/k{run}/result.nc"
        if not outcome.completed:
            path = self.directory / f"unfinished/run{run}.k{run}.failed.nc"
        path.parent.mkdir(exist_ok=True)
        netcdf.write(xr.Dataset(attrs={"status": outcome.value}), path)


@pytest.fixture
def results(tmp_path):
    return Results(tmp_path)


def test_runs_from_beginning_to_end(results):
    results.begin(1, earlier=50.0)  # a log of an earlier workflow
    runs = plugin.Runs(**results.told())
    runs.look()
    assert runs.text() == "0 of 6 simulations done (0 %)"
    for job in range(3):
        results.begin(job)
    runs.look()
    assert runs.text() == "0 of 6 simulations done (0 %), 3 running"
    results.end(0, Outcome.AFTER_EVENT)
    results.end(2, Outcome.END_TIME)
    runs.look()
    assert runs.text() == "2 of 6 simulations done (33 %), 2 running, 1 without an event"
    results.end(3, Outcome.TENSION)  # its batch goes on
    results.begin(1, "a step\nKilled\n\n")
    runs.job_failed(results.logs[1])
    assert runs.failed == {"k3": Outcome.TENSION.value, "k1": "Killed"}
    results.end(1, Outcome.AFTER_EVENT)  # in another attempt
    runs.look()
    assert runs.failed.keys() == {"k3"} and runs.running == 1
    assert "1 failed" in runs.text()
    for run in (3, 4, 5):
        results.end(run, Outcome.AFTER_EVENT)
    runs.look()
    assert runs.text() == "6 of 6 simulations done (100 %), 1 without an event"


class Terminal(io.StringIO):
    def isatty(self):
        return True


def handler(stream, monkeypatch, **settings):
    monkeypatch.setattr(plugin.sys, "stderr", stream)
    monkeypatch.setattr(plugin, "PAUSE", 0.01)
    given = {"stdout": False, "nocolor": False, "quiet": None} | settings
    return plugin.LogHandler(SimpleNamespace(**given), None)


def say(handler, message, level=logging.INFO, **extra):
    record = logging.LogRecord("snakemake", level, "", 0, message, (), None)
    record.__dict__.update(extra)
    handler.handle(record)


def shown(stream, text):
    """What a stream has got, once a text is in it."""
    end = time.monotonic() + 10.0
    while text not in stream.getvalue() and time.monotonic() < end:
        time.sleep(0.01)
    assert text in stream.getvalue()
    return stream.getvalue()


def test_terminal_has_one_line_and_all_errors(results, monkeypatch):
    stream = Terminal()
    output = handler(stream, monkeypatch)
    say(output, "Job stats")
    say(output, "", simulations=results.told())
    shown(stream, f"{plugin.ERASE}0 of 6 simulations done (0 %)")
    say(output, "Finished job 1", event=LogEvent.JOB_FINISHED)
    say(output, "Select jobs to execute...")
    results.begin(0, "no disk\n")
    say(output, "Error in rule", logging.ERROR, event=LogEvent.JOB_ERROR, log=[results.logs[0]])
    results.end(1, Outcome.AFTER_EVENT)
    shown(stream, "1 of 6 simulations done (16 %), 1 failed")
    output.close()
    output.close()
    said = stream.getvalue()
    assert "Job stats" in said and "\x1b[31mError in rule" in said
    assert "Finished" not in said and "Select" not in said
    assert said.count("Simulations that failed:\nrun0: no disk\n") == 1


def test_file_has_lines_now_and_then_and_all_messages(results, monkeypatch):
    stream = io.StringIO()
    output = handler(stream, monkeypatch)
    say(output, "", simulations=results.told())
    say(output, "Finished job 1", event=LogEvent.JOB_FINISHED)
    results.end(1, Outcome.AFTER_EVENT)
    shown(stream, "1 of 6")
    monkeypatch.setattr(plugin, "LINE_EVERY", -1.0)
    output._next = 0.0
    shown(stream, "(16 %)\n1 of 6")
    output.close()
    assert stream.getvalue().startswith("Finished job 1\n") and "\x1b" not in stream.getvalue()


@pytest.mark.parametrize("case", ["few", "quiet"])
def test_no_line(case, results, monkeypatch):
    stream, told = io.StringIO(), results.told()
    if case == "few":
        del told["jobs"][results.logs[2]]
    level = [SimpleNamespace(name="PROGRESS")] if case == "quiet" else None
    output = handler(stream, monkeypatch, quiet=level)
    say(output, "", simulations=told)
    output.close()
    assert stream.getvalue() == ""


class TestAsOthersAreTested(OfInterface):
    __test__ = True

    def get_log_handler_cls(self):
        return plugin.LogHandler

    def get_log_handler_settings(self):
        return None
