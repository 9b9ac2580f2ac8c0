"""The separable solver against the assembled matrix, and what must hold for any body."""

import numpy as np
import pytest
from fem.assembled_problem import Assembled

from benchmarks.nodal import nodal_values
from nucleation.fem.body import Body
from nucleation.fem.grid import Grid
from nucleation.fem.operator import Operator
from nucleation.model.material import Material

UPPER = Material(shear_modulus=3.1e9, poisson_ratio=0.29, density=1200.0)
LOWER = Material(shear_modulus=9.0e9, poisson_ratio=0.21, density=2700.0)
GRIDS = [Grid(1.0, 0.3, 12, 5), Grid(1.0, 0.3, 9, 6, grading=4.0), Grid(0.7, 0.1, 15, 2)]
PERIOD = Grid(0.7, 0.2, 9, 5, grading=3.0, periodic=True)
PERIODS = (PERIOD, Grid(0.7, 0.3, 9, 4, periodic=True))
PAIRS = [
    (Grid(1.0, 0.3, 12, 5), Grid(1.0, 0.2, 12, 4)),
    (Grid(1.0, 0.3, 9, 3, grading=2.0), Grid(1.0, 0.5, 9, 6, grading=4.0)),
]
BOTTOMS = ("free", "clamped", "roller")
STATIC, SLOW, FAST = 0.0, 1e6, 1e13  # s in 1/s^2: statics, elasticity and inertia alike, inertia


def pair_of(grids, bottom="free", upper=UPPER, lower=LOWER):
    return Body((grids[0], upper), (grids[1], lower), bottom)


def random_field(body, rng):
    field = body.zero_field()
    field.modes[:] = rng.normal(size=field.modes.shape)
    field.edge[:] = body.modes.has_edge * rng.normal(size=field.edge.shape)
    return field


def relative(value, reference):
    return np.abs(value - reference).max() / np.abs(reference).max()


BODIES = {
    **{f"block {i}": Body((grid, UPPER)) for i, grid in enumerate(GRIDS)},
    "period": Body((PERIOD, UPPER)),
    **{f"pair, {bottom}": pair_of(PAIRS[0], bottom) for bottom in BOTTOMS},
    **{f"graded pair, {bottom}": pair_of(PAIRS[1], bottom) for bottom in BOTTOMS},
}


def assembled(name):
    body = BODIES[name]
    return body, Assembled(body, name.rpartition(", ")[2])


def balanced(operator, load, w):
    """Field, tangential and normal nodal forces with the right edge in balance."""
    response = operator.respond(load, w)
    field = operator.balance(response, w)[0]
    return field, response.tangential, response.normal


@pytest.mark.parametrize("s", [STATIC, SLOW, FAST])
@pytest.mark.parametrize("name", BODIES)
def test_equals_assembled_matrix(name, s):
    """Displacements and forces on the upper body, under any loads."""
    rng, (body, reference) = np.random.default_rng(1), assembled(name)
    load, w = random_field(body, rng), 1e-9 * rng.normal(size=body.grid.n_x)
    gauge = s == STATIC and name.endswith("free")
    field, tangential, normal = balanced(Operator(body, s), load, w)
    u, left = reference.solve(s, reference.forces(load), w, pinned=gauge)
    bound = 1e-10 if gauge else 1e-12  # soft bending modes cost digits
    x, y, _ = reference.places[0]
    values = reference.values(field)
    for unknowns in (x, y):
        assert relative(values[unknowns], u[unknowns]) < bound
    assert relative(values, u) < bound
    assert relative(tangential, left[x[0, 1:]]) < bound
    assert relative(normal, left[y[0]]) < bound


@pytest.mark.parametrize("name", BODIES)
def test_inertia_and_loads_equal_assembled(name):
    body, reference = assembled(name)
    grid, (x, y, _) = body.grid, reference.places[0]
    field = random_field(body, np.random.default_rng(2))
    above, below = body.split(field.edge)[0], body.split(field.edge)[-1]
    below[0] = -above[0] if len(body.layers) == 2 else 0.0  # no opening
    momentum = reference.mass @ reference.values(field)
    assert body.momentum_x(field) == pytest.approx(momentum[x[:, grid.own]].sum(), rel=1e-12)
    ours = reference.forces(body.inertia_load(7.0, [(1.0, field)], body.zero_field()))
    if not grid.periodic:
        for unknowns, *_ in reference.places:
            momentum[unknowns[:, 0]] = 0.0  # the driven edge moves by itself
    assert relative(ours, 7.0 * momentum) < 1e-12
    far = reference.forces(body.far_load(3.0, 4.0 * grid.periodic))
    np.testing.assert_allclose(far[y[-1]], -3.0 * grid.nodal_lengths, atol=1e-14)
    np.testing.assert_allclose(far[x[-1]], 4.0 * grid.periodic * grid.dx, atol=1e-14)


