"""What drives a run: the loads as functions of time.

A :class:`Drive` says what is imposed on the body and on its interface at an instant; a step asks
for the instant at which it ends. It must be a function of time alone, whatever the steps are, and
the same in a run that goes on from a checkpoint. Drives that are not steady are other classes
of a declared perturbation: an edge velocity V(t) with its integral U(t), a normal stress in
:meth:`Drive.load`, a strength that varies along x, a forcing of the state.
"""

import dataclasses
from typing import Any, ClassVar, Protocol

import numpy as np

from ..fem.grid import Field
from ..model.parameters import Parameters
from ..types import Array
from .realisation import Series, Sheet, profile

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


@dataclasses.dataclass(frozen=True)
class Perturbed(Steady):
    """A steady drive and what a perturbation of relative strength eps adds to it."""

    strength: float  # eps


@dataclasses.dataclass(frozen=True)
class InTime(Perturbed):
    """A perturbation that is one function of time, the same everywhere."""

    series: Series

    def realised(self, steps: Array, frames: Array) -> Recorded:
        """``eps xi`` at every step."""
        return ("step",), self.strength * np.array([self.series.value(t) for t in steps])


@dataclasses.dataclass(frozen=True)
class FluctuatingVelocity(InTime):
    """An edge that moves at ``V [1 + eps xi(t)]``."""

    def at(self, time: float) -> Imposed:
        """What is imposed at a time (s): U(t) and its derivatives are those of the series."""
        size, series = self.strength, self.series
        return Imposed(
            time,
            self.velocity * (time + size * series.integral(time)),
            self.velocity * (1.0 + size * series.value(time)),
            acceleration=self.velocity * size * series.slope(time),
        )


@dataclasses.dataclass(frozen=True)
class FluctuatingLoad(InTime):
    """A stress ``sigma0 [1 + eps xi(t)]`` on the top."""

    def load(self, time: float) -> Field:
        """The load (N/m) at a time (s)."""
        return self.constant_load.times(1.0 + self.strength * self.series.value(time))


@dataclasses.dataclass(frozen=True)
class UnevenStrength(Perturbed):
    """A friction coefficient ``f(v, phi) [1 + eps xi(x)]``."""

    uneven: Array  # xi at the nodes 0..n_x

    def at(self, time: float) -> Imposed:
        """What is imposed at a time (s)."""
        factor = 1.0 + self.strength * self.uneven
        return dataclasses.replace(super().at(time), strength=factor)

    def realised(self, steps: Array, frames: Array) -> Recorded:
        """``eps xi`` along x."""
        return ("x",), self.strength * self.uneven


@dataclasses.dataclass(frozen=True)
class ForcedState(Perturbed):
    """A state variable that evolves by ``d log(phi)/dt = g + eps (V/D) xi(x, t)``."""

    rate: float  # V/D, 1/s
    sheet: Sheet

    def at(self, time: float) -> Imposed:
        """What is imposed at a time (s)."""
        forcing = (self.strength * self.rate) * self.sheet.values(time)
        return dataclasses.replace(super().at(time), state_forcing=forcing)

    def realised(self, steps: Array, frames: Array) -> Recorded:
        """``eps xi`` along x, in every frame."""
        return ("time", "x"), self.strength * np.array([self.sheet.values(t) for t in frames])


def drive_of(parameters: Parameters, body: Any) -> Drive:
    """The drive that parameters ask for: an edge or a top that moves, or a far load that rises.

    Of the body it takes the grid and ``top_load``, of a normal and perhaps a shear stress (Pa).
    """
    loading, near = parameters.loading, near_drive(parameters, body)
    if loading.kind != "remote":
        return near
    shear = body.top_load(0.0, 1.0)
    per_displacement = loading.stress_rate / loading.velocity
    start = shear.times(loading.initial_shear_stress)
    return Remote(near, start, shear.times(per_displacement))


def near_drive(parameters: Parameters, body: Any) -> Steady:
    """What moves, and the normal load: steady where nothing is perturbed."""
    declared, loading = parameters.perturbation, parameters.loading
    velocity, load = loading.velocity, body.top_load(loading.normal_stress)
    if not declared.acts:
        return Steady(velocity, load)
    steady, x = (velocity, load, declared.strength), body.grid.x
    seed, scale = declared.seed, declared.correlation_length
    time = declared.correlation_time * parameters.memory_time
    if declared.kind == "drive_velocity":
        return FluctuatingVelocity(*steady, Series(seed, time))
    if declared.kind == "normal_load":
        return FluctuatingLoad(*steady, Series(seed, time))
    if declared.kind == "strength":
        return UnevenStrength(*steady, profile(seed, scale, x))
    return ForcedState(*steady, 1.0 / parameters.memory_time, Sheet(seed, time, scale, x))
