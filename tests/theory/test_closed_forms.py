import dataclasses

import numpy as np
import pytest
from layer_problem import reference_transfer
from two_bodies import Body, Interface, critical_wavenumber, fault_of

from nucleation.lengths.formulas import bimaterial
from nucleation.model.material import Material
from nucleation.theory.closed_forms import (
    bimaterial_contrast,
    bimaterial_length_ratio,
    thin_limit_length,
)
from nucleation.theory.status import NoLength

SOFT, STIFF = Material(3.1e9, 1 / 3), Material(9.3e9, 0.2)
INTERFACE = Interface()


def bimaterial_modulus(upper, lower):
    """M (Pa) of Eq. (8)."""
    return bimaterial(
        upper.shear_modulus, upper.poisson_ratio, lower.shear_modulus, lower.poisson_ratio
    )[0]


def largest_crossing(coupling, a, zeta):
    """Largest load g at which a root of Eq. (5) is marginal, for ``G2/G1 f = coupling``.

    Eq. (5) is ``a x^2 + [g (1 - i coupling) - zeta] x + g (1 - i coupling) = 0``, solved by
    numpy.roots on a grid of g that is refined around the topmost change of sign.
    """
    low, high = 1e-9, 2.0 * (a + abs(zeta))
    for _ in range(6):
        loads = np.geomspace(low, high, 400)
        growth = [
            np.roots([a, g * (1 - 1j * coupling) - zeta, g * (1 - 1j * coupling)]).real.max()
            for g in loads
        ]
        unstable = np.flatnonzero(np.array(growth) > 0.0)
        if unstable.size == 0:
            return np.nan
        low, high = loads[unstable[-1]], loads[unstable[-1] + 1]
    return high


@pytest.mark.parametrize("k", [2.0, -5e3])
@pytest.mark.parametrize(("upper", "lower"), [(SOFT, SOFT), (SOFT, STIFF), (STIFF, SOFT)])
def test_bimaterial_constants_are_those_of_the_layer_problem(upper, lower, k):
    """G1 and G2 of half-spaces are ``M sign(k)/(2 mu1)`` and ``beta M/(2 mu1)`` (Eq. 7)."""
    expected = reference_transfer(k, Body(upper), Body(lower), upper.shear_modulus)
    modulus = bimaterial_modulus(upper, lower) / (2.0 * upper.shear_modulus)
    found = [np.sign(k) * modulus, bimaterial_contrast(upper, lower) * modulus]
    np.testing.assert_allclose(found, expected, rtol=1e-14, atol=1e-30)


@pytest.mark.parametrize("f_beta", [0.0, 1e-6, 0.1025, -0.1025, 0.6, 3.0])
@pytest.mark.parametrize("zeta_over_a", [1e-3, 0.1, 2.35, 50.0, -1e-4, -1e-2])
def test_bimaterial_ratio_against_the_roots_of_the_spectrum(f_beta, zeta_over_a):
    a = 0.0068
    load = largest_crossing(f_beta, a, zeta_over_a * a)
    # k_c = 2 g sigma0/(M ell), hence L_c/L_c^M = zeta/g
    expected = zeta_over_a * a / load
    computed = bimaterial_length_ratio(f_beta, zeta_over_a)
    np.testing.assert_allclose(computed, expected, rtol=1e-9)


def test_bimaterial_ratio_limits():
    assert bimaterial_length_ratio(0.0, 0.5) == 1.0
    assert bimaterial_length_ratio(0.2, 0.0) == 0.0
    assert bimaterial_length_ratio(0.2, 1e-14) == pytest.approx(1e-14 * 1.04 / 0.04, rel=1e-9)
    assert np.isnan(bimaterial_length_ratio(0.0, 0.0))
    assert np.isnan(bimaterial_length_ratio(0.5, -1.5))
    assert bimaterial_length_ratio(np.zeros((2, 1)), np.ones(3)).shape == (2, 3)


def test_velocity_strengthening_threshold():
    """``2 sqrt(-a zeta)/(a + zeta)``, Sec. 4."""
    a, zeta = 0.0068, -5e-5
    threshold = 2.0 * np.sqrt(-a * zeta) / (a + zeta)
    assert np.isnan(largest_crossing(threshold * 0.999, a, zeta))
    assert np.isfinite(largest_crossing(threshold * 1.01, a, zeta))
    assert np.isnan(bimaterial_length_ratio(threshold * (1 - 1e-9), zeta / a))
    assert np.isfinite(bimaterial_length_ratio(threshold * (1 + 1e-9), zeta / a))


@pytest.mark.parametrize("zeta", [0.016, 1e-4, -1e-5])
def test_the_ratio_is_that_of_the_theory(zeta):
    """Eq. (9): times ``pi M ell/(zeta sigma0)`` it is the length of two half-spaces."""
    s = dataclasses.replace(INTERFACE, friction=1.5, zeta=zeta)
    scale = np.pi * bimaterial_modulus(SOFT, STIFF) * s.slip_length / (zeta * s.normal_stress)
    ratio = bimaterial_length_ratio(1.5 * bimaterial_contrast(SOFT, STIFF), zeta / s.a)
    found = critical_wavenumber(Body(SOFT), Body(STIFF), s).length
    assert found == pytest.approx(scale * float(ratio), rel=1e-12)


def test_thin_limit():
    """With G1 = 2 Hk/(1 - nu) and G2 = 0 in Eq. (5) both roots are marginal."""
    heights, s, mu = np.array([1e-4, 5e-3]), INTERFACE, SOFT.shear_modulus
    lengths = thin_limit_length(heights, fault_of(SOFT, s))
    for height, length in zip(heights, lengths, strict=True):
        k = 2 * np.pi / length
        gamma = mu * k * 2 * height * k / (1 - SOFT.poisson_ratio) * s.slip_length
        gamma /= s.normal_stress
        roots = np.roots([s.a, gamma - s.zeta, gamma])
        assert np.all(np.abs(roots.real) < 1e-12 * np.abs(roots))


def test_velocity_strengthening_is_refused():
    with pytest.raises(NoLength, match="zeta"):
        thin_limit_length(0.1, fault_of(SOFT, dataclasses.replace(INTERFACE, zeta=-0.001)))
