"""Lengths of the literature against independent mechanics, limits and relations among them."""

import math

import numpy as np
import pytest
from asked import lengths_in_use
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp
from scipy.optimize import brentq
from two_bodies import Body, Interface, fault_of, transfer_functions

from nucleation.api import Fault
from nucleation.lengths import formulas
from nucleation.lengths.formulas import TWO_MATERIALS
from nucleation.lengths.in_use import LENGTHS, expanding_length
from nucleation.model.material import Material
from nucleation.model.quantities import ParameterError
from nucleation.theory import closed_forms

ROCK = {"shear_modulus": 3.1e9, "poisson_ratio": 1 / 3}
LOAD = {"normal_stress": 1e6, "slip_distance": 5e-7}
WEAKENING = {"a": 0.0068, "zeta": 0.016}  # a/b = 0.298
NEUTRAL = {"a": 0.02, "zeta": 0.005}  # a/b = 0.8
PLANE_MODULUS = 3.1e9 / (1 - 1 / 3)
STATE_LENGTH = PLANE_MODULUS * 5e-7 / (0.0228 * 1e6)


def one(key, **changes):
    """One length (m) of the usual fault with other values."""
    fault = ROCK | LOAD | WEAKENING | changes
    return lengths_in_use(**fault)[key]


@pytest.mark.parametrize("eta", [*formulas.CONVENTIONAL_ETA, 1.0])
def test_conventional_length_makes_a_slider_marginal(eta):
    """Its stiffness ``eta mu/L`` is that of a spring (Pa/m) at which steady sliding is neutral."""
    s, mu = Interface(), 3.1e9
    friction = s.a, s.a + s.zeta, s.zeta
    setting = formulas.Setting(mu, 0.3, s.normal_stress, *friction, s.slip_length, math.inf, 0.0)
    length = setting.conventional(eta)
    by_rate = s.normal_stress * s.a / s.velocity
    steady_state = s.slip_length / s.velocity
    by_state = s.normal_stress * (s.a + s.zeta) / steady_state
    slip_rate = np.array([-eta * mu / length / by_rate, -by_state / by_rate])
    aging = np.array([0, -1 / steady_state]) - slip_rate / s.velocity
    rates = np.linalg.eigvals([slip_rate, aging])
    assert_allclose(rates.real, 0.0, atol=1e-12 * abs(rates[0]))
    assert rates[0].imag != 0.0


def test_closed_forms_of_the_paper():
    """Eqs. (6) and (11) as the theory has them, for one fault at a time."""
    fault = fault_of(Material(3.1e9, 1 / 3), Interface())
    expected = math.pi * 3.1e9 * 5e-7 / (0.016 * (1 - 1 / 3) * 1e6)
    assert one("homogeneous_sliding") == pytest.approx(expected, rel=1e-14)
    height = np.array([1e-4, 1e-3])
    expected = closed_forms.thin_limit_length(height, fault)
    assert_allclose(one("thin_limit", height=height), expected, rtol=1e-14)


def test_relations():
    """What the definitions imply between lengths of one fault."""
    full = one("homogeneous_sliding")
    assert full == pytest.approx(4 * one("rice_ruina"))
    ratio = one("dieterich_longest") / one("dieterich_shortest")
    assert ratio == pytest.approx(2 * math.pi / 3)
    assert full / one("dieterich_longest") == pytest.approx(math.pi / (1 - 1 / 3) / (4 / 3))
    assert one("state_evolution") == pytest.approx(STATE_LENGTH)
    small = {"a": 0.001, "zeta": 0.0218}
    assert one("uenishi_rice", **small) == pytest.approx(1.158 * STATE_LENGTH)
    assert one("uenishi_rice", weakening_rate=0.0228e6 / 5e-7) == one("uenishi_rice", **small)


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
    assert one("uenishi_rice", weakening_rate=rate) == pytest.approx(expected, rel=5e-4)
    with pytest.raises(ParameterError, match=r"weakening_rate = 0.0 Pa/m is not allowed"):
        one("uenishi_rice", weakening_rate=0.0)


def test_rubin_ampuero_localised_length():
    """Self-similar acceleration ``dlog v/dt ~ v(0)`` without stress concentration at the tips.

    Elastic stressing ``= sigma0 (a dlog v/dt - b v/D)``; ``a/b`` is the constant over the peak.
    """

    def tip(weakening):
        n, c = crack_coefficients(weakening)
        return np.sum(n * c)

    half = brentq(tip, 1.0, 1.6, xtol=1e-12)  # in units of L_b
    assert one("rubin_ampuero_localised") == pytest.approx(2 * half * STATE_LENGTH, rel=5e-5)
    n, c = crack_coefficients(half)
    peak = half * np.sum(c * np.sin(n * np.pi / 2))
    assert pytest.approx(-1 / peak, abs=5e-5) == formulas.LOCALISED_LIMIT


def test_rubin_ampuero_crack_length():
    """Energy release rate of a crack of stress drop ``zeta sigma0 log(r)`` against fracture energy.

    ``K^2/(2 mu*) = pi (L/2) drop^2/(2 mu*)`` equals ``b sigma0 D log(r)^2 / 2``.
    """
    log_ratio = 7.0
    drop = 0.005 * 1e6 * log_ratio
    fracture_energy = 0.025 * 1e6 * 5e-7 * log_ratio**2 / 2
    half = fracture_energy * 2 * PLANE_MODULUS / (math.pi * drop**2)
    assert one("rubin_ampuero_crack", **NEUTRAL) == pytest.approx(2 * half, rel=1e-12)


