"""Manufactured elastodynamics: the solver is of second order in h and in dt.

Neither order is polluted by the other: BDF2 is exact for displacements quadratic in time, and
bilinear elements are exact for displacements bilinear in space.
"""

import numpy as np
import pytest
from verification.manufactured import (
    Displacement,
    ManufacturedDynamics,
    Power,
    Sine,
    Term,
    orders,
    table,
)

from nucleation.elasticity import Material
from nucleation.parameters import Geometry, Mesh, Parameters

MATERIAL = Material()
GEOMETRY = Geometry(height=0.3, length=1.0)
SCALE = 1e-6  # m, of the displacements; inertia and elasticity are alike for times of 1e-3 s

SMOOTH = Displacement(
    (
        (Term(SCALE, Sine(2.1), Sine(1.7, 1.9), Power(1.0, 1e3, 5e5)),),
        (
            Term(2 * SCALE, Sine(1.9, 2.0), Sine(2.3), Power(1.0, -7e2, 6e5)),
            Term(-1e-4, Power(1.0), Power(0.0, 1.0), Power(1.0)),
        ),
    ),
    MATERIAL,
)
BILINEAR = Displacement(
    (
        (Term(SCALE, Power(0.0, 1.0), Power(1.0, 0.7), Sine(1e4, 0.3)),),
        (Term(2 * SCALE, Power(1.0, 0.6), Power(0.0, 1.0), Sine(1.5e4, 1.1)),),
    ),
    MATERIAL,
)


def dynamics(exact, n, grading=1.0):
    mesh = Mesh(n_x=2 * n, n_y=n, grading=grading)
    return ManufacturedDynamics(Parameters(MATERIAL, geometry=GEOMETRY, mesh=mesh), exact)


@pytest.mark.parametrize("grading", [1.0, 3.0])
def test_second_order_in_h(grading):
    errors, sizes = [], [4, 8, 16, 32]
    for n in sizes:
        problem = dynamics(SMOOTH, n, grading)
        state, _ = problem.run(rung=-56, steps=12)  # 12 steps of 9.2e-5 s
        errors.append(problem.displacement_error(state) / SCALE)
    table(f"elastodynamics, h, grading {grading}", [f"{2 * n}x{n}" for n in sizes], errors)
    np.testing.assert_allclose(orders(errors)[1:], 2.0, atol=0.1)
    assert errors[-1] < 2e-4


def test_second_order_in_dt():
    errors, rungs = [], [-72, -76, -80, -84]
    problem = dynamics(BILINEAR, 4)
    for i, rung in enumerate(rungs):
        state, _ = problem.run(rung, steps=48 * 2**i)
        errors.append(problem.displacement_error(state) / SCALE)
    steps = [1.5 * 2 ** (r / 4) for r in rungs]
    table("elastodynamics, dt", [f"{h:.3e}" for h in steps], errors)
    np.testing.assert_allclose(orders(errors)[1:], 2.0, atol=0.1)
    assert errors[-1] < 2e-4


def test_exact_for_bilinear_fields_quadratic_in_time():
    """Both at once: nothing is left but round-off, and the reactions are the exact tractions."""
    terms = tuple(
        tuple(Term(t.amplitude, t.x, t.y, Power(1.0, 8e2, 7e5)) for t in component)
        for component in BILINEAR.terms
    )
    exact = Displacement(terms, MATERIAL)
    problem = dynamics(exact, 5, grading=2.0)
    state, report = problem.run(rung=-56, steps=10)
    loads, time = problem.loads, state.time
    assert problem.displacement_error(state) < 1e-10 * SCALE
    _, shear, normal = exact.stress(loads.x, np.zeros_like(loads.x), time)
    # quadrature of the body force belongs to the balance, not to the reactions
    interface = report.interface
    expected = -loads.along_x @ shear
    np.testing.assert_allclose(
        interface.tangential[1:], expected[1:], atol=1e-8 * np.abs(expected).max()
    )
    expected = -loads.along_x @ normal
    np.testing.assert_allclose(interface.normal, expected, atol=1e-8 * np.abs(expected).max())
