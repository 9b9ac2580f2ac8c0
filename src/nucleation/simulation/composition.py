"""The usual composition of a run: one block or two, friction, the declared drive, BDF."""

from __future__ import annotations

from ..fem.bodies import body_of
from ..model.parameters import Parameters
from ..stepping.scheme import BDF
from .forcing import drive_of
from .interface import Interface
from .step import Dynamics


def composed(parameters: Parameters) -> Dynamics:
    """The dynamics that parameters ask for: here a further drive or scheme is chosen."""
    body = body_of(parameters)
    return Dynamics(
        body,
        Interface(parameters.friction),
        drive_of(parameters, body),
        BDF(body.crossing_time),
    )
