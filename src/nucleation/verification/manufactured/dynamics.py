"""The solver's own steps under the loads of a manufactured solution.

Two kinds of interface: displacement prescribed (elastodynamics alone), or the solver's frictional
one. There the slip rate follows from the displacement, the state variable is chosen freely, and
two loads make both of them a solution:

- the state equation has a source, ``dpsi/dt = g(omega)/phi + S``, ``S = psi_t - g(omega)/phi``;
- an applied traction carries the difference between friction and shear stress,
  ``-sigma_xy - f(v, phi) sigma_yy`` on the body. It cannot be avoided: at the driven edge's foot
  the shear stress of any smooth field vanishes, friction does not.

The solver needs no hooks: drive and interface are all that is replaced.
"""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
from scipy import fft

from ...fem.block import Block
from ...fem.condensed import Operator, Response
from ...fem.grid import Field, Grid, Motion
from ...model.friction.law import Friction
from ...model.parameters import Parameters
from ...simulation.drive import Drive, Imposed
from ...simulation.interface import Interface, InterfaceSolution, Past, Solver
from ...simulation.state import State
from ...simulation.step import Dynamics, StepReport
from ...simulation.stepping import BDF
from ...types import Array
from .fields import Displacement, Loads, Term

NEWTON_TOLERANCE = 1e-12  # relative, of slip rates: below every error measured


@dataclasses.dataclass(frozen=True)
class GivenDisplacement:
    """In place of the frictional interface: its displacement is prescribed."""

    friction: Friction
    problem: Manufactured
    extra_normal: float = 0.0

    def solve(
        self, operator: Operator, response: Response, past: Past, imposed: Imposed, guess: Array
    ) -> InterfaceSolution:
        """The forces that hold the interface there; arguments of :meth:`Interface.solve`."""
        w = self.problem.exact_w(imposed.time)
        dp, dnormal = operator.apply(w - response.w)
        v = np.append(guess[:1], (w - past.w) / past.beta)
        return InterfaceSolution(
            v, np.zeros_like(v), np.append(0.0, response.tangential + dp),
            response.normal + dnormal, w, 0,
        )  # fmt: skip


