"""The frictional interface: Newton's method for the slip rates of one implicit step.

At the new time the slip rate ``v``, the state ``psi = log(phi)``, the nodal tangential force
``p`` and the nodal normal force ``R`` (on the body, R > 0 in compression) fulfil

    p = p0 + D (w - w0),   R = R0 + N (w - w0),   w = w_past + beta (v - V)
    p + f(v, psi(v)) R = 0

at the nodes 1..n_x, with the body's condensed operator D, N (:mod:`nucleation.fem.condensed`), the
slip w less that of the driven edge, and the state eliminated by the closed form of its implicit
step. Node 0 slips at the imposed velocity V.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from functools import cached_property
from typing import NamedTuple, Protocol

import numpy as np
from scipy.linalg import lapack

from ..fem.condensed import Operator, Response
from ..model.friction.law import Friction
from ..types import Array
from . import compiled_laws, passes
from .drive import Imposed
from .state import State
from .stepping import Formula

ROUNDING = 1e-14  # relative, of displacements
DESCENTS = 6  # of Newton's method for one node alone, from at most twice what it is to balance
LARGEST_ASINH = 700.0
UNCHANGED = 1e-3  # change of a slip rate that friction does not see, in units of the tolerance
ACTIVE = 1e-4  # a node is coupled to its neighbours above this ratio of elastic to frictional slope


class NewtonFailure(RuntimeError):
    """Newton's method did not converge; the step must be shortened."""


class Tension(NewtonFailure):
    """The interface is in tension somewhere, where the friction law has no meaning."""


@dataclasses.dataclass(frozen=True)
class InterfaceSolution:
    """The interface at the new time; arrays over the nodes 0..n_x unless said otherwise."""

    slip_rate: Array  # m/s
    log_state: Array
    tangential: Array  # N/m, force on the body
    normal: Array  # N/m, force on the body
    w: Array  # m, nodes 1..n_x
    iterations: int


class Past(NamedTuple):
    """What the step's formula takes from the past: ``y = past + beta dy/dt``."""

    w: Array  # m, nodes 1..n_x
    log_state: Array  # nodes 0..n_x
    beta: float  # s
    at_rest: bool  # whether the interface has not slipped yet

    @classmethod
    def of(cls, state: State, formula: Formula, imposed: Imposed, at_rest: bool) -> Past:
        """The past of a state, to which the forcing at the new time adds as a rate."""
        log_state = formula.from_past(state.past_log_states)
        if imposed.state_forcing is not None:
            log_state = log_state + formula.beta * imposed.state_forcing
        return cls(formula.from_past(state.past_w), log_state, formula.beta, at_rest)


class Solver(Protocol):
    """What holds a body at its interface in a step."""

    @property
    def friction(self) -> Friction:
        """The law that its slip distance is taken from."""

    @property
    def extra_normal(self) -> Array | float:
        """Normal force (N/m) on the nodes 0..n_x beside what the body exerts."""

    def solve(
        self, operator: Operator, response: Response, past: Past, imposed: Imposed, guess: Array
    ) -> InterfaceSolution:
        """The interface at the new time; arguments of :meth:`Interface.solve`."""


def newton_direction(
    operator: Operator, coefficient: Array, residual: Array, damping: Array, elastic: Array,
    beta: float,
) -> Array:  # fmt: skip
    """Newton's direction of the slip rates (m/s) by ``beta (D + f N) + R df/dv``.

    Only nodes that elasticity couples are solved for together, in single precision, which is twice
    as fast and costs less than the method's second order; others are alone.
    """
    active = passes.coupled(elastic, damping, ACTIVE)
    solved = -residual[active].astype(np.float32)
    if active.size:
        stiffness, coupling = operator.tangent(active + 1, np.float32)
        matrix = passes.newton_matrix(stiffness, coupling, coefficient, damping, active, beta)
        *_, solved, info = lapack.sgesv(matrix.T, solved, overwrite_a=True, overwrite_b=True)
        if info:
            raise NewtonFailure("the interface's tangent is singular")
    return passes.direction(residual, elastic, damping, active, solved)


