"""Drives: the loads on a run as functions of time.

A :class:`Drive` gives the velocity of the driven edge, the loads on the body, the strength of the
interface and the forcing of its state at any time; a step evaluates it at its end. Its functions
must depend on time alone: not on the steps, and be the same after a restart from a checkpoint.
"""

from collections.abc import Callable
from typing import NamedTuple

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
    factors: tuple[float, ...] = (1.0,)  # of the drive's loads


class Drive(NamedTuple):
    """Loads as functions of time (s)."""

    velocity: float  # m/s, unperturbed: the scale of slip rates
    at: Callable[[float], Imposed]  # boundary conditions
    loads: tuple[Field, ...]  # N/m, on the body: those times their factors
    moves: bool = True  # an edge is moved, and the driving force is the force on it


def steady_drive(velocity: float, load: Field) -> Drive:
    """An edge that moves at a constant velocity (m/s) under a constant load (N/m)."""
    return Drive(velocity, lambda time: Imposed(time, velocity * time, velocity), (load,))


def remote_drive(near: Drive, shear: Field, start: float, rising: float) -> Drive:
    """A far shear load (N/m per Pa) from a stress (Pa) on that rises (Pa/m).

    It rises per metre of displacement of an imaginary driven edge. No edge moves. Where the edge's
    velocity would fluctuate, the rate of the far load does.
    """

    def at(time: float) -> Imposed:
        imposed = near.at(time)
        return imposed._replace(
            displacement=0.0,
            velocity=0.0,
            acceleration=0.0,
            factors=(*imposed.factors, start + rising * imposed.displacement),
        )

    return Drive(near.velocity, at, (*near.loads, shear), moves=False)
