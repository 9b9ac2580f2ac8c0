"""Closed forms, and laws and limits of the theory for any pair of bodies and any friction."""

import dataclasses
import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from layer_problem import reference_transfer
from two_bodies import (
    RIGID,
    Body,
    Interface,
    critical_wavenumber,
    fault_of,
    growth_rates,
    transfer_functions,
)

from nucleation.lengths.formulas import bimaterial
from nucleation.model.material import Material
from nucleation.theory.closed_forms import (
    bimaterial_contrast,
    bimaterial_length_ratio,
    thin_limit_length,
)
from nucleation.theory.status import NoLength
from nucleation.theory.stiffness import FAR_SIDES

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


def powers(low, high):
    """Numbers of any magnitude between powers of ten."""
    return st.floats(low, high).map(lambda exponent: 10.0**exponent)


materials = st.builds(Material, powers(6, 12), st.floats(-0.9, 0.49))
heights = powers(-3, 2) | st.just(math.inf)
bodies = st.builds(Body, materials, heights, st.sampled_from(sorted(FAR_SIDES)))
wavenumbers = powers(-3, 5)
interfaces = st.builds(
    Interface,
    friction=st.floats(0.0, 0.9),
    a=powers(-3, -1),
    zeta=powers(-3, -1),
    slip_length=powers(-7, -2),
    velocity=powers(-12, 0),
    normal_stress=powers(4, 9),
)


@given(wavenumbers, bodies, bodies)
def test_exchange_of_the_bodies_reverses_the_coupling(k, upper, lower):
    g1, g2 = transfer_functions(k, upper, lower)
    other = np.array(transfer_functions(k, lower, upper))
    other *= lower.material.shear_modulus / upper.material.shear_modulus
    assert other[0] == pytest.approx(float(g1), rel=1e-9)
    assert other[1] == pytest.approx(float(-g2), rel=1e-6, abs=1e-9 * float(g1))


@given(wavenumbers, bodies)
def test_mirror_images_do_not_couple(k, body):
    g1, g2 = transfer_functions(k, body, body)
    assert abs(g2) <= 1e-12 * g1
    rigid, _ = transfer_functions(k, body, RIGID)
    assert g1 <= rigid  # a body that gives way as well makes the pair softer


@given(powers(0, 5), st.floats(40.0, 1e6), materials, materials)
def test_tall_layers_are_half_spaces(k, number, upper, lower):
    tall = [Body(material, number / k, "free") for material in (upper, lower)]
    found = np.ravel(transfer_functions(k, *tall))
    modulus, beta = bimaterial(
        upper.shear_modulus, upper.poisson_ratio, lower.shear_modulus, lower.poisson_ratio
    )
    expected = modulus / (2.0 * upper.shear_modulus) * np.array([1.0, beta])  # Eq. (7)
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9 * expected[0])


@given(st.floats(0.0, 3.0), st.floats(0.0, 1.0), powers(-4, 3))
def test_more_coupling_is_shorter(f_beta, more, zeta_over_a):
    one, other = bimaterial_length_ratio([f_beta, f_beta + more], zeta_over_a)
    assert 0.0 < other <= one * (1.0 + 1e-12) <= 1.0 + 1e-12
    assert bimaterial_length_ratio(-f_beta, zeta_over_a) == one


@settings(max_examples=25)
@given(bodies, bodies | st.just(RIGID), interfaces, powers(-2, 2))
def test_only_ratios_of_lengths_matter(upper, lower, interface, scale):
    """With heights and slip length so many times as large, so is the critical length.

    At the stress below which held layers are stable it is infinite, and decided by round-off.
    """

    def scaled(body):
        return body if body is RIGID else Body(body.material, body.height * scale, body.far_side)

    values = vars(interface) | {"slip_length": interface.slip_length * scale}
    larger = Interface(**values)
    assume(larger.slip_length < 1e3)
    try:
        length = critical_wavenumber(upper, lower, interface).length
    except NoLength:
        return  # a thin held layer is a stiff spring
    assume(length < 1e4 * min(body.height for body in (upper, lower) if body is not RIGID))
    found = critical_wavenumber(scaled(upper), scaled(lower), larger).length
    assert found == pytest.approx(scale * length, rel=1e-6)


@settings(max_examples=25)
@given(bodies, bodies | st.just(RIGID), interfaces, st.floats(1.0, 10.0))
def test_nothing_grows_beyond_the_critical_wavenumber(upper, lower, interface, further):
    try:
        point = critical_wavenumber(upper, lower, interface)
    except NoLength:
        return
    k = point.wavenumber * np.array([1.0, 1.0 + 1e-6, 1.0 + further])
    fastest = growth_rates(k, upper, lower, interface).real.max(axis=0)
    size = np.abs(growth_rates(k[0], upper, lower, interface)).max()
    assert abs(fastest[0]) <= 1e-6 * size
    assert (fastest[1:] <= 1e-9 * size).all()


@settings(max_examples=25)
@given(materials, interfaces, powers(-6, -4), powers(2, 4))
def test_block_lies_between_its_limits(material, interface, thin, tall):
    """From the root of Eq. (11), friction being small, to a half-space on a rigid base."""
    plain = Interface(**vars(interface) | {"friction": 0.0})
    unit = critical_wavenumber(Body(material), Body(material), plain).length
    heights = np.array([thin, 0.01, 1.0, tall]) * unit
    assume((heights > 1e-9).all() and (heights < 1e9).all())
    lengths = np.array(
        [critical_wavenumber(Body(material, h, "free"), RIGID, plain).length for h in heights]
    )
    assert (np.diff(lengths) > 0.0).all()
    assert lengths[0] == pytest.approx(
        float(thin_limit_length(heights[0], fault_of(material, plain))), rel=0.05
    )
    half = critical_wavenumber(Body(material), RIGID, plain).length
    assert lengths[-1] == pytest.approx(half, rel=0.05)
