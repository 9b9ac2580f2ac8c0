"""Laws and limits of the theory that hold for any pair of bodies and any friction."""

import math

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st
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
from nucleation.theory.closed_forms import bimaterial_length_ratio, thin_limit_length
from nucleation.theory.status import NoLength
from nucleation.theory.stiffness import FAR_SIDES


def powers(low, high):
    """Numbers of any magnitude between powers of ten."""
    return st.floats(low, high).map(lambda exponent: 10.0**exponent)


materials = st.builds(Material, powers(6, 12), st.floats(-0.9, 0.49))
heights = powers(-3, 2) | st.just(math.inf)
bodies = st.builds(Body, materials, heights, st.sampled_from(sorted(FAR_SIDES)))
wavenumbers = powers(-3, 5)
interfaces = st.builds(
    Interface,
    friction=st.floats(0.0, 0.9), a=powers(-3, -1), zeta=powers(-3, -1), slip_length=powers(-7, -2),
    velocity=powers(-12, 0), normal_stress=powers(4, 9),
)  # fmt: skip


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
    tall = [Body(material, number / k, "traction") for material in (upper, lower)]
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
        [critical_wavenumber(Body(material, h, "traction"), RIGID, plain).length for h in heights]
    )
    assert (np.diff(lengths) > 0.0).all()
    assert lengths[0] == pytest.approx(
        float(thin_limit_length(heights[0], fault_of(material, plain))), rel=0.05
    )
    half = critical_wavenumber(Body(material), RIGID, plain).length
    assert lengths[-1] == pytest.approx(half, rel=0.05)