def test_expanding_length_at_a_finite_slip_rate():
    """Energy release rate against fracture energy, stresses by the friction law itself.

    Far ahead v_far and phi; within, steady sliding at v; at the tip v with the state from ahead.
    """
    a, b, sigma, slip_distance = 0.02, 0.025, 1e6, 5e-7
    rate, far_rate, far_ratio = 1e-2, 3e-9, 40.0
    far_state = far_ratio * slip_distance / far_rate

    def stress(v, phi):
        return sigma * (a * math.log(v) + b * math.log(phi))

    residual = stress(rate, slip_distance / rate)
    drop = stress(far_rate, far_state) - residual
    peak = stress(rate, far_state) - residual
    fracture_energy = 0.5 * slip_distance / (b * sigma) * peak**2  # b sigma0 falls per slip D
    half = fracture_energy * 2 * PLANE_MODULUS / (math.pi * drop**2)
    found = expanding_length(Fault(**ROCK, **LOAD, **NEUTRAL), rate, far_rate, far_ratio)
    assert float(found) == pytest.approx(2 * half, rel=1e-12)


def test_limits_of_the_expanding_length_at_a_finite_slip_rate():
    fault = Fault(**ROCK, **LOAD, **NEUTRAL)
    asymptote = one("rubin_ampuero_crack", **NEUTRAL)
    assert float(expanding_length(fault, 1e-3, 1e-8, 1.0)) == pytest.approx(asymptote, rel=1e-12)
    # above steady state the zone is shorter, and reaches the asymptote from below
    found = expanding_length(fault, np.array([1e-3, 1e3, 1e200]), 1e-8, 10.0)
    assert (np.diff(found) > 0.0).all() and found[-1] == pytest.approx(asymptote, rel=0.05)
    assert np.isnan(expanding_length(fault, 1e-9, 1e-8, 1.0))  # slower than far ahead
    assert np.isnan(expanding_length(fault, 1e-7, 1e-8, 1e-3))  # no stress drop
    localised = Fault(**ROCK, **LOAD, **WEAKENING)
    assert np.isnan(expanding_length(localised, 1e-3, 1e-8, 1.0))


def test_thin_layer_length():
    """``E H W'' = sigma0 (a - b W)``, slip rate ``v = D W/(t_end - t)``, from the edge inwards."""
    height = 1e-3
    modulus = 2 * PLANE_MODULUS * height * 5e-7

    def bend(x, w):
        return [w[1], 1e6 * (0.0068 - 0.0228 * w[0]) / modulus]

    def edge(x, w):
        return w[1]

    edge.terminal, edge.direction = True, -1  # the peak: half the patch
    solution = solve_ivp(bend, (0, 1.0), [0, 0], events=edge, rtol=1e-10, atol=1e-14)
    half, (peak, _) = solution.t_events[0][0], solution.y_events[0][0]
    computed = one("thin_layer", height=[height, 4 * height])
    assert_allclose(computed, [2 * half, 4 * half], rtol=1e-7)
    # below one, where the state still ages, if a/b < 1/2
    assert peak == pytest.approx(2 * 0.0068 / 0.0228)


@pytest.mark.parametrize(
    ("key", "inside", "outside"),
    [
        ("rubin_ampuero_localised", [0.01, 0.378], [0.3782, 0.9, 1.2]),
        ("rubin_ampuero_crack", [0.501, 0.999], [0.499, 0.1, 1.001]),
        ("thin_layer", [0.01, 0.499], [0.501, 1.2]),
        ("rice_ruina", [0.01, 0.999], [1.0, 1.2]),
        ("homogeneous_sliding", [0.01, 0.999], [1.0, 1.2]),
        ("dieterich_shortest", [0.999], [1.0]),
        ("dieterich_longest", [0.999], [1.0]),
        ("thin_limit", [0.01, 0.9], [1.0, 1.2]),
        ("state_evolution", [0.01, 1.2], []),
        ("uenishi_rice", [0.01, 0.099], [0.101, 0.9, 1.2]),
        ("creeping_asperity", [0.01, 0.999], [1.0, 1.2]),
        ("loaded_patch", [0.01, 0.989], [0.991, 1.0, 1.2]),
    ],
)
def test_ranges_of_validity_in_a_over_b(key, inside, outside):
    def length(ratio):
        return one(key, a=0.02 * ratio, zeta=0.02 * (1 - ratio), height=1e-5)

    assert all(length(ratio) > 0.0 for ratio in inside)
    assert all(np.isnan(length(ratio)) for ratio in outside)


TWO = {"friction": 0.6, "second_shear_modulus": 4e9, "second_poisson_ratio": 0.3}


@pytest.mark.parametrize("second", [4e9, 1e9, 9.9e11, math.inf])
@pytest.mark.parametrize("key", [x.key for x in LENGTHS if x.system == TWO_MATERIALS])
def test_lengths_of_two_materials_have_the_modulus_of_the_pair(key, second):
    pair = TWO | {"second_shear_modulus": second, "friction": 0.01, "a": 0.0001, "zeta": 0.0227}
    if "crack" in key:
        pair |= NEUTRAL
    k, finite = 1.0, min(second, 9.9e12)  # Eq. (7): G1 = M/(2 mu1) sign(k)
    g1, _ = transfer_functions(k, Body(Material(3.1e9, 1 / 3)), Body(Material(finite, 0.3)))
    modulus = 2.0 * 3.1e9 * float(g1)
    alone = one(key.removesuffix("_two_materials"), **{k: pair[k] for k in ("a", "zeta")})
    assert one(key, **pair) == pytest.approx(alone * modulus / PLANE_MODULUS, rel=1e-3)
