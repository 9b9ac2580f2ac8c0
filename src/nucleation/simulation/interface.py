"""The frictional interface: Newton's method for the slip rates of one implicit step.

At the new time the slip rate ``v``, the state ``psi = log(phi)``, the nodal tangential force
``p`` and the nodal normal force ``R`` (on the body, R > 0 in compression) satisfy

    p = p0 + D (w - w0),   R = R0 + N (w - w0),   w = w_past + beta (v - V)
    p + f(v, psi(v)) R = 0

at the nodes 1..n_x, with the body's condensed operator D, N (:mod:`nucleation.fem.operator`) and
the slip w less that of the driven edge. The state is eliminated by the closed form of its implicit
step. Node 0 slips at the imposed velocity V.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable
from functools import cache, cached_property
from inspect import getmembers, getsource, isfunction
from sys import modules
from typing import NamedTuple

import numpy as np
from numba.extending import register_jitable
from numpy.typing import NDArray
from scipy.linalg import lapack

from ..fem.compiling import compiled
from ..fem.operator import Forces, Operator
from ..model.friction import Friction
from ..types import Array
from . import passes
from .drive import Imposed
from .event import Outcome

ROUNDING = 1e-14  # relative, of displacements
UNCHANGED = 1e-3  # change of a slip rate that friction does not see, in units of the tolerance
MOST_ITERATIONS = 8  # of Newton's method
MOST_ITERATIONS_FROM_REST = 50
ACTIVE = 1e-4  # a node is coupled to its neighbours above this ratio of elastic to frictional slope


class NewtonFailure(RuntimeError):
    """A step has no solution and must be shortened, with the outcome if no shorter one has one."""

    def __init__(self, reason: str, outcome: Outcome = Outcome.STEP_UNDERFLOW) -> None:
        super().__init__(reason)
        self.outcome = outcome


@dataclasses.dataclass(frozen=True)
class InterfaceSolution:
    """The interface at the new time."""

    slip_rate: Array  # m/s, nodes 0..n_x
    log_state: Array  # nodes 0..n_x
    tangential: Array  # N/m, force on the body, nodes 0..n_x
    normal: Array  # N/m, force on the body, nodes 0..n_x
    w: Array  # m, nodes 1..n_x
    iterations: int


class Past(NamedTuple):
    """The past part of the step's formula ``y = past + beta dy/dt``, with the state's forcing."""

    w: Array  # m, nodes 1..n_x
    log_state: Array  # nodes 0..n_x
    beta: float  # s
    at_rest: bool  # whether the interface has not slipped yet


CompiledFriction = Callable[..., tuple[Array, Array, Array]]
"""Function of slip rates (m/s), the past part of log(phi), beta (s), v0 (m/s), D (m) and the law's
constants. It returns psi, f and df/dv (s/m) at the end of a step."""


@cache
def compiled_friction(
    formula: Callable[..., tuple[Array, Array, Array]],
    implicit_log_state: Callable[..., tuple[Array, Array]],
) -> CompiledFriction:
    """Compile ``psi = past + beta dpsi/dt`` at the end of a step, f, and its total slope df/dv.

    A law's formula and its state evolution are defined once, in NumPy, for arrays of any shape
    (:mod:`nucleation.model.friction`). numba compiles the same functions into one pass over the
    nodes of the interface for each of their lines.
    """
    own = [modules[formula.__module__], modules[implicit_log_state.__module__]]
    for module in own:
        for _, function in getmembers(module, isfunction):
            if function.__module__ == module.__name__:
                register_jitable(function)
    register_jitable(formula)

    def _at_end(  # type: ignore[no-untyped-def]
        v, past, beta, v0, distance, constants
    ):
        speed = np.sqrt(v * v + v0 * v0)
        psi, psi_by_rate = implicit_log_state(past, beta, speed / distance)
        coefficient, by_rate, by_log_state = formula(v, psi, constants)
        slope = by_rate + by_log_state * psi_by_rate * v / (speed * distance)
        return psi, coefficient, slope

    # numba finds compiled code by its name; processes share it, so the name has to be unique
    names = [module.__name__.rpartition(".")[2] for module in own]
    _at_end.__qualname__ = "_".join(names)
    content = "".join(map(getsource, [*own, passes]))
    return compiled(_at_end, content=content)


@dataclasses.dataclass(frozen=True)
class Interface:
    """Friction between a body and its base or a second body, and the accuracy of its solution."""

    friction: Friction  # its parameters may be arrays over the nodes 0..n_x
    tolerance: float = 1e-8  # of the residual, in units of the slip rate's relative change
    extra_normal: Array | float = 0.0  # N/m, on the nodes 0..n_x in addition to the body's

    @cached_property
    def _even(self) -> bool:
        """Whether the law is the same at all nodes."""
        law = self.friction
        return not any(map(np.ndim, (*law.constants, law.slip_distance)))

    def solve(
        self, operator: Operator, response: Forces, past: Past, imposed: Imposed, rates: Array
    ) -> InterfaceSolution:
        """Solve for the interface at the new time.

        The `response` holds the displacement of guessed slip rates (m/s), nodes 0..n_x. Raises
        NewtonFailure if there is no convergence, a force is not finite, or a nodal normal force of
        the solution is tensile.
        """
        law, modes = self.friction, operator.body.modes
        compiled_law = compiled_friction(type(law).formula, law.evolution_law.implicit_log_state)
        beta, velocity = past.beta, imposed.velocity
        strength = np.ones(rates.size) if imposed.strength is None else imposed.strength
        elastic = beta * operator.diagonal
        # of v = (w - past.w) / beta
        rounding = ROUNDING * passes.largest(past.w) / beta
        most = MOST_ITERATIONS_FROM_REST if past.at_rest else MOST_ITERATIONS
        w, p = response.w, response.tangential
        normal = response.normal + self.extra_normal
        anew = rates.size  # number of nodes, from the left, at which friction is evaluated again
        for iteration in range(most + 1):
            found = compiled_law(
                rates[:anew],
                past.log_state[:anew],
                beta,
                law.regularisation_slip_rate,
                law.slip_distance,
                law.constants,
            )
            if anew == rates.size:
                psi, coefficient, slope = found
            else:
                psi[:anew], coefficient[:anew], slope[:anew] = found
            least = np.full(rates.size, law.linear_below(psi))
            residual, damping, error, friction, active = passes.balance(
                p,
                normal,
                coefficient,
                slope,
                rates,
                elastic,
                least,
                self.tolerance,
                rounding,
                strength,
                ACTIVE,
            )
            if not math.isfinite(error):
                raise NewtonFailure("slip rate is not finite")
            if error < 1.0:
                if normal.min() <= 0.0:
                    raise NewtonFailure("the interface is in tension", Outcome.TENSION)
                # node 0 belongs to the driven edge; its friction follows from its rate V
                tangential = modes.on_all_nodes(p, -friction[0] * normal[0])
                return InterfaceSolution(rates, psi, tangential, normal, w, iteration)
            solved = _solved(operator, friction[1:], residual, damping, active, beta)
            linear = residual, elastic, damping, active, solved
            if law.asinh_of_rate:
                step = np.full(rates.size, law.step_at_rest(psi))
                v = passes.updated_by_asinh(rates, *linear, least, step)
            else:
                v = passes.updated(rates, *linear, law.regularisation_slip_rate)
            rates, w, change_of_w, reach = passes.moved(
                v,
                rates,
                velocity,
                not modes.has_edge,
                beta,
                past.w,
                response.w,
                UNCHANGED * self.tolerance,
                least,
            )
            anew = reach if self._even else rates.size
            p, normal = operator.apply(change_of_w)
            p += response.tangential
            normal += response.normal
            normal += self.extra_normal
        raise NewtonFailure(f"no convergence in {most} iterations")


def _solved(
    operator: Operator,
    coefficient: Array,
    residual: Array,
    damping: Array,
    active: NDArray[np.intp],
    beta: float,
) -> NDArray[np.float32]:
    """Change of the slip rates (m/s) of coupled nodes by ``beta (D + f N) + R df/dv``.

    Only nodes that elasticity couples are solved for together. Single precision is twice as fast
    there, and costs less than the method's second order. Each other node is solved for alone.
    """
    solved = -residual[active].astype(np.float32)
    if active.size:
        stiffness, coupling = operator.tangent(active + 1, np.float32)
        matrix = passes.newton_matrix(stiffness, coupling, coefficient, damping, active, beta)
        *_, solved, info = lapack.sgesv(matrix.T, solved, overwrite_a=True, overwrite_b=True)
        if info:
            raise NewtonFailure("the interface's tangent is singular")
    return solved
