"""Onset and critical length from synthetic records with known answers."""

import numpy as np
import pytest
import xarray as xr

from nucleation.analysis.extraction import (
    ExtractionSettings,
    extract,
    find_onset,
    patch_edge,
    patch_lengths,
)
from nucleation.model.parameters import Parameters
from nucleation.simulation.event import DropWatch

MEMORY_TIME = 0.05  # D/V (s) of the default parameters
VELOCITY = 1e-5


def force_record(onset=10.0, fall=0.004, size=0.05, end=12.0):
    """|f_d| rising as a square root, then falling by `size` within `fall` seconds."""
    times = [np.arange(0.0, onset, 0.01), onset + np.linspace(0.0, 2 * fall, 81)]
    time = np.concatenate((*times, np.arange(onset + 3 * fall, end, 0.01)))
    force = 1e4 * np.sqrt(time + 0.1)
    force *= 1 - size * np.clip((time - onset) / fall, 0.0, 1.0)
    return time, force


def test_onset_is_the_start_of_the_abrupt_drop():
    time, force = force_record()
    onset = find_onset(time, force, MEMORY_TIME, 0.02)
    assert time[onset.start] == pytest.approx(10.0, abs=0.0101)
    assert time[onset.end] == pytest.approx(10.0 + 0.004 * 0.4, abs=2e-4)
    assert onset.start <= onset.steep <= onset.end


def test_a_slow_decrease_is_no_event():
    time, force = force_record(fall=2.0, size=0.1, end=20.0)
    assert find_onset(time, force, MEMORY_TIME, 0.02) is None


def test_a_small_drop_is_no_event():
    time, force = force_record(size=0.01)
    assert find_onset(time, force, MEMORY_TIME, 0.02) is None


def test_the_first_of_two_events_counts():
    time, force = force_record()
    later, again = force_record(onset=5.0, end=7.0)
    onset = find_onset(
        np.append(time, time[-1] + 0.01 + later), np.append(force, again), MEMORY_TIME, 0.02
    )
    assert time[onset.start] == pytest.approx(10.0, abs=0.0101)


def test_drop_watch_forgets_what_left_the_window():
    watch = DropWatch(window=1.0, drop=0.1)
    assert not watch.dropped(0.0, 100.0)
    assert not watch.dropped(0.5, 95.0)
    assert not watch.dropped(1.2, 88.0)  # 100 is forgotten, 95 is not: a fall by 7 %
    assert watch.dropped(1.3, 85.0)


@pytest.mark.parametrize("threshold", [1e-8, 1e-6, 5e-6])
def test_patch_edge_is_found_between_nodes(threshold):
    """log v falls linearly in x, so the crossing is known exactly."""
    x = np.linspace(0.0, 1.0, 41)
    rate = 1e-5 * 10.0 ** (-x / 0.06)
    assert patch_edge(x, rate, threshold) == pytest.approx(0.06 * np.log10(1e-5 / threshold))


def test_patch_edge_limits():
    x = np.linspace(0.0, 1.0, 21)
    far = np.where(x > 0.8, 1e-3, 1e-12)  # slip at the far corner is not the patch
    assert patch_edge(x, far, 1e-6) == 0.0
    holed = np.where((x < 0.3) & ~((x > 0.1) & (x < 0.2)), 1e-5, 1e-12)
    assert 0.25 <= patch_edge(x, holed, 1e-6) <= 0.3  # the furthest edge counts
    assert patch_edge(x, np.full(21, 1e-2), 1e-6) == 0.5  # all slips: no edge in the part searched


def synthetic_simulation(onset=10.0, decay=0.05):
    """A patch that grows as 0.05 sqrt(t), its slip rate decaying exponentially ahead."""
    x = np.linspace(0.0, 2.0, 801)
    step_time, force = force_record(onset=onset)
    time = step_time[::3]
    edge = 0.05 * np.sqrt(time)
    rate = VELOCITY * np.exp(-np.maximum(x - edge[:, None], 0.0) / decay)
    return xr.Dataset(
        {
            "slip_rate": (("time", "x"), rate),
            "step_time": ("step", step_time),
            "driving_force": ("step", -force),
        },
        coords={"time": time, "x": x},
        attrs={"parameters": Parameters().to_json()},
    )


def test_extract_reads_the_length_at_onset():
    measured = extract(synthetic_simulation(), ExtractionSettings(edge_threshold=0.1))
    length = 0.05 * np.sqrt(10.0) + 0.05 * np.log(10.0)
    assert measured["onset_time"] == pytest.approx(10.0, abs=0.011)
    assert measured["length"] == pytest.approx(length, abs=1e-3)
    low, high = (0.05 * np.sqrt(10.0) + 0.05 * np.log(1 / share) for share in (0.5, 1e-3))
    assert measured["length_low"] == pytest.approx(low, abs=1e-3)
    assert measured["length_high"] == pytest.approx(high, abs=1e-3)
    assert measured["onset_time_low"] <= measured["onset_time"] <= measured["onset_time_high"]


def test_a_patch_that_pauses_keeps_its_length():
    """The slip rate oscillates before the onset; what has crept still belongs to the patch."""
    simulation = synthetic_simulation()
    settings = ExtractionSettings(edge_threshold=0.1)
    pause = 1.0 - 0.999 * np.exp(-(((simulation["time"] - 10.0) / 0.3) ** 2))
    slowed = simulation.assign(slip_rate=simulation["slip_rate"] * pause)
    lengths = [extract(dataset, settings)["length"] for dataset in (simulation, slowed)]
    assert lengths[1] == pytest.approx(lengths[0], rel=0.06)  # it grew by 5 % in the pause
    assert lengths[1] < lengths[0]


def test_settings_change_the_edge():
    simulation = synthetic_simulation()
    lengths = [
        extract(simulation, ExtractionSettings(edge_threshold=share))["length"]
        for share in (0.4, 0.1, 0.01)
    ]
    np.testing.assert_allclose(np.diff(lengths), 0.05 * np.log([4.0, 10.0]), atol=1e-4)


def test_no_event_gives_nan():
    simulation = synthetic_simulation(onset=50.0).isel(step=slice(0, 900))
    measured = extract(simulation)
    assert all(np.isnan(value) for value in measured.values())


def test_patch_lengths_follow_every_frame():
    simulation = synthetic_simulation()
    lengths = patch_lengths(simulation, 0.1 * VELOCITY)
    expected = 0.05 * np.sqrt(simulation["time"].values) + 0.05 * np.log(10.0)
    np.testing.assert_allclose(lengths, expected, atol=1e-3)
