"""What a scheme promises: its rungs and steps belong together, and its formulas are exact."""

import numpy as np
import pytest

from nucleation.simulation.stepping import (
    BDF,
    LARGEST_GROWTH,
    LARGEST_GROWTH_OF_BDF3,
    Formula,
    rung_value,
)

TIMES = np.array([1.0, 0.6, 0.35])  # s


@pytest.mark.parametrize("rung", [-40, -9, -3])
def test_the_coefficient_of_a_step_is_that_of_its_rung(rung):
    step = BDF().step(rung, TIMES)
    assert BDF().coefficient(step.length, 0.4) == pytest.approx(rung_value(rung), rel=1e-12)


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
        found = formula.from_past(past**power) + formula.beta * power * new ** (power - 1)
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
        return Formula.bdf2(BDF().coefficient(growth, 1.0), 1.0)

    def bdf3(growth):
        return Formula.bdf3(growth, -np.cumsum([0.0, 1.0, 1.0 / growth]))

    for formula, growth in ((bdf2, LARGEST_GROWTH), (bdf3, LARGEST_GROWTH_OF_BDF3)):
        assert growth > 1.2
        assert amplification(formula(growth)) == pytest.approx(1.0, abs=1e-9)
        assert amplification(formula(2.0 * growth)) > 1.2
