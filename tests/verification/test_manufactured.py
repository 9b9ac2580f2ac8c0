"""Manufactured solutions of one block: orders in h and in dt, and fields that are solved exactly.

With the displacement of the interface prescribed (elastodynamics: the body, its inertia, its loads
and the time stepping), and with friction of either law, its state variable and the computed normal
stress solved together by the solver's own steps (benchmarks.manufactured.orders has the fields).
"""

import numpy as np
import pytest

from benchmarks.manufactured import orders as measured
from benchmarks.manufactured.orders import ERRORS, SCALE, manufactured, orders

pytestmark = pytest.mark.slow

LAWS = ("aging", "slip")
# errors of displacement, slip rate and log(phi) with the finest mesh and the shortest step
BOUNDS = {
    ("elastodynamics", "mesh"): (1.2e-4,),
    ("elastodynamics", "step"): (5e-5,),
    ("aging", "mesh"): (5e-4, 5e-4, 2e-4),
    ("slip", "mesh"): (7e-4, 1.4e-3, 5e-4),
    ("aging", "step"): (8e-5, 3.3e-5, 1.2e-5),
    ("slip", "step"): (8e-5, 3.3e-5, 1.2e-5),
    ("aging", "quasi_static_step"): (8e-7, 3.3e-6, 1.2e-6),
    ("slip", "quasi_static_step"): (2.2e-7, 3e-6, 9e-7),
}
ORDER = {"mesh": 2.0, "step": 2.0, "quasi_static_step": 3.0}


@pytest.mark.parametrize(("problem", "refinement"), BOUNDS)
def test_order(convergence, problem, refinement):
    own = convergence[convergence.problem.eq(problem) & convergence.refinement.eq(refinement)]
    for name, bound in zip(ERRORS, BOUNDS[problem, refinement], strict=False):
        found = own[name].to_numpy()
        np.testing.assert_allclose(orders(found)[1:], ORDER[refinement], rtol=0.05)
        assert found[-1] < bound


@pytest.mark.parametrize("law", LAWS)
def test_second_order_with_steps_that_change(law):
    """Steps that grow and shrink along the ladder, by the same pattern at every level."""
    found = measured.step_errors(law, pattern=(0, 1, 2, 1, -1))
    np.testing.assert_allclose(orders(found)[1:], 2.0, atol=0.1)
    assert (found[-1] < 1.5e-4).all()


@pytest.mark.parametrize("name", ["elastodynamics", *LAWS])
def test_exact_for_bilinear_fields_quadratic_in_time(name):
    """Only round-off is left; the reactions are the exact tractions, friction's and the applied."""
    problem = manufactured(name, "exact", rows=5)
    state, report = problem.run(*[-56] * 10)
    loads, interface = problem.loads, report.interface
    assert problem.displacement_error(state) < 1e-11 * SCALE
    # quadrature of the body force belongs to the balance, not to the reactions
    shear, normal = (-loads.along_x @ stress for stress in loads.interface_stress(state.time))
    if name in LAWS:
        assert problem.slip_rate_error(state) < 1e-11 * problem.velocity
        assert problem.log_state_error(state) < 1e-11
        shear -= problem.applied_force(state.time)
        coefficient = problem.friction_coefficient(problem.grid.x, state.time)
        np.testing.assert_allclose(
            interface.tangential, -coefficient * interface.normal, rtol=1e-10
        )
    for found, expected in ((interface.tangential[1:], shear[1:]), (interface.normal, normal)):
        assert np.abs(found - expected).max() < 1e-10 * np.abs(expected).max()
