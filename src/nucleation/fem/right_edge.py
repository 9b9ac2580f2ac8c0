"""The free right edge: its n_y values of u_y couple to all modes, and are eliminated last.

Their influence on the interface decays exponentially over some heights of the block.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from ..types import Array
from .body import Body
from .factors import LayerFactors
from .grid import Field
from .modes import BlockModes

NEGLIGIBLE = 1e-13  # of the edge's largest force on a node; below is round-off


class EdgeValues:
    """The edge values of a block or a pair, stacked, with all other unknowns in balance at given w.

    A pair has its corner twice: the lower body is mirrored. Stiffnesses are in N/m per m:

    - `schur` of the edge values at fixed w, all else eliminated; its first row and column belong to
      the upper body's corner and give its normal force. `compliance` is its inverse on the free
      values, zero on those held fixed.
    - `to_interface` are nodal forces on the interface, a row for each edge value: tangential at the
      nodes 1..n_x, also the forces on the edge values per unit of w, and normal at 0..n_x.
    - `response` are edge values per unit of w at each node, (levels, n_x), and `diagonal` is the
      edge's part of the diagonal of D.
    - `felt` is `to_interface` without the corner's own force at the last nodes, above round-off,
      (2, levels, nodes); `response_near` is the response to these nodes.
    """

    def __init__(
        self,
        body: Body,
        factors: list[LayerFactors],
        moves: bool,
        series: tuple[Array, Array] | None,
    ) -> None:
        """`series` are compliance and forces of a pair; `moves`: there is inertia."""
        assert isinstance(body.modes, BlockModes)
        self._body = body
        self._factors = factors
        if series is None:
            modal = factors[0].to_modes()
            self.schur = factors[0].schur()
            self.compliance = _inverse_within(self.schur, slice(1, None))
        else:
            modal = self._put_in_series(*series, moves)
        one = np.ones(body.modes.n_x)
        nothing = np.zeros((2, body.modes.n_x))
        # in this layout the steps' compiled transform serves here, too
        rows = np.ascontiguousarray(np.moveaxis(body.modes.scale * modal, 1, 0))
        by_edge = [body.modes.forces(row, one, nothing) for row in rows]
        tangential, normal = map(np.array, zip(*by_edge, strict=True))
        self.response = -self.compliance @ tangential
        self.diagonal = np.einsum("ji,ji->i", tangential, self.response)
        forces = np.array([tangential, normal[:, :-1]])
        largest = np.abs(forces).max(axis=(0, 1))
        first = int(np.argmax(largest > NEGLIGIBLE * largest.max()))
        self.felt = np.ascontiguousarray(forces[..., first:])
        self.response_near = np.ascontiguousarray(self.response[:, first:])
        normal[:, -1] = self.schur[:, 0]
        self.to_interface = tangential, normal

    def _put_in_series(self, compliance: Array, forces: Array, moves: bool) -> Array:
        """Set `schur` and `compliance`; return forces on the modes of w and u_y per edge value."""
        above, below = (layer.to_modes() for layer in self._factors)
        mirror = np.array([1.0, -1.0])[:, None, None]
        x, y = np.concatenate((above, below * mirror), axis=1)
        n = above.shape[1]
        stiffness = np.zeros((len(x), len(x)))
        stiffness[:n, :n] = self._factors[0].schur()
        stiffness[n:, n:] = self._factors[1].schur()
        xx, xy, yy = compliance
        moved_x = xx * x + xy * y
        moved_y = xy * x + yy * y
        self.schur = stiffness - self._body.modes.scale * (x @ moved_x.T + y @ moved_y.T)
        held = self._body.is_held_along_y
        independent = np.delete(np.eye(len(x)), n, axis=1)
        independent[n, 0] = -1.0  # the corner, mirrored
        own = slice(None if held or moves else 1, -1 if held else None)
        inverse = _inverse_within(independent.T @ self.schur @ independent, own)
        self.compliance = independent @ inverse @ independent.T
        own_x = np.concatenate((np.zeros_like(above[0]), below[0]))  # on w2
        own_y = y.copy()
        own_y[n:] = 0.0  # the upper block's own
        _, _, yx1, yy1, xx2, xy2, _, _ = forces
        from_below = xx2 * x + xy2 * y
        from_above = yx1 * x + yy1 * y
        return np.array([from_below - own_x, own_y - from_above])

    def residual(self, load: Field, modes: Array) -> Array:
        """Force on the edge values (N/m) where they are zero, given amplitudes (m)."""
        parts = zip(
            self._factors,
            self._body.parts(load),
            self._body.parts(Field(modes, np.zeros_like(load.edge))),
            strict=True,
        )
        found = [layer.residual(own, part.modes, part.edge) for layer, own, part in parts]
        return np.concatenate(found)


def _inverse_within(stiffness: Array, free: slice) -> Array:
    """Inverse of a symmetric positive definite matrix on its free values, zero on the others."""
    compliance = np.zeros_like(stiffness)
    own = stiffness[free, free]
    compliance[free, free] = cho_solve(cho_factor(own), np.eye(own.shape[0]))
    return compliance
