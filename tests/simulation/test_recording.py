"""What a run records, level by level, and what it shows of itself while it works."""

import dataclasses
import io
import os
import re

import numpy as np
import pytest

from nucleation.datasets import netcdf
from nucleation.datasets.variables import DatasetError
from nucleation.extraction.definitions import ExtractionSettings
from nucleation.extraction.extraction import Record, extract
from nucleation.extraction.growth import follow_patch
from nucleation.run.run import PAPER_RUN
from nucleation.simulation import progress, recording
from nucleation.simulation.progress import Progress
from nucleation.simulation.recording import Recorder
from nucleation.simulation.run import instants, simulate
from nucleation.simulation.start import at_rest, composed

ONE = PAPER_RUN.replaced(
    height=0.02,
    block_length=1.83,
    n_x=80,
    n_y=4,
    grading=6.0,
    tolerance=5e-2,
    longest_step=0.5,
    time_after_event=0.0,
    end_time=30.0,
    strength=1e-3,
    perturbation="normal_load",
)
"""A run to its event of a tenth of the usual cost."""


@pytest.fixture(scope="module")
def records():
    levels = ("interface", "lengths")
    return {level: simulate(ONE.replaced(record=level)) for level in levels}


def test_lengths_and_stability_are_the_same_from_every_level(records):
    settings = ExtractionSettings()
    expected, found = extract(records["interface"]), extract(records["lengths"])
    assert np.isfinite(expected["length"]) and found["onset_time"] == expected["onset_time"]
    for name, value in expected.items():
        assert found[name] == pytest.approx(value, rel=1e-6), name
    one, other = (follow_patch(records[level], settings) for level in ("interface", "lengths"))
    assert float(one["stability_length"]) > 0.0
    for name in ("stability_length", "stability_frequency"):
        assert float(other[name]) == pytest.approx(float(one[name]), rel=1e-5), name


def test_the_smallest_record_is_small(records, tmp_path):
    sizes = {}
    for level, record in records.items():
        path = tmp_path / f"{level}.nc"
        netcdf.write(record, path)
        sizes[level] = os.path.getsize(path)
    assert sizes["lengths"] < 0.35 * sizes["interface"]


def test_what_was_not_recorded_is_said(records):
    with pytest.raises(DatasetError, match=r"slip, shear_stress.*run's record is lengths"):
        Record(records["lengths"]).require("slip", "shear_stress")
    Record(records["interface"]).require("slip", "shear_stress")
    Record(records["lengths"]).require("slip_rate")


PARAMETERS = PAPER_RUN.replaced(height=0.02, block_length=0.4, n_x=16, n_y=4)
V = PARAMETERS.fault.velocity
MEMORY = PARAMETERS.memory_time


@pytest.fixture(scope="module")
def start():
    dynamics = composed(PARAMETERS)
    return dynamics, *at_rest(dynamics, PARAMETERS)


def recorded(start, times, rates):
    """The record of some instants (s), with one slip rate (m/s) at all nodes."""
    dynamics, state, report = start
    recorder = Recorder(PARAMETERS, dynamics)
    for time, rate in zip(times, rates, strict=True):
        slip_rate = np.full_like(report.interface.slip_rate, rate)
        interface = dataclasses.replace(report.interface, slip_rate=slip_rate)
        recorder.record(
            dataclasses.replace(state, past_times=np.array([time])),
            dataclasses.replace(report, interface=interface),
        )
    return recorder.dataset()


STEPS = np.arange(100)


@pytest.mark.parametrize(
    ("times", "rates", "frames"),
    [
        (1e-6 * STEPS, V + 0.0 * STEPS, [0, 40, 80]),  # every forty steps
        (0.05 * STEPS[:25] * (1 + 1e-9), V + 0.0 * STEPS[:25], [0, 8, 16, 24]),  # 0.4 D/V
        # a slip rate has changed by half its logarithm: for fast slip asinh(v / V) grows as log(v)
        (1e-6 * STEPS[:21], 1e4 * V * np.exp(0.1001 * STEPS[:21]), [0, 5, 10, 15, 20]),
    ],
    ids=["steps", "time", "slip rate"],
)
def test_when_frames_are_taken(start, times, rates, frames):
    record = recorded(start, MEMORY * times, rates)
    np.testing.assert_array_equal(record["time"], MEMORY * times[frames])


