"""Two layers of one period on one another: homogeneous sliding of a pair and its modes.

Each layer has the modes of :mod:`.periodic`; they are put in series mode by mode (:mod:`.series`).
Where no far side is held, the mean displacement of both layers together is free: inertia governs it
in motion, and in statics, where the tractions on both far sides are in balance, it is zero.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator

import numpy as np

from ..types import Array
from .condensed import Balance, Expectation
from .grid import Field
from .periodic import Circulant, PeriodicBlock, with_entry_zero
from .separable import LoadedResponse
from .series import Series, TwoBodies


class PeriodicPair(TwoBodies[PeriodicBlock]):
    """A period of two layers, driven by shear tractions on their far sides."""

    def operator(self, s: float) -> PeriodicPairOperator:
        """The dynamic stiffness ``K + s M`` (`s` in 1/s^2), condensed on the interface."""
        return PeriodicPairOperator(self, s)

    def top_load(self, normal_stress: float, shear_stress: float = 0.0) -> Field:
        """Nodal forces (N/m) of compressive and shear stress (Pa) on the far sides.

        Those along a direction in which the lower far side is held do nothing.
        """
        above = self.upper.top_load(normal_stress, shear_stress)
        return self.joined(above, self.lower.top_load(normal_stress, -shear_stress))


@dataclasses.dataclass(frozen=True)
class PeriodicPairResponse(LoadedResponse):
    """A response and the sweep down to the interface that it comes from."""

    swept: Array
    start: Array


class PeriodicPairOperator(Circulant):
    """``K + s M`` of a :class:`PeriodicPair`; D and N are circulant."""

    def __init__(self, body: PeriodicPair, s: float) -> None:
        self.body, self.s = body, s
        self.upper, self.lower = body.upper.operator(s), body.lower.operator(s)
        with np.errstate(invalid="ignore", divide="ignore"):
            self.series = Series(self.upper, self.lower)
        masses = body.upper.material.density + body.lower.material.density
        if body.lower.far_side == "free" and s * masses == 0.0:
            # the mean: forces in balance go through, and move nothing
            self.series.modal[:, 0] = self.series.compliance[:, 0] = 0.0
            self.series.forces[:, 0] = np.tile(0.5 * np.eye(2).ravel(), 2)
            self.series.by_slip[:, 0] = 0.5, 0.0

    @property
    def along_x(self) -> PeriodicBlock:
        """The upper layer."""
        return self.body.upper

    @property
    def megabytes(self) -> float:
        """Memory that this operator holds once all of its parts are in use (MB)."""
        return self.upper.megabytes + self.lower.megabytes

    def interface_forces(
        self, w_amplitudes: Array, reduced: Array | float = 0.0
    ) -> tuple[Array, Array]:
        """Nodal forces along x and y (N/m) on the upper layer at all nodes."""
        return self.along_x.interface_forces(self.series.modal * w_amplitudes - reduced)

    def respond(self, load: Field, w: Array) -> PeriodicPairResponse:
        """The forces that hold the interface at nodal `w` (m) under a load."""
        body, modes = self.body, np.empty_like(load.modes)
        into, own = body.parts(Field(modes, load.edge)), body.parts(load)
        self.upper.swept(own.upper, np.zeros_like(own.upper.edge), into.upper.modes)
        self.lower.swept(own.lower, np.zeros_like(own.lower.edge), into.lower.modes)
        held, start = self.series.loaded(into.upper.modes[0], into.lower.modes[0])
        tangential, normal = self.interface_forces(body.sine_amplitudes(w), held)
        return PeriodicPairResponse(w, tangential, with_entry_zero(normal), load, modes, start)

    def responses(
        self, load: Field, w: Array, expected: Expectation
    ) -> Iterator[PeriodicPairResponse]:
        """The one response at nodal `w` (m) under a load."""
        yield self.respond(load, w)

    def balance(
        self, response: PeriodicPairResponse, w: Array, expected: Expectation | None = None
    ) -> Balance:
        """Both layers at nodal `w` (m) under the load of a response, which is used up by it."""
        field = Field(response.swept, np.zeros_like(response.load.edge))
        upper, lower = (part.modes for part in self.body.parts(field))
        amplitudes = self.body.sine_amplitudes(w)
        self.series.set_interface(upper, lower, amplitudes, response.start)
        self.upper.substitute(upper)
        self.lower.substitute(lower)
        return Balance(field, self.body.no_memory, True)
