"""The separable solver against the assembled matrix, and exact solutions."""

import numpy as np
import pytest
from fem.assembled_problem import AssembledBlock, nodal_forces
from fem.test_pair import BOTTOMS, FAST, SLOW, STATIC, pair_of, relative
from fem.test_pair import GRIDS as GRIDS_OF_PAIRS

from nucleation.fem.body import Body
from nucleation.fem.grid import Field, Grid, Motion
from nucleation.fem.operator import Operator
from nucleation.fem.right_edge import foreseen_edge
from nucleation.model.material import Material

MATERIAL = Material(shear_modulus=3.1e9, poisson_ratio=0.29, density=1200.0)
GRIDS = [Grid(1.0, 0.3, 12, 5), Grid(1.0, 0.3, 9, 6, grading=4.0), Grid(0.7, 0.1, 15, 2)]


@pytest.fixture(params=GRIDS, ids=["uniform", "graded", "thin"])
def grid(request):
    return request.param


def random_load(body, rng):
    load = body.zero_field()
    load.modes[:] = rng.normal(size=load.modes.shape)
    load.edge[:] = rng.normal(size=load.edge.shape)
    return load


def assembled_load(block, body, load):
    """The nodal forces whose generalised forces per mode are those of `load`."""
    forces = np.zeros(block.stiffness.shape[0])
    tangential, normal = nodal_forces(body.modes, load.modes)
    forces[block.x[:, 1:]], forces[block.y] = tangential, normal
    forces[block.y[:, -1]] = load.edge
    return forces


def balanced(operator, load, w):
    """Field, tangential and normal nodal forces with the right edge in balance."""
    response = operator.respond(load, w)
    field = operator.balance(response, w)[0]
    return field, response.tangential, response.normal


@pytest.mark.parametrize("s", [STATIC, SLOW, FAST])
def test_equals_assembled_matrix(grid, s):
    rng = np.random.default_rng(1)
    body, block = Body((grid, MATERIAL)), AssembledBlock(grid, MATERIAL)
    operator = Operator(body, s)
    load, w = random_load(body, rng), 1e-9 * rng.normal(size=grid.n_x)
    field, tangential, normal = balanced(operator, load, w)
    prescribed = np.zeros(block.stiffness.shape[0])
    prescribed[block.x[0, 1:]] = w
    u, reaction = block.solve(s, assembled_load(block, body, load), prescribed)
    u_x, u_y = body.nodal_values(field)
    assert relative(u_x, u[block.x]) < 1e-12
    assert relative(u_y, u[block.y]) < 1e-12
    assert relative(tangential, reaction[block.x[0, 1:]]) < 1e-12
    assert relative(normal, reaction[block.y[0]]) < 1e-12


def test_inertia_and_top_load_equal_assembled(grid):
    rng = np.random.default_rng(2)
    body, block = Body((grid, MATERIAL)), AssembledBlock(grid, MATERIAL)
    field = random_load(body, rng)
    field.edge[0] = 0.0
    values = np.zeros(block.stiffness.shape[0])
    values[block.x], values[block.y] = body.nodal_values(field)
    ours = assembled_load(block, body, body.inertia_load(7.0, [(1.0, field)], body.zero_field()))
    theirs = 7.0 * block.mass @ values
    theirs[block.x[:, 0]] = 0.0  # the driven edge moves by itself
    assert relative(ours, theirs) < 1e-12
    top = assembled_load(block, body, body.far_load(3.0))
    np.testing.assert_allclose(top, block.top_load(3.0), atol=1e-14)


BODIES = {
    **{f"block {i}": Body((grid, MATERIAL)) for i, grid in enumerate(GRIDS)},
    **{f"pair, {bottom}": pair_of(GRIDS_OF_PAIRS[0], bottom) for bottom in BOTTOMS},
}


@pytest.mark.parametrize("s", [STATIC, SLOW, FAST])
@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
def test_condensed_operator(body, s):
    """apply() is the response of respond(), tangent() and diagonal are its matrix, D is SPD."""
    bound, normal_bound = (1e-12, 1e-12) if len(body.layers) == 1 else (1e-11, 1e-10)
    rng, n = np.random.default_rng(4), body.grid.n_x
    operator, w = Operator(body, s), rng.normal(size=n)
    field, tangential, normal = balanced(operator, body.zero_field(), w)
    p, reaction = operator.apply(w)
    assert relative(p, tangential) < bound
    assert relative(reaction, normal) < normal_bound
    assert relative(operator.edge.response @ w, field.edge) < 10.0 * bound
    columns = [operator.apply(unit) for unit in np.eye(n)]
    d, c = (np.array([column[i] for column in columns]).T for i in (0, 1))
    nodes = np.array([1, 2, 5, n - 1, n])
    stiffness, coupling = operator.tangent(nodes)
    assert relative(stiffness, d[np.ix_(nodes - 1, nodes - 1)]) < 1e-7  # EDGE_FELT is left out
    assert relative(coupling, c[np.ix_(nodes, nodes - 1)]) < 1e-7
    assert relative(operator.diagonal, np.diag(d)) < bound
    assert relative(d, d.T) < bound
    assert np.linalg.eigvalsh(d).min() > 0.0


def test_transforms_are_inverse_and_dual(grid):
    rng = np.random.default_rng(5)
    modes = Body((grid, MATERIAL)).modes
    values, amplitudes = rng.normal(size=(2, grid.n_x))
    np.testing.assert_allclose(modes.sine_values(modes.sine_amplitudes(values)), values, rtol=1e-12)
    # nodal forces do the same work as modal ones
    ((tangential,), (normal,)) = nodal_forces(modes, [np.array([amplitudes, amplitudes])])
    modal = 0.5 * grid.n_x * amplitudes
    assert tangential @ values == pytest.approx(modal @ modes.sine_amplitudes(values))
    cosines = np.linalg.inv(modes.cosine_values(np.eye(grid.n_x)))  # nodal unit values in modes
    np.testing.assert_allclose(normal[:-1], cosines @ modal, atol=1e-12 * abs(modal).max())


@pytest.mark.parametrize("off", [0.0, 1e-3], ids=["as foreseen", "otherwise"])
def test_edge_that_moves_as_foreseen_saves_a_solve(off):
    """A response with foreseen edge values serves if the edge does what it was foreseen to do.

    If not, the error is known. Either way the field is the one that is solved for without them.
    """
    grid = Grid(1.0, 0.1, 40, 6)
    body, rng = Body((grid, MATERIAL)), np.random.default_rng(6)
    operator, load = Operator(body, SLOW), random_load(body, rng)
    near_the_load = np.where(np.arange(grid.n_x) < 10, 1e-9 * rng.normal(size=grid.n_x), 0.0)
    at_rest = operator.respond(load, 0.0 * near_the_load)
    solved = operator.balance(at_rest, near_the_load)[0]
    moved = Field(solved.modes, (1.0 + off) * solved.edge)
    foreseen = foreseen_edge((Motion(moved, body.zero_field(), 0.0),), 1e-3, 0.0)
    response = operator.respond(load, near_the_load, foreseen)
    found, _, error = operator.balance(response, near_the_load, foreseen=foreseen)
    assert operator.tolerates(error) == (off == 0.0)
    assert error == pytest.approx(off, abs=1e-12)
    response = operator.respond(load, near_the_load)
    again, _, error = operator.balance(response, near_the_load, foreseen=foreseen)
    assert error == pytest.approx(off, abs=1e-12)
    for field in (again, *([] if off else [found])):
        assert relative(field.modes, solved.modes) < 1e-12
        assert relative(field.edge, solved.edge) < 1e-12
