"""Two elastic blocks on one another, condensed on their common interface y = 0.

Both blocks have the modes of :mod:`.block`, on grids with the same elements along x, and are
put in series (:mod:`.series`). The upper block is driven at its left edge, the lower one is held
there. The right edge of both is free; at its corner both share the unknown ``u_y(L, 0)``. If no far
side is held, all of ``u_y`` may shift with it: in motion inertia determines the shift; in statics,
where no force acts on it, the corner stays.
"""

from __future__ import annotations

import dataclasses
from functools import cached_property

import numpy as np

from ..types import Array
from .block import Block, BlockOperator
from .condensed_nodes import CondensedOnNodes
from .grid import Components, Field, Motion, Motions
from .right_edge import EdgeValues, inverse_within
from .series import SeriesOperator, TwoBodies

LIFTED = 100.0  # times the slip: a translation along y that has grown from round-off


class BlockPair(TwoBodies[Block]):
    """Two blocks. If the lower far side is ``free``, it bears the same normal stress."""

    @property
    def is_held(self) -> bool:
        """Whether the lower far side is held along y."""
        return self.lower.far_side != "free"

    def operator(self, s: float) -> _PairOperator:
        """Factorise the dynamic stiffness ``K + s M`` (`s` in 1/s^2)."""
        return _PairOperator(self, s)

    def top_load(self, normal_stress: float) -> Field:
        """Return the nodal forces (N/m) of a compressive stress (Pa) on free far sides."""
        above = self.upper.top_load(normal_stress)
        if self.is_held:
            return self.joined(above, self.lower.zero_field())
        return self.joined(above, self.lower.top_load(normal_stress))

    @cached_property
    def _risen(self) -> Field:
        """Both blocks moved up by one metre."""
        level = self.upper.cosine_amplitudes(np.ones(self.grid.n_x))
        upper = self.upper.zero_field()
        upper.modes[:, 1] = level
        upper.edge[:] = 1.0
        lower = self.lower.zero_field()
        lower.modes[:, 1] = -level
        lower.edge[:] = -1.0
        return self.joined(upper, lower)

    def settled(
        self,
        motions: Motions,
        step: float,
        slid: float,
    ) -> Motions:
        """Remove a translation along y that has grown from round-off, if no far side is held.

        No force acts on such a translation but round-off, which makes it grow without bound over
        minutes. Once it exceeds :data:`LIFTED` times the slip, it is removed with its velocity: the
        motions are seen from a corner that does not rise.

        Parameters
        ----------
        motions, step, slid
            As in :meth:`.condensed.ElasticBody.settled`.
        """
        rise = float(motions[0].displacement.edge[0])
        rate = float(motions[0].velocity.edge[0])
        if self.is_held or not abs(rise) > LIFTED * slid:
            return motions
        ages = (0.0, step)
        return tuple(
            self._raised(motion, age * rate - rise, -rate)
            for motion, age in zip(motions, ages, strict=False)
        )

    def _raised(
        self,
        motion: Motion,
        distance: float,
        rate: float,
    ) -> Motion:
        """A motion with both blocks moved up by a distance (m), at a rate (m/s)."""
        displacement = motion.displacement.plus(self._risen.times(distance))
        velocity = motion.velocity.plus(self._risen.times(rate))
        return dataclasses.replace(motion, displacement=displacement, velocity=velocity)


class _PairOperator(SeriesOperator, CondensedOnNodes):
    """``K + s M`` of a :class:`BlockPair` for one ``s`` (1/s^2), with ``s = 0`` for statics."""

    body: BlockPair
    upper: BlockOperator
    lower: BlockOperator

    def __init__(self, body: BlockPair, s: float) -> None:
        super().__init__(body, s, body.upper.operator(s), body.lower.operator(s))
        self.edge = _PairEdge(self)

    @property
    def megabytes(self) -> float:
        """Memory that the operator holds once all of its parts are in use (MB)."""
        levels = self.levels_above + self.body.lower.grid.n_y + 1
        return super().megabytes + 8e-6 * (13 * self.body.grid.n_x + 2 * levels**2)

    def corner_reaction(
        self,
        load: Field,
        swept: Array,
        edge: Array,
        amplitudes: Array,
        start: Array | None,
    ) -> float:
        """Return the normal force (N/m) on the corner.

        Parameters
        ----------
        load, swept, edge, amplitudes, start
            As in :meth:`.condensed_nodes.CondensedOnNodes.corner_reaction`.
        """
        assert start is not None
        lowest = swept[:2].copy()
        lowest[0] = start + self.by_slip * amplitudes
        self.upper.substitute(lowest)
        load_above, _ = self.body.parts(load)
        edge_above = edge[: self.levels_above]
        return self.upper.edge.corner_reaction(load_above, lowest, edge_above)


