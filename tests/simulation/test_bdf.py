"""The step formulas for any steps: exact for polynomials of their order, and their error."""

from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nucleation.simulation.stepping import (
    BDF,
    LARGEST_GROWTH,
    LARGEST_GROWTH_OF_BDF3,
    RUNGS_PER_OCTAVE,
    Formula,
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
    formula = Formula.bdf2(BDF().coefficient(ratio * previous, previous), previous)
    y, rate = polynomial(c, 2, previous)
    assert formula.step == pytest.approx(ratio * previous, rel=1e-9)
    found = formula.from_past(y(past_times(previous))) + formula.beta * rate(formula.step)
    assert found == pytest.approx(y(formula.step), rel=1e-9, abs=1e-9)


@given(steps, gentle, gentle, gentle, coefficients)
def test_bdf3_is_exact_for_cubics(previous, ratio, growth, earlier, c):
    past = past_times(previous, growth)
    formula = Formula.bdf3(ratio * previous, past)
    y, rate = polynomial(c, 3, previous)
    found = formula.from_past(y(past)) + formula.beta * rate(formula.step)
    scale = np.abs(y(past)).max() + abs(y(formula.step))
    assert found == pytest.approx(y(formula.step), rel=1e-8, abs=1e-8 * scale)


@given(steps, ratios, ratios, coefficients)
def test_extrapolation_is_exact_for_quadratics_and_the_error_is_that_of_a_cubic(
    previous, ratio, growth, c
):
    past = past_times(previous, growth)
    formula = Formula.bdf2(BDF().coefficient(ratio * previous, previous), previous)
    weights = extrapolation_weights(formula.step, past)
    y, _ = polynomial(c, 2, previous)
    scale = 1e-9 * (np.abs(weights) @ np.abs(y(past)) + 1.0)
    assert weights @ y(past) == pytest.approx(y(formula.step), abs=scale)
    y, rate = polynomial([0.0, 0.0, 0.0, 1.0], 3, previous)
    stepped = formula.from_past(y(past)) + formula.beta * rate(formula.step)
    estimate = error_factor(formula, past) * abs(stepped - weights @ y(past))
    error = abs(y(formula.step) - stepped)
    assert estimate == pytest.approx(error, rel=1e-6, abs=1e-12 * np.abs(weights).max())


@given(st.floats(1e-12, 1e6))
def test_a_rung_is_below_and_near(beta):
    rung = rung_below(beta)
    assert rung_value(rung) <= beta * (1 + 1e-8) <= rung_value(rung + 1) * (1 + 1e-8)
    assert np.log2(beta / rung_value(rung)) <= (1.0 + 1e-8) / RUNGS_PER_OCTAVE
    assert rung_below(rung_value(rung)) == rung


def test_second_order_on_an_oscillator_with_changing_steps():
    """Global error of y' = i y falls as the square of the step, growing and shrinking steps."""

    def error(n):
        steps = (1.0 + 0.5 * np.sin(np.arange(n) * 2 * np.pi * 3 / n)) / n
        y = [1.0 + 0j, np.exp(1j * steps[0])]  # exact start
        for previous, h in pairwise(steps):
            f = Formula.bdf2(BDF().coefficient(h, previous), previous)
            y.append(f.from_past(np.array(y[:-3:-1])) / (1 - 1j * f.beta))
        return abs(y[-1] - np.exp(1j * steps.sum()))

    assert np.log2(error(100) / error(200)) == pytest.approx(2.0, abs=0.1)
