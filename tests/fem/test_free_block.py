"""The block with free side edges, and the pair of them, against the assembled matrix."""

import numpy as np
import pytest
from fem.assembled_problem import AssembledBlock

from nucleation.fem.bodies import body_of, period_of
from nucleation.fem.grid import Grid
from nucleation.model.material import Material
from nucleation.model.parameters import Geometry, Loading, Mesh, Parameters

GRID = Grid(0.8, 0.3, 8, 5, 2.0)
PARAMETERS = Parameters(
    loading=Loading(kind="top"), geometry=Geometry(0.3, 0.8), mesh=Mesh(8, 5, 2.0)
)


def assembled():
    """u_x given on top and interface, u_y = 0 on the interface, all else free."""
    block = AssembledBlock(GRID, Material())
    block.fixed[:] = False
    for held in (block.x[0], block.y[0], block.x[-1]):
        block.fixed[held] = True
    block.free = ~block.fixed
    return block


@pytest.mark.parametrize("s", [0.0, 1e6, 1e9])
def test_forces_and_displacement_are_those_of_the_assembled_matrix(s):
    rng = np.random.default_rng(1)
    block, body = assembled(), body_of(PARAMETERS)
    w = 1e-6 * rng.standard_normal(9)
    load = body.top_load(1e6)
    w_past = 1e-6 * rng.standard_normal(9)
    past = body.operator(0.0).balance(body.operator(0.0).respond(load, w_past), w_past).displacement
    u_past = np.zeros(block.stiffness.shape[0])
    u_past[block.x], u_past[block.y] = body.nodal_values(past)
    operator = body.operator(s)
    response = operator.respond(body.inertia_load(s, [(1.0, past)], load), w)
    found = operator.balance(response, w).displacement
    prescribed = np.zeros(block.stiffness.shape[0])
    prescribed[block.x[0]] = w
    u, reactions = block.solve(s, block.top_load(1e6) + s * (block.mass @ u_past), prescribed)
    x, y = body.nodal_values(found)
    scale = np.abs(u).max()
    np.testing.assert_allclose(x, u[block.x], atol=1e-11 * scale)
    np.testing.assert_allclose(y, u[block.y], atol=1e-11 * scale)
    size = np.abs(reactions).max()
    np.testing.assert_allclose(response.tangential, reactions[block.x[0]], atol=1e-10 * size)
    np.testing.assert_allclose(response.normal, reactions[block.y[0]], atol=1e-10 * size)


def test_dense_blocks_are_those_of_apply():
    operator = body_of(PARAMETERS).operator(1e8)
    stiffness, coupling = operator.tangent(np.arange(1, 10))
    for k, unit in enumerate(np.eye(9)):
        p, normal = operator.apply(unit)
        np.testing.assert_allclose(stiffness[:, k], p, atol=1e-9 * stiffness.max())
        np.testing.assert_allclose(coupling[:, k], normal, atol=1e-9 * stiffness.max())
    np.testing.assert_allclose(stiffness, stiffness.T, atol=1e-9 * stiffness.max())
    np.testing.assert_allclose(operator.diagonal, stiffness.diagonal())


@pytest.mark.parametrize("s", [0.0, 1e6])
@pytest.mark.parametrize("mode", [np.cos, np.sin])
def test_far_from_its_sides_a_mode_of_slip_meets_the_stiffness_of_a_period(mode, s):
    """Free sides carry no shear stress, so modes are no modes there; that decays over H."""
    n, dx = 21, 0.025  # elements to a wavelength, their length; H is 8 of them
    period = PARAMETERS.replaced({"height": 0.2, "length": n * dx, "n_x": n, "n_y": 8})
    phase = 2.0 * np.pi * np.arange(12 * n + 1) / n
    exact = period_of(period).operator(s).apply(mode(phase[1 : n + 1]))
    differences = []
    for wavelengths in (4, 8, 12):
        elements = wavelengths * n
        block = body_of(period.replaced({"length": elements * dx, "n_x": elements}))
        forces = block.operator(s).apply(mode(phase[: elements + 1]))
        middle = slice(elements // 2 + 1, elements // 2 + 1 + n)
        pairs = zip(forces, (exact[0], exact[1][1:]), strict=True)
        differences.append([np.abs(a[middle] - b).max() / np.abs(b).max() for a, b in pairs])
    assert np.all(np.array(differences).T < [1e-2, 1e-6, 1e-10])
    assert min(differences[0]) > 1e-6  # of the sides, not of round-off
