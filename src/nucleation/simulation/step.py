"""One implicit step of the block on its frictional interface: state in, state out.

A step is pure: it returns a new state and changes nothing, so a rejected step leaves no trace and
a stored state restarts the run exactly.
"""

from __future__ import annotations

import dataclasses
from collections import OrderedDict

import numpy as np
from numpy.typing import NDArray

from ..fem import kernels
from ..fem.block import Block, Field
from ..fem.grid import Grid
from ..fem.operator import BlockOperator
from ..model.parameters import Parameters
from ..stepping.bdf import LARGEST_GROWTH_OF_BDF3, Formula, error_factor, extrapolation_weights
from ..stepping.ladder import rung_value
from .interface import Interface, InterfaceSolution
from .state import State, pushed

Array = NDArray[np.float64]

OPERATOR_MEMORY = 400.0  # MB kept for factorised operators
MOST_ITERATIONS_AT_START = 50  # of Newton's method, which starts from rest
QUASI_STATIC = 10.0  # crossings of the block's height by shear waves within a step
LARGEST_RATE_EXPONENT = 40.0  # of asinh(v / v_scale) in the extrapolated guess
SLOW = 1e-2  # slip rates below this part of V need no relative accuracy,
SLOW_IN_EVENT = 1e-3  # nor do those below this part of the fastest one,
SLIGHT_SLIP = 1e-2  # nor those that slip by less than this part of D within the step
EDGE_ROUND_OFF = 4.0  # relative, of the edge values: times epsilon and the condition (H / dy)^2


@dataclasses.dataclass(frozen=True)
class StepReport:
    """What a step tells besides the new state."""

    interface: InterfaceSolution
    driving_force: float  # f_d (N/m), negative in compression
    error: float  # largest local error of asinh(v / v_scale) and log(phi)


