"""The parts of a run put together, and its start.

A run starts at rest under its load, on an interface that can carry the stress. If an elastic body
is pressed down without slip, the shear stress at its free corner grows without bound as the mesh is
refined: the base prevents the expansion by Poisson's ratio. Where that stress exceeds the strength,
the interface has slipped already while the block was loaded.
"""

import numpy as np

from ..fem.body import Body
from ..fem.grid import Field, Grid
from ..fem.operator import Operator, Response
from ..model.perturbations import KINDS
from ..run import run as runs
from ..run.checks import require_consistent
from ..run.run import Run
from ..types import Array
from .drive import remote_drive, steady_drive
from .interface import Interface, InterfaceSolution
from .step import Dynamics, State, StepReport
from .stepping import BDF

NEWTON = 1e-3
"""Largest tolerance of Newton's method over that of the step, if the run is perturbed."""


def grid_of(body: runs.Body, periodic: bool = False) -> Grid:
    """The mesh of a block."""
    return Grid(body.length, body.height, body.n_x, body.n_y, body.grading, periodic)


def body_of(run: Run) -> Body:
    """The body of a run: pushed at its left edge, or periodic under a remote load.

    A ParameterError names contradictions.
    """
    require_consistent(run)
    return layers_of(run, periodic=run.fault.loading == "remote")


def layers_of(run: Run, periodic: bool) -> Body:
    """The body or bodies of a run, whether they fit or not; a period's ``n_x`` is odd."""
    upper, below = run.upper, run.below
    first = grid_of(upper, periodic), upper.material
    if below is None:
        return Body(first)
    return Body(first, (grid_of(below, periodic), below.material), below.far_side)


def interface_of(run: Run, grid: Grid) -> Interface:
    """The frictional interface of a run on the mesh of its body, with its heterogeneity."""
    varied = run.heterogeneity
    friction = run.law
    tolerance = Interface.tolerance  # an unperturbed run is perturbed by round-off alone
    if run.perturbation.acts:
        coarse = NEWTON * run.stepping.tolerance
        tolerance = max(tolerance, min(coarse, run.perturbation.strength))
    if varied.varies == "none":
        return Interface(friction, tolerance)
    factor = varied.factor(grid.x, grid.length, grid.periodic)
    friction = varied.friction(friction, run.fault.velocity, factor)
    extra: Array | float = 0.0
    if varied.varies == "normal_stress":
        extra = run.fault.normal_stress * (factor - 1.0) * grid.nodal_lengths
    return Interface(friction, tolerance, extra_normal=extra)


def composed(run: Run) -> Dynamics:
    """The dynamics of a run: a further drive or scheme is chosen here."""
    body = body_of(run)
    interface = interface_of(run, body.grid)
    load = body.far_load(run.fault.normal_stress)
    drive = steady_drive(run.fault.velocity, load)
    if run.perturbation.acts:
        steady, kind = drive.at, KINDS[run.perturbation.kind]
        made = kind(run.perturbation, run.memory_time, run.fault.velocity, body.grid.x)
        drive = drive._replace(at=lambda time: steady(time)._replace(**made.imposed(time)))
    if run.fault.loading == "remote":
        shear = body.far_load(0.0, 1.0)
        rising = run.start.stress_rate / run.fault.velocity
        drive = remote_drive(drive, shear, run.start.initial_shear_stress, rising)
    return Dynamics(body, interface, drive, BDF(body.crossing_time))


def at_rest(dynamics: Dynamics, run: Run) -> tuple[State, StepReport]:
    """The static field under the load at rest."""
    body = dynamics.body
    imposed = dynamics.drive.at(0.0)
    factors = dynamics.factors(imposed)
    load = dynamics.load(0.0, factors)
    operator = dynamics.operator(0.0)
    response = operator.respond(load, np.zeros(body.modes.n_x))
    if run.start.initial_stress == "uniform_shear" and run.fault.loading != "remote":
        # after the slip with which all nodes bear the initial shear stress
        nodes = np.arange(1, body.modes.n_x + 1)
        stiffness, _ = operator.tangent(nodes)
        forces = -run.start.initial_shear_stress * dynamics.grid.nodal_lengths[nodes]
        slip = np.linalg.solve(stiffness, forces - response.tangential)
        response = operator.respond(load, slip)
    else:
        response = _relaxed(dynamics, run, operator, load, response)
    displacement = operator.balance(response, response.w)[0]
    slip_rate = body.modes.on_all_nodes(np.zeros(body.modes.n_x), imposed.velocity)
    log_state = np.full_like(slip_rate, np.log(run.fault.initial_state))
    motion = body.at_rest(displacement, imposed.velocity, factors)
    past = slip_rate[None], log_state[None], response.w[None]
    state = State((motion,), np.zeros(1), *past)
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
    force = friction - body.total_mass * imposed.acceleration
    return state, StepReport(interface, force, 0.0)


def _relaxed(
    dynamics: Dynamics, run: Run, operator: Operator, load: Field, response: Response
) -> Response:
    """The response after slip of all nodes that bore more shear than their strength.

    These then bear their strength, that of sliding at V. Without such nodes it is `response`.
    """
    n = dynamics.grid.n_x
    friction = dynamics.interface.friction
    of_law = friction.coefficient(run.fault.velocity, run.fault.initial_state)
    on_all_nodes = np.broadcast_to(of_law, dynamics.grid.n_x + 1)
    coefficient = on_all_nodes[-n:]
    extra = np.broadcast_to(dynamics.interface.extra_normal, n + 1)[-n:]
    slipped = np.zeros(n, dtype=bool)
    direction = np.sign(response.tangential)
    while True:
        normal = response.normal[-n:] + extra
        strength = coefficient * normal
        weaker = ~slipped & (np.abs(response.tangential) > strength)
        if not weaker.any():
            return response
        slipped |= weaker
        nodes = np.flatnonzero(slipped)
        stiffness, coupling = operator.tangent(nodes + 1)
        signed = (direction * coefficient)[nodes]
        excess = signed * normal[nodes] - response.tangential[nodes]
        matrix = stiffness - signed[:, None] * coupling
        w = response.w.copy()
        w[nodes] += np.linalg.solve(matrix, excess)
        response = operator.respond(load, w)
