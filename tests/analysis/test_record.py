"""A record reads a run once, by one definition of everything."""

import numpy as np
import pytest
from analysis.made_up_patch import VELOCITY, synthetic_simulation

from nucleation.analysis.definitions import ExtractionSettings
from nucleation.analysis.extraction import extract
from nucleation.analysis.record import Record
from nucleation.simulation.patch import Extent

SETTINGS = ExtractionSettings(edge_threshold=0.1)


def test_lengths_follow_every_frame():
    record = Record(synthetic_simulation(), SETTINGS)
    expected = 0.05 * np.sqrt(record.time) + 0.05 * np.log(10.0)
    np.testing.assert_allclose(record.lengths, expected, atol=1e-3)
    assert record.threshold == pytest.approx(0.1 * VELOCITY)
    usual, high, low = record.all_lengths
    assert usual is record.lengths
    assert (high[1:] < usual[1:]).all() and (usual[1:] < low[1:]).all()


def test_lengths_never_fall_and_are_those_of_a_run_that_is_going_on():
    simulation = synthetic_simulation()
    pause = 1.0 - 0.999 * np.exp(-(((simulation["time"] - 10.0) / 0.3) ** 2))
    record = Record(simulation.assign(slip_rate=simulation["slip_rate"] * pause), SETTINGS)
    assert (np.diff(record.lengths) >= 0.0).all() and (np.diff(record.lengths) == 0.0).any()
    extent = Extent(record.x, record.threshold)
    seen = [extent.reach(rate) for rate in record.simulation["slip_rate"].values]
    np.testing.assert_array_equal(seen, record.lengths)


def test_onset_creep_and_extraction_agree():
    record = Record(synthetic_simulation(onset=10.0), SETTINGS)
    assert record.drop_times[0] == pytest.approx(10.0, abs=0.011)
    assert record.time[record.creep[-1]] <= record.drop_times[0] < record.time[record.creep[-1] + 1]
    length = record.lengths[record.frames_at(record.drop_times)][0]
    assert extract(record.simulation, SETTINGS)["length"] == length


@pytest.mark.parametrize(("fall", "abrupt"), [(0.8, True), (1.6, False)])
def test_an_abrupt_drop_takes_no_longer_than_the_memory_time(fall, abrupt):
    """A fall by 2.5 % counts if 2 % of it are within D/V, which is 0.05 s."""
    record = Record(synthetic_simulation(fall=fall * 0.05, size=0.025), SETTINGS)
    assert (record.onset is not None) == abrupt
