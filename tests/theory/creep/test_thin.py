"""The thin limit by a second route, and its own limit of strong weakening in closed form."""

import numpy as np
import pytest
from asked import critical_length
from scipy.integrate import quad, solve_ivp
from scipy.optimize import root
from scipy.special import sici
from thin_limit import thin_limit

from nucleation.api import Fault
from nucleation.theory.creep.lengths import stability_answers
from nucleation.theory.creep.response import SLIMMEST, response
from nucleation.theory.evaluation import evaluate


def at_the_edge(ratio, frequency, scale):
    """u(1) of the solution with u(0) = 0, u'(0) = 1; a = 1/ratio and zeta = 1."""
    rate, start = 1j * frequency, 1e-8

    def slope(y, u):
        answer = rate * (rate / ratio - y) / (y * (rate + y))
        return [u[1], scale * answer * u[0]]

    begun = [start + 0j, 1.0 + scale * rate / ratio * start]
    return solve_ivp(slope, (start, 1.0), begun, "DOP853", rtol=1e-11, atol=1e-14).y[0, -1]


def shot(ratio, frequency, length_ratio):
    """Frequency and length by shooting, from a first guess."""

    def both(logarithms):
        end = at_the_edge(ratio, *np.exp(logarithms))
        return [end.real, end.imag]

    found = root(both, np.log([frequency, (2.0 * np.pi * length_ratio) ** 2]), tol=1e-12)
    frequency, scale = np.exp(found.x)
    return np.sqrt(scale) / (2.0 * np.pi), frequency


@pytest.mark.parametrize("ratio", [0.2, 1.0, 2.288, 6.0])
def test_shooting_agrees(ratio):
    found = thin_limit(ratio)
    by_shooting = shot(ratio, 1.02 * found[1], 1.02 * found[0])
    assert found == pytest.approx(by_shooting, rel=1e-7)


def test_strong_weakening():
    """The closed forms of docs/creeping_patch.md, by quadrature.

    With ``e = a/zeta``, ``S = i sqrt(c/e)`` and ``zeta = 1``, Eq. (T) is ``u'' = lambda [-1 +
    i sqrt(e) g + e h] u`` with ``g = sqrt(c)/y - y/sqrt(c)`` and ``h = y^2/c - 1``. At order zero
    ``u = sin(pi y)`` and ``lambda = pi^2``. At order sqrt(e) the mean of g vanishes, which gives c;
    at order e ``lambda = pi^2 (1 + e X)`` with ``X = h_11 + sum g_1n^2/(n^2 - 1)``.
    """
    share = 1.0 / (2.0 * (np.euler_gamma + np.log(2.0 * np.pi) - sici(2.0 * np.pi)[1]))

    def projected(function, n):
        both = lambda y: 2.0 * np.sin(np.pi * y) * np.sin(n * np.pi * y)  # noqa: E731
        return quad(lambda y: function(y) * both(y), 0.0, 1.0, limit=400)[0]

    def first(y):
        return np.sqrt(share) / y - y / np.sqrt(share)

    mean = projected(lambda y: y**2 / share - 1.0, 1)
    others = sum(projected(first, n) ** 2 / (n**2 - 1.0) for n in range(2, 40))
    assert projected(first, 1) == pytest.approx(0.0, abs=1e-9)
    ratio = 1e4
    length_ratio, frequency = thin_limit(ratio)
    assert frequency**2 / (1.0 + ratio) == pytest.approx(share, rel=1e-3)
    assert (2.0 * length_ratio - 1.0) * ratio == pytest.approx(0.5 * (mean + others), rel=1e-3)


LAYER = {
    "shear_modulus": 3.1e9,
    "poisson_ratio": 1.0 / 3.0,
    "friction": 0.0,
    "a": 0.0068,
    "slip_distance": 5e-7,
    "normal_stress": 1e6,
}


@pytest.mark.parametrize("second", [{"second_shear_modulus": np.inf}, {}], ids=["rigid", "same"])
@pytest.mark.parametrize("zeta_over_a", [0.3, 0.5, 1.0, 2.288, 6.0, 20.0])
def test_the_patch_of_a_very_thin_layer_meets_the_limit_within_its_error(zeta_over_a, second):
    """It was 0.3 % short with a stated error of 0.009 %."""
    given = LAYER | second | {"zeta": zeta_over_a * LAYER["a"], "height": 1e-8}
    length, error = stability_answers(Fault(**given))[:2]
    ratio = length / critical_length(**given)
    assert ratio == pytest.approx(thin_limit(zeta_over_a)[0], rel=error)
    assert error < 3e-3


def test_layers_slimmer_than_the_tables_reach_go_on_from_those_that_are_not():
    one = systems(1e-3)
    at = SLIMMEST * 1e-3
    before, after = (response(one, at * factor) for factor in (1.0 - 1e-7, 1.0 + 1e-7))
    largest = np.abs(before.shear).max()
    np.testing.assert_allclose(after.shear, before.shear, atol=2e-6 * largest, rtol=1e-5)


def systems(height):
    given = LAYER | {"zeta": 0.016, "height": height, "second_shear_modulus": np.inf}
    found = []
    evaluate(Fault(**given), lambda own: found.append(own) or np.zeros((1, 1)))
    return found[0]