@dataclasses.dataclass(frozen=True)
class Interface:
    """Friction between a body and what it slides on, and how tightly it is solved."""

    friction: Friction  # its parameters may be arrays over the nodes 0..n_x
    tolerance: float = 1e-8  # of the residual, in units of the slip rate's relative change
    most_iterations: int = 8
    most_iterations_from_rest: int = 50
    extra_normal: Array | float = 0.0  # N/m, on the nodes 0..n_x beside what the body exerts

    @cached_property
    def _compiled(self) -> Callable[..., tuple[Array, ...]]:
        return compiled_laws.friction(self.friction)

    def solve(
        self, operator: Operator, response: Response, past: Past, imposed: Imposed, guess: Array
    ) -> InterfaceSolution:
        """Solve for the slip rates at the new time.

        Parameters
        ----------
        operator, response : the condensed body and its forces at the predicted displacement.
        past : what the step's formula takes from the past.
        imposed : velocity of the driven edge and strength of the interface at the new time.
        guess : slip rates (m/s) at nodes 1..n_x, those that belong to ``response.w``.

        Raises
        ------
        NewtonFailure
            No convergence, or a force that is not finite.
        Tension
            A nodal normal force of the solution is tensile.
        """
        v, w, beta, law = guess, response.w, past.beta, self.friction
        rounding = ROUNDING * passes.largest_size(past.w) / beta  # of v = (w - past.w) / beta
        p, normal = response.tangential, response.normal + self.extra_normal
        most = self.most_iterations_from_rest if past.at_rest else self.most_iterations
        elastic = beta * operator.diagonal
        first = normal.size - v.size  # node 0 is free only where no edge is driven
        rates = operator.body.on_all_nodes(v, imposed.velocity)
        anew = rates.size  # nodes, from the left, whose friction has to be evaluated
        strength = 1.0 if imposed.strength is None else imposed.strength
        for iteration in range(most + 1):
            found = self._friction(rates[:anew], past.log_state[:anew], beta)
            if anew == rates.size:
                psi, *friction = found
            else:
                for values, some in zip((psi, *friction), found, strict=True):
                    values[:anew] = some
            least = law.linear_below(psi)
            residual, damping, error, coefficient = passes.balance(
                p, normal, *friction, rates, elastic, least, self.tolerance, rounding, strength
            )
            if not math.isfinite(error):
                raise NewtonFailure("slip rate is not finite")
            if error < 1.0:
                if normal.min() <= 0.0:
                    raise Tension("the interface is in tension")
                # node 0 belongs to the driven edge; its friction follows from its rate V
                tangential = operator.body.on_all_nodes(p, -coefficient[0] * normal[0])
                return InterfaceSolution(rates, psi, tangential, normal, w, iteration)
            change = newton_direction(
                operator, coefficient[first:], residual, damping, elastic, beta
            )
            if law.asinh_of_rate:
                v = _updated_by_asinh(v, change, damping, elastic, least[first:])
            else:
                v = passes.updated(v, change, law.regularisation_slip_rate)
            before, rates = rates, operator.body.on_all_nodes(v, imposed.velocity)
            if self._even:
                anew = passes.reach(rates, before, UNCHANGED * self.tolerance, least)
            w, change = passes.moved(v, imposed.velocity, beta, past.w, response.w)
            dp, dnormal = operator.apply(change)
            p = response.tangential + dp
            normal = response.normal + dnormal + self.extra_normal
        raise NewtonFailure(f"no convergence in {most} iterations")

    @cached_property
    def _even(self) -> bool:
        """Whether the law is the same at all nodes."""
        values = *self.friction.constants, self.friction.characteristic_slip_distance
        return all(np.ndim(value) == 0 for value in values)

    def _friction(self, v: Array, past_log_state: Array, beta: float) -> tuple[Array, ...]:
        """psi, state at the end of the step, friction coefficient, and its total slope (s/m)."""
        law = self.friction
        v0, distance = law.regularisation_slip_rate, law.characteristic_slip_distance
        return self._compiled(v, past_log_state, beta, v0, distance, law.constants)


def _updated_by_asinh(
    v: Array, change: Array, damping: Array, elastic: Array, scale: Array
) -> Array:
    """``v + change`` to first order, for friction that goes with ``asinh(v / scale)``.

    Stuck nodes slip by tens of orders of magnitude more slowly than their neighbours: there a
    straight line says nothing of where the root is, from below no more than from above. So each
    node solves its own balance ``E v + c asinh(v/s)``, whose slope is Newton's, ``E`` plus the
    damping. With ``v = s sinh z`` the balance is convex in z, and Newton's method descends to its
    root from either of the bounds that E or c alone would give.
    """
    strength = damping * np.hypot(v, scale)
    curved = strength > 0.0  # not where friction weakens within the step
    v_curved, s, c, e = v[curved], scale[curved], strength[curved], elastic[curved]
    wanted = e * v_curved + c * np.arcsinh(v_curved / s) + (e + damping[curved]) * change[curved]
    size = np.abs(wanted)
    z = np.minimum(np.minimum(size / c, np.arcsinh(size / (e * s))), LARGEST_ASINH)
    for _ in range(DESCENTS):
        z -= (e * s * np.sinh(z) + c * z - size) / (e * s * np.cosh(z) + c)
    updated = v + change
    updated[curved] = np.copysign(s * np.sinh(z), wanted)
    return updated
