import dataclasses
import math

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from nucleation.elasticity import Material
from nucleation.stability import InterfaceState, NoInstability, conventional, half_spaces_length

MATERIAL = Material(3.1e9, 1 / 3)
INTERFACE = InterfaceState()  # a/b = 0.298
NEUTRAL = dataclasses.replace(INTERFACE, a=0.02, zeta=0.005)  # a/b = 0.8
PLANE_MODULUS = 3.1e9 / (1 - 1 / 3)
STATE_LENGTH = PLANE_MODULUS * 5e-7 / (0.0228 * 1e6)


def test_critical_spring_stiffness():
    """Linearised slider on a spring: both eigenvalues marginal at K_c per unit area."""
    s, area = INTERFACE, 0.3
    stiffness = conventional.critical_spring_stiffness(s.normal_stress * area, s) / area
    by_rate = s.normal_stress * s.a / s.velocity
    steady_state = s.slip_length / s.velocity
    by_state = s.normal_stress * (s.a + s.zeta) / steady_state
    slip_rate = np.array([-stiffness / by_rate, -by_state / by_rate])
    aging = np.array([0, -1 / steady_state]) - slip_rate / s.velocity
    rates = np.linalg.eigvals([slip_rate, aging])
    assert_allclose(rates.real, 0.0, atol=1e-12 * abs(rates[0]))
    assert rates[0].imag != 0.0


@pytest.mark.parametrize("eta", [*conventional.CONVENTIONAL_ETA, 1.0])
def test_conventional_length_balances_the_stiffnesses(eta):
    area, s = 0.2, INTERFACE
    length = conventional.conventional_length(MATERIAL, s, eta)
    patch = conventional.effective_stiffness(length, area, MATERIAL, eta)
    assert patch == pytest.approx(conventional.critical_spring_stiffness(1e6 * area, s))
    assert length == pytest.approx(eta * 3.1e9 * 5e-7 / (0.016 * 1e6))  # Eq. (3)


def test_range_of_eta():
    assert pytest.approx((0.63662, 1.33333), abs=1e-5) == conventional.CONVENTIONAL_ETA
    assert conventional.homogeneous_sliding_eta(1 / 3) == pytest.approx(4.712389)
    eta = conventional.homogeneous_sliding_eta(MATERIAL.poisson_ratio)
    ours = conventional.conventional_length(MATERIAL, INTERFACE, eta)
    assert ours == pytest.approx(half_spaces_length(MATERIAL, INTERFACE), rel=1e-14)


def test_rice_ruina_length():
    expected = math.pi / 4 * PLANE_MODULUS * 5e-7 / (0.016 * 1e6)
    assert conventional.rice_ruina_length(MATERIAL, INTERFACE) == pytest.approx(expected)
    assert half_spaces_length(MATERIAL, INTERFACE) == pytest.approx(4 * expected)


def crack_coefficients(weakening, terms=60):
    """Slip-rate coefficients ``c_n`` of a patch ``|x| < 1`` under ``weakening * slip``.

    ``slip = sum c_n sin(n theta)``, ``x = cos(theta)``, n odd, resisted elastically by
    ``sum n c_n sin(n theta) / (2 sin theta)`` and loaded by the constant 1.
    """
    n = 2 * np.arange(terms) + 1
    theta = (np.arange(terms) + 0.5) * np.pi / (2 * terms)
    sines = np.sin(np.outer(theta, n))
    elastic = n / 2 * sines / np.sin(theta)[:, None]
    return n, np.linalg.solve(elastic - weakening * sines, np.ones(terms))


def test_uenishi_rice_length():
    """Smallest half-length at which the elastic resistance to some slip is used up by weakening."""

    def inverse(weakening):
        n, c = crack_coefficients(weakening)
        return 1 / np.sum(c * np.sin(n * np.pi / 2))

    half = brentq(inverse, 0.4, 0.7)  # in units of mu*/W
    rate = 4e10
    expected = 2 * half * PLANE_MODULUS / rate
    assert conventional.uenishi_rice_length(MATERIAL, rate) == pytest.approx(expected, rel=5e-4)
    with pytest.raises(ValueError, match="weakening_rate"):
        conventional.uenishi_rice_length(MATERIAL, 0.0)


