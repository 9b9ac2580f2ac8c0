"""The next step's size by the estimated error of the last one."""

import pytest

from nucleation.simulation.run import _step_factor
from nucleation.simulation.stepping import BDF


@pytest.mark.parametrize(("error", "factor"), [(1.0, 0.85), (8.0, 0.85 / 2.0), (0.125, 1.7)])
def test_the_step_follows_the_cube_root_of_the_error_with_a_margin(error, factor):
    """The local error is of third order; `error` is in units of the tolerance."""
    assert _step_factor(error, BDF()) == pytest.approx(factor)


def test_a_step_grows_to_twice_and_shrinks_to_a_fifth_at_most():
    assert _step_factor(0.0, BDF()) == 2.0
    assert _step_factor(1e9, BDF()) == 0.2
    assert _step_factor(float("inf"), BDF()) == 1.0  # no estimate
