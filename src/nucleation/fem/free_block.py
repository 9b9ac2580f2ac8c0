"""A block, or a pair, that is free at both side edges and moved at its top.

Any displacement is the sum of two parts about the middle of the block. In the odd part u_x is odd
and u_y even: the half block is held along x in the middle, and is a :class:`.block.Block` with its
left edge there. In the even part u_x is even and u_y odd (:class:`.even_half.EvenHalf`). On a grid
with an even number of elements both are blocks of half the length with one free edge, and they do
not interact: stiffness, inertia, edge and interface are those of :mod:`.block` and :mod:`.pair`. At
a node ``c + i``, c being the middle node, the displacement is even + odd, at ``c - i`` even - odd.
All nodes 0..n_x of the interface are free.
"""

from __future__ import annotations

import dataclasses

import numpy as np

from ..types import Array
from .block import Block
from .condensed import Balance, ElasticBody, Expectation, Operator, Response
from .grid import Components, Field, Grid, Motion, Terms
from .pair import BlockPair


class FreeBlock(ElasticBody):
    """A block, or two, with free side edges; seen from its top, which is moved along x.

    Parameters
    ----------
    grid : Grid
        The mesh of the whole (upper) block, with an even number of elements along x.
    odd, even : Block or BlockPair
        The right halves for u_x odd and even about the middle.
    """

    def __init__(
        self,
        grid: Grid,
        odd: Block | BlockPair,
        even: Block | BlockPair,
    ) -> None:
        self.grid = grid
        self.far_side = odd.far_side
        self.odd = odd
        self.even = even
        self.free_nodes = grid.n_x + 1
        self.crossing_time = odd.crossing_time
        self.total_mass = 2.0 * even.total_mass
        self._middle = grid.n_x // 2
        below = odd.grid_below
        if below is not None:
            self.grid_below = dataclasses.replace(
                below,
                length=grid.length,
                n_x=grid.n_x,
            )

    def on_all_nodes(self, values: Array, driven: float) -> Array:
        """Return the values themselves: no node of the interface is driven.

        Parameters
        ----------
        values, driven
            As in :meth:`.condensed.ElasticBody.on_all_nodes`.
        """
        return values

    def operator(self, s: float) -> _FreeOperator:
        """Factorise the dynamic stiffness ``K + s M`` (`s` in 1/s^2)."""
        return _FreeOperator(self, s)

    def parts(self, field: Field) -> tuple[Field, Field]:
        """Return the odd and the even half of a field."""
        levels = field.modes.shape[0]
        odd = field.modes[..., : self._middle]
        even = field.modes[..., self._middle :]
        return (
            Field(np.ascontiguousarray(odd), field.edge[:levels]),
            Field(np.ascontiguousarray(even), field.edge[levels:]),
        )

    def joined(self, odd: Field, even: Field) -> Field:
        """Join the fields of both halves.

        Parameters
        ----------
        odd, even : Field
            Fields of the halves.

        Returns
        -------
        Field
            The field of the whole block.
        """
        modes = np.concatenate((odd.modes, even.modes), axis=-1)
        edge = np.concatenate((odd.edge, even.edge))
        return Field(modes, edge)

    def halved(self, w: Array) -> tuple[Array, Array]:
        """Return the odd and the even part of nodal values along x, at the halves' free nodes."""
        right = w[self._middle :]
        left = w[self._middle :: -1]
        odd = 0.5 * (right - left)
        even = 0.5 * (right + left)
        return odd[1:], even

    def whole(self, odd: Array, even: Array) -> Array:
        """Return nodal values at all nodes.

        Parameters
        ----------
        odd, even : ndarray
            Their odd and even part at i = 0..n_x/2 from the middle (last axis).

        Returns
        -------
        ndarray
            Values at the nodes 0..n_x (last axis).
        """
        right = even + odd
        left = even - odd
        left = left[..., :0:-1]
        return np.concatenate((left, right), axis=-1)

    def at_rest(self, displacement: Field, velocity: float) -> Motion:
        """Return the motion of the block at rest, seen from its top.

        Parameters
        ----------
        displacement, velocity
            As in :meth:`.condensed.ElasticBody.at_rest`.
        """
        _, even = self.parts(displacement)
        motion = self.even.at_rest(even, velocity)
        rates = self.joined(self.odd.zero_field(), motion.velocity)
        return Motion(displacement, rates, 2.0 * motion.momentum)

    def translation_load(self, acceleration: float) -> Field:
        """Return the inertia (N/m) against an acceleration (m/s^2) of the top and the block."""
        even = self.even.translation_load(acceleration)
        return self.joined(self.odd.zero_field(), even)

    def top_load(self, normal_stress: float) -> Field:
        """Return the nodal forces (N/m) of a compressive stress (Pa) on the top."""
        odd = self.odd.top_load(normal_stress)
        even = self.even.top_load(normal_stress)
        return self.joined(odd, even)

    def inertia_load(
        self,
        s: float,
        terms: Terms,
        load: Field | None = None,
    ) -> Field:
        """Add the inertia of fields to a load.

        Parameters
        ----------
        s, terms, load
            As in :meth:`.condensed.ElasticBody.inertia_load`.
        """
        odd_terms = []
        even_terms = []
        for coefficient, field in terms:
            odd, even = self.parts(field)
            odd_terms.append((coefficient, odd))
            even_terms.append((coefficient, even))
        odd_load, even_load = (None, None) if load is None else self.parts(load)
        return self.joined(
            self.odd.inertia_load(s, odd_terms, odd_load),
            self.even.inertia_load(s, even_terms, even_load),
        )

    def momentum_x(self, velocity: Field) -> float:
        """Return the momentum along x (kg/s per unit depth), that of the even part (m/s)."""
        _, even = self.parts(velocity)
        return 2.0 * self.even.momentum_x(even)

    def nodal_values(self, field: Field) -> Components:
        """Return nodal w_x and u_y of the (upper) block, each of shape (n_y + 1, n_x + 1)."""
        odd, even = self.parts(field)
        odd_x, even_y = self.odd.nodal_values(odd)
        even_x, odd_y = self.even.nodal_values(even)
        return self.whole(odd_x, even_x), self.whole(odd_y, even_y)

    def nodal_values_below(self, field: Field) -> Components:
        """Return nodal u_x and u_y of the second block, levels from the interface down."""
        odd, even = self.parts(field)
        odd_x, even_y = self.odd.nodal_values_below(odd)
        even_x, odd_y = self.even.nodal_values_below(even)
        return self.whole(odd_x, even_x), self.whole(odd_y, even_y)


