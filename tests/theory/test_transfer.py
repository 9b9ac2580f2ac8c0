import itertools
import warnings
from decimal import Decimal

import numpy as np
import pytest
from layer_problem import reference_matrix, reference_transfer

from nucleation.model.material import Material
from nucleation.model.quantities import ParameterError
from nucleation.theory.bounds import transfer_bounds
from nucleation.theory.transfer import (
    RIGID,
    Body,
    interface_matrix,
    reference_modulus,
    response_matrix,
    scaled_sinh_excess,
    transfer_functions,
)

LAYER_NUMBERS = (1e-8, 3e-3, 0.4, 1.3, 6.0, 24.0, 26.0, 100.0)
SOFT, STIFF, AUXETIC = Material(3.1e9, 1 / 3), Material(8.7e9, 0.21), Material(1e9, -0.6)
UPPER = [
    Body(SOFT, 0.02, "velocity"),
    Body(SOFT, 0.03, "traction"),
    Body(AUXETIC, 0.02, "traction"),
    Body(SOFT),
    None,
]
LOWER = [
    Body(STIFF, 0.05, "velocity"),
    Body(STIFF, 0.02, "traction"),
    Body(SOFT, 0.02, "velocity"),
    Body(STIFF, far_side="traction"),
    None,
]
PAIRS = [pair for pair in itertools.product(UPPER, LOWER) if pair != (None, None)]


def or_rigid(body):
    return RIGID if body is None else body


@pytest.mark.parametrize("x", [1e-150, 1e-8, 0.1, 0.999, 1.0, 1.5, 9.0, 400.0])
def test_scaled_sinh_excess(x):
    d = Decimal(x)
    exact = ((d.exp() - (-d).exp()) / 2 - d) * (-d).exp()
    if x < 1e-100:
        exact = d**3 / 6
    assert scaled_sinh_excess(x) == pytest.approx(float(exact), rel=3e-15, abs=0.0)


@pytest.mark.parametrize("q", LAYER_NUMBERS)
@pytest.mark.parametrize("nu", [-0.6, 0.0, 1 / 3, 0.499])
@pytest.mark.parametrize("far_side", ["velocity", "traction"])
def test_response_matrix_solves_the_layer_problem(q, nu, far_side):
    body = Body(Material(2.0e9, nu), 0.3, far_side)
    for sign, side in itertools.product((1, -1), ("upper", "lower")):
        k = sign * q / body.height
        np.testing.assert_allclose(
            response_matrix(k, body, side), reference_matrix(k, body, side), rtol=2e-14
        )


@pytest.mark.parametrize("k", [7.0, -0.02])
def test_response_matrix_of_the_paper(k):
    """Eqs. (S-general_M) and (S-M_inf), written out."""
    mu, nu, height = 2.0e9, 0.3, 0.2
    q = height * k
    cross = 1j * (2 * q + (1 - 2 * nu) * np.sinh(2 * q))
    layer = np.array(
        [[-4 * (1 - nu) * np.sinh(q) ** 2, cross], [-cross, -4 * (1 - nu) * np.cosh(q) ** 2]]
    ) / (2 * k * mu * (np.sinh(2 * q) - 2 * q))
    material = Material(mu, nu)
    np.testing.assert_allclose(response_matrix(k, Body(material, height)), layer, rtol=1e-9)
    diagonal = -2 * (1 - nu) * np.sign(k)
    half_space = np.array([[diagonal, 1j * (1 - 2 * nu)], [-1j * (1 - 2 * nu), diagonal]])
    half_space /= 2 * k * mu
    for far_side in ("velocity", "traction"):
        body = Body(material, far_side=far_side)
        np.testing.assert_allclose(response_matrix(k, body), half_space, rtol=1e-14)


def test_thin_free_layer_is_a_plate():
    """Stretching and bending stiffness of a plate, ``E' H k^2`` and ``E' H^3 k^4 / 12``."""
    mu, nu, height, k = 3.1e9, 1 / 3, 1e-8, 1.0
    modulus = 2 * mu / (1 - nu)
    matrix = response_matrix(k, Body(Material(mu, nu), height, "traction"))
    assert matrix[1, 1] == pytest.approx(-12 / (modulus * height**3 * k**4), rel=1e-6)
    # at its lower face a plate yields four times as much to shear as in its middle plane
    assert matrix[0, 0] == pytest.approx(-4 / (modulus * height * k**2), rel=1e-6)


@pytest.mark.parametrize("k", [4e-7, 0.6, 45.0, -45.0, 900.0, 1e4])
@pytest.mark.parametrize(("upper", "lower"), PAIRS)
def test_transfer_functions_solve_the_layer_problem(upper, lower, k):
    mu = (upper or lower).material.shear_modulus
    expected = reference_transfer(k, upper, lower, mu)
    g1, g2 = transfer_functions(k, or_rigid(upper), or_rigid(lower))
    assert g1 == pytest.approx(expected[0], rel=2e-14, abs=0.0)
    assert g2 == pytest.approx(expected[1], rel=1e-12, abs=1e-14 * abs(g1))


