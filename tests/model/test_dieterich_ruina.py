"""The regularised Dieterich-Ruina law against its formula and the logarithmic law."""

import math

import numpy as np
import pytest

from nucleation.model.friction import Friction
from nucleation.model.friction.constants import full_law
from nucleation.model.quantities import ParameterError

V = 1e-5


def law(**values):
    return Friction(law="dieterich_ruina", **values)


def test_coefficient_is_the_formula():
    """With values of the SEAS benchmarks, typed in once more."""
    friction = law(
        reference_friction=0.6, reference_slip_rate=1e-6, log_rate_coefficient=0.010,
        log_state_coefficient=0.015, slip_distance=0.008,
    )  # fmt: skip
    v, phi = np.meshgrid(np.geomspace(1e-16, 10.0, 9), np.geomspace(1e-3, 1e9, 7))
    exponent = (0.6 + 0.015 * np.log(1e-6 * phi / 0.008)) / 0.010
    expected = 0.010 * np.arcsinh(v / 2e-6 * np.exp(exponent))
    np.testing.assert_allclose(friction.coefficient(v, phi), expected, rtol=1e-12)


def test_its_usual_values_are_the_main_texts():
    assert law().expansion(V) == pytest.approx((0.41, 0.0068, 0.016), rel=1e-7)


def test_expansion_where_the_state_is_regularised():
    """``zeta = b (V/w)^2 - a``: below v0 the state of steady sliding no longer depends on V."""
    friction = law(regularisation_slip_rate=V)
    f, a, zeta = friction.expansion(V)
    assert a == pytest.approx(0.0068) and zeta == pytest.approx(0.0228 / 2 - 0.0068)
    assert f == pytest.approx(0.41 - 0.0228 / 2 * math.log(2.0))
    again = full_law(friction, V, f, a, zeta)
    assert again.log_state_coefficient == pytest.approx(0.0228)


def test_constants_of_a_law_that_is_hardly_logarithmic():
    """For f = 3 a the hyperbolic tangent counts: a is not the law's own coefficient."""
    friction = full_law(law(), V, 0.03, 0.01, 0.002)
    assert friction.expansion(V) == pytest.approx((0.03, 0.01, 0.002), rel=1e-9)
    assert friction.log_rate_coefficient > 0.01 * 1.003


def test_what_no_double_can_hold_is_refused():
    with pytest.raises(ParameterError, match=r"log_rate_coefficient = 1e-07 .* 4.1e-07 or more"):
        law(log_rate_coefficient=1e-7)


@pytest.mark.parametrize("a", [1e-3, 1e-5])
def test_a_small_direct_effect_has_the_logarithm(a):
    """exp(f/a) overflows; a below f/300 was refused."""
    small = law(log_rate_coefficient=a)
    v, psi = np.array([-2e-5, 0.0, 1e-7, 2e-5]), np.log(3.0)
    f, by_rate, by_log_state = small.coefficient_and_slopes(v, psi)
    constants = small.reference_friction, small.reference_slip_rate, small.log_state_coefficient
    f0, rate, b = constants
    state = b * (psi + np.log(rate / small.slip_distance))
    expected = f0 + a * np.log(np.abs(v[[0, 2, 3]]) / rate) + state
    assert np.abs(f[[0, 2, 3]]) == pytest.approx(expected, rel=1e-12)
    assert f[0] == -f[3] and f[1] == 0.0
    assert by_rate[2] == pytest.approx(a / v[2], rel=1e-12)
    assert by_log_state[3] == pytest.approx(b)


def test_extreme_states_stay_finite():
    v = np.array([-1.0, -1e-300, 0.0, 1e-300, 1e-9, 1e3])
    for log_state in (-300.0, 0.0, 300.0):
        for values in law().coefficient_and_slopes(v, log_state):
            assert np.isfinite(values).all()
