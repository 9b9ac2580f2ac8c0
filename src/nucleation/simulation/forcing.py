"""Drives with a declared perturbation, one class for each of its kinds.

Each is a function of time alone, without memory: a restart needs nothing of it. V(t), U(t) and
U''(t) of a fluctuating velocity are exact, not sums over steps.
"""

import dataclasses
from typing import Any

import numpy as np

from ..fem.field import Field
from ..model.parameters import Parameters
from ..types import Array
from .drive import Drive, Imposed, Recorded, Remote, Steady
from .realisation import Series, Sheet, profile


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
