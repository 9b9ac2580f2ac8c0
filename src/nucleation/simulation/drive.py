"""What drives a run: the loads as functions of time.

A :class:`Drive` says what is imposed on the body and on its interface at an instant; a step asks
for the instant at which it ends. It must be a function of time alone, whatever the steps are, and
the same in a run that goes on from a checkpoint. Drives that are not steady are other classes
(:mod:`.forcing`): an edge velocity V(t) with its integral U(t), a normal stress in
:meth:`Drive.load`, a strength that varies along x, a forcing of the state.
"""

from __future__ import annotations

import dataclasses
from typing import Protocol

from ..fem.field import Field
from ..types import Array


@dataclasses.dataclass(frozen=True)
class Imposed:
    """What is imposed on the driven edge and on the interface at one instant."""

    time: float  # s
    displacement: float  # m, U(t) of the driven edge
    velocity: float  # m/s, V(t)
    strength: Array | None = None  # factor on the friction coefficient, nodes 0..n_x; None: 1
    state_forcing: Array | None = None  # added to d log(phi)/dt (1/s), nodes 0..n_x; None: 0
    acceleration: float = 0.0  # m/s^2, U''(t) of the driven edge


class Drive(Protocol):
    """Loads as functions of time."""

    @property
    def velocity(self) -> float:
        """The usual velocity (m/s) of the driven edge, the scale of slip rates."""

    def at(self, time: float) -> Imposed:
        """What is imposed on driven edge and interface at a time (s)."""

    def load(self, time: float) -> Field:
        """The body's external load (N/m) at a time (s)."""


@dataclasses.dataclass(frozen=True)
class Steady:
    """An edge that moves at a constant velocity under a constant load."""

    velocity: float  # m/s
    constant_load: Field  # N/m, as of a body's ``top_load``

    def at(self, time: float) -> Imposed:
        """What is imposed on driven edge and interface at a time (s)."""
        return Imposed(time, self.velocity * time, self.velocity)

    def load(self, time: float) -> Field:
        """The same load (N/m) at all times."""
        return self.constant_load
