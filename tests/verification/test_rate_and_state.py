"""Manufactured rate-and-state friction with inertia: the orders in h and in dt, for both laws.

Friction with its state variable, the computed normal stress and the elastic body are solved
together by the solver's own steps; source, traction and body force make chosen fields their
solution (nucleation.verification.manufactured.dynamics).
"""

import numpy as np
import pytest

from nucleation.verification.manufactured import dynamics
from nucleation.verification.orders import (
    ERRORS,
    errors,
    manufactured,
    orders,
    step_errors,
)

pytestmark = pytest.mark.slow

LAWS = ("aging", "slip")
# errors of displacement, slip rate and log(phi) with the finest mesh and the shortest step
BOUNDS = {
    ("aging", "mesh"): (5e-4, 5e-4, 2e-4),
    ("slip", "mesh"): (7e-4, 1.4e-3, 5e-4),
    ("aging", "step"): (8e-5, 3.3e-5, 1.2e-5),
    ("slip", "step"): (8e-5, 3.3e-5, 1.2e-5),
    ("aging", "quasi_static_step"): (8e-7, 3.3e-6, 1.2e-6),
    ("slip", "quasi_static_step"): (2.2e-7, 3e-6, 9e-7),
}
ORDER = {"mesh": 2.0, "step": 2.0, "quasi_static_step": 3.0}


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("refinement", ORDER)
def test_order(convergence, law, refinement):
    for name, bound in zip(ERRORS, BOUNDS[law, refinement], strict=True):
        found = convergence[name].sel(problem=law, refinement=refinement).values
        np.testing.assert_allclose(orders(found)[1:], ORDER[refinement], rtol=0.05)
        assert found[-1] < bound


@pytest.mark.parametrize("law", LAWS)
def test_second_order_with_steps_that_change(law):
    """Steps that grow and shrink along the ladder, by the same pattern at every level."""
    found = step_errors(law, pattern=(0, 1, 2, 1, -1))
    np.testing.assert_allclose(orders(found)[1:], 2.0, atol=0.1)
    assert (found[-1] < 1.5e-4).all()


@pytest.mark.parametrize("law", LAWS)
def test_exact_for_bilinear_fields_quadratic_in_time(law):
    """Only round-off is left; the reactions are the exact tractions, friction's and the applied."""
    found = errors(manufactured(law, "exact", rows=5), [-56] * 10)
    assert max(found) < 1e-11
    problem = manufactured(law, "exact", rows=5)
    state, report = problem.run(*[-56] * 10)
    loads, interface = problem.loads, report.interface
    shear, normal = (-loads.along_x @ stress for stress in loads.interface_stress(state.time))
    applied = problem.applied_force(state.time)
    np.testing.assert_allclose(interface.normal, normal, rtol=1e-10)
    np.testing.assert_allclose(
        interface.tangential[1:],
        (shear - applied)[1:],
        rtol=0.0,
        atol=1e-10 * np.abs(applied).max(),
    )
    coefficient = problem.friction_coefficient(problem.grid.x, state.time)
    np.testing.assert_allclose(interface.tangential, -coefficient * interface.normal, rtol=1e-10)


@pytest.mark.parametrize("law", LAWS)
def test_every_part_counts(law, monkeypatch):
    """Without the source, or with the other law's, the fields are no solution any more."""
    other = dict(zip(LAWS, LAWS[::-1], strict=True))[law]
    wrong = manufactured(other, "exact", rows=5).source
    for source in (lambda self, time: 0.0 * wrong(time), lambda self, time: wrong(time)):
        monkeypatch.setattr(dynamics.ManufacturedFriction, "source", source)
        displacement, slip_rate, log_state = errors(manufactured(law, "exact", 5), [-56] * 10)
        assert log_state > 1e-3
        assert slip_rate > 1e-4
        assert displacement > 1e-4
