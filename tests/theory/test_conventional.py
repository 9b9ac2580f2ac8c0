"""The stiffnesses of the spring block and of a patch."""

import math

import numpy as np
import pytest
from numpy.testing import assert_allclose

from nucleation.model.linearised import InterfaceState
from nucleation.model.material import Material
from nucleation.theory import conventional

INTERFACE = InterfaceState()


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


def test_range_of_eta():
    assert pytest.approx((0.63662, 1.33333), abs=1e-5) == conventional.CONVENTIONAL_ETA
    assert conventional.homogeneous_sliding_eta(1 / 3) == pytest.approx(4.712389)


def test_effective_stiffness():
    stiffness = conventional.effective_stiffness([0.1, 0.2], 0.3, Material(2e9), math.pi)
    assert_allclose(stiffness, [math.pi * 6e9, math.pi * 3e9], rtol=1e-14)
