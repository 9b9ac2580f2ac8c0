"""Does a weakening patch creep, slip slowly or nucleate; and the process zone."""

import functools
import math

import pytest
from asked import ROCK, weakening_patch_length

from nucleation.answers.theory import process_zone
from nucleation.api import Fault
from nucleation.lengths import weakening_patch as patch_outcomes
from nucleation.lengths.weakening_patch import (
    BY_VELOCITY,
    NO_WIDTH,
    OTHER_A,
    OTHER_B,
    patch_answer,
    simulated,
)

STATE_LENGTH = 40e9 * 5e-6 / (0.015 * 50e6)


@pytest.mark.parametrize(
    ("changed", "zone"),
    [
        ({}, 0.5 * STATE_LENGTH),
        (
            {"second_shear_modulus": math.inf, "friction": 0.6, "height": 1e-4},
            math.sqrt(2e-4 * STATE_LENGTH),
        ),
        ({"plane": "antiplane"}, 0.375 * STATE_LENGTH),
    ],
)
def test_process_zone(changed, zone):
    """By hand: the stiffness of half-spaces is ``mu* k/2``, of a thin layer ``2 mu* H k^2``."""
    assert process_zone(Fault(**ROCK | changed)).value == pytest.approx(zone, rel=2e-3)


def patch(row, **changed):
    """A fault and its surroundings with one of the simulated frictions."""
    zeta = row.zeta_over_a * ROCK["a"]
    fault = {**ROCK, "b": ROCK["a"] + zeta, "plane": "antiplane", "velocity": 1e-8} | changed
    outside = {"outside_zeta": -row.strengthening * zeta}
    if row.varies == OTHER_A:
        outside["outside_a"] = fault["b"] - outside["outside_zeta"]
    return fault, outside


@functools.cache
def smallest_width(items):
    return float(weakening_patch_length(**dict(items)))


def told(fault, outside, ratio):
    """The outcome of a patch by its W/W_c."""
    width = ratio * smallest_width(frozenset((fault | outside).items()))
    return patch_answer(Fault(**fault), **outside, width=width)["outcome"]


@pytest.mark.parametrize("row", simulated()[::4])
def test_outcome_by_the_width(row):
    words = patch(row)
    assert told(*words, 0.99) == "it creeps"
    if row.slow_slip_up_to > 1.0:
        assert told(*words, 0.999 * row.slow_slip_up_to) == "slow slip; no event was simulated"
    between = told(*words, 0.5 * (max(1.0, row.slow_slip_up_to) + row.events_from))
    assert between.startswith("slow slip or events: either")
    events = f"events, simulated from {row.events_from:.3g} W_c on"
    assert told(*words, 1.001 * row.events_from) == events


def test_between_simulated_frictions():
    """Slow slip ends at the least width of the neighbours, events begin at the greatest."""
    rows = {(row.varies, row.zeta_over_a, row.strengthening): row for row in simulated()}
    corners = [rows[OTHER_B, z, r] for z in (0.5, 1.0) for r in (0.1, 0.5)]
    slow, events = patch_outcomes.bounds(OTHER_B, 0.7, 0.3)
    assert slow == min(row.slow_slip_up_to for row in corners)
    assert events == max(row.events_from for row in corners)
    alone = rows[OTHER_B, 0.5, 0.5]
    exact = alone.slow_slip_up_to, alone.events_from
    assert patch_outcomes.bounds(OTHER_B, 0.5, 0.5) == exact
    assert patch_outcomes.bounds(OTHER_B, 0.5 * (1.0 + 1e-12), 0.5) == exact


@pytest.mark.parametrize("varies", [OTHER_A, OTHER_B])
def test_nothing_is_promised_beyond_the_simulated_frictions(varies):
    rows = [row for row in simulated() if row.varies == varies]
    weak = min(row.zeta_over_a for row in rows)
    strong = max(row.zeta_over_a for row in rows)
    for ratio, factor in ((weak, 0.99), (strong, 1.01)):
        own = [row for row in rows if row.zeta_over_a == ratio]
        for row in own:
            assert patch_outcomes.bounds(varies, factor * ratio, row.strengthening) is None
        r = [row.strengthening for row in own]
        for outside in (0.99 * min(r), 1.01 * max(r)):
            assert patch_outcomes.bounds(varies, ratio, outside) is None
        fault, around = patch(own[0]._replace(zeta_over_a=factor * ratio))
        assert told(fault, around, 2.0) == "slow slip or events: such friction was not tried"
    assert patch_outcomes.bounds("b", 1.0, 1.0) is None


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"plane": "stress"}, "plane stress"),
        ({"second_shear_modulus": 60e9}, "a fault between different bodies"),
        ({"zone_thickness": 1.0, "zone_shear_modulus": 20e9}, "a fault between different bodies"),
        ({"height": 1.0}, "a body lower than 2.6 W"),
        ({"evolution": "slip"}, "the slip law"),
        ({"velocity": 1e-3}, "2 a sigma0 c_s/(mu V) = 1.7e+02, outside 7e+02 to 1.4e+08,"),
        ({"velocity": 1e-10}, "2 a sigma0 c_s/(mu V) = 1.7e+09, outside 7e+02 to 1.4e+08,"),
    ],
)
def test_nothing_is_promised_of_other_faults(changed, words):
    fault, around = patch(simulated()[0], **changed)
    assert told(fault, around, 0.9) == "it creeps"
    assert told(fault, around, 2.0) == f"slow slip or events: {words} was not tried"


def test_without_a_velocity_it_is_asked_for():
    """Which of both it is depends on V; creep below W_c does not."""
    row = simulated()[0]
    fault, around = patch(row, velocity=None)
    for ratio in (1.05, 0.5 * (1.0 + row.events_from), 2.0):
        assert told(fault, around, ratio) == BY_VELOCITY
    assert told(fault, around, 0.9) == "it creeps"


def test_natural_faults_at_plate_rates_were_tried():
    """With 2700 kg/m^3, and W over the height just as in the simulations."""
    row = simulated()[0]
    fault, around = patch(row, velocity=1e-9, density=2700.0)
    smallest = float(weakening_patch_length(**around, **fault))
    high = fault | {"height": 2.61 * 1.7 * smallest}
    for own in (fault, high):
        assert told(own, around, 1.69).startswith("events")


def test_weak_patch_of_the_report():
    """Slow slip was simulated at 1.41 W_c without inertia, too, an event at 1.8."""
    fault = {
        "shear_modulus": 3.1e9,
        "a": 0.0068,
        "zeta": 0.00136,
        "slip_distance": 5e-7,
        "normal_stress": 1e6,
        "plane": "antiplane",
        "velocity": 1e-5,
        "density": 1200.0,
    }
    found = patch_answer(Fault(**fault), -0.00136, width=3.6)
    assert found["width_ratio"] == pytest.approx(1.41, abs=0.01)
    assert found["outcome"].startswith("slow slip")


def test_no_width_nucleates():
    strengthening = patch_answer(Fault(**ROCK | {"b": 0.008}), -0.005, width=1.0)
    unstable = patch_answer(Fault(**ROCK), 0.001, width=1.0)
    for answer in (strengthening, unstable):
        assert math.isnan(answer["smallest_width"])
        assert answer["outcome"] == NO_WIDTH
    assert patch_answer(Fault(**ROCK), -0.005)["outcome"] == ""