@pytest.mark.parametrize("s", [STATIC, SLOW, FAST])
@pytest.mark.parametrize("body", BODIES.values(), ids=BODIES)
def test_condensed_operator(body, s):
    """apply() is the response of respond(), tangent() and diagonal are its matrix, D is SPD."""
    bound, normal_bound = (1e-12, 1e-12) if len(body.layers) == 1 else (1e-11, 1e-10)
    rng, n = np.random.default_rng(4), body.grid.n_x
    operator, w = Operator(body, s), rng.normal(size=n)
    field, tangential, normal = balanced(operator, body.zero_field(), w)
    response = operator.edge.response @ w if operator.edge else field.edge
    p, reaction = operator.apply(w)
    assert relative(p, tangential) < bound
    assert relative(reaction, normal) < normal_bound
    np.testing.assert_allclose(response, field.edge, atol=10.0 * bound * np.abs(field.edge).max())
    columns = [operator.apply(unit) for unit in np.eye(n)]
    d, c = (np.array([column[i] for column in columns]).T for i in (0, 1))
    nodes = np.array([1, 2, 5, n - 1, n])
    stiffness, coupling = operator.tangent(nodes)
    assert relative(stiffness, d[np.ix_(nodes - 1, nodes - 1)]) < 1e-7  # EDGE_FELT is left out
    assert relative(coupling, c[np.ix_(nodes, nodes - 1)]) < 1e-7
    assert relative(operator.diagonal, np.diag(d)) < bound
    assert relative(d, d.T) < bound
    assert np.linalg.eigvalsh(d).min() > 0.0


@pytest.mark.parametrize("s", [STATIC, SLOW])
def test_identical_blocks_do_not_couple_slip_to_normal_stress(s):
    """N = 0 exactly, and D of both is half of that of a block whose face is free: (a - b^2/c)/2."""
    grid = PAIRS[0][0]
    operator = Operator(pair_of((grid, grid), lower=UPPER), s)
    a, b, c = operator.factors[0].pivot
    assert (operator.modal[1] == 0.0).all()
    np.testing.assert_allclose(operator.modal[0], 0.5 * (a - b**2 / c), rtol=1e-8)
    w = np.random.default_rng(7).normal(size=grid.n_x)
    p, normal = operator.apply(w)
    assert np.abs(normal).max() < 1e-12 * np.abs(p).max()


FREE = {  # components along which nothing is held, by the lower far side
    "block": {"free": {1}, "clamped": set(), "roller": set()},
    "period": {"free": {0, 1}, "clamped": set(), "roller": {0}, "velocity": {1}},
}
FREE_BODIES = [
    (pair_of(PERIODS if kind == "period" else PAIRS[1], side), components)
    for kind, sides in FREE.items()
    for side, components in sides.items()
]


@pytest.mark.parametrize(("body", "components"), FREE_BODIES)
def test_a_pair_translates_along_each_direction_in_which_nothing_is_held(body, components):
    """All nodes of both layers move alike; along the other component none does."""
    moved = []
    for free in body.translations:
        field = body.zero_field()
        free.taken_from(field, -3.0)
        values = [nodal_values(body, field, number) for number in (0, 1)]
        (component,) = (c for c in (0, 1) if np.abs(values[0][c]).max() > 0.0)
        for layer in values:
            np.testing.assert_allclose(layer[component], 3.0, atol=1e-13)
            np.testing.assert_allclose(layer[1 - component], 0.0, atol=1e-13)
        moved.append(component)
    assert set(moved) == components and len(moved) == len(components)


def test_a_layer_on_a_rigid_base_is_held():
    assert not any(BODIES[name].translations for name in ("block 0", "period"))


@pytest.mark.parametrize(
    ("bottom", "grids"), [("free", PAIRS[1]), ("free", PERIODS), ("roller", PERIODS)]
)
def test_a_translation_is_that_of_the_centre_of_mass(bottom, grids):
    """By the assembled mass matrix; a field from which it is taken has no momentum."""
    body = pair_of(grids, bottom)
    reference = Assembled(body, bottom)
    field = random_field(body, np.random.default_rng(3))
    above, below = body.split(field.edge)
    below[0] = -above[0]  # no opening
    for free in body.translations:
        unit = body.zero_field()
        free.taken_from(unit, -1.0)
        along = reference.values(unit)
        inertia = reference.mass @ along
        assert free.mass == pytest.approx(inertia @ along, rel=1e-12)
        expected = inertia @ reference.values(field) / free.mass
        assert free.of(field) == pytest.approx(expected, rel=1e-10)
        free.taken_from(field, free.of(field))
        assert abs(free.of(field)) < 1e-14


def test_other_elements_along_x_are_refused():
    with pytest.raises(ValueError, match="n_x = 12"):
        pair_of((Grid(1.0, 0.3, 12, 5), Grid(1.0, 0.2, 13, 4)))
