"""Onset of made-up forces and edges of made-up slip rates, with known answers."""

import numpy as np
import pytest

from nucleation.extraction.definitions import find_onset
from nucleation.simulation.event import slipping_edge, slipping_zone

MEMORY_TIME = 0.05  # D/V (s) of the default parameters


def force_record(onset=10.0, fall=0.004, size=0.05, end=12.0):
    """|f_d| rising as a square root, then falling by `size` within `fall` seconds."""
    times = [np.arange(0.0, onset, 0.01), onset + np.linspace(0.0, 2 * fall, 81)]
    time = np.concatenate((*times, np.arange(onset + 3 * fall, end, 0.01)))
    force = 1e4 * np.sqrt(time + 0.1)
    force *= 1 - size * np.clip((time - onset) / fall, 0.0, 1.0)
    return time, force


def onset_of(time, force, drop=0.02, fast=True, ruptures=False):
    """The onset in a patch that is long enough."""
    masks = (np.broadcast_to(mask, time.shape) for mask in (fast, True, ruptures))
    return find_onset(time, force, MEMORY_TIME, drop, *masks)


def test_onset_is_the_start_of_the_abrupt_drop():
    time, force = force_record()
    onset = onset_of(time, force)
    assert time[onset.start] == pytest.approx(10.0, abs=0.0101)
    assert time[onset.end] == pytest.approx(10.0 + 0.004 * 0.4, abs=2e-4)
    assert onset.start <= onset.steep <= onset.end


@pytest.mark.parametrize("given", [{"fall": 2.0, "size": 0.1, "end": 20.0}, {"size": 0.01}])
def test_a_slow_decrease_and_a_small_drop_are_no_event(given):
    assert onset_of(*force_record(**given)) is None


def test_the_first_of_two_events_counts():
    time, force = force_record()
    later, again = force_record(onset=5.0, end=7.0)
    onset = onset_of(np.append(time, time[-1] + 0.01 + later), np.append(force, again))
    assert time[onset.start] == pytest.approx(10.0, abs=0.0101)


def test_a_force_that_follows_its_load_is_no_event():
    time, force = force_record()
    before = time < 10.0
    force[before] *= 1 + 0.03 * np.sin(60.0 * time[before])
    fast = time > 10.0002
    early = onset_of(time, force)
    onset = onset_of(time, force, fast=fast)
    assert time[early.end] < 1.0
    assert time[onset.end] == pytest.approx(10.0, abs=0.004)
    assert fast[onset.end]


@pytest.mark.parametrize("threshold", [1e-8, 1e-6, 5e-6])
def test_slipping_edge_is_found_between_nodes(threshold):
    """log v falls linearly in x, so the crossing is known exactly."""
    x = np.linspace(0.0, 1.0, 41)
    rate = 1e-5 * 10.0 ** (-x / 0.06)
    assert slipping_edge(x, rate, threshold) == pytest.approx(0.06 * np.log10(1e-5 / threshold))


def test_slipping_edge_limits():
    x = np.linspace(0.0, 1.0, 21)
    far = np.where(x > 0.8, 1e-3, 1e-12)  # slip at the far corner is not the patch
    assert slipping_edge(x, far, 1e-6) == 0.0
    holed = np.where((x < 0.3) & ~((x > 0.1) & (x < 0.2)), 1e-5, 1e-12)
    assert 0.25 <= slipping_edge(x, holed, 1e-6) <= 0.3  # the furthest edge counts
    assert slipping_edge(x, np.full(21, 1e-2), 1e-6) == 0.5  # all slips: the part searched


@pytest.mark.parametrize("periodic", [False, True])
@pytest.mark.parametrize("middle", [0.5, 0.1])
def test_both_ends_of_a_slipping_zone_are_found_between_nodes(middle, periodic):
    """log v falls linearly on both sides; in a period the zone may begin below zero."""
    x = np.linspace(0.0, 1.0, 41)
    away = np.abs(x - middle)
    if periodic:
        away = np.minimum(away, 1.0 - away)
    rate = 1e-5 * 10.0 ** (-away / 0.06)
    half = 0.06 * np.log10(1e-5 / 2e-8)
    begin, end = slipping_zone(x, rate, 2e-8, periodic)
    expected = (middle - half, middle + half)
    if not periodic:
        expected = (max(expected[0], 0.0), expected[1])
    assert (begin, end) == pytest.approx(expected, abs=1e-12)


@pytest.mark.parametrize(("rise", "belongs"), [(0.08, True), (0.13, False)])
def test_a_rise_by_a_tenth_of_the_fall_after_it_ends_the_drop(rise, belongs):
    """The force falls from 1.5, rises again to 1, and falls to 0."""
    force = np.array([1.4, 1.5, 1.0 - rise, 1.0, 0.5, 0.0])
    onset = onset_of(np.arange(force.size) * 1e-3, force, 0.99)
    assert force[onset.start] == (1.5 if belongs else 1.0)


@pytest.mark.parametrize("ruptured", [[], [4, 5, 6, 7]])
def test_a_force_that_a_rupture_raises_is_past_its_onset(ruptured):
    """It falls a little from 1.5, is raised to 2 by the rupture, and falls to 1."""
    force = np.array([1.4, 1.5, 1.49, 1.48, 1.48, 1.7, 2.0, 1.0])
    ruptures = np.isin(np.arange(force.size), ruptured)
    onset = onset_of(np.arange(force.size) * 1e-3, force, 0.4, ruptures=ruptures)
    assert force[onset.start] == (1.5 if ruptured else 2.0)
    assert onset.start <= onset.steep <= onset.end == force.size - 1


@pytest.mark.parametrize(
    ("falls", "steep"),
    [
        ([0.05, 0.05, 0.15, 0.9], 6),  # the first fall by more than the load has risen in a step
        ([0.05, 0.05, 0.9], 6),  # the last fall counts
        ([0.09, 0.09, 0.09, 0.09, 0.9], 4),  # only falls up to the end of the drop count
    ],
)
def test_the_steep_part_falls_faster_than_loading_has_raised_the_force(falls, steep):
    """The force rises by 0.1 in a step up to the maximum, 1.4, which is step 4."""
    rises = 1.0 + 0.1 * np.arange(5)
    force = np.concatenate((rises, rises[-1] - np.cumsum(falls)))
    onset = onset_of(np.arange(force.size) * 1e-3, force, 0.25)
    assert (onset.start, onset.steep) == (4, steep)
