"""The solver's own steps under the loads of a manufactured solution.

There are two kinds of interface: its displacement is prescribed (elastodynamics alone), or it is
the solver's frictional one. There the slip rate follows from the displacement, the state variable
is chosen freely, and two loads make both of them a solution:

- the state equation has a source, ``dpsi/dt = g(omega)/phi + S``, ``S = psi_t - g(omega)/phi``;
- an applied traction on the body is the difference between friction and shear stress,
  ``-sigma_xy - f(v, phi) sigma_yy``. It cannot be avoided: at the foot of the driven edge the shear
  stress of any smooth field vanishes, friction does not.

The solver needs no hooks: only drive and interface are replaced.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable

import numpy as np

from nucleation.fem.body import Body
from nucleation.fem.grid import Field, Motion
from nucleation.fem.modes import BlockModes
from nucleation.fem.operator import Forces, Operator
from nucleation.run.run import Run
from nucleation.simulation.drive import Drive, Imposed
from nucleation.simulation.interface import Interface, InterfaceSolution, Past
from nucleation.simulation.start import grid_of
from nucleation.simulation.step import Dynamics, State, StepReport
from nucleation.simulation.stepping import BDF
from nucleation.types import Array

from ..nodal import nodal_values
from .fields import Displacement, Loads, Term

NEWTON_TOLERANCE = 1e-12  # relative, of slip rates: below every error measured


@dataclasses.dataclass(frozen=True)
class GivenDisplacement(Interface):
    """An interface with a prescribed displacement, in place of the frictional one."""

    exact_w: Callable[[float], Array] = dataclasses.field(kw_only=True)

    def solve(
        self, operator: Operator, response: Forces, past: Past, imposed: Imposed, rates: Array
    ) -> InterfaceSolution:
        """Find the forces that hold the interface."""
        w = self.exact_w(imposed.time)
        change, change_normal = operator.apply(w - response.w)
        tangential = response.tangential + change
        v = np.append(rates[:1], (w - past.w) / past.beta)
        return InterfaceSolution(
            v, np.zeros_like(v), np.append(0.0, tangential), response.normal + change_normal, w, 0
        )


class _Loaded(Dynamics):
    """Under a load (N/m) that is a function of time (s)."""

    load_at: Callable[[float], Field]

    def load(self, time: float, factors: Array) -> Field:
        """The load (N/m) at a time (s)."""
        return self.load_at(time)


class Manufactured:
    """The solver's own step under the loads of a displacement; it drives its `dynamics`.

    exact : displacement of the block; with friction, sigma_yy at y = 0 is compressive.
    log_state : psi = log(phi) as a sum of terms at y = 0; without any, the displacement of the
        interface is prescribed.
    lumped : whether the applied traction counts friction node by node, as the solver does. Then the
        nodal values of fields bilinear in space solve the solver's equations exactly. Otherwise
        friction is integrated along x, and the lumping of the solver is an error of order h^2.
    """

    body: Body

    def __init__(
        self, run: Run, exact: Displacement, log_state: tuple[Term, ...] = (), lumped: bool = True
    ) -> None:
        self.log_state = log_state
        self.lumped = lumped
        self.friction = run.law
        self.velocity = run.fault.velocity
        self.body = self.body_of(run)
        self.grid = self.body.grid
        self.exact = exact
        self.loads = Loads(self.grid, exact)
        interface = Interface(self.friction, NEWTON_TOLERANCE)
        if not log_state:
            interface = GivenDisplacement(self.friction, exact_w=self.exact_w)
        scheme = BDF(self.body.crossing_time)
        drive = Drive(self.velocity, self.at, ())
        self.dynamics = _Loaded(self.body, interface, drive, scheme)
        self.dynamics.load_at = self.load
        self.dynamics.condenses = False  # the load has another field at each time

    def body_of(self, run: Run) -> Body:
        """Make the elastic body."""
        return Body((grid_of(run.upper), run.upper.material))

    def at(self, time: float) -> Imposed:
        """The motion of the driven edge and the source of the state at a time (s)."""
        source = self.source(time) if self.log_state else None
        return Imposed(time, self.velocity * time, self.velocity, state_forcing=source)

    def load(self, time: float) -> Field:
        """The load (N/m) of displacement and applied traction at a time (s)."""
        forces = self.loads.nodal(time)
        if self.log_state:
            forces[0, 0] += self.applied_force(time)
        return self.loads.field(forces)

    def run(self, *rungs: int) -> tuple[State, StepReport]:
        """Integrate from the exact start, one step per rung; return the last state and report."""
        first_step = self.dynamics.scheme.steady_step(rungs[0])
        state = self.exact_state(first_step)
        for rung in rungs:
            state, report = self.dynamics.advance(state, rung)
        return state, report

    def nodal_exact(self, time: float, **orders: int) -> Array:
        """Exact w_x and u_y (m) at the nodes, or a derivative, (2, n_y + 1, n_x + 1)."""
        x = self.grid.x[None]
        y = self.grid.y[:, None]
        w_x = self.exact.value(0, x, y, time, **orders)
        u_y = self.exact.value(1, x, y, time, **orders)
        return np.array([w_x, u_y])

    def exact_w(self, time: float) -> Array:
        """The exact w_x (m) at the interface's nodes 1..n_x at a time (s)."""
        return self.exact.value(0, self.grid.x[1:], np.zeros(self.grid.n_x), time)

    def exact_slip_rate(self, x: Array, time: float, by_t: int = 0) -> Array:
        """The exact slip rate or a derivative in time."""
        own = self.exact.value(0, x, np.zeros_like(x), time, by_t=1 + by_t)
        return own if by_t else self.velocity + own

    def exact_log_state(self, x: Array, time: float, by_t: int = 0) -> Array:
        """The exact psi = log(phi) or a derivative in time."""
        y = np.zeros_like(x)
        terms = (term(x, y, time, by_t=by_t) for term in self.log_state)
        return sum(terms, np.zeros_like(x))

    def exact_motion(self, time: float) -> Motion:
        """The body's motion at a time (s)."""
        displacement = block_field(self.body, self.nodal_exact(time))
        rate = block_field(self.body, self.nodal_exact(time, by_t=1))
        momentum = self.body.momentum_x(rate)
        return Motion(displacement, rate, momentum, np.zeros(1), np.zeros(1))

    def exact_state(self, step: float) -> State:
        """The state at t = 0, with exact values at 0, -step and -2 step (s)."""
        times = np.array([0.0, -step, -2 * step])
        x = self.grid.x
        rates = np.array([self.exact_slip_rate(x, t) for t in times])
        states = np.array([self.exact_log_state(x, t) for t in times])
        w = np.array([self.exact_w(t) for t in times])
        motions = tuple(self.exact_motion(t) for t in times[:2])
        return State(motions, times, rates, states, w)

    def displacement_error(self, state: State) -> float:
        """The root mean square over the area of the nodal error (m)."""
        values = np.array(nodal_values(self.body, state.motions[0].displacement))
        return self.loads.mean_over_area(values - self.nodal_exact(state.time))

    def slip_rate_error(self, state: State) -> float:
        """The root mean square over the interface of the nodal error (m/s)."""
        exact = self.exact_slip_rate(self.grid.x, state.time)
        return self._mean(state.past_slip_rates[0] - exact)

    def log_state_error(self, state: State) -> float:
        """The root mean square over the interface of the nodal error of psi."""
        exact = self.exact_log_state(self.grid.x, state.time)
        return self._mean(state.past_log_states[0] - exact)

    def _mean(self, error: Array) -> float:
        square = error**2 @ self.grid.nodal_lengths / self.grid.length
        return float(np.sqrt(square))

    def friction_coefficient(self, x: Array, time: float) -> Array:
        """F(v, phi) of the exact slip rate and state."""
        state = np.exp(self.exact_log_state(x, time))
        slip_rate = self.exact_slip_rate(x, time)
        return self.friction.coefficient(slip_rate, state)

    def applied_force(self, time: float) -> Array:
        """The nodal force (N/m) of the applied traction along x, at the nodes 0..n_x."""
        loads = self.loads
        shear, normal = loads.interface_stress(time)
        if self.lumped:
            coefficient = self.friction_coefficient(self.grid.x, time)
            friction = coefficient * (loads.along_x @ normal)
        else:
            coefficient = self.friction_coefficient(loads.x, time)
            friction = loads.along_x @ (coefficient * normal)
        return -loads.along_x @ shear - friction

    def source(self, time: float) -> Array:
        """The source (1/s) of the state equation in psi, at the nodes 0..n_x."""
        x = self.grid.x
        state = np.exp(self.exact_log_state(x, time))
        slip_rate = self.exact_slip_rate(x, time)
        own = self.friction.state_rate(slip_rate, state) / state
        return self.exact_log_state(x, time, by_t=1) - own


def block_field(body: Body, values: Array) -> Field:
    """Convert nodal values of a layer of a block into a field."""
    modes = body.modes
    assert isinstance(modes, BlockModes)
    x, y = values
    along_x = modes.sine_amplitudes(x[:, 1:])
    along_y = modes.cosine_amplitudes(y[:, :-1])
    return Field(np.stack((along_x, along_y), axis=1), y[:, -1].copy())
