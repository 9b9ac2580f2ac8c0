"""Homogeneous sliding of a periodic block or pair: step and interface of the simulation."""

from __future__ import annotations

import numpy as np

from ..fem.bodies import period_of
from ..model.parameters import Parameters
from ..stepping.scheme import BDF
from ..types import Array
from .drive import Steady
from .interface import Interface
from .state import State
from .step import Dynamics


def sliding_period(parameters: Parameters, interface: Interface | None = None) -> Dynamics:
    """A period of a long block that slides homogeneously at V: by traction, or by its top.

    ``geometry.length`` is the period. The reports' driving force has no meaning here.

    Parameters
    ----------
    parameters : of the period, its number of nodes ``mesh.n_x`` odd.
    interface : by default that of the simulation.
    """
    body = period_of(parameters)
    law, loading = parameters.friction, parameters.loading
    shear = loading.normal_stress * float(law.steady_coefficient(loading.velocity))
    load = body.top_load(loading.normal_stress, shear)
    return Dynamics(
        body, interface or Interface(law), Steady(loading.velocity, load), BDF(body.crossing_time)
    )


def sliding_state(dynamics: Dynamics, perturbation: Array) -> State:
    """Homogeneous steady sliding, with a perturbation of log(phi) at the period's nodes."""
    body, n, velocity = dynamics.body, dynamics.grid.n_x, dynamics.drive.velocity
    operator = body.operator(0.0)
    far_side = getattr(body, "upper", body).far_side  # type: ignore[union-attr]
    load = dynamics.drive.load(0.0)
    response = operator.respond(load, np.zeros(n))
    if far_side == "velocity":  # the interface lags behind the top that drags it
        strength = dynamics.interface.friction.steady_coefficient(velocity) * response.normal[1:]
        response = operator.respond(load, -strength / operator.apply(np.ones(n))[0])
    balance = operator.balance(response, response.w)
    steady = float(np.log(dynamics.interface.friction.steady_state(velocity)))
    # carried along by the driving traction, it stands still as seen from V
    motion = body.at_rest(balance.displacement, 0.0)
    rates, log_state = np.full(n + 1, velocity), steady + np.append(0.0, perturbation)
    return State.beginning(motion, rates, log_state, response.w, balance.memory)
