"""The frozen patch's spectrum against differences of the nonlinear equations."""

import numpy as np
import pytest
from scipy.optimize import brentq

from nucleation.elasticity import Material
from nucleation.fem.body import Body
from nucleation.fem.grid import Grid
from nucleation.fem.operator import BodyOperator
from nucleation.friction import Friction
from nucleation.patch_stability import crossing, log_state_derivatives, patch_spectrum


@pytest.mark.parametrize("law", ["aging", "slip"])
def test_log_state_derivatives(law):
    friction = Friction(evolution=law)

    def rate(v, psi):
        return friction.state_rate(v, np.exp(psi)) * np.exp(-psi)

    h = 1e-5
    for v, psi in ((1e-5, -3.0), (2e-9, 1.0), (1e-3, -7.0)):
        by_rate, by_psi = log_state_derivatives(friction, np.array(v), np.exp(psi))
        numeric = (rate(v * (1 + h), psi) - rate(v * (1 - h), psi)) / (2 * h * v)
        assert by_rate == pytest.approx(numeric, rel=1e-6)
        assert by_psi == pytest.approx((rate(v, psi + h) - rate(v, psi - h)) / (2 * h), rel=1e-6)


@pytest.mark.parametrize("law", ["aging", "slip"])
def test_spectrum_equals_that_of_differences(law):
    """Jacobian of (dw/dt, dpsi/dt), v from nodal force balance by bracketing."""
    friction = Friction(evolution=law)
    grid = Grid(0.8, 0.02, 32, 5)
    operator = BodyOperator(Body(grid, Material()), 0.0)
    rate = np.where(grid.x < 0.26, 1e-5 * np.exp(-grid.x / 0.3), 1e-12)
    state = 0.07 * (1 + grid.x)
    stress = -1e6 * (1 + 0.1 * np.cos(5 * grid.x))
    spectrum = patch_spectrum(operator, friction, rate, state, stress, 1e-7)
    nodes, n = spectrum.nodes, spectrum.nodes.size
    assert n == 10
    base = -friction.coefficient(rate, state)[nodes] * -stress[nodes] * grid.dx

    def time_derivative(z):
        w = np.zeros(grid.n_x)
        w[nodes - 1] = z[:n]
        psi = np.log(state[nodes]) + z[n:]
        p, normal, _ = operator.apply(w)
        p, normal = base + p[nodes - 1], -stress[nodes] * grid.dx + normal[nodes]
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
    scale = np.abs(reference[:4]).max()
    np.testing.assert_allclose(spectrum.eigenvalues[:4].real, reference[:4].real, atol=1e-4 * scale)
    np.testing.assert_allclose(
        np.abs(spectrum.eigenvalues[:4].imag), np.abs(reference[:4].imag), atol=1e-3 * scale
    )


def test_crossing_finds_where_growth_begins():
    length = np.linspace(0.1, 0.3, 401)
    low, middle, high = crossing(length, 3.0 * (length - 0.2), 0.01)
    assert middle == pytest.approx(0.2, abs=1e-3)
    assert low <= middle <= high
    # growth that varies within each hop widens the error bar, not the middle
    shaken = 3.0 * (length - 0.2) + 0.06 * np.sin(2 * np.pi * length / 0.01)
    low, again, high = crossing(length, shaken, 0.01)
    assert again == pytest.approx(middle, abs=5e-3)
    assert low == pytest.approx(0.18, abs=6e-3)
    assert high == pytest.approx(0.22, abs=6e-3)


def test_no_growth_no_length():
    assert np.isnan(crossing(np.linspace(0, 1, 50), -np.ones(50), 0.1)).all()
