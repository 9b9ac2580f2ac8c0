"""Where a run starts: a body at rest under its load, and an interface that begins to be driven."""

from __future__ import annotations

import numpy as np

from ..model.parameters import Loading
from .interface import InterfaceSolution
from .state import State
from .step import Dynamics, StepReport


def at_rest(dynamics: Dynamics, loading: Loading) -> tuple[State, StepReport]:
    """The static field under the load at rest, without slip or in uniform shear.

    Parameters
    ----------
    dynamics : what is to start.
    loading : its ``initial_state`` (s), ``initial_stress`` and ``initial_shear_stress`` (Pa).
    """
    body, grid, imposed = dynamics.body, dynamics.grid, dynamics.drive.at(0.0)
    n, operator, load = body.free_nodes, body.operator(0.0), dynamics.load(imposed)
    response = operator.respond(load, np.zeros(n))
    if loading.initial_stress == "uniform_shear" and loading.kind != "remote":
        forces = -loading.initial_shear_stress * grid.nodal_lengths[-n:]
        stiffness, _ = operator.tangent(np.arange(1, n + 1))
        slipped = np.linalg.solve(stiffness, forces - response.tangential)
        response = operator.respond(load, slipped)
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