@pytest.mark.parametrize(("upper", "lower"), PAIRS)
def test_interface_matrix_inverts_the_response(upper, lower):
    k = np.array([[3.0, 40.0], [-70.0, 500.0]])
    upper, lower = or_rigid(upper), or_rigid(lower)
    matrix = interface_matrix(k, upper, lower)
    jump = response_matrix(k, upper, "upper") - response_matrix(k, lower, "lower")
    assert matrix.shape == (2, 2, 2, 2)
    identity = np.broadcast_to(np.eye(2), (2, 2, 2, 2))
    np.testing.assert_allclose(matrix @ jump, identity, atol=1e-9)
    g1, g2 = transfer_functions(k, upper, lower)
    mu = reference_modulus(upper, lower)
    np.testing.assert_allclose(matrix[..., 0, 0], -mu * k * g1, rtol=1e-14)
    np.testing.assert_allclose(matrix[..., 1, 0], 1j * mu * k * g2, rtol=1e-14)


@pytest.mark.parametrize(("upper", "lower"), PAIRS)
def test_any_layer_number_is_safe(upper, lower):
    k = np.geomspace(1e-7, 1e9, 60)
    upper, lower = or_rigid(upper), or_rigid(lower)
    with warnings.catch_warnings(), np.errstate(over="raise", divide="raise", invalid="raise"):
        warnings.simplefilter("error")
        g1, g2 = transfer_functions(k, upper, lower)
        response = response_matrix(k, upper)
    assert np.all(g1 > 0) and np.all(np.isfinite(g2)) and np.all(np.isfinite(response))
    mirrored = transfer_functions(-k, upper, lower)
    np.testing.assert_array_equal(mirrored, [-g1, g2])


@pytest.mark.parametrize("body", [Body(SOFT, 0.02), Body(SOFT, 0.02, "traction"), Body(STIFF)])
def test_mirror_symmetric_pair_does_not_couple(body):
    k = np.geomspace(1e-6, 1e6, 40)
    assert np.all(transfer_functions(k, body, body)[1] == 0.0)


def test_exchange_of_the_bodies_reverses_the_coupling():
    k = np.geomspace(1e-3, 1e5, 40)
    upper, lower = Body(SOFT, 0.02, "traction"), Body(STIFF, 0.07)
    g1, g2 = transfer_functions(k, upper, lower)
    h1, h2 = transfer_functions(k, lower, upper)
    ratio = STIFF.shear_modulus / SOFT.shear_modulus
    np.testing.assert_allclose(g1, ratio * h1, rtol=1e-13)
    np.testing.assert_allclose(g2, -ratio * h2, rtol=1e-10, atol=1e-14)


def test_rigid_body_is_the_stiff_limit():
    k = np.geomspace(1e-2, 1e4, 20)
    block = Body(SOFT, 0.01, "traction")
    stiff = Body(Material(9.9e12, 0.2))
    np.testing.assert_allclose(
        transfer_functions(k, block, stiff), transfer_functions(k, block, RIGID), atol=1e-3
    )
    assert np.all(response_matrix(k, RIGID) == 0.0)


@pytest.mark.parametrize(("upper", "lower"), PAIRS)
@pytest.mark.parametrize("width", [1e-5, 1e-3, 0.1, 1.0])
def test_bounds_enclose_the_transfer_functions(upper, lower, width):
    low = np.geomspace(1e-4, 1e4, 50)
    upper, lower = or_rigid(upper), or_rigid(lower)
    bounds = transfer_bounds(low, low * np.exp(width), upper, lower)
    inside = low * np.exp(width * np.linspace(0.0, 1.0, 41))[:, None]
    g1, g2 = transfer_functions(inside, upper, lower)
    slack = 1 + 1e-13
    assert np.all(g1.min(0) * slack >= bounds.g1_low)
    assert np.all(g1.max(0) <= bounds.g1_high * slack)
    assert np.all(np.abs(g2).max(0) <= bounds.g2_high * slack)
    if width == 1e-5:
        assert np.all(bounds.g1_high < 1.01 * bounds.g1_low)
        assert np.all(bounds.g2_high < np.abs(g2).max(0) + 0.01 * g1.max(0))


def test_errors():
    with pytest.raises(ValueError, match="at least one"):
        transfer_functions(1.0, RIGID, RIGID)
    for k in (0.0, np.nan, np.inf):
        with pytest.raises(ValueError, match="wavenumber"):
            transfer_functions([1.0, k], Body(), RIGID)
        with pytest.raises(ValueError, match="wavenumber"):
            response_matrix(k, Body())
    with pytest.raises(ValueError, match="middle"):
        response_matrix(1.0, Body(), "middle")
    for bad in ({"height": 0.0}, {"height": -1.0}, {"far_side": "free"}):
        with pytest.raises(ParameterError, match=next(iter(bad))):
            Body(**bad)
