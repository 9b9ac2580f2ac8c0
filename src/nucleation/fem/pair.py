"""Two elastic blocks on one another, condensed on their common interface y = 0.

Both blocks have the modes of :mod:`.block_modes`, on grids with the same elements along x, and are
put in series (:mod:`.series`). The upper one is driven at its left edge, the lower one held there.
On the right edge, free in both, the corner ``u_y(L, 0)`` is an unknown that both blocks share. With
it all of ``u_y`` may shift if no far side holds it: inertia fixes that in motion, and in statics,
where no force acts on it, the corner stays.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from functools import cached_property

import numpy as np

from ..types import Array
from .block import Block
from .condensed import Balance, Expectation
from .condensed_nodes import CondensedOnNodes
from .field import Field
from .right_edge import EdgeValues, inverse_within, predicted, relative_error
from .separable import LoadedResponse
from .series import Series, TwoBodies


class Pair(TwoBodies[Block]):
    """Two blocks; where the lower one's far side is ``free``, it bears the same normal stress."""

    def operator(self, s: float) -> PairOperator:
        """The dynamic stiffness ``K + s M`` (`s` in 1/s^2), condensed on the interface."""
        return PairOperator(self, s)

    def top_load(self, normal_stress: float) -> Field:
        """Nodal forces (N/m) of the compressive stress (Pa) on the far sides that are free."""
        below = self.lower.top_load(normal_stress)
        if self.lower.far_side != "free":
            below = self.lower.zero_field()
        return self.joined(self.upper.top_load(normal_stress), below)


@dataclasses.dataclass(frozen=True)
class PairResponse(LoadedResponse):
    """A pair's response to a load, with the edge values (m) in balance of both blocks.

    Where the edge values were given and not found, `swept` holds the sweep down to the interface.
    """

    edge: Array
    reduced: Array  # T^-1 (r1 + r2) of the sweep, (2, n_x): the interface at w = 0
    swept: Array | None = None


class PairOperator(CondensedOnNodes):
    """``K + s M`` of a :class:`Pair` for one ``s`` (1/s^2), with ``s = 0`` for statics."""

    def __init__(self, body: Pair, s: float) -> None:
        self.body, self.s = body, s
        self.upper, self.lower = body.upper.operator(s), body.lower.operator(s)
        self.series = Series(self.upper, self.lower)
        self.edge: PairEdge = PairEdge(self)

    @property
    def along_x(self) -> Block:
        """The upper block."""
        return self.body.upper

    @property
    def modal(self) -> Array:
        """D and N per mode, the right edge held, times 2/n_x (N/m per m), (2, n_x)."""
        return self.series.modal

    @property
    def megabytes(self) -> float:
        """Memory that this operator holds once all of its parts are in use (MB)."""
        levels = self.body.grid.n_y + self.body.lower.grid.n_y + 2
        own = 8e-6 * (13 * self.body.grid.n_x + 2 * levels**2)
        return self.upper.megabytes + self.lower.megabytes + own

    def interface_forces(
        self, amplitudes: Array, reduced: Array | float = 0.0
    ) -> tuple[Array, Array]:
        """Nodal tangential forces at 1..n_x and normal forces at 0..n_x - 1 (N/m), edge apart."""
        return self.along_x.interface_forces(self.modal * amplitudes - reduced)

    def respond(self, load: Field, w: Array, edge: Array | None = None) -> PairResponse:
        """The forces that hold the interface at nodal `w` (m) under a load, the edge in balance.

        Given edge values (m) are taken to be in balance, which saves half of the work.
        """
        body, amplitudes = self.body, self.body.sine_amplitudes(w)
        given = np.zeros_like(load.edge) if edge is None else edge
        swept = self._swept(load, given)
        loads, modes = body.parts(load), body.parts(Field(swept, given))
        held, start = self.series.loaded(modes.upper.modes[0], modes.lower.modes[0])
        tangential, normal = self.interface_forces(amplitudes, held)
        if edge is not None:
            lowest = modes.upper.modes[:2].copy()
            self.series.set_interface(lowest, np.empty_like(lowest), amplitudes, start)
            self.upper.substitute(lowest)
            corner = self.upper.edge.corner_reaction(loads.upper, lowest, modes.upper.edge)
            return PairResponse(w, tangential, np.append(normal, corner), load, given, start, swept)
        self._substitute(swept, amplitudes, start)
        residual = self.edge.residual(load, swept, given)
        found = self.edge.correction(residual)
        near, edge_tangential, edge_normal = self.edge.felt
        tangential[near:] += found @ edge_tangential
        normal[near:] += found @ edge_normal
        corner = self.edge.schur[0] @ found - residual[0]
        return PairResponse(w, tangential, np.append(normal, corner), load, found, start)

    def responses(self, load: Field, w: Array, expected: Expectation) -> Iterator[PairResponse]:
        """Responses at nodal `w` (m) under a load; the last one holds whatever happens.

        As of a block: where the right edge has moved as predicted in the last step, to round-off,
        the first response takes that for granted.
        """
        if float(expected.memory) < self.edge.round_off:
            yield self.respond(load, w, predicted(expected))
        yield self.respond(load, w)

    def balance(
        self, response: PairResponse, w: Array, expected: Expectation | None = None
    ) -> Balance:
        """The pair at nodal `w` (m) under the load of a response, which is used up by it."""
        edge, modes, start = response.edge, response.swept, response.reduced
        if w is not response.w:
            edge = edge + self.edge.change(w - response.w)
        amplitudes = self.body.sine_amplitudes(w)
        if modes is None:
            modes = self._swept(response.load, edge)
            first = self.body.parts(Field(modes, edge))
            _, start = self.series.loaded(first.upper.modes[0], first.lower.modes[0])
            self._substitute(modes, amplitudes, start)
            displacement, foreseen = Field(modes, edge), None
        else:
            self._substitute(modes, amplitudes, start)
            foreseen = response.edge
            residual = self.edge.residual(response.load, modes, foreseen)
            displacement = Field(modes, foreseen + self.edge.correction(residual))
        if expected is None:
            return Balance(displacement, self.body.no_memory, True)
        assumed = predicted(expected) if foreseen is None else foreseen
        error = relative_error(displacement.edge, assumed, edge)
        holds = foreseen is None or error < self.edge.round_off
        return Balance(displacement, np.array(error), holds)

    def _swept(self, load: Field, edge: Array) -> Array:
        """Both blocks swept down to the interface, stacked."""
        modes = np.empty_like(load.modes)
        into = self.body.parts(Field(modes, edge))
        for operator, own, to in zip(
            (self.upper, self.lower), self.body.parts(load), into, strict=True
        ):
            operator.swept(own, to.edge, to.modes)
        return modes

    def _substitute(self, modes: Array, amplitudes: Array, start: Array) -> None:
        """Both blocks back from the interface, in place."""
        upper, lower = (part.modes for part in self.body.parts(Field(modes, np.empty(0))))
        self.series.set_interface(upper, lower, amplitudes, start)
        self.upper.substitute(upper)
        self.lower.substitute(lower)


