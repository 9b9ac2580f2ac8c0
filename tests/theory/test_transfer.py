import itertools
import warnings

import numpy as np
import pytest
from layer_problem import reference_stiffness, reference_transfer
from two_bodies import RIGID, Body, Interface, fault_of, transfer_functions

from nucleation.model.material import Material
from nucleation.theory.stiffness import FAR_SIDES

LAYER_NUMBERS = (1e-8, 3e-3, 0.4, 1.3, 6.0, 24.0, 26.0, 100.0)
SOFT, STIFF, AUXETIC = Material(3.1e9, 1 / 3), Material(8.7e9, 0.21), Material(1e9, -0.6)
KINDS = tuple(FAR_SIDES)
UPPER = [
    Body(SOFT, 0.02, "velocity"),
    Body(SOFT, 0.03, "free"),
    Body(AUXETIC, 0.02, "free"),
    Body(SOFT, 0.02, "clamped"),
    Body(AUXETIC, 0.01, "roller"),
    Body(SOFT),
    None,
]
LOWER = [
    Body(STIFF, 0.05, "velocity"),
    Body(STIFF, 0.02, "free"),
    Body(SOFT, 0.02, "velocity"),
    Body(STIFF, 0.05, "clamped"),
    Body(SOFT, 0.03, "roller"),
    Body(STIFF, far_side="free"),
    None,
]
PAIRS = [pair for pair in itertools.product(UPPER, LOWER) if pair != (None, None)]


def or_rigid(body):
    return RIGID if body is None else body


@pytest.mark.parametrize("q", LAYER_NUMBERS)
@pytest.mark.parametrize("nu", [-0.6, 0.0, 0.25, 1 / 3, 0.499, 0.4999999])
@pytest.mark.parametrize("far_side", KINDS)
def test_stiffness_solves_the_layer_problem(q, nu, far_side):
    body = Body(Material(2.0e9, nu), 0.3, far_side)
    xx, xy, yy, det = reference_stiffness(q / body.height, body)
    found = body.layers.stiffness(q / body.height)
    assert found.xx == pytest.approx(xx, rel=2e-14)
    assert found.yy == pytest.approx(yy, rel=2e-14)
    assert found.det == pytest.approx(det, rel=3e-14)
    assert found.xy == pytest.approx(xy, rel=1e-13, abs=1e-15 * xx)


def test_half_space_of_the_paper():
    """The inverse of Eq. (S-M_inf), ``A M = 1``."""
    nu = 0.3
    m = np.array([[2 * (1 - nu), 1 - 2 * nu], [1 - 2 * nu, 2 * (1 - nu)]]) / 2
    for far_side in KINDS:
        a = Body(Material(2.0e9, nu), far_side=far_side).layers.stiffness(7.0)
        np.testing.assert_allclose([[a.xx, -a.xy], [-a.xy, a.yy]] @ m, np.eye(2), atol=1e-14)


@pytest.mark.parametrize("k", [4e-7, 0.6, 45.0, -45.0, 900.0, 1e4])
@pytest.mark.parametrize(("upper", "lower"), PAIRS)
def test_transfer_functions_solve_the_layer_problem(upper, lower, k):
    mu = (upper or lower).material.shear_modulus
    expected = reference_transfer(k, upper, lower, mu)
    g1, g2 = transfer_functions(k, or_rigid(upper), or_rigid(lower))
    assert g1 == pytest.approx(expected[0], rel=2e-14, abs=0.0)
    assert g2 == pytest.approx(expected[1], rel=1e-12, abs=1e-14 * abs(g1))


@pytest.mark.parametrize(("upper", "lower"), PAIRS)
def test_any_layer_number_is_safe(upper, lower):
    k = np.geomspace(1e-7, 1e9, 60)
    upper, lower = or_rigid(upper), or_rigid(lower)
    with warnings.catch_warnings(), np.errstate(over="raise", divide="raise", invalid="raise"):
        warnings.simplefilter("error")
        g1, g2 = transfer_functions(k, upper, lower)
    assert np.all(g1 > 0) and np.all(np.isfinite(g2))
    mirrored = transfer_functions(-k, upper, lower)
    np.testing.assert_array_equal(mirrored, [-g1, g2])


def test_errors():
    with pytest.raises(ValueError, match="at least one"):
        transfer_functions(1.0, RIGID, RIGID)
    for k in (0.0, np.nan, np.inf):
        with pytest.raises(ValueError, match="wavenumber"):
            fault_of(SOFT, Interface()).transfer_functions([1.0, k])