def test_rubin_ampuero_localised_length():
    """Self-similar acceleration ``dlog v/dt ~ v(0)`` without stress concentration at the tips.

    Elastic stressing ``= sigma0 (a dlog v/dt - b v/D)``; ``a/b`` is the constant over the peak.
    """

    def tip(weakening):
        n, c = crack_coefficients(weakening)
        return np.sum(n * c)

    half = brentq(tip, 1.0, 1.6, xtol=1e-12)  # in units of L_b
    computed = conventional.rubin_ampuero_localised_length(MATERIAL, INTERFACE)
    assert computed == pytest.approx(2 * half * STATE_LENGTH, rel=5e-5)
    n, c = crack_coefficients(half)
    peak = half * np.sum(c * np.sin(n * np.pi / 2))
    assert pytest.approx(-1 / peak, abs=5e-5) == conventional.LOCALISED_LIMIT


def test_rubin_ampuero_crack_length():
    """Energy release rate of a crack of stress drop ``zeta sigma0 log(r)`` against fracture energy.

    ``K^2/(2 mu*) = pi (L/2) drop^2/(2 mu*)`` equals ``b sigma0 D log(r)^2 / 2``.
    """
    s, log_ratio = NEUTRAL, 7.0
    drop = s.zeta * s.normal_stress * log_ratio
    fracture_energy = (s.a + s.zeta) * s.normal_stress * s.slip_length * log_ratio**2 / 2
    half = fracture_energy * 2 * PLANE_MODULUS / (math.pi * drop**2)
    computed = conventional.rubin_ampuero_crack_length(MATERIAL, s)
    assert computed == pytest.approx(2 * half, rel=1e-12)


def test_thin_layer_length():
    """``E H W'' = sigma0 (a - b W)``, slip rate ``v = D W/(t_end - t)``, from the edge inwards."""
    height, s = 1e-3, INTERFACE
    modulus = 2 * PLANE_MODULUS * height * s.slip_length
    b = s.a + s.zeta

    def bend(x, w):
        return [w[1], s.normal_stress * (s.a - b * w[0]) / modulus]

    def edge(x, w):
        return w[1]

    edge.terminal, edge.direction = True, -1  # the peak: half the patch
    solution = solve_ivp(bend, (0, 1.0), [0, 0], events=edge, rtol=1e-10, atol=1e-14)
    half, (peak, _) = solution.t_events[0][0], solution.y_events[0][0]
    computed = conventional.thin_layer_length([height, 4 * height], MATERIAL, s)
    assert_allclose(computed, [2 * half, 4 * half], rtol=1e-7)
    assert peak == pytest.approx(2 * s.a / b)  # below one, where the state still ages, if a/b < 1/2


def test_edges_of_the_ranges_of_validity():
    def interface(ratio):
        return dataclasses.replace(INTERFACE, a=0.02 * ratio, zeta=0.02 * (1 - ratio))

    assert conventional.rubin_ampuero_localised_length(MATERIAL, interface(0.378)) > 0.0
    assert conventional.rubin_ampuero_crack_length(MATERIAL, interface(0.501)) > 0.0
    assert conventional.thin_layer_length(0.01, MATERIAL, interface(0.499)) > 0.0
    for ratio, length in [
        (0.379, conventional.rubin_ampuero_localised_length),
        (0.499, conventional.rubin_ampuero_crack_length),
        (1.001, conventional.rubin_ampuero_crack_length),
        (0.501, lambda m, s: conventional.thin_layer_length(0.01, m, s)),
    ]:
        with pytest.raises(ValueError, match="a/b ="):
            length(MATERIAL, interface(ratio))


def test_state_evolution_length():
    computed = conventional.state_evolution_length(MATERIAL, INTERFACE)
    assert computed == pytest.approx(STATE_LENGTH)


@pytest.mark.parametrize(
    ("length", "interface"),
    [
        (conventional.rubin_ampuero_localised_length, NEUTRAL),
        (conventional.rubin_ampuero_crack_length, INTERFACE),
        (lambda m, s: conventional.thin_layer_length(0.01, m, s), NEUTRAL),
        (conventional.rubin_ampuero_localised_length, InterfaceState(a=0.01, zeta=-0.02)),
        (conventional.rubin_ampuero_crack_length, InterfaceState(a=0.01, zeta=-0.001)),
    ],
)
def test_range_of_validity(length, interface):
    with pytest.raises(ValueError, match="a/b ="):
        length(MATERIAL, interface)


@pytest.mark.parametrize(
    "length",
    [
        lambda m, s: conventional.conventional_length(m, s, 1.0),
        conventional.rice_ruina_length,
        conventional.state_evolution_length,
    ],
)
def test_strengthening_is_refused(length):
    with pytest.raises(NoInstability, match="zeta"):
        length(MATERIAL, InterfaceState(a=0.01, zeta=-0.02))
