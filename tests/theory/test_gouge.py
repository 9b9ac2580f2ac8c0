"""A soft layer between rigid walls: nothing is unstable below ``sigma0 = mu D/(zeta h)``."""

import math

import numpy as np
import pytest
from asked import critical_length, transfer_functions

GOUGE = {"shear_modulus": 1e8, "poisson_ratio": 0.3, "height": 2e-3, "far_side": "clamped",
         "second_shear_modulus": math.inf}  # fmt: skip
FRICTION = {"a": 0.005, "zeta": 0.005, "slip_distance": 1e-5, "friction": 0.0}
THRESHOLD = 1e8 * 1e-5 / (0.005 * 2e-3)


def test_long_waves_meet_the_stiffness_of_simple_shear():
    k = np.array([1e-2, 1e-1, 1.0])
    shear, _ = transfer_functions(k, **GOUGE)
    assert 1e8 * k * shear == pytest.approx(1e8 / 2e-3, rel=1e-5)


def test_the_threshold():
    stress = THRESHOLD * np.array([0.5, 0.9999, 1.0001, 2.0])
    stable = np.isnan(critical_length(**GOUGE, **FRICTION, normal_stress=stress))
    assert stable.tolist() == [True, True, False, False]
