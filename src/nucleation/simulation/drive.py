"""Drives: the loads on a run as functions of time.

A :class:`Drive` gives the velocity of the driven edge, the loads on the body, the strength of the
interface and the forcing of its state at any time; a step evaluates it at its end. A drive must be
a function of time alone: independent of the steps, and the same after a restart from a checkpoint.
"""

import dataclasses
from typing import ClassVar, NamedTuple

from ..fem.body import Body
from ..fem.grid import Field
from ..run.run import Run
from ..types import Array
from .realisation import Series, Sheet, profile


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
class _Remote(Drive):
    """A far shear load that rises with the displacement of an imaginary driven edge.

    No edge moves. Where the edge's velocity would fluctuate, the rate of the far load does.
    """

    velocity: float
    near: Steady
    start: Field  # N/m, the far load at time zero
    rising: Field  # N/m per m of the edge's displacement
    moves: ClassVar[bool] = False

    def at(self, time: float) -> Imposed:
        return self.near.at(time)._replace(displacement=0.0, velocity=0.0, acceleration=0.0)

    def load(self, time: float) -> Field:
        displacement = self.near.at(time).displacement
        risen = self.rising.times(displacement)
        return self.near.load(time).plus(self.start).plus(risen)


@dataclasses.dataclass(frozen=True)
class _FluctuatingVelocity(Steady):
    """An edge that moves at ``V [1 + eps xi(t)]``."""

    strength: float  # eps
    series: Series

    def at(self, time: float) -> Imposed:
        size = self.strength
        ahead = size * self.series.integral(time)
        faster = size * self.series.value(time)
        return Imposed(
            time,
            displacement=self.velocity * (time + ahead),
            velocity=self.velocity * (1.0 + faster),
            acceleration=self.velocity * size * self.series.slope(time),
        )


@dataclasses.dataclass(frozen=True)
class _FluctuatingLoad(Steady):
    """A stress ``sigma0 [1 + eps xi(t)]`` on the top."""

    strength: float  # eps
    series: Series

    def load(self, time: float) -> Field:
        larger = self.strength * self.series.value(time)
        return self.constant_load.times(1.0 + larger)


@dataclasses.dataclass(frozen=True)
class _UnevenStrength(Steady):
    """A friction coefficient ``f(v, phi) [1 + eps xi(x)]``."""

    factor: Array  # at the nodes 0..n_x

    def at(self, time: float) -> Imposed:
        return super().at(time)._replace(strength=self.factor)


@dataclasses.dataclass(frozen=True)
class _ForcedState(Steady):
    """A state variable that evolves by ``d log(phi)/dt = g + eps (V/D) xi(x, t)``."""

    rate: float  # eps V/D, 1/s
    sheet: Sheet

    def at(self, time: float) -> Imposed:
        forcing = self.rate * self.sheet.values(time)
        return super().at(time)._replace(state_forcing=forcing)


def drive_of(run: Run, body: Body) -> Drive:
    """The drive of a run: a moving edge, or a far load that rises."""
    near = _near_drive(run, body)
    if run.fault.loading != "remote":
        return near
    shear = body.far_load(0.0, 1.0)
    start = shear.times(run.start.initial_shear_stress)
    per_displacement = run.start.stress_rate / run.fault.velocity
    return _Remote(near.velocity, near, start, shear.times(per_displacement))


def _near_drive(run: Run, body: Body) -> Steady:
    """The moving edge and the normal load, with their declared perturbation."""
    declared = run.perturbation
    velocity = run.fault.velocity
    load = body.far_load(run.fault.normal_stress)
    if not declared.acts:
        return Steady(velocity, load)
    strength, seed = declared.strength, declared.seed
    time = declared.correlation_time * run.memory_time
    length = declared.correlation_length
    if declared.kind == "drive_velocity":
        return _FluctuatingVelocity(velocity, load, strength, Series(seed, time))
    if declared.kind == "normal_load":
        return _FluctuatingLoad(velocity, load, strength, Series(seed, time))
    if declared.kind == "strength":
        factor = 1.0 + strength * profile(seed, length, body.grid.x)
        return _UnevenStrength(velocity, load, factor)
    rate = strength * (1.0 / run.memory_time)
    return _ForcedState(velocity, load, rate, Sheet(seed, time, length, body.grid.x))