class _PairEdge(EdgeValues):
    """The free right edges of both blocks: their values stacked, with the corner in both."""

    def __init__(self, operator: _PairOperator) -> None:
        self._operator = operator
        self._above = operator.upper.edge
        self._below = operator.lower.edge
        self._first_below = operator.levels_above  # where the lower block's values begin

    @cached_property
    def round_off(self) -> float:
        """Relative error of the edge values in any solve."""
        return max(self._above.round_off, self._below.round_off)

    def residual(
        self,
        load: Field,
        modes: Array,
        edge: Array,
    ) -> Array:
        """Return the unbalanced force on the edge values (N/m), stacked.

        Parameters
        ----------
        load, modes, edge
            As in :meth:`.right_edge.EdgeValues.residual`.
        """
        body = self._operator.body
        load_above, load_below = body.parts(load)
        above, below = body.parts(Field(modes, edge))
        residual_above = self._above.residual(
            load_above,
            above.modes,
            above.edge,
        )
        residual_below = self._below.residual(
            load_below,
            below.modes,
            below.edge,
        )
        return np.concatenate((residual_above, residual_below))

    @cached_property
    def _to_modes(self) -> tuple[Array, Array]:
        """Forces on the modes of w1 and u_y, and on those of w2, per unit of each edge value."""
        above = self._above.to_modes()
        below = self._below.to_modes()
        mirror = np.array([1.0, -1.0])[:, None, None]
        joint = np.concatenate((above, below * mirror), axis=1)
        lower = np.concatenate((np.zeros_like(above[0]), below[0]))
        return joint, lower

    @cached_property
    def schur(self) -> Array:
        """Stiffness of the edge values (N/m per m), all other unknowns eliminated at fixed w."""
        (x, y), _ = self._to_modes
        n = self._first_below
        stiffness = np.zeros((len(x), len(x)))
        stiffness[:n, :n] = self._above.schur
        stiffness[n:, n:] = self._below.schur
        xx, xy, yy = self._operator.compliance
        moved_x = xx * x + xy * y
        moved_y = xy * x + yy * y
        scale = self._operator.along_x.mode_scale
        return stiffness - scale * (x @ moved_x.T + y @ moved_y.T)

    @cached_property
    def compliance(self) -> Array:
        """Inverse of :attr:`schur` on its free values: the corner once, none that is held."""
        n = self._first_below
        body = self._operator.body
        independent = np.delete(np.eye(len(self.schur)), n, axis=1)
        independent[n, 0] = -1.0  # the corner, mirrored
        mass = body.upper.material.density + body.lower.material.density
        corner_is_free = body.is_held or self._operator.s * mass > 0.0
        first = None if corner_is_free else 1
        last = -1 if body.is_held else None
        stiffness = independent.T @ self.schur @ independent
        inverse = inverse_within(stiffness, slice(first, last))
        return independent @ inverse @ independent.T

    @cached_property
    def to_interface(self) -> Components:
        """Nodal forces on the interface, all other unknowns eliminated, per edge value."""
        (x, y), lower = self._to_modes
        above = y.copy()
        above[self._first_below :] = 0.0  # the upper block's own
        _, _, yx1, yy1, xx2, xy2, _, _ = self._operator.forces
        from_below = xx2 * x + xy2 * y
        from_above = yx1 * x + yy1 * y
        modal = np.array([from_below - lower, above - from_above])
        layer = self._operator.along_x
        return layer.interface_forces(layer.mode_scale * modal)