class Manufactured(Drive):
    """The solver's own step under the loads of a displacement, the drive of its own `dynamics`.

    Parameters
    ----------
    parameters, exact : of the block, and its displacement; with friction it has a compressive
        sigma_yy at y = 0.
    log_state : psi = log(phi) as a sum of terms, in which y = 0. Without one the interface's
        displacement is prescribed.
    lumped : whether the applied traction counts friction node by node as the solver does. Then
        the nodal values of fields bilinear in space solve the solver's equations exactly. If not,
        friction is integrated along x, and the solver's lumping shows as an error of order h^2.
    """

    body: Any  # a block, or a pair in what derives from it
    velocity = 0.0
    moves = True

    def __init__(
        self, parameters: Parameters, exact: Displacement, log_state: tuple[Term, ...] = (),
        lumped: bool = True,
    ) -> None:  # fmt: skip
        self.log_state, self.lumped = log_state, lumped
        self.friction, self.velocity = parameters.friction, parameters.loading.velocity
        self.body = self.body_of(parameters)
        self.grid = self.body.grid
        self.exact, self.loads = exact, Loads(self.grid, exact)
        held = Interface(self.friction, NEWTON_TOLERANCE)
        interface: Solver = held if log_state else GivenDisplacement(self.friction, self)
        self.dynamics = Dynamics(self.body, interface, self, BDF(self.body.crossing_time))

    def body_of(self, parameters: Parameters) -> Any:
        """The elastic body."""
        return Block(Grid.of(parameters.geometry, parameters.mesh), parameters.material)

    def at(self, time: float) -> Imposed:
        """What is imposed on driven edge and interface at a time (s): the state has a source."""
        source = self.source(time) if self.log_state else None
        return Imposed(time, self.velocity * time, self.velocity, state_forcing=source)

    def load(self, time: float) -> Field:
        """The load (N/m) of displacement and applied traction at a time (s)."""
        forces = self.loads.nodal(time)
        if self.log_state:
            forces[0, 0] += self.applied_force(time)
        return self.loads.field(forces)

    def run(self, *rungs: int) -> tuple[State, StepReport]:
        """Integrate from the exact start, a step per rung; return the last state and report."""
        state = self.exact_state(self.dynamics.scheme.steady_step(rungs[0]))
        for rung in rungs:
            state, report = self.dynamics.advance(state, rung)
        return state, report

    def nodal_exact(self, time: float, **orders: int) -> Array:
        """Exact w_x and u_y (m) at the nodes, or a derivative, (2, n_y + 1, n_x + 1)."""
        x, y = self.grid.x[None], self.grid.y[:, None]
        return np.array([self.exact.value(c, x, y, time, **orders) for c in (0, 1)])

    def exact_w(self, time: float) -> Array:
        """Exact w_x (m) at the interface's nodes 1..n_x."""
        return self.exact.value(0, self.grid.x[1:], np.zeros(self.grid.n_x), time)

    def exact_slip_rate(self, x: Array, time: float, by_t: int = 0) -> Array:
        """Exact slip rate (m/s) at x (m), or its derivative in time."""
        own = self.exact.value(0, x, np.zeros_like(x), time, by_t=1 + by_t)
        return own if by_t else self.velocity + own

    def exact_log_state(self, x: Array, time: float, by_t: int = 0) -> Array:
        """Exact psi = log(phi) at x (m), or its derivative in time (1/s)."""
        terms = (term(x, np.zeros_like(x), time, by_t=by_t) for term in self.log_state)
        return sum(terms, np.zeros_like(x))

    def exact_motion(self, time: float) -> Motion:
        """The body's motion at a time (s)."""
        u, rate = (block_field(self.body, self.nodal_exact(time, by_t=order)) for order in (0, 1))
        return Motion(u, rate, self.body.momentum_x(rate))

    def exact_state(self, step: float) -> State:
        """The state at t = 0 with exact values at 0, -step and -2 step (s)."""
        times = np.array([0.0, -step, -2 * step])
        rates = np.array([self.exact_slip_rate(self.grid.x, t) for t in times])
        states = np.array([self.exact_log_state(self.grid.x, t) for t in times])
        w = np.array([self.exact_w(t) for t in times])
        motions = tuple(self.exact_motion(t) for t in times[:2])
        return State(motions, times, rates, states, w, self.body.no_memory)

    def displacement_error(self, state: State) -> float:
        """Root mean square over the area of the nodal error (m)."""
        error = np.array(self.body.nodal_values(state.displacement)) - self.nodal_exact(state.time)
        return self.loads.mean_over_area(error)

    def slip_rate_error(self, state: State) -> float:
        """Root mean square over the interface of the nodal error (m/s)."""
        return self._mean(state.past_slip_rates[0] - self.exact_slip_rate(self.grid.x, state.time))

    def log_state_error(self, state: State) -> float:
        """Root mean square over the interface of the nodal error of psi."""
        return self._mean(state.past_log_states[0] - self.exact_log_state(self.grid.x, state.time))

    def _mean(self, error: Array) -> float:
        return float(np.sqrt(error**2 @ self.grid.nodal_lengths / self.grid.length))

    def friction_coefficient(self, x: Array, time: float) -> Array:
        """f(v, phi) of the exact slip rate and state at x (m)."""
        state = np.exp(self.exact_log_state(x, time))
        return self.friction.coefficient(self.exact_slip_rate(x, time), state)

    def applied_force(self, time: float) -> Array:
        """Nodal force (N/m) of the applied traction along x, at the nodes 0..n_x."""
        loads = self.loads
        shear, normal = loads.interface_stress(time)
        if self.lumped:
            friction = self.friction_coefficient(self.grid.x, time) * (loads.along_x @ normal)
        else:
            friction = loads.along_x @ (self.friction_coefficient(loads.x, time) * normal)
        return -loads.along_x @ shear - friction

    def source(self, time: float) -> Array:
        """Source (1/s) of the state equation in psi, at the nodes 0..n_x."""
        x = self.grid.x
        state = np.exp(self.exact_log_state(x, time))
        own = self.friction.state_rate(self.exact_slip_rate(x, time), state) / state
        return self.exact_log_state(x, time, by_t=1) - own


def block_field(block: Block, values: Array) -> Field:
    """Nodal values (2, n_y + 1, n_x + 1) as a field of a block."""
    grid = block.grid
    modes = np.empty((grid.n_y + 1, 2, grid.n_x))
    modes[:, 0] = block.sine_amplitudes(values[0, :, 1:])
    modes[:, 1] = fft.dct(values[1, :, :-1], type=3) / grid.n_x
    return Field(modes, values[1, :, -1].copy())