class PairEdge(EdgeValues):
    """The free right edges of both blocks: their values stacked, the corner among both of them."""

    def __init__(self, operator: PairOperator) -> None:
        self._operator = operator
        self._parts = operator.upper.edge, operator.lower.edge
        self._first_below = operator.body.grid.n_y + 1  # where the lower block's values begin

    @cached_property
    def round_off(self) -> float:
        """Relative error of the edge values in any solve."""
        return max(edge.round_off for edge in self._parts)

    def residual(self, load: Field, modes: Array, edge: Array) -> Array:
        """Unbalanced force on the edge values (N/m), stacked."""
        body = self._operator.body
        both = zip(self._parts, body.parts(load), body.parts(Field(modes, edge)), strict=True)
        return np.concatenate([part.residual(own, f.modes, f.edge) for part, own, f in both])

    @cached_property
    def _to_modes(self) -> tuple[Array, Array]:
        """Forces on the modes of w1 and u_y, and on those of w2, per unit of each edge value."""
        above, below = (edge.to_modes() for edge in self._parts)
        joint = np.concatenate((above, below * np.array([1.0, -1.0])[:, None, None]), axis=1)
        lower = np.concatenate((np.zeros_like(above[0]), below[0]))
        return joint, lower

    @cached_property
    def schur(self) -> Array:
        """Stiffness of the edge values (N/m per m), all else eliminated at fixed w."""
        joint, n = self._to_modes[0], self._first_below
        stiffness = np.zeros((joint.shape[1], joint.shape[1]))
        for part, own in zip(self._parts, (slice(n), slice(n, None)), strict=True):
            stiffness[own, own] = part.schur
        xx, xy, yy = self._operator.series.compliance
        released = np.array([xx * joint[0] + xy * joint[1], xy * joint[0] + yy * joint[1]])
        scale = 2.0 / self._operator.along_x.grid.n_x
        return stiffness - scale * (joint[0] @ released[0].T + joint[1] @ released[1].T)

    @cached_property
    def compliance(self) -> Array:
        """Inverse of :attr:`schur` on its free values: the corner once, and what no side holds."""
        body, n = self._operator.body, self._first_below
        number = self.schur.shape[0]
        held = body.lower.far_side != "free"
        independent = np.delete(np.eye(number), n, axis=1)
        independent[n, 0] = -1.0  # the corner, mirrored
        masses = body.upper.material.density + body.lower.material.density
        fixed = held or self._operator.s * masses > 0.0
        free = slice(None if fixed else 1, -1 if held else None)
        inverse = inverse_within(independent.T @ self.schur @ independent, free)
        return independent @ inverse @ independent.T

    @cached_property
    def to_interface(self) -> tuple[Array, Array]:
        """Nodal forces on the interface, all else eliminated, per unit of each edge value."""
        (x, y), lower = self._to_modes
        above = y.copy()
        above[self._first_below :] = 0.0  # the upper block's own
        f = self._operator.series.forces
        modal = np.array([f[4] * x + f[5] * y - lower, above - (f[2] * x + f[3] * y)])
        layer = self._operator.along_x
        return layer.interface_forces((2.0 / layer.grid.n_x) * modal)
