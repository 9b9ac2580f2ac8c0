"""Loads that are functions of time reach the body and the interface."""

import dataclasses

import numpy as np

from nucleation.run.run import PAPER_RUN
from nucleation.simulation.drive import Steady
from nucleation.simulation.interface import Interface
from nucleation.simulation.start import at_rest, composed
from nucleation.simulation.step import Dynamics

PARAMETERS = PAPER_RUN.replaced(
    height=0.02, block_length=0.4, n_x=16, n_y=4, grading=2.0, normal_stress=2e5, velocity=1e-3
)
LADDER = (*range(-92, -60, 4), *[-60] * 30)
STRENGTH = 1.3


def last_step(parameters, drive=None, interface=None):
    """The report after some steps of the usual composition, but for drive and interface."""
    usual = composed(parameters)
    dynamics = Dynamics(
        usual.body, interface or usual.interface, drive or usual.drive, usual.scheme
    )
    state, report = at_rest(dynamics, parameters)
    for rung in LADDER:
        state, report = dynamics.advance(state, rung)
    return state, report


@dataclasses.dataclass(frozen=True)
class Stronger(Steady):
    """The same friction at all nodes, but stronger."""

    def at(self, time):
        return super().at(time)._replace(strength=np.full(17, STRENGTH))


def test_strength_multiplies_friction():
    friction, steady = PARAMETERS.law, composed(PARAMETERS).drive
    _, found = last_step(PARAMETERS, Stronger(steady.velocity, steady.constant_load))
    stronger = dataclasses.replace(
        friction,
        base_friction=STRENGTH * friction.base_friction,
        rate_coefficient=STRENGTH * friction.rate_coefficient,
    )
    _, expected = last_step(PARAMETERS, interface=Interface(stronger))
    assert np.count_nonzero(expected.interface.slip_rate > 1e-5) >= 2
    for name in ("slip_rate", "log_state", "tangential", "normal"):
        one, other = getattr(found.interface, name), getattr(expected.interface, name)
        np.testing.assert_allclose(one, other, rtol=1e-7, atol=1e-9 * np.abs(other).max())
