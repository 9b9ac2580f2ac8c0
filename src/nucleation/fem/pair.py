"""Two elastic blocks on one another, condensed on their common interface y = 0.

Both blocks have the modes of :mod:`.block_modes`, on grids with the same elements along x, and are
put in series (:mod:`.series`). The upper one is driven at its left edge, the lower one held there.
On the right edge, free in both, the corner ``u_y(L, 0)`` is an unknown that both blocks share. With
it all of ``u_y`` may shift if no far side holds it: inertia fixes that in motion, and in statics,
where no force acts on it, the corner stays.
"""

from __future__ import annotations

import dataclasses
from functools import cached_property

import numpy as np

from ..types import Array
from .block import Block
from .condensed_nodes import CondensedOnNodes
from .grid import Field, Motions
from .right_edge import EdgeValues, inverse_within
from .series import Series, TwoBodies

LIFTED = 100.0  # times what has slid: a translation along y that has grown from rounding


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

    @cached_property
    def _risen(self) -> Field:
        """Both blocks moved up by one metre."""
        level = self.upper.cosine_amplitudes(np.ones(self.grid.n_x))
        fields = []
        for block, sign in ((self.upper, 1.0), (self.lower, -1.0)):  # that one is mirrored
            field = block.zero_field()
            field.modes[:, 1], field.edge[:] = sign * level, sign
            fields.append(field)
        return self.joined(*fields)

    def settled(self, motions: Motions, step: float, slid: float) -> Motions:
        """The same motions seen from a corner that does not rise, if no far side holds the pair.

        Nothing feels a translation along y, so that rounding is all that acts on it, and makes it
        grow without end over minutes. Once it is :data:`LIFTED` times what has slid (m), it is
        taken out with its velocity; the second motion is a step (s) older than the first.
        """
        rise, rate = (float(f.edge[0]) for f in (motions[0].displacement, motions[0].velocity))
        if self.lower.far_side != "free" or not abs(rise) > LIFTED * slid:
            return motions
        return tuple(
            dataclasses.replace(
                motion,
                displacement=motion.displacement.plus(self._risen.times(age * rate - rise)),
                velocity=motion.velocity.plus(self._risen.times(-rate)),
            )
            for motion, age in zip(motions, (0.0, step), strict=False)
        )


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

    def swept_down(self, load: Field, edge: Array) -> Array:
        """The forward sweep of a load to the interface in both blocks, with given edge values."""
        modes = np.empty_like(load.modes)
        into = self.body.parts(Field(modes, edge))
        for operator, own, to in zip(
            (self.upper, self.lower), self.body.parts(load), into, strict=True
        ):
            operator.swept(own, to.edge, to.modes)
        return modes

    def reduced(self, swept: Array) -> tuple[Array, Array]:
        """What a sweep takes from the modal forces at w = 0, and where it moves the interface."""
        n = self.body.grid.n_y + 1
        return self.series.loaded(swept[0], swept[n])

    def substitute_up(self, swept: Array, amplitudes: Array, start: Array | None) -> None:
        """The backward sweep of both blocks from amplitudes of w at the interface, in place."""
        assert start is not None
        n = self.body.grid.n_y + 1
        self.series.set_interface(swept[:n], swept[n:], amplitudes, start)
        self.upper.substitute(swept[:n])
        self.lower.substitute(swept[n:])

    def corner_reaction(
        self, load: Field, swept: Array, edge: Array, amplitudes: Array, start: Array | None
    ) -> float:
        """Normal force (N/m) on the upper corner's node, from the lowest levels alone."""
        assert start is not None
        lowest = swept[:2].copy()
        self.series.set_interface(lowest, np.empty_like(lowest), amplitudes, start)
        self.upper.substitute(lowest)
        above = self.body.parts(Field(swept, edge)).upper.edge
        return self.upper.edge.corner_reaction(self.body.parts(load).upper, lowest, above)


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
