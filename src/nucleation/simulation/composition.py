"""The usual composition of a run: one block, friction, a steady drive, BDF."""

from __future__ import annotations

from ..fem.block import Block
from ..fem.grid import Grid
from ..model.parameters import Parameters
from ..stepping.scheme import BDF
from .drive import Steady
from .interface import Interface
from .step import Dynamics


def composed(parameters: Parameters) -> Dynamics:
    """The dynamics that parameters ask for: here a further body, drive or scheme is chosen."""
    loading = parameters.loading
    body = Block(Grid.of(parameters.geometry, parameters.mesh), parameters.material)
    return Dynamics(
        body,
        Interface(parameters.friction),
        Steady(loading.velocity, body.top_load(loading.normal_stress)),
        BDF(body.crossing_time),
    )
