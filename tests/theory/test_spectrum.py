import warnings

import numpy as np
import pytest
from two_bodies import RIGID, Body, Interface, growth_rates, transfer_functions

from nucleation.model.material import Material

INTERFACE = Interface(
    friction=0.6, a=0.0068, zeta=0.016, slip_length=5e-7, velocity=3e-5, normal_stress=2e6
)
SOFT, STIFF = Material(3.1e9, 1 / 3), Material(2.4e10, 0.2)
PAIRS = [
    (Body(SOFT, 0.01, "free"), RIGID),
    (Body(SOFT, 0.02), Body(STIFF, 0.05, "free")),
    (RIGID, Body(STIFF)),
    (Body(SOFT), Body(SOFT)),
]


def linear_dynamics(k, upper, lower, s):
    """Matrix of ``d/dt (slip, state)`` for ``f = f0 + a log v + b log phi`` and the aging law."""
    mu = (upper if isinstance(upper, Body) else lower).material.shear_modulus
    g1, g2 = transfer_functions(k, upper, lower)
    steady_state = s.slip_length / s.velocity
    by_rate = s.normal_stress * s.a / s.velocity
    by_state = s.normal_stress * (s.a + s.zeta) / steady_state
    elastic = -mu * k * g1 + s.friction * 1j * mu * k * g2  # dsigma_xy + f dsigma_yy per slip
    slip_rate = np.array([elastic / by_rate, -by_state / by_rate])
    aging = np.array([0, -1 / steady_state]) - steady_state / s.slip_length * slip_rate
    return np.array([slip_rate, aging])


def distance(pairs, others):
    """Relative distance of two arrays of root pairs, whatever the order within a pair."""
    return np.minimum(
        np.max(np.abs(pairs - others) / np.abs(others), axis=0),
        np.max(np.abs(pairs[::-1] - others) / np.abs(others), axis=0),
    )


@pytest.mark.parametrize(("upper", "lower"), PAIRS)
@pytest.mark.parametrize("zeta", [0.016, -0.003, -0.009])
def test_growth_rates_are_eigenvalues_of_the_dynamics(upper, lower, zeta):
    interface = Interface(friction=0.6, a=0.0068, zeta=zeta, velocity=3e-5)
    wavenumbers = np.concatenate([np.geomspace(0.3, 300, 20), -np.geomspace(0.3, 300, 5)])
    computed = growth_rates(wavenumbers, upper, lower, interface)
    assert np.all(computed[0].real >= computed[1].real)
    for k, rates in zip(wavenumbers, computed.T, strict=True):
        expected = np.linalg.eigvals(linear_dynamics(k, upper, lower, interface))
        assert distance(rates, expected) < 1e-11


@pytest.mark.parametrize(("upper", "lower"), PAIRS)
def test_growth_rates_satisfy_the_spectrum_equation(upper, lower):
    """Eq. (5) as printed, at wavenumbers where the two roots differ by many orders."""
    s, k = INTERFACE, np.geomspace(1e-6, 1e6, 50)
    mu = (upper if isinstance(upper, Body) else lower).material.shear_modulus
    g1, g2 = transfer_functions(k, upper, lower)
    elastic = mu * k * (g1 - 1j * s.friction * g2)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        rates = growth_rates(k, upper, lower, s)
    rate = s.velocity / s.slip_length
    friction = s.normal_stress * rates * (s.a * rates / rate - s.zeta)
    residual = elastic * (s.velocity + rates * s.slip_length) + friction
    size = np.abs(elastic) * (s.velocity + np.abs(rates) * s.slip_length)
    size += s.normal_stress * np.abs(rates) * (s.zeta + s.a * np.abs(rates) / rate)
    assert np.all(np.abs(residual) < 1e-14 * size)
