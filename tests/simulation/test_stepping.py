"""Formulas of steps: exact for polynomials of their order, their error, stability and control."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nucleation.simulation.run import _step_factor
from nucleation.simulation.stepping import (
    BDF,
    LARGEST_GROWTH,
    LARGEST_GROWTH_OF_BDF3,
    RUNGS_PER_OCTAVE,
    _Formula,
    error_factor,
    extrapolation_weights,
    rung_below,
    rung_value,
)

steps = st.floats(-9.0, 2.0).map(lambda exponent: 10.0**exponent)  # s
ratios = st.floats(0.05, LARGEST_GROWTH)
gentle = st.floats(0.2, LARGEST_GROWTH_OF_BDF3)
coefficients = st.lists(st.floats(-1.0, 1.0), min_size=4, max_size=4)


def polynomial(coefficients, degree, scale):
    """Of order one over times of some length, and its derivative."""
    values = np.polynomial.Polynomial(np.array(coefficients[: degree + 1]), [0, scale], [0, 1])
    return values, values.deriv()


def past_times(previous, *growths):
    """Now (zero) and before, newest first, each step so many times the one before it."""
    lengths = previous / np.cumprod([1.0, *growths])
    return -np.cumsum([0.0, *lengths])


@given(steps, ratios, coefficients)
def test_bdf2_is_exact_for_quadratics(previous, ratio, c):
    formula = _Formula.bdf2(BDF().leading_coefficient(ratio * previous, previous), previous)
    y, rate = polynomial(c, 2, previous)
    assert formula.step == pytest.approx(ratio * previous, rel=1e-9)
    found = formula.past @ y(past_times(previous)) + formula.beta * rate(formula.step)
    assert found == pytest.approx(y(formula.step), rel=1e-9, abs=1e-9)


@given(steps, gentle, gentle, gentle, coefficients)
def test_bdf3_is_exact_for_cubics(previous, ratio, growth, earlier, c):
    past = past_times(previous, growth)
    formula = _Formula.bdf3(ratio * previous, past)
    y, rate = polynomial(c, 3, previous)
    found = formula.past @ y(past)[: len(formula.past)] + formula.beta * rate(formula.step)
    scale = np.abs(y(past)).max() + abs(y(formula.step))
    assert found == pytest.approx(y(formula.step), rel=1e-8, abs=1e-8 * scale)


@given(steps, ratios, ratios, coefficients)
def test_extrapolation_is_exact_for_quadratics_and_has_the_error_of_a_cubic(
    previous, ratio, growth, c
):
    past = past_times(previous, growth)
    formula = _Formula.bdf2(BDF().leading_coefficient(ratio * previous, previous), previous)
    weights = extrapolation_weights(formula.step, past)
    y, _ = polynomial(c, 2, previous)
    scale = 1e-9 * (np.abs(weights) @ np.abs(y(past)) + 1.0)
    assert weights @ y(past) == pytest.approx(y(formula.step), abs=scale)
    y, rate = polynomial([0.0, 0.0, 0.0, 1.0], 3, previous)
    stepped = formula.past @ y(past)[: len(formula.past)] + formula.beta * rate(formula.step)
    estimate = error_factor(formula, past) * abs(stepped - weights @ y(past))
    error = abs(y(formula.step) - stepped)
    assert estimate == pytest.approx(error, rel=1e-6, abs=1e-12 * np.abs(weights).max())


@given(st.floats(1e-12, 1e6))
def test_a_rung_is_below_and_near(beta):
    rung = rung_below(beta)
    assert rung_value(rung) <= beta * (1 + 1e-8) <= rung_value(rung + 1) * (1 + 1e-8)
    assert np.log2(beta / rung_value(rung)) <= (1.0 + 1e-8) / RUNGS_PER_OCTAVE
    assert rung_below(rung_value(rung)) == rung


TIMES = np.array([1.0, 0.6, 0.35])  # s


@pytest.mark.parametrize("step", [1e-6, 0.005, 3.0])
def test_steady_steps_stay_on_their_rung(step):
    scheme = BDF()
    rung = scheme.steady_rung(step)
    steady = scheme.steady_step(rung)
    assert steady <= step * (1 + 1e-9) < scheme.steady_step(rung + 1) * (1 + 1e-9)
    past = -steady * np.arange(3)
    assert scheme.step(rung, past).length == pytest.approx(steady, rel=1e-12)


def test_slip_and_state_are_of_third_order_where_waves_are_not_resolved():
    """A polynomial of the scheme's order is followed exactly, in the values and in the guess."""
    past = np.array([0.0, -0.1, -0.2])
    rung = BDF().steady_rung(0.1)
    length = BDF().step(rung, past).length
    for crossings, power in ((np.inf, 3), (11.0, 3), (9.0, 2), (1e-9, 2)):
        step = BDF(length / crossings).step(rung, past)
        new, formula = step.length, step.interface
        past_part = formula.past @ past[: len(formula.past)] ** power
        found = past_part + formula.beta * power * new ** (power - 1)
        assert found == pytest.approx(new**power, rel=1e-12)
        assert len(formula.past) == power
        assert len(step.body.past) == BDF.levels == 2
        assert step.extrapolation @ past**2 == pytest.approx(new**2, rel=1e-12)


def test_the_first_steps_have_no_estimate():
    first, second, third = (BDF().step(-20, TIMES[-n:]) for n in (1, 2, 3))
    assert (first.error(0.0), second.error(0.3)) == (np.inf, 0.0)
    assert 0.0 < third.error(1.0) < 1.0
    assert (first.first, second.first, third.first) == (True, False, False)


def amplification(formula):
    """Largest factor by which errors grow in a step of y' = 0."""
    companion = np.eye(len(formula.past), k=-1)
    companion[0] = formula.past
    return np.abs(np.linalg.eigvals(companion)).max()


def test_the_largest_growth_of_steps_is_stable_and_twice_as_much_is_not():
    """Of steps that grow again and again by the same factor; shorter ones never grow."""

    def bdf2(growth):
        return _Formula.bdf2(BDF().leading_coefficient(growth, 1.0), 1.0)

    def bdf3(growth):
        return _Formula.bdf3(growth, -np.cumsum([0.0, 1.0, 1.0 / growth]))

    for formula, growth in ((bdf2, LARGEST_GROWTH), (bdf3, LARGEST_GROWTH_OF_BDF3)):
        assert growth > 1.2
        assert amplification(formula(growth)) == pytest.approx(1.0, abs=1e-9)
        assert amplification(formula(2.0 * growth)) > 1.2


@pytest.mark.parametrize(
    ("error", "factor"),
    [(1.0, 0.85), (8.0, 0.85 / 2.0), (0.125, 1.7), (0.0, 2.0), (1e9, 0.2), (np.inf, 1.0)],
)
def test_the_step_follows_the_cube_root_of_the_error_with_a_margin(error, factor):
    """To twice and to a fifth at most; the error is infinite without an estimate."""
    assert _step_factor(error, BDF()) == pytest.approx(factor)
