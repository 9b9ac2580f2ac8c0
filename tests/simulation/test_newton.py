"""What the compiled passes say of numbers and nodes that do not serve; test_step holds the rest."""

import numpy as np
import pytest

from nucleation.simulation import newton

N = 40
RATIO = 1e-4


@pytest.mark.parametrize("where", [0, 17, N - 1])
def test_an_undefined_residual_is_an_undefined_error(where):
    p, ones = np.zeros(N), np.ones(N + 1)
    p[where] = np.nan
    *_, error = newton.balance(p, ones, ones, ones, np.ones(N), np.ones(N), 1e-3, 0.0)
    assert np.isnan(error)


def test_other_coupled_nodes_are_an_infinite_change():
    elastic = np.ones(N)
    damping = np.where(np.arange(N) % 2 == 0, 1.0, -1e9)  # every other node is coupled
    active = newton.coupled(elastic, damping, RATIO)
    assert newton.change_of_slope(active, damping[active], elastic, damping, RATIO) == 0.0
    replaced = np.sort(np.append(active[1:], 1))
    for others in (active[1:], active[:-1], replaced, np.append(active, N - 1), active[:0]):
        before = damping[others]
        assert newton.change_of_slope(others, before, elastic, damping, RATIO) == np.inf
