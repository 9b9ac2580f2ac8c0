"""Levels of recording: what stands in the record of a run, and that less of it gives the same."""

import os

import numpy as np
import pytest

from nucleation.datasets import netcdf
from nucleation.datasets.variables import DatasetError
from nucleation.extraction.definitions import ExtractionSettings
from nucleation.extraction.extraction import Record, extract
from nucleation.extraction.growth import follow_patch
from nucleation.run.run import PAPER_RUN
from nucleation.simulation.run import simulate

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
    with pytest.raises(DatasetError, match=r"slip, shear_stress.*recording\.record is lengths"):
        Record(records["lengths"]).require("slip", "shear_stress")
    Record(records["interface"]).require("slip", "shear_stress")
    Record(records["lengths"]).require("slip_rate")
