import dataclasses
import re

import numpy as np
import pytest
from scipy.optimize import brentq, fsolve
from two_bodies import (
    RIGID,
    Body,
    Interface,
    critical_length,
    critical_lengths,
    critical_wavenumber,
    growth_rates,
)

from nucleation.model.material import Material
from nucleation.theory.spectrum import marginal_stiffness
from nucleation.theory.status import NoLength
from nucleation.theory.stiffness import FAR_SIDES

pytestmark = pytest.mark.filterwarnings("error")
MATERIAL = Material(3.1e9, 1 / 3)
MAIN_TEXT = Interface(
    friction=0.41, a=0.0068, zeta=0.016, slip_length=0.5e-6, velocity=1e-5, normal_stress=1e6
)
TABLE_S1 = dataclasses.replace(MAIN_TEXT, friction=0.414, a=0.00682, zeta=0.0156)
HEIGHTS = np.array([0.005, 0.01, 0.02, 0.03, 0.05, 0.07, 0.1])


def crossings(upper, lower, interface, k):
    """Indices before which the fastest root of Eq. (5) changes the sign of its real part."""
    return np.flatnonzero(np.diff(growth_rates(k, upper, lower, interface)[0].real > 0.0))


def printed_equations(unknowns, height, s):
    """Eq. (S-ReIm) with Eq. (10), as printed; unknowns log(k) and omega ell / V."""
    k, omega = np.exp(unknowns[0]), unknowns[1] * s.velocity / s.slip_length
    mu, nu = MATERIAL.shear_modulus, MATERIAL.poisson_ratio
    q, v, ell = height * k, s.velocity, s.slip_length
    denominator = 2 * q**2 + (3 - 4 * nu) * np.cosh(2 * q) - 4 * nu * (3 - 2 * nu) + 5
    g1 = 4 * (1 - nu) * (2 * q + np.sinh(2 * q)) / denominator
    g2 = 4 * (q**2 + (1 - 2 * nu) * np.sinh(q) ** 2) / denominator
    square = v**2 + omega**2 * ell**2
    real = s.normal_stress * omega**2 * ell * (s.a + s.zeta) / square
    imaginary = s.normal_stress * omega * (s.a * omega**2 * ell**2 - s.zeta * v**2) / (v * square)
    scale = s.normal_stress / ell
    return [(mu * k * g1 - real) / scale, (s.friction * g2 * mu * k - imaginary) / scale]


@pytest.mark.parametrize("interface", [MAIN_TEXT, TABLE_S1])
@pytest.mark.parametrize("height", HEIGHTS)
def test_block_on_a_rigid_base_solves_the_printed_equations(interface, height):
    guess = [np.log(2 * np.pi / 0.5), 1.5]
    solution, _, status, _ = fsolve(
        printed_equations, guess, args=(height, interface), full_output=True, xtol=1e-13
    )
    assert status == 1
    point = critical_wavenumber(Body(MATERIAL, height, "free"), RIGID, interface)
    assert point.wavenumber == pytest.approx(np.exp(solution[0]), rel=1e-10)
    assert point.angular_frequency == pytest.approx(solution[1] * 20.0, rel=1e-10)
    assert point.length == pytest.approx(2 * np.pi / point.wavenumber)


def test_numbers_of_figure_3():
    """The theory line at the heights of the simulations (m), to the digits given."""
    expected = [0.23501, 0.32765, 0.45093, 0.53747, 0.65605, 0.73155, 0.79491]
    np.testing.assert_allclose(critical_length(HEIGHTS, MATERIAL, MAIN_TEXT), expected, atol=6e-6)
    ratio = critical_length(HEIGHTS, MATERIAL, TABLE_S1) / expected
    assert np.all((ratio > 1.0125) & (ratio < 1.0245))


def random_system(rng):
    """Two bodies of any kind, at most one rigid, and an interface."""

    def body():
        height = rng.choice([np.inf, 10 ** rng.uniform(-3, 1)])
        material = Material(10 ** rng.uniform(9, 10.5), rng.uniform(-0.3, 0.49))
        return Body(material, float(height), str(rng.choice(list(FAR_SIDES))))

    pair = [body(), body()]
    if (rigid := rng.integers(4)) < 2:
        pair[rigid] = RIGID
    a = 10 ** rng.uniform(-3, -1.5)
    zeta = a * rng.choice([-0.02, -0.001, 0.01, 0.1, 1.0, 5.0]) * rng.uniform(0.2, 2)
    slip_length = 10 ** rng.uniform(-7, -4)
    return *pair, Interface(rng.uniform(0.1, 1.5), a, zeta, slip_length)


