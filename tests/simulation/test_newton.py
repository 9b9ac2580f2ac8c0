"""Compiled passes over the nodes against the same in whole arrays, to the last bit."""

import numpy as np
import pytest
from numpy.testing import assert_array_equal

from nucleation.simulation import newton

N = 40
RATIO = 1e-4


@pytest.fixture
def nodes():
    """Elasticity and damping of nodes of which about half are coupled, and random numbers."""
    random = np.random.default_rng(1)
    elastic = random.uniform(0.5, 2.0, N)
    damping = 10.0 ** random.uniform(0.0, 8.0, N)
    damping[::7] *= -1.0  # where friction weakens
    damping[-1] = 1e9  # the last one is alone
    return elastic, damping, random


def test_balance(nodes):
    elastic, _, random = nodes
    p, normal, f, slope = (random.normal(size=N + i) for i in (0, 1, 1, 1))
    resolved, tolerance, rounding = random.uniform(1.0, 2.0, N), 1e-3, 1e-4
    residual, damping, error = newton.balance(
        p, normal, f, slope, elastic, resolved, tolerance, rounding
    )
    assert_array_equal(residual, p + f[1:] * normal[1:])
    assert_array_equal(damping, slope[1:] * normal[1:])
    scale = (elastic + np.abs(damping)) * (tolerance * resolved) + elastic * rounding
    assert error == np.max(np.abs(residual) / scale)


@pytest.mark.parametrize("where", [0, 17, N - 1])
def test_an_undefined_residual_is_an_undefined_error(nodes, where):
    elastic, _, random = nodes
    p, ones = random.normal(size=N), np.ones(N + 1)
    p[where] = np.nan
    *_, error = newton.balance(p, ones, ones, ones, elastic, np.ones(N), 1e-3, 0.0)
    assert np.isnan(error)


def test_coupled_nodes_and_the_change_of_their_slope(nodes):
    elastic, damping, random = nodes
    active = newton.coupled(elastic, damping, RATIO)
    assert_array_equal(active, np.flatnonzero(elastic > RATIO * np.abs(damping)))
    assert 5 < active.size < N - 5
    before = damping[active] * random.uniform(0.5, 1.5, active.size)
    expected = np.abs(damping[active] - before) / (elastic[active] + np.abs(before))
    found = newton.change_of_slope(active, before, elastic, damping, RATIO)
    assert found == expected.max()


def test_other_coupled_nodes_are_an_infinite_change(nodes):
    elastic, damping, _ = nodes
    active = newton.coupled(elastic, damping, RATIO)
    alone = np.setdiff1d(np.arange(N), active)
    assert alone[-1] > active[-1]
    replaced = np.sort(np.append(active[1:], alone[0]))
    for others in (active[1:], active[:-1], replaced, np.append(active, alone[-1]), active[:0]):
        before = damping[others]
        assert newton.change_of_slope(others, before, elastic, damping, RATIO) == np.inf


def test_newton_matrix(nodes):
    elastic, damping, random = nodes
    active = newton.coupled(elastic, damping, RATIO)
    shape, f, beta = (active.size, active.size), random.uniform(0.2, 0.8, N), 0.3
    stiffness, coupling = (random.normal(size=shape).astype(np.float32) for _ in range(2))
    expected = beta * (stiffness + f[active, None].astype(np.float32) * coupling)
    expected[np.diag_indices_from(expected)] += damping[active]
    newton.newton_matrix(stiffness, coupling, f, damping, active, beta)
    assert_array_equal(stiffness, expected)


def test_uncoupled_and_moved(nodes):
    elastic, damping, random = nodes
    residual, v, past, start = (random.normal(size=N) for _ in range(4))
    assert_array_equal(
        newton.uncoupled(residual, elastic, damping), residual / -(elastic + damping)
    )
    w, change = newton.moved(v, 0.7, 0.3, past, start)
    assert_array_equal(w, past + 0.3 * (v - 0.7))
    assert_array_equal(change, w - start)


def test_updated(nodes):
    random = nodes[2]
    v, change, v0 = random.normal(size=N), random.normal(size=N), 0.5
    v[:2], change[:2] = 1.0, -np.sqrt(1.25) * np.array([0.49, 0.51])
    new, shrinking = newton.updated(v, change, v0)
    assert_array_equal(new, v + change)
    ratio = change / np.sqrt(v * v + v0**2)
    assert_array_equal(shrinking, np.flatnonzero((np.abs(ratio) > 0.5) & (v * change < 0.0)))
    assert 3 < shrinking.size < N - 3
