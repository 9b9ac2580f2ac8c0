"""Lengths at the ends of the allowed ranges: answered, with ranges around them, or refused."""

import math
import warnings

import numpy as np
import pytest
from asked import ROCK

from nucleation.api import Fault, ParameterError
from nucleation.theory.roots import roots
from nucleation.theory.status import BEYOND, UNKNOWN

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


WINDOW = {
    "shear_modulus": 0.0718,
    "poisson_ratio": -0.9999,
    "normal_stress": 7016.0,
    "a": 0.00762,
    "zeta": -3.5718e-10,
    "slip_distance": 6.4328e-8,
    "friction": 0.6,
    "velocity": 1e-6,
    "far_side": "velocity",
    "second_shear_modulus": 7.3626,
    "second_poisson_ratio": -0.978,
    "second_height": 1.06e-9,
}


@pytest.mark.parametrize("height", [1.0, 1e30, 1e203, 1e308, math.inf])
def test_a_window_of_growth_beside_a_high_body_is_found(height):
    """The high body's long waves took all points of the search: it was stable."""
    fault = Fault(**WINDOW, height=height)
    k = float(fault.critical_mode().wavenumber)
    assert k == pytest.approx(1.75e9, rel=0.01)
    below, above = fault.spectrum(k * np.array([0.999, 1.001])).real.max(axis=0)
    assert below > 0.0 > above


def test_alike_bodies_have_no_coupling_by_round_off():
    """The same zones before unlike bodies: a strengthening fault was unstable by 1e-17."""
    fault = Fault(
        shear_modulus=0.00941,
        poisson_ratio=0.2,
        normal_stress=7e7,
        a=5e-5,
        zeta=-1e-300,
        slip_distance=8.6e-10,
        friction=0.6,
        height=1.9e-11,
        second_shear_modulus=1.6e-5,
        second_poisson_ratio=-0.03,
        second_height=1e245,
        zone_thickness=math.inf,
        zone_shear_modulus=1.04e-8,
        zone_poisson_ratio=np.linspace(-0.9, 0.49, 50),
    )
    assert np.isnan(fault.critical_length()).all()


@pytest.mark.parametrize("loading", ["edge", "remote"])
@pytest.mark.parametrize("ratio", [1e-60, 1e-30, 1e-11])
def test_a_growth_that_round_off_hides_has_no_length(ratio, loading):
    """L_s was 1e-36 L_c, or a ValueError; L_c is known."""
    rock = {k: v for k, v in ROCK.items() if k != "b"}
    found = Fault(**rock, zeta=0.01 * ratio, height=1e100, loading=loading).lengths("none")
    assert found["critical_length"].exists
    answer = found["stability_length"]
    assert answer.status == UNKNOWN and "round-off hides the growth" in answer.reason


@pytest.mark.parametrize("zeta", [1e-302, 5e-324])
def test_a_layer_that_weakens_is_not_stable_at_waves_too_long_to_compute(zeta):
    """It was called stable."""
    rock = {k: v for k, v in ROCK.items() if k != "b"}
    fault = Fault(**rock, zeta=zeta, height=1.0, second_height=1e203, friction=0.6)
    answer = fault.lengths("none")["critical_length"]
    assert answer.status == BEYOND and "longer than any" in answer.reason


@pytest.mark.parametrize("scale", [1e-300, 1.0, 1e300])
def test_a_root_does_not_depend_on_the_size_of_the_function(scale):
    """Products of numbers below 1e-162 vanish, and the root was infinite."""
    (found,) = roots(lambda x, _: scale * (x**3 - 2.0), np.array([0.0]), np.array([9.0]), 1e-15)
    assert found == pytest.approx(2.0 ** (1.0 / 3.0), rel=1e-14)


def test_a_coupling_that_makes_all_patches_grow_has_no_length():
    """The search went on to patches of no length, whose equations have no finite numbers."""
    fault = Fault(
        shear_modulus=1.1432e9,
        poisson_ratio=0.0,
        normal_stress=1.8544e-4,
        a=1.373e-4,
        b=0.05825,
        slip_distance=2.786e-13,
        plane="stress",
        loading="remote",
        friction=9.104,
        second_shear_modulus=4.0956e9,
        second_poisson_ratio=-0.9949,
    )
    answer = fault.lengths("none")["stability_length"]
    assert answer.status == UNKNOWN and "all patches down to" in answer.reason


@pytest.mark.parametrize("k", [0.0, math.nan, math.inf, -1e-31, [1.0, 1e31]])
@pytest.mark.parametrize("name", ["spectrum", "transfer_functions"])
def test_a_wavenumber_beyond_its_range_is_refused(name, k):
    """The answer was not a number."""
    with pytest.raises(ParameterError, match=r"wavenumber.*\[1e-30, 1e\+30\] 1/m"):
        getattr(Fault(**ROCK, velocity=1e-6), name)(k)


