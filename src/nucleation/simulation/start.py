"""The start of a run: the body at rest under its load, on an interface that can carry the stress.

If an elastic body is pressed down without slip, the shear stress at its free corner grows without
bound as the mesh is refined: the base prevents the expansion by Poisson's ratio. Where that stress
exceeds the strength, the interface has slipped already while the block was loaded.
"""

import numpy as np

from ..fem.grid import Field
from ..fem.operator import Operator, Response
from ..run.run import Run
from ..types import Array
from .interface import InterfaceSolution
from .step import Dynamics, State, StepReport


def at_rest(dynamics: Dynamics, run: Run) -> tuple[State, StepReport]:
    """The static field under the load at rest."""
    body = dynamics.body
    imposed = dynamics.drive.at(0.0)
    load = dynamics.in_frame(dynamics.drive.load(0.0), imposed)
    operator = Operator(body, 0.0)
    response = operator.respond(load, np.zeros(body.modes.n_x))
    if run.start.initial_stress == "uniform_shear" and run.fault.loading != "remote":
        response = _in_uniform_shear(dynamics, run, operator, load, response)
    else:
        response = _relaxed(dynamics, run, operator, load, response)
    displacement = operator.balance(response, response.w).displacement
    slip_rate = body.modes.on_all_nodes(np.zeros(body.modes.n_x), imposed.velocity)
    log_state = np.full_like(slip_rate, np.log(run.fault.initial_state))
    state = State.beginning(
        body.at_rest(displacement, imposed.velocity),
        slip_rate,
        log_state,
        response.w,
    )
    interface = InterfaceSolution(
        slip_rate,
        log_state,
        # at rest no friction acts on the driven edge's own node
        tangential=body.modes.on_all_nodes(response.tangential, 0.0),
        normal=response.normal + dynamics.interface.extra_normal,
        w=response.w,
        iterations=0,
    )
    friction = float(interface.tangential[dynamics.grid.own].sum())
    force = friction - dynamics.frame_inertia(imposed)
    return state, StepReport(interface, force, 0.0)


def _in_uniform_shear(
    dynamics: Dynamics,
    run: Run,
    operator: Operator,
    load: Field,
    response: Response,
) -> Response:
    """The response after the slip with which all nodes bear the initial shear stress."""
    n = dynamics.grid.n_x
    nodes = np.arange(1, n + 1)
    stiffness, _ = operator.tangent(nodes)
    forces = -run.start.initial_shear_stress * dynamics.grid.nodal_lengths[-n:]
    slip = np.linalg.solve(stiffness, forces - response.tangential)
    return operator.respond(load, slip)


def _relaxed(
    dynamics: Dynamics,
    run: Run,
    operator: Operator,
    load: Field,
    response: Response,
) -> Response:
    """The response after slip of all nodes that bore more shear than their strength.

    These then bear their strength, that of sliding at V. Without such nodes it is `response`.
    """
    n = dynamics.grid.n_x
    friction = dynamics.interface.friction
    of_law = friction.coefficient(run.fault.velocity, run.fault.initial_state)
    on_all_nodes = np.broadcast_to(of_law, dynamics.grid.n_x + 1)
    coefficient = on_all_nodes[-n:]

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
        strength = signed * normal_forces(response)[nodes]
        excess = strength - response.tangential[nodes]
        matrix = stiffness - signed[:, None] * coupling
        w = response.w.copy()
        w[nodes] += np.linalg.solve(matrix, excess)
        response = operator.respond(load, w)
