"""One implicit step of a body on its frictional interface: state in, state out.

A step returns a new state and changes nothing else. So a rejected step leaves no trace, and a
stored state restarts the run exactly. A step combines four parts that do not know each other
(:func:`nucleation.simulation.run.composed` makes the usual ones): a body
(:mod:`nucleation.fem.body`), an interface (:mod:`.interface`), a drive (:mod:`.drive`) and a
scheme (:mod:`.stepping`).
"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Mapping
from functools import cached_property, lru_cache, partial

import numpy as np

from ..fem.body import Body
from ..fem.condensed import CondensedBody
from ..fem.grid import Field, Motion
from ..fem.operator import Forces, Operator
from ..types import Array, Arrays
from . import passes
from .drive import Drive, Imposed
from .event import Outcome
from .interface import Interface, InterfaceSolution, NewtonFailure, Past
from .stepping import Scheme, Step

OPERATOR_MEMORY = 400.0  # MB kept for factorised operators
SLOW = 1e-2  # slip rates below this part of V need no relative accuracy,
SLIGHT_SLIP = 1e-2  # nor do those that slip by less than this part of D within the step
INERT = 1e-8  # ``s`` times a crossing squared below which inertia is lost in the stiffness
UNBALANCED = 1e-8  # force on a body as a whole over those on its nodes: above round-off
IMPOSSIBLE = 10.0  # times what radiation allows: stress concentrations and reflections do not
STOPPED = 1e-20  # part of the fastest slip rate that is left after a step that is too long


@dataclasses.dataclass(frozen=True)
class State:
    """A body and its interface at one instant: all past values from which the next step follows.

    The past includes the present, and begins with it; it is as long as the scheme needs.
    """

    motions: tuple[Motion, ...]
    past_times: Array  # s
    past_slip_rates: Array  # m/s, (past, nodes 0..n_x)
    past_log_states: Array  # (past, nodes 0..n_x)
    past_w: Array  # m, slip less that of the driven edge, (past, nodes 1..n_x)

    def to_arrays(self) -> Arrays:
        """The exact state as plain arrays by name, to be stored."""
        arrays = {name: np.asarray(getattr(self, name)) for name in _PLAIN}
        motions = [(*one.displacement, *one.velocity, *one[2:]) for one in self.motions]
        for name, values in zip(_OF_MOTIONS, zip(*motions, strict=True), strict=True):
            arrays[name] = np.array(values)
        return arrays

    @classmethod
    def from_arrays(cls, arrays: Mapping[str, Array]) -> State:
        """The inverse of :meth:`to_arrays`."""
        motions = []
        for u, u_edge, v, v_edge, momentum, *factors in zip(
            *[arrays[name] for name in _OF_MOTIONS], strict=True
        ):
            motion = Motion(Field(u, u_edge), Field(v, v_edge), float(momentum), *factors)
            motions.append(motion)
        plain = {name: arrays[name] for name in _PLAIN}
        return cls(tuple(motions), **plain)

    @property
    def time(self) -> float:
        """Present time (s)."""
        return float(self.past_times[0])

    @property
    def last_step(self) -> float:
        """Length of the last step (s), zero at the start."""
        before = min(1, self.past_times.size - 1)
        return float(self.past_times[0] - self.past_times[before])


Solve = Callable[[Operator, Forces], InterfaceSolution]
"""Function that solves for the interface at the end of a step."""

_PLAIN = ("past_times", "past_slip_rates", "past_log_states", "past_w")
_OF_MOTIONS = (
    "displacement",
    "displacement_edge",
    "velocity",
    "velocity_edge",
    "momentum",
    "factors",
    "factor_rates",
)


def _pushed(newest: Array | float, past: Array, most: int) -> Array:
    """The past values, newest first, with one more before them; at most a number of them."""
    kept = past[: most - 1]
    result = np.empty((kept.shape[0] + 1, *past.shape[1:]))
    result[0] = newest
    result[1:] = kept
    return result


@dataclasses.dataclass(frozen=True)
class StepReport:
    """Results of a step that are not part of the new state."""

    interface: InterfaceSolution
    driving_force: float  # f_d (N/m), negative in compression
    error: float  # largest local error of asinh(v / v_scale) and log(phi)


class Dynamics:
    """A body on an interface under a drive, advanced by a scheme.

    With ``u_x = U(t) + w_x`` the body is seen from its driven edge. Where the edge accelerates,
    inertia acts as a body force ``-rho U''`` along x.
    """

    def __init__(self, body: Body, interface: Interface, drive: Drive, scheme: Scheme) -> None:
        self.body = body
        self.interface = interface
        self.drive = drive
        self.scheme = scheme
        self.grid = body.grid
        most = max(4, int(OPERATOR_MEMORY / body.operator_megabytes))
        # ``K + s M`` by s (1/s^2), those used recently
        self.operator = lru_cache(most)(partial(Operator, body))
        self._slip_distance = float(np.min(interface.friction.slip_distance))
        self._no_forcing = np.zeros(body.modes.n_x + 1)
        self.loads = (*drive.loads, body.translation_load(1.0))
        self.condenses = body.is_held

    def advance(self, state: State, rung: int) -> tuple[State, StepReport]:
        """Make one step of a rung; raises NewtonFailure if a lower rung may help."""
        step = self.scheme.step(rung, state.past_times)
        time = state.time + step.length
        imposed = self.drive.at(time)
        # Above the scale by relative changes, also in an event. After it elastic waves ring in the
        # body. They shake the slip rates but hardly move the interface; the last term lets the
        # steps become longer than these waves.
        least = max(SLOW * self.drive.velocity, SLIGHT_SLIP * self._slip_distance / step.length)
        formula = step.interface
        scaled, rates, log_state, scale, past_w, past_log_state, w = passes.predicted(
            state.past_slip_rates,
            state.past_log_states,
            state.past_w,
            step.extrapolation,
            (*formula.past, 0.0)[:3],
            formula.beta,
            imposed.velocity,
            not self.body.modes.has_edge,
            self._no_forcing if imposed.state_forcing is None else imposed.state_forcing,
            least,
        )
        past = Past(past_w, past_log_state, formula.beta, step.first)
        solve = partial(self.interface.solve, past=past, imposed=imposed, rates=rates)
        factors = self.factors(imposed)
        follows = step.without_waves and self.condenses
        state = self.in_form(state, condensed=follows)
        way = self._follow if follows else self._move
        solution, displacement, velocity = way(step, state, factors, w, solve)
        self._require_possible(state, solution, imposed)
        newest, oldest = state.motions[0], state.motions[-1]
        factor_rates = step.body.rate(factors, newest.factors, oldest.factors)
        if follows:
            momentum = -float(self.condensed_body.works(velocity.modes, factor_rates)[-1])
        else:
            momentum = self.body.momentum_x(velocity)
        force = float(solution.tangential[self.grid.own].sum())
        if self.drive.moves:  # its force balances friction and the rate of momentum
            force -= step.body.rate(momentum, newest.momentum, oldest.momentum)
        force -= self.body.total_mass * imposed.acceleration  # of the frame
        motion = Motion(displacement, velocity, momentum, factors, factor_rates)
        new = self._pushed(state, time, solution, motion)
        rate, psi = solution.slip_rate, solution.log_state
        distance = passes.distance(scaled, log_state, rate, psi, scale)
        return new, StepReport(solution, force, step.error(distance))

    def _move(
        self, step: Step, state: State, factors: Array, w: Array, solve: Solve
    ) -> tuple[InterfaceSolution, Field, Field]:
        """The interface, displacement (m) and velocity (m/s) after a step."""
        inertia = []  # the past part
        for c, past_motion in zip(step.body.past, state.motions, strict=False):
            inertia += [(c, past_motion.displacement), (c * step.body.beta, past_motion.velocity)]
        s = self.inertia(step)
        load = self.load(state.time + step.length, factors)
        load = self.body.inertia_load(s, inertia, load)
        newest, oldest = state.motions[0], state.motions[-1]
        before = step.body.past, step.body.beta, newest.displacement, oldest.displacement
        operator = self.operator(s)
        response = operator.respond(load, w)
        solution = solve(operator, response)
        displacement, velocity = operator.balance(response, solution.w, before)
        self._hold(s, solution, displacement, velocity, step.body.beta)
        return solution, displacement, velocity

    def inertia(self, step: Step) -> float:
        """The weight (1/s^2) of inertia in a step: zero where blocks that move freely have none.

        Held by its inertia alone, such a pair would follow the round-off of its stiffness. A
        period's translation is a mode of its own, and slip all along it has inertia alone.
        """
        free = bool(self.body.translations) and self.body.modes.has_edge
        return 0.0 if free and step.s * self.body.crossing_time**2 < INERT else step.s

    def _hold(
        self,
        s: float,
        solution: InterfaceSolution,
        displacement: Field,
        velocity: Field,
        beta: float,
    ) -> None:
        """Keep the centre of mass where nothing holds the body; its momentum is that of the loads.

        All loads are in balance along these directions. Raises NewtonFailure if the step has given
        the body a momentum beyond round-off.
        """
        for free in self.body.translations:
            moved = free.of(displacement)
            inertia = s * free.mass
            if inertia * abs(moved) > UNBALANCED * self._forces(solution, displacement, inertia):
                raise NewtonFailure("momentum that no load has given", Outcome.MOMENTUM)
            free.taken_from(displacement, moved)
            free.taken_from(velocity, moved / beta)

    def _forces(self, solution: InterfaceSolution, displacement: Field, inertia: float) -> float:
        """Forces (N/m) whose round-off may leave the body out of balance."""
        largest = np.abs(displacement.modes[0]).max() + np.abs(displacement.modes[-1]).max()
        nodal = np.abs(solution.tangential).sum() + np.abs(solution.normal).sum()
        return float(nodal + inertia * largest)

    def _require_possible(
        self, state: State, solution: InterfaceSolution, imposed: Imposed
    ) -> None:
        """Refuse slip that no balance of forces explains: the step is too long, or the run fails.

        The normal stress, released within a passage of shear waves, moves the faces apart at the
        stress over each impedance ``rho c_s``; friction bears less. No interface stops at once.
        """
        fastest = passes.largest(solution.slip_rate)
        stress = abs(float(solution.normal.sum())) / self.grid.length
        most = IMPOSSIBLE * (stress * self.body.admittance + abs(imposed.velocity))
        if fastest > most:
            reason = f"a slip rate of {fastest:.3g} m/s, where waves allow {most:.3g} m/s"
            raise NewtonFailure(reason, Outcome.IMPOSSIBLE)
        if fastest < STOPPED * passes.largest(state.past_slip_rates[0]):
            reason = f"the slip rate falls to {fastest:.3g} m/s within a step"
            raise NewtonFailure(reason, Outcome.IMPOSSIBLE)

    def _follow(
        self, step: Step, state: State, factors: Array, w: Array, solve: Solve
    ) -> tuple[InterfaceSolution, Field, Field]:
        """As :meth:`_move`, of the condensed body."""
        rule = step.body
        newest, oldest = state.motions
        u1, u2 = newest.displacement.modes, oldest.displacement.modes
        straight = rule.straight(u1, newest.velocity.modes, u2, oldest.velocity.modes)
        steady = rule.straight(
            newest.factors, newest.factor_rates, oldest.factors, oldest.factor_rates
        )
        operator = self.operator(step.s)
        forces = self.condensed_body.respond(operator, w, factors, straight, steady)
        solution = solve(operator, forces)
        rate = rule.rate(solution.w, u1, u2)
        return solution, Field(solution.w, np.empty(0)), Field(rate, np.empty(0))

    def in_form(self, state: State, condensed: bool) -> State:
        """The state with its body condensed or not."""
        if state.motions[0].is_condensed == condensed:
            return state
        body = self.condensed_body
        change = body.condensed if condensed else body.expanded
        return dataclasses.replace(state, motions=tuple(map(change, state.motions)))

    def factors(self, imposed: Imposed) -> Array:
        """Factors of the body's loads; the last one is the acceleration of the frame (m/s^2)."""
        return np.array([*imposed.factors, imposed.acceleration])

    def load(self, time: float, factors: Array) -> Field:
        """The load (N/m) on the body at a time (s), with the inertia of the frame."""
        return self.body.combined(self.loads, factors)

    def works(self, motion: Motion) -> Array:
        """Work (J/m) of each load of the drive times one on the displacement."""
        loads = self.drive.loads
        if motion.is_condensed:
            found = self.condensed_body.works(motion.displacement.modes, motion.factors)
            return found[: len(loads)]
        return np.array([self.body.work(load, motion.displacement) for load in loads])

    @cached_property
    def condensed_body(self) -> CondensedBody:
        """The body condensed on its interface."""
        return CondensedBody(self.body, self.loads, self.operator)

    def _pushed(
        self, state: State, time: float, solution: InterfaceSolution, motion: Motion
    ) -> State:
        """The state with the new values, and the past ones that the scheme still needs."""
        most = self.scheme.instants
        motions = (motion, *state.motions[: self.scheme.levels - 1])
        return State(
            motions,
            _pushed(time, state.past_times, most),
            _pushed(solution.slip_rate, state.past_slip_rates, most),
            _pushed(solution.log_state, state.past_log_states, most),
            _pushed(solution.w, state.past_w, most),
        )
