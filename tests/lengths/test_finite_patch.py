"""Patches of fixed length against other evaluations: collocation, in time, and by quadrature."""

import numpy as np
import pytest
from asked import lengths_in_use
from scipy.linalg import eig

from nucleation.lengths import finite_patch, formulas

ROCK = {"shear_modulus": 3.1e9, "poisson_ratio": 1 / 3}
FAULT = ROCK | {"normal_stress": 1e6, "slip_distance": 5e-7}
STIFFNESS = 3.1e9 / (1 - 1 / 3)  # mu*, Pa


def collocated(points):
    """Chebyshev collocation of the hypersingular crack operator: x, and slip to minus stress.

    ``-(1/2 pi) fp int u(s)/(s - x)^2 ds`` on (-1, 1) for slip ``u = sqrt(1 - s^2) w(s)``, w by its
    values at the zeros of U_n.
    """
    theta = np.arange(1, points + 1) * np.pi / (points + 1)
    x = np.cos(theta)
    n = np.arange(1, points + 1)
    values = np.sin(np.outer(theta, n)) / np.sin(theta)[:, None]  # U_{n-1} at x
    stress = 0.5 * n * values  # of sqrt(1 - s^2) U_{n-1}
    return x, stress @ np.linalg.inv(values)


def growth(half_length, a_over_b, rate, points=120):
    """Fastest growth over V(0)/D of a patch, half-length in L_b, slip rates V(x)/V(0) given.

    The plain linear system in time for log v and log phi, by nodes: nothing is eliminated.
    """
    x, crack = collocated(points)
    s, w = rate(x), np.sqrt(1.0 - x**2)
    stress = crack @ np.diag(s / w) / half_length  # of a perturbation of log v
    to_rate = np.hstack([(np.diag(s) - stress) / a_over_b, np.diag(s) / a_over_b])
    to_state = np.hstack([-np.diag(s), -np.diag(s)])
    return eig(np.vstack([to_rate, to_state]), right=False).real.max()


def ellipse(x):
    return np.sqrt(1.0 - x**2)


def test_the_collocated_operator_is_the_singular_integral():
    """Of ``u = (1 - x^2)^(3/2)``, by parts an ordinary principal value: exact for polynomials."""
    x, crack = collocated(40)
    found = crack @ (1.0 - x**2)
    exact = 0.75 * (1.0 - 2.0 * x**2)  # of sqrt(1 - s^2) (1 - s^2) = (3 U_0 - U_2)/4
    np.testing.assert_allclose(found, exact, atol=1e-10)
    s, ds = np.linspace(-1.0, 1.0, 400001, retstep=True)
    slope = -3.0 * s * np.sqrt(1.0 - s**2)
    place = 0.5 * (s[260000] + s[260001])  # between two nodes: the principal value
    integral = np.sum(slope / (s - place)) * ds / (2.0 * np.pi)
    assert -integral == pytest.approx(0.75 * (1.0 - 2.0 * place**2), abs=2e-4)


def test_the_asperity_is_that_of_uenishi_and_rice():
    x, crack = collocated(80)
    values = eig(crack, np.diag(ellipse(x)), right=False).real
    assert pytest.approx(2.0 * values.min(), abs=5e-4) == formulas.FINITE_PATCH


@pytest.mark.parametrize("ratio", [0.3, 0.9])
def test_an_asperity_loses_stability_at_its_length(ratio):
    half = 0.5 * formulas.FINITE_PATCH / (1.0 - ratio)
    uniform = np.ones_like
    assert growth(0.995 * half, ratio, uniform) < 0.0 < growth(1.005 * half, ratio, uniform)


@pytest.mark.parametrize("ratio", [0.05, 0.3, 0.6, 0.9])
def test_a_loaded_patch_loses_stability_at_its_length(ratio):
    """Against the system in time, which knows nothing of frequencies and modes."""
    half = 0.5 * finite_patch.loaded_patch_factor(ratio) / (1.0 - ratio)
    assert growth(0.995 * half, ratio, ellipse) < 0.0 < growth(1.005 * half, ratio, ellipse)


def test_the_factor_without_direct_effect_is_that_of_slip_weakening():
    """State has no time to follow the mode: strength falls by b sigma0/D, whatever V(x)."""
    assert finite_patch.loaded_patch_factor(0.0) == pytest.approx(1.158, abs=1e-3)


def test_the_polynomial_is_as_good_as_what_it_goes_through(monkeypatch):
    ratios = np.array([0.02, 0.11, 0.37, 0.5, 0.77, 0.95, 0.985])
    exact = finite_patch.marginal_loaded_patches(ratios)
    np.testing.assert_allclose(finite_patch.loaded_patch_factor(ratios), exact, rtol=1e-5)
    monkeypatch.setattr(finite_patch, "TERMS", 48)
    monkeypatch.setattr(finite_patch, "NODES", 400)
    finite_patch._basis.cache_clear()
    finer = finite_patch.marginal_loaded_patches(ratios)
    finite_patch._basis.cache_clear()
    np.testing.assert_allclose(exact, finer, rtol=1e-4)


def test_lengths_of_finite_patches():
    a, zeta = np.array([0.0068, 0.02]), np.array([0.016, 0.005])
    found = lengths_in_use(**FAULT, a=a, zeta=zeta)
    scale = STIFFNESS * 5e-7 / (zeta * 1e6)
    np.testing.assert_allclose(found["creeping_asperity"], 1.158 * scale)
    factor = finite_patch.loaded_patch_factor(a / (a + zeta))
    np.testing.assert_allclose(found["loaded_patch"], factor * scale)
    # as Uenishi and Rice's with the weakening of steady states in the place of W
    for i in range(2):
        rate = zeta[i] * 1e6 / 5e-7
        weakening = lengths_in_use(**FAULT, a=a[i], zeta=zeta[i], weakening_rate=rate)
        expected = pytest.approx(float(found["creeping_asperity"][i]))
        assert float(weakening["uenishi_rice"]) == expected
