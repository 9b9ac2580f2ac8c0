"""Levels of recording: less of a record gives the same; frames and remarks of a recorder."""

import dataclasses
import os

import numpy as np
import pytest

from nucleation.datasets import netcdf
from nucleation.datasets.variables import DatasetError
from nucleation.extraction.definitions import ExtractionSettings
from nucleation.extraction.extraction import Record, extract
from nucleation.extraction.growth import follow_patch
from nucleation.run.run import PAPER_RUN
from nucleation.simulation import recording
from nucleation.simulation.recording import Recorder
from nucleation.simulation.run import simulate
from nucleation.simulation.start import at_rest, composed

ONE = PAPER_RUN.replaced(
    height=0.02, block_length=1.83, n_x=80, n_y=4, grading=6.0, tolerance=5e-2, longest_step=0.5,
    time_after_event=0.0, end_time=30.0, strength=1e-3, perturbation="normal_load"
)  # fmt: skip
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


@pytest.mark.parametrize(("times", "rates", "frames"), [
    (1e-6 * STEPS, V + 0.0 * STEPS, [0, 40, 80]),  # every forty steps
    (0.05 * STEPS[:25] * (1 + 1e-9), V + 0.0 * STEPS[:25], [0, 8, 16, 24]),  # 0.4 D/V
    # a slip rate has changed by half its logarithm: for fast slip asinh(v / V) grows as log(v)
    (1e-6 * STEPS[:21], 1e4 * V * np.exp(0.1001 * STEPS[:21]), [0, 5, 10, 15, 20]),
], ids=["steps", "time", "slip rate"])  # fmt: skip
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