@pytest.mark.parametrize(
    ("width", "remarks"),
    [(1.2, ["not resolved: at the onset the front is 1.2 elements wide"]), (1.3, [])],
)
def test_a_front_within_an_element_and_a_quarter_is_lost(start, monkeypatch, width, remarks):
    monkeypatch.setattr(recording, "front_width", lambda *_: width)
    dynamics, state, report = start
    recorder = Recorder(PARAMETERS, dynamics)
    recorder.record(state, report)
    assert recorder.remarks() == []  # no event yet
    recorder._onset_time = 0.0
    assert recorder.remarks() == remarks


COARSE = PAPER_RUN.replaced(
    height=0.005,
    block_length=0.9,
    n_x=60,
    n_y=6,
    grading=2.0,
    end_time=30.0,
    time_after_event=0.0,
    tolerance=5e-2,
    longest_step=0.1,
)


class Terminal(io.StringIO):
    def isatty(self):
        return True


@pytest.mark.slow
def test_log_gets_lines_with_what_one_wants_to_know(monkeypatch):
    monkeypatch.setattr(progress, "PAUSE", 0.0)
    log = io.StringIO()
    record = simulate(COARSE, progress=Progress(COARSE, log))
    lines = log.getvalue().splitlines()
    assert len(lines) == record.sizes["step"]
    pattern = (
        r"step (\d+): t = ([\d.e-]+) s, dt = ([\d.e-]+) s, max v = ([\d.e-]+) m/s, "
        r"patch ([\d.e-]+) m, rejected (\d+), (\d+) % of the way"
    )
    found = [re.fullmatch(pattern, line) for line in lines]
    assert all(found)
    assert [int(m[1]) for m in found] == list(range(record.sizes["step"]))
    np.testing.assert_allclose([float(m[2]) for m in found], record["step_time"], rtol=1e-4)
    last = found[-1]
    assert int(last[7]) >= 60  # the event comes at two thirds of the theory's length or later
    done = [int(m[7]) for m in found]
    assert max(np.diff(done)) <= 10 and min(np.diff(done)) >= 0


def test_terminal_gets_a_line_that_goes_away(monkeypatch):
    monkeypatch.setattr(progress, "PAUSE_ON_TERMINAL", 0.0)
    terminal = Terminal()
    short = COARSE.replaced(end_time=0.5)
    line = Progress(short, terminal)
    simulate(short, progress=line)
    line.close()
    shown = terminal.getvalue()
    assert "\n" not in shown.rstrip("\n")
    assert " % of the way" in shown and "max v = " in shown and "patch " in shown
    assert shown.endswith("\r") and shown.split("\r")[-2].strip() == ""


def test_a_simulation_of_the_library_shows_itself_on_a_terminal(monkeypatch):
    """It showed nothing for minutes; a file gets nothing, and False silences it."""
    short = COARSE.replaced(end_time=0.02, n_x=16)
    for stream, words, shows in (
        (Terminal(), {}, True),
        (Terminal(), {"progress": False}, False),
        (io.StringIO(), {}, False),
        (io.StringIO(), {"progress": True}, True),
    ):
        monkeypatch.setattr("sys.stderr", stream)
        progress.simulate(short, **words)
        assert ("max v = " in stream.getvalue()) == shows


@pytest.mark.parametrize(
    ("changed", "part"), [({}, 50), ({"end_time": 20.0}, 75), ({"end_time": 10.0}, 99)]
)
def test_part_of_the_way_is_by_the_end_time_where_no_patch_is_long(changed, part):
    instant = next(instants(COARSE))
    state = dataclasses.replace(instant.state, past_times=np.array([15.0]))
    log = io.StringIO()
    Progress(COARSE.replaced(**changed), log)(dataclasses.replace(instant, state=state))
    assert f", {part} % of the way" in log.getvalue()
