"""What drives a run: the loads as functions of time.

A :class:`Drive` says what is imposed on the body and on its interface at an instant; a step asks
for the instant at which it ends. It must be a function of time alone, whatever the steps are, and
the same in a run that goes on from a checkpoint. Drives that are not steady are other classes
(:mod:`.forcing`): an edge velocity V(t) with its integral U(t), a normal stress in
:meth:`Drive.load`, a strength that varies along x, a forcing of the state.
"""

import dataclasses
from typing import ClassVar, Protocol

from ..fem.field import Field
from ..types import Array

Recorded = tuple[tuple[str, ...], Array]


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

    @property
    def moves(self) -> bool:
        """Whether an edge or a side is moved; the load is then the force on it."""

    def at(self, time: float) -> Imposed:
        """What is imposed on driven edge and interface at a time (s)."""

    def load(self, time: float) -> Field:
        """The body's external load (N/m) at a time (s)."""

    def realised(self, steps: Array, frames: Array) -> Recorded | None:
        """The relative perturbation as a variable of a record: dimensions and values, if any.

        Parameters
        ----------
        steps, frames : times (s) of all steps, and of the frames that show the interface.
        """
        return None


@dataclasses.dataclass(frozen=True)
class Steady:
    """An edge that moves at a constant velocity under a constant load."""

    velocity: float  # m/s
    constant_load: Field  # N/m, as of a body's ``top_load``
    moves: ClassVar[bool] = True

    def at(self, time: float) -> Imposed:
        """What is imposed on driven edge and interface at a time (s)."""
        return Imposed(time, self.velocity * time, self.velocity)

    def load(self, time: float) -> Field:
        """The same load (N/m) at all times."""
        return self.constant_load

    def realised(self, steps: Array, frames: Array) -> Recorded | None:
        """Nothing is perturbed."""
        return None


@dataclasses.dataclass(frozen=True)
class Remote:
    """No edge moves; in its place far loads rise with the displacement that it would have had.

    So the rate of the shear stress fluctuates where an edge's velocity would.
    """

    near: Steady
    start: Field  # N/m, the far load at time zero
    rising: Field  # N/m per m of that displacement
    moves: ClassVar[bool] = False

    @property
    def velocity(self) -> float:
        """The scale (m/s) of slip rates."""
        return self.near.velocity

    def at(self, time: float) -> Imposed:
        """What is imposed at a time (s)."""
        imposed = self.near.at(time)
        return dataclasses.replace(imposed, displacement=0.0, velocity=0.0, acceleration=0.0)

    def load(self, time: float) -> Field:
        """The load (N/m) at a time (s)."""
        risen = self.rising.times(self.near.at(time).displacement)
        return self.near.load(time).plus(self.start).plus(risen)

    def realised(self, steps: Array, frames: Array) -> Recorded | None:
        """The perturbation of what it is made of."""
        return self.near.realised(steps, frames)
