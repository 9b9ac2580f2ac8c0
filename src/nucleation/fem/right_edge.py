"""The free right edge: its n_y values of u_y couple to all modes, and are eliminated last.

Their influence on the interface decays exponentially over some heights of the block.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from ..types import Array
from .body import Body
from .factors import LayerFactors
from .grid import Components, Field, Motion
from .modes import BlockModes

NEGLIGIBLE = 1e-13  # of the edge's largest force on a node; below is round-off


def foreseen_edge(motions: Sequence[Motion], step: float, last_step: float) -> Array:
    """Edge values (m) after a step (s) with the acceleration of the last step."""
    now = motions[0]
    before = motions[-1]
    edge = now.displacement.edge + step * now.velocity.edge
    if last_step == 0.0:
        return edge
    change = now.velocity.edge - before.velocity.edge
    return edge + (0.5 * step**2 / last_step) * change


class EdgeValues:
    """The edge values of a block or a pair, stacked, with all other unknowns in balance at given w.

    `series` are compliance and forces of a pair; `moves`: there is inertia. A pair has its corner
    twice: the lower body is mirrored.
    """

    def __init__(
        self,
        body: Body,
        factors: list[LayerFactors],
        moves: bool,
        series: tuple[Array, Array] | None,
    ) -> None:
        assert isinstance(body.modes, BlockModes)
        self._body = body
        self._modes = body.modes
        self._factors = factors
        self._moves = moves
        self._series = series
        self.round_off = max(layer.round_off for layer in factors)

    def residual(self, load: Field, modes: Array, edge: Array) -> Array:
        """Unbalanced force on the edge values (N/m), given those and amplitudes (m)."""
        parts = zip(
            self._factors,
            self._body.parts(load),
            self._body.parts(Field(modes, edge)),
            strict=True,
        )
        found = [layer.residual(own, part.modes, part.edge) for layer, own, part in parts]
        return np.concatenate(found)

    @cached_property
    def _to_modes(self) -> tuple[Array, Array]:
        """Forces of a pair on the modes of w1 and u_y, and on those of w2, per edge value."""
        above, below = (layer.to_modes() for layer in self._factors)
        mirror = np.array([1.0, -1.0])[:, None, None]
        joint = np.concatenate((above, below * mirror), axis=1)
        return joint, np.concatenate((np.zeros_like(above[0]), below[0]))

    @cached_property
    def schur(self) -> Array:
        """Stiffness of the edge values (N/m per m), all other unknowns eliminated at fixed w.

        Its first row and column belong to the upper body's corner: they give its normal force.
        """
        if self._series is None:
            return self._factors[0].schur
        (x, y), _ = self._to_modes
        n = len(self._factors[0].schur)
        stiffness = np.zeros((len(x), len(x)))
        stiffness[:n, :n] = self._factors[0].schur
        stiffness[n:, n:] = self._factors[1].schur
        xx, xy, yy = self._series[0]
        moved_x = xx * x + xy * y
        moved_y = xy * x + yy * y
        return stiffness - self._modes.scale * (x @ moved_x.T + y @ moved_y.T)

    @cached_property
    def compliance(self) -> Array:
        """Inverse of :attr:`schur` on the free values (m per N/m), zero on those held fixed."""
        if self._series is None:
            return _inverse_within(self.schur, slice(1, None))
        above = self._body.layers[0].levels
        held = self._body.is_held_along_y
        independent = np.delete(np.eye(len(self.schur)), above, axis=1)
        independent[above, 0] = -1.0  # the corner, mirrored
        first = None if held or self._moves else 1
        last = -1 if held else None
        stiffness = independent.T @ self.schur @ independent
        inverse = _inverse_within(stiffness, slice(first, last))
        return independent @ inverse @ independent.T

    @cached_property
    def to_interface(self) -> Components:
        """Nodal forces (N/m per m) on the interface, bulk eliminated, a row for each edge value.

        Tangential at the nodes 1..n_x and normal at 0..n_x - 1. The tangential ones are also the
        forces on the edge values per unit of w.
        """
        if self._series is None:
            modal = self._factors[0].to_modes()
        else:
            (x, y), lower = self._to_modes
            above = y.copy()
            above[self._body.layers[0].levels :] = 0.0  # the upper block's own
            _, _, yx1, yy1, xx2, xy2, _, _ = self._series[1]
            from_below = xx2 * x + xy2 * y
            from_above = yx1 * x + yy1 * y
            modal = np.array([from_below - lower, above - from_above])
        return self._modes.interface_forces(self._modes.scale * modal)

    @cached_property
    def response(self) -> Array:
        """Edge values per unit of w at each node, bulk and edge in balance, (levels, n_x)."""
        tangential, _ = self.to_interface
        return -self.compliance @ tangential

    @cached_property
    def response_near(self) -> Array:
        """:attr:`response` to the nodes of :attr:`felt`, (levels, nodes)."""
        return np.ascontiguousarray(self.response[:, -self.felt.shape[2] :])

    @cached_property
    def diagonal(self) -> Array:
        """Contribution of the edge to the diagonal of D at the nodes 1..n_x (N/m per m)."""
        tangential, _ = self.to_interface
        return np.einsum("ji,ji->i", tangential, self.response)

    @cached_property
    def felt(self) -> Array:
        """:attr:`to_interface` at the last nodes, above round-off, (2, levels, nodes)."""
        forces = np.array(self.to_interface)
        largest = np.abs(forces).max(axis=(0, 1))
        first = int(np.argmax(largest > NEGLIGIBLE * largest.max()))
        return np.ascontiguousarray(forces[..., first:])


def _inverse_within(stiffness: Array, free: slice) -> Array:
    """Inverse of a symmetric positive definite matrix on its free values, zero on the others."""
    compliance = np.zeros_like(stiffness)
    own = stiffness[free, free]
    compliance[free, free] = cho_solve(cho_factor(own), np.eye(own.shape[0]))
    return compliance
