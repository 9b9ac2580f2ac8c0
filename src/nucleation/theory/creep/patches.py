"""The creeping patches of one fault, of any length, and the reasons why there is none."""

from __future__ import annotations

import dataclasses
from functools import cached_property

import numpy as np

from ...model.friction import Friction
from ...model.friction.constants import law_of
from ..critical import largest_crossings
from ..spectrum import Systems
from ..status import NoLength
from ..values import FaultLike
from .linearised import (
    Creep,
    FrozenPatch,
    constant_coefficients,
    creep,
    creeping_patch,
    local_coefficients,
)
from .response import PatchResponse, SlimLayers, modes_for, response


@dataclasses.dataclass(frozen=True)
class Patches:
    """The creeping patches of one fault, of any length.

    A patch begins at an ``edge`` that is pushed, or in the interior under a ``remote`` load. Then
    `load_rate` is the rate of the shear stress that loads it, over ``sigma0 V/D``; with constant a
    and b it has no effect.
    """

    one: Systems  # a single fault, all fields of shape (1,)
    law: Friction | None = None  # which gives the local a(v) and b(v); by default constant
    velocity: float = 1.0  # V (m/s), which a law needs
    loading: str = "edge"
    load_rate: float = 1.0
    evolution: str = "aging"  # of the state, with constant a and b; a law has its own
    refinement: int = 1  # times the usual number of modes
    _slim: SlimLayers = dataclasses.field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    def __hash__(self) -> int:
        return hash(self.constants)

    @cached_property
    def number(self) -> int:
        """Number of modes that the fault needs."""
        return self.refinement * modes_for(self.one)

    def with_law(self, fault: FaultLike, velocity: float, distance: float) -> Patches:
        """Those with the fault's law at V (m/s) and D (m); ParameterError if it has none."""
        evolution = str(fault.evolution)
        law = law_of(fault.friction_law, evolution, velocity, distance, *self.constants)
        return dataclasses.replace(self, law=law, velocity=velocity)

    @property
    def memory(self) -> float:
        """D/V (s)."""
        if self.law is None:
            return 1.0 / float(self.one.rate[0])
        return self.law.slip_distance / self.velocity

    @property
    def constants(self) -> tuple[float, float, float]:
        """f, a and zeta of the fault at V."""
        one = self.one
        return float(one.friction[0]), float(one.a[0]), float(one.zeta[0])

    def response(self, length: float, number: int) -> PatchResponse:
        """The bodies' response to slip of a patch (m) in a number of modes."""
        return response(self.one, length, number, self.loading, self._slim)

    def creep(self, length: float, number: int | None = None) -> Creep:
        """The creep of a patch (m) by a number of modes, by default as many as the fault needs."""
        bodies = self.response(length, number or self.number)
        load_rate = None if self.loading == "edge" else self.load_rate
        found = creep(bodies, self.constants[0], load_rate)
        self.require_contact(found)
        return found

    def require_contact(self, creep: Creep) -> None:
        """Raise NoLength if a creep removes all of the compression somewhere."""
        if creep.normal_stress.min() <= 0.0:
            ratio = creep.response.length * float(largest_crossings(self.one)[0]) / (2.0 * np.pi)
            raise NoLength(f"the creep opens the fault at a patch length of {ratio:.4g} L_c")

    def at(self, length: float, number: int | None = None) -> FrozenPatch:
        """The linearised patch (m); slip in D, time in D/V."""
        creep = self.creep(length, number)
        if self.law is None:
            friction = constant_coefficients(creep.slip_rate, *self.constants)
        else:
            friction = local_coefficients(self.law, self.velocity * creep.fastest, creep.slip_rate)
        return creeping_patch(creep, friction)
