"""The usual composition of a run: one block or two, friction, the declared drive, BDF."""

from __future__ import annotations

from ..fem.bodies import body_of
from ..fem.grid import Grid
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
        interface_of(parameters, body.grid),
        drive_of(parameters, body),
        BDF(body.crossing_time),
    )


def interface_of(parameters: Parameters, grid: Grid) -> Interface:
    """The frictional interface with what varies along it."""
    varied, loading = parameters.heterogeneity, parameters.loading
    if varied.varies == "none":
        return Interface(parameters.friction)
    factor = varied.factor(grid.x, grid.length, grid.periodic)
    friction = varied.friction(parameters.friction, loading.velocity, factor)
    if varied.varies != "normal_stress":
        return Interface(friction)
    extra = loading.normal_stress * (factor - 1.0) * grid.nodal_lengths
    return Interface(friction, extra_normal=extra)
