"""The frozen patch's spectrum against differences of the nonlinear equations."""

import numpy as np
import pytest
from scipy.linalg import eig
from scipy.optimize import brentq

from nucleation.extraction.growth import frozen_patch
from nucleation.fem.body import Body
from nucleation.fem.grid import Grid
from nucleation.fem.operator import Operator
from nucleation.model.friction import Friction
from nucleation.run.run import PAPER_RUN

GRID = Grid(0.8, 0.02, 32, 5)
OPERATOR = Operator(Body((GRID, PAPER_RUN.upper.material)), 0.0)
RATE = np.where(GRID.x < 0.26, 1e-5 * np.exp(-GRID.x / 0.3), 1e-12)
STATE = 0.07 * (1 + GRID.x)
FORCE = 1e6 * (1 + 0.1 * np.cos(5 * GRID.x)) * GRID.nodal_lengths


@pytest.fixture(params=["aging", "slip"])
def friction(request):
    return Friction(law="product", evolution=request.param)


@pytest.fixture
def patch(friction):
    return frozen_patch(OPERATOR, friction, RATE, STATE, FORCE, 1e-7)


def test_spectrum_equals_that_of_differences(friction, patch):
    """Jacobian of (dw/dt, dpsi/dt), v from nodal force balance by bracketing."""
    nodes, n = patch.nodes, patch.nodes.size
    assert n == 10
    base = -friction.coefficient(RATE, STATE)[nodes] * FORCE[nodes]

    def time_derivative(z):
        w = np.zeros(GRID.n_x)
        w[nodes - 1] = z[:n]
        psi = np.log(STATE[nodes]) + z[n:]
        p, normal = OPERATOR.apply(w)
        p, normal = base + p[nodes - 1], FORCE[nodes] + normal[nodes]
        v = np.array(
            [
                brentq(lambda v, i=i: p[i] + friction.coefficient(v, np.exp(psi[i])) * normal[i],
                       1e-14, 1.0, xtol=1e-22, rtol=1e-14)
                for i in range(n)
            ]
        )  # fmt: skip
        return np.append(v, friction.state_rate(v, np.exp(psi)) * np.exp(-psi))

    steps = np.append(np.full(n, 1e-12), np.full(n, 1e-6))
    columns = [
        (time_derivative(unit) - time_derivative(-unit)) / (2 * step)
        for unit, step in zip(np.diag(steps), steps, strict=True)
    ]
    reference = np.linalg.eigvals(np.array(columns).T)
    reference = reference[np.argsort(-reference.real)]
    first, found = reference[:4], patch.eigenvalues[:4]
    scale = np.abs(first).max()
    np.testing.assert_allclose(found.real, first.real, atol=1e-4 * scale)
    np.testing.assert_allclose(np.abs(found.imag), np.abs(first.imag), atol=1e-3 * scale)


def test_modes_and_amplitudes_are_eigenvectors_of_the_whole_matrix(patch):
    """Right and left eigenvectors of the matrix, of twice the size, by LAPACK."""
    values, left, right = eig(patch.matrix, left=True)
    for i in np.argsort(-values.real)[:6]:
        w, log_state = patch.mode(values[i])
        own = np.concatenate([w, log_state])
        assert np.abs(w).max() == pytest.approx(1.0)
        known = right[:, i] / right[np.abs(right[: w.size, i]).argmax(), i]
        np.testing.assert_allclose(own, known, rtol=0, atol=1e-6 * np.abs(known).max())
        weights = patch.amplitude(values[i])
        known = left[:, i].conj() / (left[:, i].conj() @ own)
        np.testing.assert_allclose(weights, known, rtol=0, atol=1e-6 * np.abs(known).max())
