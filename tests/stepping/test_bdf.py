"""The step formula, its ladder and its error estimate."""

import numpy as np
import pytest

from nucleation.stepping.bdf import Formula, beta_of_step, error_factor, extrapolation_weights
from nucleation.stepping.ladder import rung_below, rung_nearest, rung_value


@pytest.mark.parametrize("ratio", [0.3, 1.0, 1.9])
def test_bdf2_is_exact_for_quadratics(ratio):
    previous = 0.7
    formula = Formula.bdf2(beta_of_step(ratio * previous, previous), previous)
    assert formula.step == pytest.approx(ratio * previous)
    for power in range(3):
        values = [t**power for t in (formula.step, 0.0, -previous)]
        rate = power * formula.step ** max(power - 1, 0)
        assert formula.from_past(np.array(values[1:])) + formula.beta * rate == (
            pytest.approx(values[0])
        )


@pytest.mark.parametrize("steps", [(0.4, 0.4, 0.4), (0.5, 0.4, 0.3), (0.1, 0.4, 0.7)])
def test_bdf3_is_exact_for_cubics(steps):
    past = 13.0 - np.array([0.0, steps[1], steps[1] + steps[2]])
    formula = Formula.bdf3(steps[0], past)
    new = past[0] + steps[0]
    for power in range(4):
        rate = power * new ** max(power - 1, 0)
        assert formula.from_past(past**power) + formula.beta * rate == pytest.approx(new**power)


def test_backward_euler():
    formula = Formula.backward_euler(0.2)
    assert (formula.step, formula.past) == (0.2, (1.0, 0.0))


@pytest.mark.parametrize("beta", [1e-9, 3.3e-4, 0.5, 1.0])
def test_ladder(beta):
    rung = rung_below(beta)
    assert rung_value(rung) <= beta * (1 + 1e-9) < rung_value(rung + 1) * (1 + 1e-9)
    assert rung_below(rung_value(rung)) == rung_nearest(rung_value(rung)) == rung


def test_extrapolation_is_exact_for_quadratics():
    past = np.array([1.0, 0.6, -0.3])
    weights = extrapolation_weights(1.7, past)
    assert weights @ (2 - past + 3 * past**2) == pytest.approx(2 - 1.7 + 3 * 1.7**2)


@pytest.mark.parametrize("ratio", [0.5, 1.0, 1.8])
def test_error_factor_recovers_the_local_error_of_a_cubic(ratio):
    """For y = t^3, the step's own error follows exactly from its distance to the extrapolation."""
    previous, before = 0.4, 0.3
    step = ratio * previous
    formula = Formula.bdf2(beta_of_step(step, previous), previous)
    past = np.array([0.0, -previous, -previous - before])
    stepped = formula.from_past(past**3) + formula.beta * 3 * step**2
    extrapolated = extrapolation_weights(step, past) @ past**3
    estimate = error_factor(formula, past) * abs(stepped - extrapolated)
    assert estimate == pytest.approx(abs(step**3 - stepped), rel=1e-10)


def test_second_order_on_an_oscillator_with_changing_steps():
    """Global error of y' = i y falls as the square of the step, growing and shrinking steps."""

    def error(n):
        previous, t, y = None, [0.0], [1.0 + 0j]
        steps = (1.0 + 0.5 * np.sin(np.arange(n) * 2 * np.pi * 3 / n)) / n
        for h in steps:
            if previous is None:
                y.append(np.exp(1j * h))  # exact start
            else:
                f = Formula.bdf2(beta_of_step(h, previous), previous)
                y.append(f.from_past(np.array(y[:-3:-1])) / (1 - 1j * f.beta))
            t.append(t[-1] + h)
            previous = h
        return abs(y[-1] - np.exp(1j * t[-1]))

    assert np.log2(error(100) / error(200)) == pytest.approx(2.0, abs=0.1)
