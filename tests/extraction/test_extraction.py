"""Onset and critical length from synthetic records with known answers."""

import numpy as np
import pytest
from configurations import messages, study
from extraction.made_up_patch import synthetic_simulation

from nucleation.extraction.definitions import ExtractionSettings
from nucleation.extraction.extraction import extract
from nucleation.simulation.run import simulate
from replication.configuration.load import configure


def test_extract_reads_the_length_at_onset():
    measured = extract(synthetic_simulation(), ExtractionSettings(edge_threshold=0.1))
    length = 0.05 * np.sqrt(10.0) + 0.05 * np.log(10.0)
    assert measured["onset_time"] == pytest.approx(10.0, abs=0.011)
    assert measured["length"] == pytest.approx(length, abs=1e-3)
    low, high = (0.05 * np.sqrt(10.0) + 0.05 * np.log(1 / share) for share in (0.5, 1e-3))
    assert measured["length_low"] == pytest.approx(low, abs=1e-3)
    assert measured["length_high"] == pytest.approx(high, abs=1e-3)
    assert measured["onset_time_low"] <= measured["onset_time"] <= measured["onset_time_high"]


def test_no_event_gives_nan():
    simulation = synthetic_simulation(onset=50.0).isel(step=slice(0, 900))
    measured = extract(simulation)
    assert all(np.isnan(value) for value in measured.values())


@pytest.mark.slow
def test_a_larger_drop_is_recorded_without_time_after_the_event():
    """The recorder had a drop of its own: with any larger one there was no length, in silence."""
    run = {"height": 0.005, "n_x": 60, "n_y": 4, "end_time": 30.0, "tolerance": 0.1}
    config = study(run | {"longest_step": 0.3, "time_after_event": 0.0}, length_over_critical=3.0)
    asked = configure(config | {"extraction": {"drop": 0.1}})
    (own,) = asked.runs
    assert own.run.stepping.event_drop == 0.1
    found = extract(simulate(own.run), asked.extraction)
    assert 0.1 < found["length"] < own.critical_length
    usual = simulate(own.run.replaced(event_drop=0.02))
    with pytest.warns(UserWarning, match="before it fell by drop = 0.1: simulate with a larger"):
        assert np.isnan(extract(usual, asked.extraction)["length"])
    assert extract(usual)["length"] > 0.1


def test_a_study_may_not_stop_before_the_drop_that_is_asked_for():
    run = {"height": 0.005, "event_drop": 0.05}
    assert "event_drop = 0.05 is not allowed with extraction.drop = 0.1" in messages(
        study(run) | {"extraction": {"drop": 0.1}}
    )
