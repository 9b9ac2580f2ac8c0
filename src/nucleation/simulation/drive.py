"""Drives: the loads on a run as functions of time.

A :class:`Drive` gives the velocity of the driven edge, the loads on the body, the strength of the
interface and the forcing of its state at any time; a step evaluates it at its end. A drive must be
a function of time alone: independent of the steps, and the same after a restart from a checkpoint.
"""

import dataclasses
from typing import ClassVar, NamedTuple

from ..fem.grid import Field
from ..types import Array


class Imposed(NamedTuple):
    """Boundary conditions on the driven edge and on the interface at one instant."""

    time: float  # s
    displacement: float  # m, U(t) of the driven edge
    velocity: float  # m/s, V(t)
    strength: Array | None = None  # factor on the friction coefficient, nodes 0..n_x; None: 1
    state_forcing: Array | None = None  # added to d log(phi)/dt (1/s), nodes 0..n_x; None: 0
    acceleration: float = 0.0  # m/s^2, U''(t) of the driven edge


class Drive:
    """Loads as functions of time; `velocity` (m/s), unperturbed, is the scale of slip rates."""

    velocity: float
    moves: ClassVar[bool] = True  # an edge is moved, and the driving force is the force on it

    def at(self, time: float) -> Imposed:
        """Boundary conditions at a time (s)."""
        raise NotImplementedError

    def load(self, time: float) -> Field:
        """External load (N/m) on the body at a time (s)."""
        raise NotImplementedError


@dataclasses.dataclass(frozen=True)
class Steady(Drive):
    """An edge that moves at a constant velocity (m/s) under a constant load (N/m)."""

    velocity: float
    constant_load: Field

    def at(self, time: float) -> Imposed:
        return Imposed(time, self.velocity * time, self.velocity)

    def load(self, time: float) -> Field:
        return self.constant_load


@dataclasses.dataclass(frozen=True)
class Remote(Drive):
    """A far shear load that rises with the displacement of an imaginary driven edge.

    No edge moves. Where the edge's velocity would fluctuate, the rate of the far load does.
    """

    velocity: float
    near: Drive
    start: Field  # N/m, the far load at time zero
    rising: Field  # N/m per m of the edge's displacement
    moves: ClassVar[bool] = False

    def at(self, time: float) -> Imposed:
        return self.near.at(time)._replace(
            displacement=0.0,
            velocity=0.0,
            acceleration=0.0,
        )

    def load(self, time: float) -> Field:
        displacement = self.near.at(time).displacement
        risen = self.rising.times(displacement)
        return self.near.load(time).plus(self.start).plus(risen)
