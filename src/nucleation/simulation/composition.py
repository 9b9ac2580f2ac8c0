"""The usual composition of a run, one block or two, friction, the drive, BDF; and its start."""

import numpy as np

from ..fem.bodies import body_of
from ..fem.grid import Grid
from ..model.parameters import Loading, Parameters
from .forcing import drive_of
from .interface import Interface, InterfaceSolution
from .state import State
from .step import Dynamics, StepReport
from .stepping.scheme import BDF

NEWTON = 1e-3
"""Of Newton's tolerance over the step's, at most; nor is it above a perturbation's strength."""


def composed(parameters: Parameters) -> Dynamics:
    """The dynamics that parameters ask for: here a further drive or scheme is chosen."""
    body = body_of(parameters)
    interface, drive = interface_of(parameters, body.grid), drive_of(parameters, body)
    return Dynamics(body, interface, drive, BDF(body.crossing_time))


def interface_of(parameters: Parameters, grid: Grid) -> Interface:
    """The frictional interface with what varies along it."""
    varied, loading = parameters.heterogeneity, parameters.loading
    tolerance = Interface.tolerance  # quiet runs live on round-off
    if parameters.perturbation.acts:
        declared = min(NEWTON * parameters.stepping.tolerance, parameters.perturbation.strength)
        tolerance = max(tolerance, declared)
    if varied.varies == "none":
        return Interface(parameters.friction, tolerance)
    factor = varied.factor(grid.x, grid.length, grid.periodic)
    friction = varied.friction(parameters.friction, loading.velocity, factor)
    if varied.varies != "normal_stress":
        return Interface(friction, tolerance)
    extra = loading.normal_stress * (factor - 1.0) * grid.nodal_lengths
    return Interface(friction, tolerance, extra_normal=extra)


def at_rest(dynamics: Dynamics, loading: Loading) -> tuple[State, StepReport]:
    """The static field under the load at rest, without slip or in uniform shear."""
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
