"""Hops of a made-up front that advances evenly."""

import made_up_runs
import numpy as np
import pytest

from nucleation.patch.hops import crossing_times, follow_hops, hop_frequency, oscillation


def test_crossing_times_between_samples():
    time, length = np.arange(5.0), np.array([0.0, 1.0, 1.0, 1.0, 3.0])
    times = crossing_times(time, length, np.array([0.5, 1.0, 2.0, 3.5]))
    np.testing.assert_allclose(times, [0.5, 3.0, 3.5, np.nan])


@pytest.mark.parametrize("span", [0.01, 0.1])
def test_frequency_of_even_hops(span):
    hops = 3.0 + 0.2 * np.arange(60)
    frequency = hop_frequency(hops, 0.005, span)
    known = np.isfinite(frequency)
    each_way = max(1, round(0.5 * span / 0.005))
    assert known.sum() == 60 - 2 * each_way
    np.testing.assert_allclose(frequency[known], 2 * np.pi / 0.2)


def test_front_that_hops_evenly():
    period = 0.125
    run = made_up_runs.record(period)
    hops = follow_hops(run)
    count = int(made_up_runs.ONSET / period)
    np.testing.assert_allclose(hops["hop_length"], run["x"].values[1 : count + 1])
    np.testing.assert_allclose(np.diff(hops["hop_time"]), period, atol=0.011)  # frames are 10 ms
    spacing, speed = 0.01, 0.01 / period
    expected = 2 * np.pi * speed / spacing
    middle = hops["hop_frequency"].values[5:-5]
    np.testing.assert_allclose(middle, expected, rtol=0.05)
    assert float(hops["onset_time"]) == pytest.approx(made_up_runs.ONSET)
    assert int(hops["n_x"]) == 200


def test_run_without_an_event_has_no_last_hop():
    run = made_up_runs.record()
    run["driving_force"] = run["driving_force"] * 0.0 - 1e4
    with pytest.raises(ValueError, match="no event"):
        follow_hops(run)


def test_amplitude_of_a_growing_oscillation_on_a_trend():
    time = np.unique(np.concatenate([np.linspace(3.0, 12.0, 700), np.linspace(8.0, 9.0, 300)]))
    grown = 1e-8 * np.exp(0.8 * time)
    rate = 5e-6 * np.sqrt(time) + grown * np.sin(12.0 * time)
    samples, amplitude = oscillation(time, rate, 0.05)
    assert samples[0] == pytest.approx(4.0) and samples[-1] == pytest.approx(11.0, abs=0.02)
    # the trend follows some of so slow an oscillation: its amplitude is met to a fifth
    np.testing.assert_allclose(amplitude, 1e-8 * np.exp(0.8 * samples), rtol=0.3)
    growth = np.polyfit(samples, np.log(amplitude), 1)[0]
    assert growth == pytest.approx(0.8, rel=0.02)
    assert oscillation(time[:20], rate[:20], 0.05)[0].size == 0