class Dynamics:
    """The block, its interface and its loads, ready to step."""

    def __init__(self, parameters: Parameters) -> None:
        geometry, mesh, loading = parameters.geometry, parameters.mesh, parameters.loading
        self.grid = Grid(geometry.length, geometry.height, mesh.n_x, mesh.n_y, mesh.grading)
        self.body = Block(self.grid, parameters.material)
        self.velocity = loading.velocity
        self.interface = Interface(parameters.friction, loading.velocity)
        self._crossing_time = geometry.height / parameters.material.shear_wave_speed
        self._initial_log_state = float(np.log(loading.initial_state))
        self._load = self.body.top_load(loading.normal_stress)
        self._initial_shear = (
            loading.initial_shear_stress if loading.initial_stress == "uniform_shear" else None
        )
        condition = (geometry.height / np.diff(self.grid.y).min()) ** 2
        self._edge_round_off = EDGE_ROUND_OFF * np.finfo(float).eps * condition
        self._operators: OrderedDict[int, BlockOperator] = OrderedDict()

    def initial_state(self) -> tuple[State, StepReport]:
        """The static field under the normal stress at rest, without slip or in uniform shear."""
        n = self.grid.n_x
        operator = BlockOperator(self.body, 0.0)
        response = operator.respond(self._load, np.zeros(n))
        if self._initial_shear is not None:
            forces = -self._initial_shear * self.grid.nodal_lengths[1:]
            stiffness, _ = operator.tangent(np.arange(1, n + 1))
            slipped = np.linalg.solve(stiffness, forces - response.tangential)
            response = operator.respond(self._load, slipped)
        w = response.w
        modes, _ = operator.solve(self._load, self.body.sine_amplitudes(w), response.edge)
        displacement = Field(modes, response.edge)
        velocity = self.body.zero_field()
        velocity.modes[:, 0] = -self.velocity * self.body.sine_amplitudes(np.ones(n))
        slip_rate = np.append(self.velocity, np.zeros(n))
        log_state = np.full(n + 1, self._initial_log_state)
        momentum = self.body.momentum_x(velocity)
        state = State.beginning(displacement, velocity, slip_rate, log_state, w, momentum)
        # at rest no friction acts on the driven edge's own node
        tangential = np.append(0.0, response.tangential)
        at_rest = InterfaceSolution(
            slip_rate, log_state, tangential, response.normal, w, response.edge, 0
        )
        return state, StepReport(at_rest, float(tangential.sum()), 0.0)

    def advance(self, state: State, rung: int) -> tuple[State, StepReport]:
        """One step with the leading coefficient ``beta`` of a rung of the step-size ladder.

        Raises
        ------
        NewtonFailure
            The interface's equations were not solved; try a lower rung.
        """
        beta = rung_value(rung)
        first = state.past_times.size == 1
        formula = (
            Formula.backward_euler(beta) if first else Formula.bdf2(beta, state.last_step)
        )  # fmt: skip
        operator = self._operator(rung)
        load = self._load_with_past(state, formula, operator.s)
        scale = self._rate_scale(state, formula.step)
        guess, log_state_guess = self._extrapolated(state, state.time + formula.step, scale)
        on_interface = self._formula_on_interface(state, formula)
        w_history = on_interface.from_past(state.past_w)
        w_guess = w_history + on_interface.beta * (guess[1:] - self.velocity)
        interface = self.interface
        if first:
            interface = dataclasses.replace(interface, most_iterations=MOST_ITERATIONS_AT_START)
        edge = self._predicted_edge(state, formula.step)
        # far from slip and waves the right edge moves as predicted, to round-off
        for given in (edge, None) if state.edge_error < self._edge_round_off else (None,):
            response = operator.respond(load, w_guess, given)
            solution = interface.solve(
                operator, response, w_history, on_interface.from_past(state.past_log_states),
                on_interface.beta, guess[1:],
            )  # fmt: skip
            displacement = operator.displacement(load, response, solution.w, solution.edge)
            edge_error = _relative_error(displacement.edge, edge, solution.edge)
            if given is None or edge_error < self._edge_round_off:
                break
        error = np.inf if first else 0.0
        if state.past_times.size == 3:
            error = error_factor(formula, state.past_times) * max(
                np.abs(np.arcsinh(solution.slip_rate / scale) - np.arcsinh(guess / scale)).max(),
                np.abs(solution.log_state - log_state_guess).max(),
            )
        return self._completed(state, formula, displacement, edge_error, solution, error)

    # -- parts of a step ------------------------------------------------------------------------

    def _operator(self, rung: int) -> BlockOperator:
        """The operator of a rung, from the cache of the most recently used ones."""
        if rung not in self._operators:
            operator = BlockOperator(self.body, 1.0 / rung_value(rung) ** 2)
            most = max(4, int(OPERATOR_MEMORY / operator.megabytes))
            while len(self._operators) >= most:
                self._operators.popitem(last=False)
            self._operators[rung] = operator
        self._operators.move_to_end(rung)
        return self._operators[rung]

    def _load_with_past(self, state: State, formula: Formula, s: float) -> Field:
        """The static load and the inertia that the step's formula takes from the past."""
        (c1, c2), beta = formula.past, formula.beta
        terms = (
            (c1, state.displacement), (c1 * beta, state.velocity),
            (c2, state.previous_displacement), (c2 * beta, state.previous_velocity),
        )  # fmt: skip
        return self.body.inertia_load(s, terms, self._load)

    def _formula_on_interface(self, state: State, formula: Formula) -> Formula:
        """The step's formula for slip and state: of third order while the body is quasi-static.

        BDF3 is not stable for undamped waves that a step resolves. Where waves cross the block
        many times within a step, inertia (kept at second order) is a small correction, and the
        third order follows the nucleating mode with longer steps.
        """
        times = state.past_times
        if times.size < 3 or formula.step < QUASI_STATIC * self._crossing_time:
            return formula
        steps = np.array([formula.step, times[0] - times[1], times[1] - times[2]])
        if (steps[:-1] > LARGEST_GROWTH_OF_BDF3 * steps[1:]).any():
            return formula
        return Formula.bdf3(formula.step, times)

    def _rate_scale(self, state: State, step: float) -> float:
        """Slip rate (m/s) from which on errors are relative: v counts as asinh(v / scale).

        The last term lets the steps grow over the elastic waves that ring in the block after an
        event: they shake the slip rates, but move the interface by next to nothing.
        """
        fastest = float(np.abs(state.past_slip_rates[0]).max())
        distance = self.interface.friction.characteristic_slip_distance
        return max(SLOW * self.velocity, SLOW_IN_EVENT * fastest, SLIGHT_SLIP * distance / step)

    def _extrapolated(self, state: State, time: float, scale: float) -> tuple[Array, Array]:
        """Slip rate (m/s) and log state at a new time, by polynomials through the past ones."""
        weights = extrapolation_weights(time, state.past_times)
        scaled = weights @ np.arcsinh(state.past_slip_rates / scale)
        scaled = np.clip(scaled, -LARGEST_RATE_EXPONENT, LARGEST_RATE_EXPONENT)
        largest = 10.0 * np.abs(state.past_slip_rates[0]).max()
        guess = np.clip(scale * np.sinh(scaled), -largest, largest)
        return guess, weights @ state.past_log_states

    def _predicted_edge(self, state: State, step: float) -> Array:
        """The edge values (m) after a step, if they go on with the acceleration of the last one."""
        edge = state.displacement.edge + step * state.velocity.edge
        if state.last_step == 0.0:
            return edge
        change = state.velocity.edge - state.previous_velocity.edge
        return edge + (0.5 * step**2 / state.last_step) * change

    def _completed(
        self, state: State, formula: Formula, displacement: Field, edge_error: float,
        solution: InterfaceSolution, error: float,
    ) -> tuple[State, StepReport]:  # fmt: skip
        (c1, c2), beta = formula.past, formula.beta
        u, u_past = state.displacement, state.previous_displacement
        rates = np.empty_like(displacement.modes)
        kernels.rate_of_change(c1, c2, beta, displacement.modes, u.modes, u_past.modes, rates)
        velocity = Field(rates, (displacement.edge - c1 * u.edge - c2 * u_past.edge) / beta)
        momentum = self.body.momentum_x(velocity)
        force = (momentum - c1 * state.momentum - c2 * state.previous_momentum) / beta
        new = State(
            displacement, velocity, state.displacement, state.velocity,
            pushed(state.time + formula.step, state.past_times),
            pushed(solution.slip_rate, state.past_slip_rates),
            pushed(solution.log_state, state.past_log_states),
            pushed(solution.w, state.past_w),
            momentum, state.momentum, edge_error,
        )  # fmt: skip
        # discrete balance along x: the driven edge carries what friction and inertia leave
        return new, StepReport(solution, float(solution.tangential.sum() - force), error)


def _relative_error(found: Array, *assumed: Array) -> float:
    """Largest error of what was assumed over the largest value; infinite if all are zero."""
    largest = np.abs(found).max()
    return max(np.abs(a - found).max() for a in assumed) / largest if largest > 0.0 else np.inf