@pytest.mark.slow
def test_largest_crossing_of_random_systems():
    """Against a scan of the roots of Eq. (5) over 14 decades; some have two or three crossings."""
    rng = np.random.default_rng(7)
    k = np.geomspace(1e-7, 1e7, 3000)
    counts = []
    for _ in range(400):
        upper, lower, interface = random_system(rng)
        scan = crossings(upper, lower, interface, k)
        counts.append((scan.size, interface.zeta > 0.0))
        if scan.size == 0:
            with pytest.raises(NoLength):
                critical_wavenumber(upper, lower, interface)
            continue
        point = critical_wavenumber(upper, lower, interface)
        assert k[scan[-1]] <= point.wavenumber <= k[scan[-1] + 1]
        roots = growth_rates(point.wavenumber, upper, lower, interface)
        nearest = np.abs(roots - 1j * point.angular_frequency).min()
        assert nearest < 1e-9 * abs(point.angular_frequency)
    assert {(0, False), (0, True), (1, True), (2, False)} <= set(counts)
    assert max(counts)[0] > 2


def test_many_systems_at_once_are_each_alone():
    """To the last bit, in any company and order; none computed twice; NaN where stable."""
    rng = np.random.default_rng(5)
    cases = [random_system(rng) for _ in range(150)]
    lengths = critical_lengths([*cases, *cases[:20]])
    assert np.array_equal(lengths[150:], lengths[:20], equal_nan=True)
    for case, length in zip(cases, lengths, strict=False):
        if np.isnan(length):
            with pytest.raises(NoLength):
                critical_wavenumber(*case)
        else:
            assert critical_wavenumber(*case).length == length
    assert 20 < np.isnan(lengths).sum() < 100
    assert critical_lengths([]).shape == (0,)


@pytest.mark.parametrize("zeta", [0.016, 1e-5, -5e-6, -4e-4])
@pytest.mark.parametrize("rho", [0.03, -0.2, 0.9])
def test_marginal_stiffness_solves_its_quadratic(zeta, rho):
    a, b = 0.0068, 0.0068 + zeta
    expected = np.roots([1 + rho**2, -2 * zeta - rho**2 * b, zeta**2])
    minus, plus = marginal_stiffness(rho, a, zeta)
    if np.iscomplex(expected).any():
        assert np.isnan(minus) and np.isnan(plus)
    else:
        np.testing.assert_allclose([minus, plus], np.sort(expected), rtol=1e-10)


@pytest.mark.parametrize("scale", [1.0, 1e5])
@pytest.mark.parametrize("excess", [1e-5, 1e-3])
def test_narrow_unstable_band_is_found(excess, scale):
    """A held block that becomes unstable, as friction grows, in a band around one wavenumber."""
    upper = Body(Material(2e9, -0.06), 1.3 * scale)
    k = np.geomspace(1e-2, 1e2, 100_000) / scale

    def interface(friction):
        return Interface(friction, 0.0064, 0.0006, 8.3e-7 * scale)

    def fastest(friction):
        return growth_rates(k, upper, RIGID, interface(friction))[0].real.max()

    threshold = brentq(fastest, 0.3, 1.5, xtol=1e-9)
    with pytest.raises(NoLength):
        critical_wavenumber(upper, RIGID, interface(threshold * (1 - excess)))
    state = interface(threshold * (1 + excess))
    scan = crossings(upper, RIGID, state, k)
    assert scan.size == 2
    assert k[scan[1]] / k[scan[0]] < 1.0 + 4.0 * excess**0.5
    point = critical_wavenumber(upper, RIGID, state)
    assert k[scan[1]] <= point.wavenumber <= k[scan[1] + 1]


@pytest.mark.parametrize(
    ("upper", "lower", "changes", "said"),
    [
        (Body(), Body(), {"zeta": -0.001}, "does not weaken"),
        (Body(), Body(), {"zeta": 0.0}, "does not weaken"),
        (Body(), RIGID, {"zeta": -0.005}, "zeta = -0.005"),
        (Body(), RIGID, {"zeta": -0.0068}, "a + zeta = 0 is not positive"),
        (Body(height=0.01, far_side="free"), RIGID, {"zeta": -0.01}, "is not positive"),
        (Body(height=0.01, far_side="free"), RIGID, {"zeta": -0.003}, "does not weaken"),
        (Body(height=0.01), RIGID, {}, "although friction weakens"),
        (Body(height=0.01, far_side="clamped"), RIGID, {}, "the far side clamped (H = 0.01 m)"),
    ],
)
def test_no_instability(upper, lower, changes, said):
    with pytest.raises(NoLength, match=re.escape(said)):
        critical_wavenumber(upper, lower, dataclasses.replace(MAIN_TEXT, **changes))
