"""Lengths at the ends of the allowed ranges: answered, with ranges around them, or refused."""

import math
import warnings

import numpy as np
import pytest
from asked import ROCK

from nucleation.api import Fault, ParameterError
from nucleation.theory.status import BEYOND

ZONE_BESIDE_A_THIN_BODY = {
    "shear_modulus": 1006239413.9,
    "poisson_ratio": 0.49,
    "normal_stress": 3456626.0,
    "a": 0.002995,
    "slip_distance": 1.8976e-4,
    "b": 0.014657,
    "friction": 0.6,
    "height": 0.11955,
    "second_height": 0.01126,
    "zone_thickness": 0.00656,
    "zone_shear_modulus": 4.276e9,
}


def test_a_zone_beside_a_thin_body_has_a_stability_length():
    """The zone's replacement made the body slimmer than any table: ValueError."""
    length = Fault(**ZONE_BESIDE_A_THIN_BODY).stability_length()
    assert 0.0 < length < ZONE_BESIDE_A_THIN_BODY["height"] * 30.0
    without = {k: v for k, v in ZONE_BESIDE_A_THIN_BODY.items() if not k.startswith("zone")}
    assert length > Fault(**without).stability_length(), "the zone is stiffer than the bodies"


@pytest.mark.parametrize("height", [1e6, 1e100, 1e308, math.inf])
def test_a_high_body_is_a_half_space(height):
    """It was stable, at 1e308 m."""
    fault = Fault(**ROCK, height=height)
    assert fault.critical_length() == pytest.approx(Fault(**ROCK).critical_length(), rel=1e-12)
    assert fault.stability_length() == pytest.approx(Fault(**ROCK).stability_length(), rel=1e-6)


@pytest.mark.parametrize("modulus", [1e28, 1e200, 1e308])
def test_a_stiff_body_is_rigid(modulus):
    """It was stable, at 1e200 Pa."""
    stiff, rigid = (
        Fault(**ROCK, friction=0.6, second_shear_modulus=x, height=[1.0, math.inf])
        for x in (modulus, math.inf)
    )
    np.testing.assert_allclose(stiff.critical_length(), rigid.critical_length(), rtol=1e-12)
    np.testing.assert_allclose(stiff.stability_length(), rigid.stability_length(), rtol=1e-9)


def test_the_range_of_the_stability_length_is_around_it_for_any_weakening():
    """At zeta/a of 1e7 the lower end was above the value."""
    fault = Fault(**{**ROCK, "a": np.array([1e-9, 1e-6, 1e-3]), "b": 1e-2})
    found = fault.lengths("none")["stability_length"]
    assert (found.low <= found.value).all() and (found.value <= found.high).all()
    assert (found.high < 1.01 * found.low).all()


def test_a_length_beyond_the_largest_number_is_none():
    rock = {k: v for k, v in ROCK.items() if k != "b"}
    found = Fault(**rock, zeta=5e-324).lengths("none")["critical_length"]
    assert math.isnan(found.value) and found.status == BEYOND


def test_no_law_has_no_friction_but_the_lengths_of_sliding_exist():
    """It was a ZeroDivisionError."""
    fault = Fault(**ROCK, friction=0.0, velocity=1e-6)
    assert fault.critical_length() == Fault(**ROCK).critical_length()
    assert "no friction law has f = 0" in fault.lengths()["drop_length"].reason


def anywhere(random):
    """A fault with all numbers anywhere in their allowed ranges."""

    def log_uniform(low, high):
        return float(10.0 ** random.uniform(math.log10(low), math.log10(high)))

    fault = {
        "shear_modulus": log_uniform(1e-9, 9e12),
        "poisson_ratio": float(random.uniform(-0.99, 0.499)),
        "normal_stress": log_uniform(1e-6, 9e12),
        "a": log_uniform(1e-12, 9.0),
        "zeta": float(random.choice([-1, 1, 1])) * log_uniform(1e-12, 9.0),
        "slip_distance": log_uniform(1e-15, 9e2),
        "friction": float(random.choice([0.0, log_uniform(1e-6, 9.0)])),
        "height": float(random.choice([math.inf, log_uniform(1e-12, 1e300)])),
        "plane": str(random.choice(["strain", "stress", "antiplane"])),
        "far_side": str(random.choice(["free", "velocity", "clamped"])),
        "loading": str(random.choice(["edge", "remote"])),
    }
    if random.random() < 0.5:
        fault["second_shear_modulus"] = float(random.choice([math.inf, log_uniform(1e-9, 1e300)]))
        fault["second_poisson_ratio"] = float(random.uniform(-0.99, 0.499))
        fault["second_height"] = float(random.choice([math.inf, log_uniform(1e-12, 1e300)]))
    if random.random() < 0.2:
        fault["zone_thickness"] = log_uniform(1e-12, 1e3)
        fault["zone_shear_modulus"] = log_uniform(1e-9, 9e12)
    return fault


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(40))
def test_all_that_is_allowed_is_answered_or_refused(seed):
    given = anywhere(np.random.default_rng(seed))
    with warnings.catch_warnings(), np.errstate(all="ignore"):
        warnings.simplefilter("ignore")
        try:
            found = Fault(**given).lengths("none")
        except ParameterError:
            return
        for key, answer in (*found.items(), *found.literature.items()):
            assert answer.exists == (answer.reason == ""), key
            assert not answer.exists or 0.0 < answer.low <= answer.value <= answer.high, key
