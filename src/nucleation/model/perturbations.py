"""The kinds of perturbations: what each changes in a simulation, and its power for the theory.

A kind is one class below. It says whether it changes in time and along x, what it imposes on the
drive of a simulation at a time, and, if it changes in time, with which power it forces the mode of
the creeping patch (docs/drop.md#the-law-of-the-drop). A class with a part missing is refused where
it is defined.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, ClassVar, Protocol

import numpy as np

from ..types import Array
from .quantities import ParameterError
from .realisations import Series, Sheet, correlation, profile, spectral_density

KINDS: dict[str, type[Kind]] = {}
"""The kinds by name, in the order in which they are defined."""


class Declared(Protocol):
    """A perturbation as it is declared: :class:`nucleation.model.settings.Perturbation`."""

    @property
    def strength(self) -> float: ...
    @property
    def correlation_time(self) -> float: ...
    @property
    def correlation_length(self) -> float: ...
    @property
    def seed(self) -> int: ...


class Mode(Protocol):
    """The oscillating mode along the creep, at instants; see nucleation.drop.mode_history."""

    @property
    def patches(self) -> Any: ...
    @property
    def x(self) -> Array: ...
    @property
    def rate(self) -> Any: ...
    @property
    def normal_load(self) -> Any: ...
    @property
    def drive(self) -> Any: ...
    @property
    def state(self) -> Any: ...


class Kind(ABC):
    """A kind of perturbation with the relative strength eps; an object is one realisation of it.

    Parameters
    ----------
    declared : Declared
        Strength, correlation time and length, and seed.
    memory : float
        D/V (s).
    velocity : float
        V (m/s) of the driven edge.
    x : ndarray
        Positions (m) of the nodes of the interface.
    """

    name: ClassVar[str]
    noise: ClassVar[str]
    """What comes before its strength where L is said: "under a load that fluctuates by"."""
    in_time: ClassVar[bool]
    """Whether it changes in time: the steps must resolve it."""
    along_x: ClassVar[bool]
    """Whether it varies along x: the mesh must resolve it."""

    def __init_subclass__(cls) -> None:
        missing = [
            part for part in ("name", "noise", "in_time", "along_x") if not hasattr(cls, part)
        ]
        halves = ["begin", "imposed", *(["power"] if getattr(cls, "in_time", True) else [])]
        own = {part for base in cls.mro()[: cls.mro().index(Kind)] for part in vars(base)}
        missing += [part for part in halves if part not in own]
        if missing:
            raise ParameterError(
                f"the perturbation {cls.__name__} of {cls.__module__} lacks {', '.join(missing)}"
            )
        KINDS[cls.name] = cls

    def __init__(self, declared: Declared, memory: float, velocity: float, x: Array) -> None:
        self.strength = declared.strength
        self.memory = memory
        self.velocity = velocity
        self.begin(declared, x)

    @abstractmethod
    def begin(self, declared: Declared, x: Array) -> None:
        """Make the realisation of the seed, at positions x (m)."""

    @abstractmethod
    def imposed(self, time: float) -> dict[str, Any]:
        """What it changes of the drive at a time (s): fields of nucleation.simulation.drive."""

    @classmethod
    def power(cls, mode: Mode, declared: Declared) -> Array:
        """``|g|^2 S(Im Lambda)`` (1/s) at the instants of a mode, per eps squared.

        S is the spectral density of xi, g the weight of the forcing in the mode's amplitude. What
        does not change in time has none: it is roughness of the strength, over which the front
        passes (nucleation.drop.delay).
        """
        raise NotImplementedError

    @staticmethod
    def spectrum(mode: Mode, declared: Declared) -> Array:
        """S (s) of xi at the frequencies of a mode."""
        return spectral_density(mode.rate.imag, declared.correlation_time * mode.patches.memory)


class DriveVelocity(Kind):
    """``V(t) = V [1 + eps xi(t)]``, the velocity of the driven edge."""

    name, in_time, along_x = "drive_velocity", True, False
    noise = "pushed at a velocity that fluctuates by"

    def begin(self, declared: Declared, x: Array) -> None:
        """A series in time."""
        self.series = Series(declared.seed, declared.correlation_time * self.memory)

    def imposed(self, time: float) -> dict[str, Any]:
        """Displacement (m), velocity (m/s) and acceleration (m/s^2) of the edge."""
        ahead = self.strength * self.series.integral(time)
        faster = self.strength * self.series.value(time)
        return {
            "displacement": self.velocity * (time + ahead),
            "velocity": self.velocity * (1.0 + faster),
            "acceleration": self.velocity * self.strength * self.series.slope(time),
        }

    @classmethod
    def power(cls, mode: Mode, declared: Declared) -> Array:
        """The displacement is the velocity over i omega."""
        weight = np.abs(mode.drive * mode.patches.velocity / mode.rate.imag)
        return weight**2 * cls.spectrum(mode, declared)


class NormalLoad(Kind):
    """``sigma0(t) = sigma0 [1 + eps xi(t)]``, the stress on the top."""

    name, in_time, along_x = "normal_load", True, False
    noise = "under a normal load that fluctuates by"

    series: Series
    begin = DriveVelocity.begin  # it is a series in time as well

    def imposed(self, time: float) -> dict[str, Any]:
        """The factor of the first load."""
        return {"factors": (1.0 + self.strength * self.series.value(time),)}

    @classmethod
    def power(cls, mode: Mode, declared: Declared) -> Array:
        """A relative change of the load is the same for all of the patch."""
        return np.abs(mode.normal_load) ** 2 * cls.spectrum(mode, declared)


class Strength(Kind):
    """``f(v, phi, x) = f(v, phi) [1 + eps xi(x)]``, the friction coefficient along x."""

    name, in_time, along_x = "strength", False, True
    noise = "on a fault whose strength varies along it by"

    def begin(self, declared: Declared, x: Array) -> None:
        """A profile along x."""
        xi = profile(declared.seed, declared.correlation_length, x)
        self.factor = 1.0 + self.strength * xi

    def imposed(self, time: float) -> dict[str, Any]:
        """The factor of the friction coefficient at each node."""
        return {"strength": self.factor}


class State(Kind):
    """``d log(phi)/dt = g + eps (V/D) xi(x, t)``, the evolution of the state variable."""

    name, in_time, along_x = "state", True, True
    noise = "on a fault whose state fluctuates by"

    def begin(self, declared: Declared, x: Array) -> None:
        """A sheet in time and along x."""
        time = declared.correlation_time * self.memory
        self.sheet = Sheet(declared.seed, time, declared.correlation_length, x)

    def imposed(self, time: float) -> dict[str, Any]:
        """The source (1/s) of the logarithm of the state at each node."""
        rate = self.strength * (1.0 / self.memory)
        return {"state_forcing": rate * self.sheet.values(time)}

    @classmethod
    def power(cls, mode: Mode, declared: Declared) -> Array:
        """Places act together as far as they are correlated."""
        distances = mode.x[:, None] - mode.x
        covariance = correlation(distances, declared.correlation_length)
        shares = np.einsum("ix,xy,iy->i", mode.state, covariance, mode.state.conj()).real
        return shares / mode.patches.memory**2 * cls.spectrum(mode, declared)
