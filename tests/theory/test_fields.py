import warnings

import numpy as np
import pytest

from nucleation.model.material import Material
from nucleation.theory.fields import block_displacement
from nucleation.theory.transfer import RIGID, Body, transfer_functions

MU, NU, HEIGHT = 3.1e9, 0.29, 0.2


def derivative(field, y, step, order):
    """Fourth-order central difference in y."""
    stencil = {1: (1, -8, 0, 8, -1), 2: (-1, 16, -30, 16, -1)}[order]
    offsets = np.arange(-2, 3) * step
    return sum(c * field(y + d) for c, d in zip(stencil, offsets, strict=True)) / (12 * step**order)


def stresses(field, k, y, step):
    """``sigma_xy`` and ``sigma_yy`` by Hooke's law (Eq. S-LE)."""
    u, du = field(y), derivative(field, y, step, 1)
    strain_xx, strain_yy, strain_xy = -1j * k * u[0], du[1], 0.5 * (du[0] - 1j * k * u[1])
    modulus = 2 * MU / (1 - 2 * NU)
    return 2 * MU * strain_xy, modulus * ((1 - NU) * strain_yy + NU * strain_xx)


def block(k):
    return lambda y: block_displacement(k, y, HEIGHT, NU, 0.3 + 0.5j)


@pytest.mark.parametrize("k", [2.0, 14.0])
def test_field_is_in_equilibrium_and_meets_the_far_side_conditions(k):
    """The Navier equation by finite differences; no stress at y = H, no u_y at y = 0."""
    field, y, step = block(k), np.linspace(0.1, 0.9, 7) * HEIGHT, 1e-3 / k
    u, du, ddu = field(y), *(derivative(field, y, step, order) for order in (1, 2))
    divergence, gradient = -1j * k * u[0] + du[1], -1j * k * du[0] + ddu[1]
    c = 1 / (1 - 2 * NU)
    residuals = c * -1j * k * divergence + ddu[0] - k**2 * u[0], c * gradient + ddu[1] - k**2 * u[1]
    scale = np.abs(u).max()
    assert np.abs(residuals).max() < 1e-8 * k**2 * scale
    assert np.abs(stresses(field, k, HEIGHT, step)).max() < 1e-9 * MU * k * scale
    assert abs(field(0.0)[1]) < 1e-14 * scale


@pytest.mark.parametrize("k", [2.0, 14.0, 60.0])
def test_block_field_gives_the_transfer_functions(k):
    field = block(k)
    shear, normal = stresses(field, k, 0.0, 1e-3 / k)
    g1, g2 = transfer_functions(k, Body(Material(MU, NU), HEIGHT, "traction"), RIGID)
    slip = field(0.0)[0]
    assert shear == pytest.approx(-MU * k * g1 * slip, rel=1e-9)
    assert normal == pytest.approx(1j * MU * k * g2 * slip, rel=1e-9)


@pytest.mark.parametrize("k", [1e-8, 1e6])
def test_field_stays_finite(k):
    y = np.linspace(0, 1, 50)
    with warnings.catch_warnings(), np.errstate(over="raise", invalid="raise"):
        warnings.simplefilter("error")
        u = block_displacement(k, y, 1.0, NU)
    assert np.all(np.isfinite(u))
    # slip of a half-space: -(3 - 4 nu) [1 - q] and of a thin block: -16 (1 - nu)^2 / [4 (1 - nu)]
    assert u[0, 0] == pytest.approx(-(3 - 4 * NU) if k > 1 else -4 * (1 - NU), rel=1e-6)


def test_block_field_needs_a_positive_wavenumber():
    with pytest.raises(ValueError, match="positive"):
        block_displacement(-1.0, 0.0, 1.0, NU)


def test_block_field_has_the_printed_amplitude():
    """Eq. (S-sol_inf) at the interface, ``y = 0``, where it simplifies."""
    k = 9.0
    q, kappa = k * HEIGHT, 3 - 4 * NU
    numerator = 2 * (-2 * q**2 - kappa * np.cosh(2 * q) + 4 * (3 - 2 * NU) * NU - 5)
    expected = numerator / (2 * q + np.exp(2 * q) + kappa)
    assert block_displacement(k, 0.0, HEIGHT, NU, 1.0)[0] == pytest.approx(expected, rel=1e-13)