class _FreeOperator(Operator):
    """``K + s M`` of a :class:`FreeBlock` for one ``s`` (1/s^2), with ``s = 0`` for statics."""

    body: FreeBlock

    def __init__(self, body: FreeBlock, s: float) -> None:
        self.body = body
        self.s = s
        self._odd = body.odd.operator(s)
        self._even = body.even.operator(s)

    @property
    def megabytes(self) -> float:
        """Memory that the operator holds once all of its parts are in use (MB)."""
        dense = 16e-6 * self.body.free_nodes**2
        return self._odd.megabytes + self._even.megabytes + dense

    def _forces(self, odd: Components, even: Components) -> Components:
        """Tangential and normal forces at all nodes from those on the halves."""
        odd_x, even_y = odd
        even_x, odd_y = even
        odd_x = np.append(0.0, odd_x)
        x = self.body.whole(odd_x, even_x)
        y = self.body.whole(odd_y[1:], even_y)
        middle = self.body.grid.n_x // 2  # it belongs to both halves of the block
        x[middle] *= 2.0
        y[middle] *= 2.0
        return x, y

    def apply(self, w: Array) -> Components:
        """Return ``D w`` and ``N w`` (N/m) at all nodes, for w (m) there."""
        odd, even = self.body.halved(w)
        return self._forces(
            self._odd.apply(odd),
            self._even.apply(even),
        )

    def respond(self, load: Field, w: Array) -> Response:
        """Find the forces that hold the interface, edges in balance.

        Parameters
        ----------
        load, w
            As in :meth:`.condensed.Operator.respond`.
        """
        odd_load, even_load = self.body.parts(load)
        odd_w, even_w = self.body.halved(w)
        odd = self._odd.respond(odd_load, odd_w)
        even = self._even.respond(even_load, even_w)
        tangential, normal = self._forces(
            (odd.tangential, odd.normal),
            (even.tangential, even.normal),
        )
        return Response(w, tangential, normal, load, halves=(odd, even))

    def balance(
        self,
        response: Response,
        w: Array,
        expected: Expectation | None = None,
    ) -> Balance:
        """Find the displacement of the block.

        Parameters
        ----------
        response, w, expected
            As in :meth:`.condensed.Operator.balance`.
        """
        odd_w, even_w = self.body.halved(w)
        odd, even = response.halves
        odd_half = self._odd.balance(odd, odd_w).displacement
        even_half = self._even.balance(even, even_w).displacement
        return Balance(
            self.body.joined(odd_half, even_half),
            self.body.no_memory,
            True,
        )
