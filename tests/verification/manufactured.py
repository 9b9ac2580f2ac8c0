"""Manufactured solutions for the block: fields with closed derivatives, and their loads.

A displacement field is a sum of products ``amplitude X(x) Y(y) T(t)`` whose factors have exact
derivatives. Body force ``rho u_tt - div sigma`` and the tractions of all free sides are integrated
against the bilinear basis by Gauss quadrature and become loads of the real solver.
"""

from __future__ import annotations

import dataclasses

import numpy as np
from scipy import fft

from nucleation.fem.body import Field
from nucleation.fem.dynamics import Dynamics, State
from nucleation.fem.interface import Interface, InterfaceSolution
from nucleation.fem.stepping import Formula, rung_value


@dataclasses.dataclass(frozen=True)
class Sine:
    """``sin(rate x + phase)``."""

    rate: float
    phase: float = 0.0

    def __call__(self, x, order=0):
        return self.rate**order * np.sin(self.rate * x + self.phase + order * np.pi / 2)


class Power:
    """The polynomial ``c0 + c1 x + c2 x^2 ..``."""

    def __init__(self, *coefficients):
        self.polynomial = np.polynomial.Polynomial(coefficients)

    def __call__(self, x, order=0):
        return self.polynomial.deriv(order)(x) + np.zeros_like(x)


@dataclasses.dataclass(frozen=True)
class Term:
    """``amplitude X(x) Y(y) T(t)``."""

    amplitude: float
    x: object
    y: object
    t: object

    def __call__(self, x, y, t, by_x=0, by_y=0, by_t=0):
        factors = self.x(x, by_x) * self.y(y, by_y) * self.t(np.asarray(t, float), by_t)
        return self.amplitude * factors


@dataclasses.dataclass(frozen=True)
class Displacement:
    """``w_x`` (zero at x = 0) and ``u_y`` (zero at y = 0), each a sum of terms."""

    terms: tuple[tuple[Term, ...], tuple[Term, ...]]
    material: object

    def value(self, component, x, y, t, **orders):
        return sum(term(x, y, t, **orders) for term in self.terms[component])

    def stress(self, x, y, t, by_x=0, by_y=0):
        """sigma_xx, sigma_xy, sigma_yy, or a derivative of them."""
        lame, shear = self.material.lame_modulus, self.material.shear_modulus

        def slope(component, along_x, along_y):
            orders = {"by_x": by_x + along_x, "by_y": by_y + along_y}
            return self.value(component, x, y, t, **orders)

        xx, yy = slope(0, 1, 0), slope(1, 0, 1)
        trace = lame * (xx + yy)
        return trace + 2 * shear * xx, shear * (slope(0, 0, 1) + slope(1, 1, 0)), (
            trace + 2 * shear * yy
        )  # fmt: skip

    def body_force(self, x, y, t):
        """``rho u_tt - div sigma``, both components."""
        along_x, along_y = self.stress(x, y, t, by_x=1), self.stress(x, y, t, by_y=1)
        inertia = [self.material.density * self.value(c, x, y, t, by_t=2) for c in (0, 1)]
        return inertia[0] - along_x[0] - along_y[1], inertia[1] - along_x[1] - along_y[2]


def quadrature(nodes):
    """Gauss points and the matrix of ``weight_g N_i(point_g)`` of linear elements."""
    points, weights = np.polynomial.legendre.leggauss(4)
    lengths, local = np.diff(nodes), 0.5 * (1 + points)
    n, g = lengths.size, points.size
    weighted = np.zeros((n + 1, n, g))
    for e in range(n):
        weighted[e, e] = 0.5 * lengths[e] * weights * (1 - local)
        weighted[e + 1, e] = 0.5 * lengths[e] * weights * local
    return (nodes[:-1, None] + lengths[:, None] * local).ravel(), weighted.reshape(n + 1, n * g)


class Loads:
    """Nodal forces of a manufactured displacement on a grid."""

    def __init__(self, grid, exact):
        self.grid, self.exact = grid, exact
        (self.x, self.along_x), (self.y, self.along_y) = quadrature(grid.x), quadrature(grid.y)

    def nodal(self, t):
        """Forces along x and y, (2, n_y + 1, n_x + 1); none of the interface's own."""
        force = self.exact.body_force(self.x[None], self.y[:, None], t)
        out = np.array([self.along_y @ f @ self.along_x.T for f in force])
        height, length = self.grid.height, self.grid.length
        _, xy, yy = self.exact.stress(self.x, np.full_like(self.x, height), t)
        out[0, -1] += self.along_x @ xy
        out[1, -1] += self.along_x @ yy
        xx, xy, _ = self.exact.stress(np.full_like(self.y, length), self.y, t)
        out[0, :, -1] += self.along_y @ xx
        out[1, :, -1] += self.along_y @ xy
        _, xy, _ = self.exact.stress(np.zeros_like(self.y), self.y, t)
        out[1, :, 0] -= self.along_y @ xy
        return out

    def field(self, forces):
        """Nodal forces (2, n_y + 1, n_x + 1) as a load of the solver: ``2/n sum_i F_i sin``."""
        n = self.grid.n_x
        theta, i = (np.arange(n) + 0.5) * np.pi / n, np.arange(1, n + 1)
        modes = np.empty((self.grid.n_y + 1, 2, n))
        modes[:, 0] = 2 / n * forces[0, :, 1:] @ np.sin(np.outer(i, theta))
        modes[:, 1] = 2 / n * forces[1, :, :-1] @ np.cos(np.outer(i - 1, theta))
        return Field(modes, forces[1, :, -1].copy())


