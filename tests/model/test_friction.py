"""The paper's friction law and its evolutions against root finding and the paper's numbers.

What holds for every law is in test_laws.py.
"""

import numpy as np
import pytest

from nucleation.model.friction import Friction
from replication.tables.curves import logarithmic_friction

LAW = Friction(law="product")
RATES = np.array([1e-13, 1e-9, 1e-7, 1e-5, 1e-3, 1.0])
STATES = np.array([1e-6, 3.3e-4, 0.05, 1.0, 500.0])


def written_out(v, phi):
    """Eq. (S-f) with Table S1, typed in once more."""
    aging = 1 + 0.075 * np.log(1 + phi / 3.3e-4)
    return aging * ((5 / 18) / np.sqrt(1 + (1e-9 / v) ** 2) + 0.005 * np.log(1 + v / 1e-7))


def test_coefficient_is_the_papers():
    v, phi = np.meshgrid(RATES, STATES)
    np.testing.assert_allclose(LAW.coefficient(v, phi), written_out(v, phi), rtol=1e-12)


def test_state_rate_is_the_papers():
    v, phi = np.meshgrid(RATES, STATES)
    omega = phi * np.sqrt(v**2 + 1e-18) / 5e-7
    for evolution, expected in (("aging", 1 - omega), ("slip", -omega * np.log(omega))):
        found = Friction(law="product", evolution=evolution).state_rate(v, phi)
        np.testing.assert_allclose(found, expected)
    assert LAW.steady_state(0.0) == pytest.approx(500.0)  # D/v0


def test_expansion_gives_the_papers_numbers():
    """f0 = 0.414, a = 0.00682, zeta = 0.0156 (Text S2.1), from Table S1 alone."""
    f0, a, zeta = LAW.expansion(1e-5)
    assert round(f0, 3) == 0.414
    assert round(a, 5) == 0.00682
    assert round(zeta, 4) == 0.0156


def test_logarithmic_law_touches_the_full_one():
    """Value and first derivatives agree at the point of expansion (Eq. S-log)."""
    v, phi, h = 1e-5, 0.05, 1e-4
    assert logarithmic_friction(LAW, v, phi, v) == pytest.approx(LAW.coefficient(v, phi), rel=1e-9)
    for dv, dphi in ((h, 0.0), (0.0, h)):
        fast, slow = (v * (1 + dv), phi * (1 + dphi)), (v * (1 - dv), phi * (1 - dphi))
        full = LAW.coefficient(*fast) - LAW.coefficient(*slow)
        log = logarithmic_friction(LAW, *fast, v) - logarithmic_friction(LAW, *slow, v)
        assert log == pytest.approx(full, rel=1e-4)
