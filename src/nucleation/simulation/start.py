"""The start of a run: the body at rest under its load, on an interface that can carry the stress.

An elastic body that is pressed down without slip has a large shear stress at its free corner, which
grows without bound as the mesh is refined: the base holds back what Poisson's ratio widens. Where
that stress is above the strength, the interface has slipped already when the block was loaded.
"""

import numpy as np

from ..fem.condensed import Operator, Response
from ..fem.grid import Field
from ..model.parameters import Loading
from ..types import Array
from .interface import InterfaceSolution
from .state import State
from .step import Dynamics, StepReport


def at_rest(dynamics: Dynamics, loading: Loading) -> tuple[State, StepReport]:
    """The static field under the load at rest.

    Parameters
    ----------
    dynamics : Dynamics
        What is to step from there.
    loading : Loading
        Its ``initial_stress`` says whether the interface starts in uniform shear, or without slip
        except where that leaves more shear than the interface can carry.
    """
    body, grid, imposed = dynamics.body, dynamics.grid, dynamics.drive.at(0.0)
    n, operator, load = body.free_nodes, body.operator(0.0), dynamics.load(imposed)
    response = operator.respond(load, np.zeros(n))
    if loading.initial_stress == "uniform_shear" and loading.kind != "remote":
        forces = -loading.initial_shear_stress * grid.nodal_lengths[-n:]
        stiffness, _ = operator.tangent(np.arange(1, n + 1))
        slipped = np.linalg.solve(stiffness, forces - response.tangential)
        response = operator.respond(load, slipped)
    else:
        response = _relaxed(dynamics, loading, operator, load, response)
    balance = operator.balance(response, response.w)
    slip_rate = body.on_all_nodes(np.zeros(n), imposed.velocity)
    log_state = np.full(grid.n_x + 1, float(np.log(loading.initial_state)))
    motion = body.at_rest(balance.displacement, imposed.velocity)
    state = State.beginning(motion, slip_rate, log_state, response.w, balance.memory)
    normal = response.normal + dynamics.interface.extra_normal
    # at rest no friction acts on the driven edge's own node
    tangential = body.on_all_nodes(response.tangential, 0.0)
    interface = InterfaceSolution(slip_rate, log_state, tangential, normal, response.w, 0)
    force = float(tangential[grid.own].sum()) - dynamics.frame_inertia(imposed)
    return state, StepReport(interface, force, 0.0)


def _relaxed(
    dynamics: Dynamics, loading: Loading, operator: Operator, load: Field, response: Response
) -> Response:
    """The response once all nodes have slipped that bore more shear than their strength.

    These bear their strength, that of sliding at V. Where no node did, it is `response` itself.
    """
    n = dynamics.body.free_nodes
    friction = dynamics.interface.friction
    of_law = friction.coefficient(loading.velocity, loading.initial_state)
    coefficient = np.broadcast_to(of_law, dynamics.grid.n_x + 1)[-n:]

    def normal_forces(now: Response) -> Array:
        return (now.normal + dynamics.interface.extra_normal)[-n:]

    slipped = np.zeros(n, dtype=bool)
    direction = np.sign(response.tangential)
    while True:
        strength = coefficient * normal_forces(response)
        weaker = ~slipped & (np.abs(response.tangential) > strength)
        if not weaker.any():
            return response
        slipped |= weaker
        nodes = np.flatnonzero(slipped)
        stiffness, coupling = operator.tangent(nodes + 1)
        signed = (direction * coefficient)[nodes]
        excess = signed * normal_forces(response)[nodes] - response.tangential[nodes]
        w = response.w.copy()
        w[nodes] += np.linalg.solve(stiffness - signed[:, None] * coupling, excess)
        response = operator.respond(load, w)
