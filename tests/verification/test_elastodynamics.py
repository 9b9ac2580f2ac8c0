"""Manufactured elastodynamics: the solver is of second order in h and in dt.

The interface's displacement is prescribed; what is tested is the body, its inertia, its loads and
the time stepping (nucleation.verification.orders has the fields).
"""

import numpy as np
import pytest

from nucleation.verification.orders import SCALE, manufactured, mesh_errors, orders

pytestmark = pytest.mark.slow


@pytest.mark.parametrize("refinement", ["mesh", "step"])
def test_second_order(convergence, refinement):
    errors = convergence["displacement_error"].sel(problem="elastodynamics", refinement=refinement)
    np.testing.assert_allclose(orders(errors)[1:], 2.0, atol=0.1)
    assert errors[-1] < {"mesh": 1.2e-4, "step": 5e-5}[refinement]


def test_second_order_in_h_on_a_uniform_mesh():
    errors = mesh_errors("elastodynamics", grading=1.0)[:, 0]
    np.testing.assert_allclose(orders(errors)[1:], 2.0, atol=0.1)
    assert errors[-1] < 1.2e-4


def test_exact_for_bilinear_fields_quadratic_in_time():
    """Both at once: nothing is left but round-off, and the reactions are the exact tractions."""
    problem = manufactured("elastodynamics", "exact", rows=5)
    state, report = problem.run(*[-56] * 10)
    loads, interface = problem.loads, report.interface
    assert problem.displacement_error(state) < 1e-10 * SCALE
    # quadrature of the body force belongs to the balance, not to the reactions
    shear, normal = (-loads.along_x @ stress for stress in loads.interface_stress(state.time))
    np.testing.assert_allclose(
        interface.tangential[1:], shear[1:], rtol=0.0, atol=1e-10 * np.abs(shear).max()
    )
    np.testing.assert_allclose(
        interface.normal, normal, rtol=0.0, atol=1e-10 * np.abs(normal).max()
    )