@dataclasses.dataclass(frozen=True)
class GivenDisplacement:
    """In place of the frictional interface: its displacement ``w`` is prescribed."""

    friction: object
    w: np.ndarray

    def solve(self, operator, response, w_history, log_state_history, beta, guess):
        dp, dnormal, dedge = operator.apply(self.w - response.w)
        v = np.append(guess[:1], (self.w - w_history) / beta)
        return InterfaceSolution(
            v, np.zeros_like(v), np.append(0.0, response.tangential + dp),
            response.normal + dnormal, self.w, response.edge + dedge, 0,
        )  # fmt: skip


@dataclasses.dataclass(frozen=True)
class SourcedInterface(Interface):
    """The frictional interface with a source (1/s) in ``dpsi/dt``, given at the new time."""

    source: np.ndarray = None

    def solve(self, operator, response, w_history, log_state_history, beta, guess):
        history = log_state_history + beta * self.source
        return super().solve(operator, response, w_history, history, beta, guess)


class ManufacturedDynamics(Dynamics):
    """The solver's own step under the loads of a manufactured displacement."""

    def __init__(self, parameters, exact):
        super().__init__(parameters)
        self.exact, self.loads = exact, Loads(self.grid, exact)

    def prescribe(self, time):
        """Set the load and the interface of the step that ends at `time` (s)."""
        self._load = self.loads.field(self.loads.nodal(time))
        w = self.exact.value(0, self.grid.x[1:], np.zeros(self.grid.n_x), time)
        self.interface = GivenDisplacement(self.interface.friction, w)

    def advance(self, state, rung):
        self.prescribe(state.time + Formula.bdf2(rung_value(rung), state.last_step).step)
        return super().advance(state, rung)

    def nodal_exact(self, time, **orders):
        """Exact w_x and u_y at the nodes, (2, n_y + 1, n_x + 1)."""
        x, y = self.grid.x[None], self.grid.y[:, None]
        return np.array([self.exact.value(c, x, y, time, **orders) for c in (0, 1)])

    def as_field(self, values):
        """Nodal values as a field of the solver."""
        modes = np.empty((self.grid.n_y + 1, 2, self.grid.n_x))
        modes[:, 0] = self.body.sine_amplitudes(values[0, :, 1:])
        modes[:, 1] = fft.dct(values[1, :, :-1], type=3) / self.grid.n_x
        return Field(modes, values[1, :, -1].copy())

    def exact_log_state(self, time):
        return np.zeros(self.grid.n_x + 1)

    def exact_state(self, step):
        """The state at t = 0 with exact values at 0, -step and -2 step."""
        times = np.array([0.0, -step, -2 * step])
        x, y = self.grid.x, np.zeros_like(self.grid.x)
        rates = [self.velocity + self.exact.value(0, x, y, t, by_t=1) for t in times]
        fields = [
            self.as_field(self.nodal_exact(t, by_t=order)) for t in times[:2] for order in (0, 1)
        ]
        states = np.array([self.exact_log_state(t) for t in times])
        momenta = [self.body.momentum_x(fields[i]) for i in (1, 3)]
        return State(*fields, times, np.array(rates), states, *momenta)

    def run(self, rung, steps):
        """Integrate from the exact start; return the last state and report."""
        state = self.exact_state(1.5 * rung_value(rung))
        for _ in range(steps):
            state, report = self.advance(state, rung)
        return state, report

    def displacement_error(self, state):
        """Root mean square over the area of the nodal error (m)."""
        error = np.array(self.body.nodal_values(state.displacement)) - self.nodal_exact(state.time)
        area = np.outer(self.loads.along_y.sum(axis=1), self.loads.along_x.sum(axis=1))
        return np.sqrt((error**2).sum(axis=0).ravel() @ area.ravel() / area.sum())


def orders(errors):
    """Orders between successive errors, each of half the spacing."""
    errors = np.asarray(errors)
    return np.log2(errors[:-1] / errors[1:])


def table(title, labels, errors):
    """Print errors and orders as a table (shown with pytest -s)."""
    print(f"\n{title}")
    for label, error, order in zip(labels, errors, [np.nan, *orders(errors)], strict=True):
        print(f"  {label:>14}  {error:10.3e}  {order:6.3f}")