def anywhere(random):
    """A fault with all numbers anywhere in their allowed ranges, or near each other."""

    def log_uniform(low, high):
        return float(10.0 ** random.uniform(math.log10(low), math.log10(high)))

    def one_of(*values):
        return values[random.integers(len(values))]

    least = one_of(1e-12, 1e-12, 1e-12, 1e-300)
    fault = {
        "shear_modulus": log_uniform(1e-9, 9.9e12),
        "poisson_ratio": one_of(random.uniform(-0.999, 0.4999), -0.9999, 0.499999, 0.0),
        "normal_stress": log_uniform(1e-6, 9.9e12),
        "a": log_uniform(1e-12, 9.9),
        "zeta": one_of(-1.0, 1.0, 1.0) * log_uniform(least, 9.9),
        "slip_distance": log_uniform(1e-15, 9.9e2),
        "velocity": log_uniform(1e-30, 9.9e2),
        "friction": one_of(0.0, 0.6, log_uniform(1e-12, 9.9)),
        "plane": one_of("strain", "stress", "antiplane"),
        "loading": one_of("edge", "remote"),
        "evolution": one_of("aging", "slip"),
    }
    near = fault["shear_modulus"] * fault["slip_distance"] / fault["normal_stress"] / fault["a"]

    def height():
        return one_of(
            math.inf, log_uniform(1e-12, 1e308), max(1e-12, near * log_uniform(1e-6, 1e6))
        )

    sides = ["free", "velocity", "clamped", "roller"][: 3 if fault["plane"] == "antiplane" else 4]
    fault |= {"height": height(), "far_side": one_of(*sides), "second_far_side": one_of(*sides)}
    if random.random() < 0.5:
        fault["second_shear_modulus"] = one_of(math.inf, log_uniform(1e-9, 1e308))
        fault["second_poisson_ratio"] = random.uniform(-0.999, 0.4999)
        fault["second_height"] = height()
    if random.random() < 0.25:
        fault["zone_thickness"] = height()
        fault["zone_shear_modulus"] = log_uniform(1e-9, 9.9e12)
        fault["zone_poisson_ratio"] = random.uniform(-0.999, 0.4999)
    return fault


QUICK = [*range(20), *(pytest.param(n, marks=pytest.mark.slow) for n in range(20, 120))]


@pytest.mark.parametrize("seed", QUICK)
def test_all_that_is_allowed_is_answered_or_refused(seed):
    """No other exception, no warning, each range around its value, no growth above k_c."""
    random = np.random.default_rng(seed)
    given = anywhere(random)
    k = float(random.choice([-1, 1]) * 10.0 ** random.uniform(-30.0, 30.0))
    with warnings.catch_warnings():
        warnings.simplefilter("error", RuntimeWarning)
        warnings.simplefilter("ignore", UserWarning)
        try:
            fault = Fault(**given)
        except ParameterError:  # b is not in its range
            return
        found = fault.lengths("none")
        mode = fault.critical_mode()
        assert np.isfinite(fault.transfer_functions(k)).all()
        assert np.isfinite(fault.spectrum(k)).all()
    for key, answer in (*found.items(), *found.literature.items()):
        assert answer.exists == (answer.reason == ""), key
        assert not answer.exists or 0.0 < answer.low <= answer.value <= answer.high, key
    critical = found["critical_length"]
    assert (critical.status == BEYOND) == math.isinf(mode.length)
    if not math.isinf(mode.length):
        assert critical.value == pytest.approx(float(mode.length), nan_ok=True)
    stable_beyond = float(mode.wavenumber)
    if not stable_beyond > 0.0:
        stable_beyond = 1e-30
    waves = stable_beyond * 1.0001 * np.geomspace(1.0, 1e60, 400)
    waves = waves[(waves > 1e-30) & (waves < 1e30)]
    growth = fault.spectrum(waves).real.max(axis=0) * given["slip_distance"] / given["velocity"]
    assert (growth < 1e-9).all()


@pytest.mark.parametrize("seed", range(20))
def test_lengths_scale_with_the_elastic_length(seed):
    """By a power of two, which changes no digit: exactly."""
    given = anywhere(np.random.default_rng(seed))
    scaled = dict(given)
    for name in ("slip_distance", "height", "second_height", "zone_thickness"):
        if name in given:
            scaled[name] = 4.0 * given[name]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            found, larger = Fault(**given).lengths("none"), Fault(**scaled).lengths("none")
        except ParameterError:
            return
    for key, answer in found.items():
        np.testing.assert_allclose(larger[key].value, 4.0 * answer.value, rtol=1e-14)
        assert larger[key].status == answer.status
