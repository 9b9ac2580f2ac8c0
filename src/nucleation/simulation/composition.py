"""The usual composition of a run: one block, friction, the declared drive, BDF."""

from __future__ import annotations

from ..fem.block import Block
from ..fem.grid import Grid
from ..model.parameters import Parameters
from ..stepping.scheme import BDF
from .forcing import drive_of
from .interface import Interface
from .step import Dynamics


def composed(parameters: Parameters) -> Dynamics:
    """The dynamics that parameters ask for: here a further body, drive or scheme is chosen."""
    body = Block(Grid.of(parameters.geometry, parameters.mesh), parameters.material)
    return Dynamics(
        body,
        Interface(parameters.friction),
        drive_of(parameters, body),
        BDF(body.crossing_time),
    )
