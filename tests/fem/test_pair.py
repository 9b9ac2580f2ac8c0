"""What must hold for any pair of blocks on one another."""

import numpy as np
import pytest

from nucleation.fem.body import Body as ElasticBody
from nucleation.fem.grid import Grid, Motion
from nucleation.fem.operator import Operator
from nucleation.model.material import Material

UPPER = Material(shear_modulus=3.1e9, poisson_ratio=0.29, density=1200.0)
LOWER = Material(shear_modulus=9.0e9, poisson_ratio=0.21, density=2700.0)
GRIDS = [
    (Grid(1.0, 0.3, 12, 5), Grid(1.0, 0.2, 12, 4)),
    (Grid(1.0, 0.3, 9, 3, grading=2.0), Grid(1.0, 0.5, 9, 6, grading=4.0)),
]
BOTTOMS = ("free", "clamped", "roller")
STATIC, SLOW, FAST = 0.0, 1e6, 1e13  # s in 1/s^2: statics, elasticity and inertia alike, inertia


def pair_of(grids, bottom="free", upper=UPPER, lower=LOWER):
    return ElasticBody((grids[0], upper), (grids[1], lower), bottom)


def random_field(body, rng):
    field = body.zero_field()
    field.modes[:] = rng.normal(size=field.modes.shape)
    field.edge[:] = body.modes.has_edge * rng.normal(size=field.edge.shape)
    return field


def relative(value, reference):
    return np.abs(value - reference).max() / np.abs(reference).max()


@pytest.mark.parametrize("s", [STATIC, SLOW])
def test_identical_blocks_do_not_couple_slip_to_normal_stress(s):
    """N = 0 exactly, and D of both is half of that of a block whose face is free: (a - b^2/c)/2."""
    grid = GRIDS[0][0]
    operator = Operator(pair_of((grid, grid), lower=UPPER), s)
    a, b, c = operator.factors[0].pivot
    assert (operator.modal[1] == 0.0).all()
    np.testing.assert_allclose(operator.modal[0], 0.5 * (a - b**2 / c), rtol=1e-8)
    w = np.random.default_rng(7).normal(size=grid.n_x)
    p, normal = operator.apply(w)
    assert np.abs(normal).max() < 1e-12 * np.abs(p).max()


def test_a_translation_that_has_grown_from_rounding_is_taken_out():
    """All nodes of both blocks move by what the corner has risen, at each instant its own."""
    rng, step = np.random.default_rng(3), 0.1
    body = pair_of(GRIDS[0])
    motions = tuple(Motion(random_field(body, rng), random_field(body, rng), 0.0) for _ in "ab")
    rise, rate = (float(f.edge[0]) for f in (motions[0].displacement, motions[0].velocity))
    settled = body.settled(motions, step, 1e-3 * abs(rise))
    for age, old, new in zip((0.0, step), motions, settled, strict=True):
        for moved, f, g in (
            (rise - age * rate, old.displacement, new.displacement),
            (rate, old.velocity, new.velocity),
        ):
            for number in (0, 1):
                (x, y), (x_new, y_new) = (body.nodal_values(one, number) for one in (f, g))
                np.testing.assert_array_equal(x, x_new)
                np.testing.assert_allclose(y - y_new, moved, atol=1e-13)
    assert body.settled(motions, step, 0.1 * abs(rise)) is motions
    assert pair_of(GRIDS[0], "roller").settled(motions, step, 0.0) is motions


def test_other_elements_along_x_are_refused():
    with pytest.raises(ValueError, match="n_x = 12"):
        pair_of((Grid(1.0, 0.3, 12, 5), Grid(1.0, 0.2, 13, 4)))
