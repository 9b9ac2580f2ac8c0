"""The condensed operators D and N between the nodes of the interface, from those between modes.

Eliminating the bulk and the right edge leaves a linear relation between ``w`` at the nodes 1..n_x
of the interface and the nodal forces on the upper body, tangential ``p`` (nodes 1..n_x) and normal
``R`` (nodes 0..n_x):

    p = p0 + D w,    R = R0 + N w

with D symmetric positive definite. Without the right edge D and N are diagonal between modes; the
edge adds a term of low rank. All of this is the same for one block and a pair of them, as is the
prediction of the edge through a step.
"""

from abc import abstractmethod
from collections.abc import Iterator
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..types import Array
from . import field_kernels, transforms
from .condensed import Balance, Blocks, Expectation, Nodes, Response
from .elimination import Elimination
from .grid import Components, Field
from .right_edge import EdgeValues, predicted

EDGE_FELT = 1e-16  # of a node's own stiffness, squared coupling: 1e-8 in the coupling


class CondensedOnNodes(Elimination):
    """``K + s M`` of a body with the nodes and the modes of a block (:mod:`.block`).

    Attributes
    ----------
    edge : EdgeValues
        The right edge.
    """

    edge: EdgeValues
    _last_key: tuple[bytes, type] | None = None
    _last_blocks: Blocks

    @abstractmethod
    def corner_reaction(
        self,
        load: Field,
        swept: Array,
        edge: Array,
        amplitudes: Array,
        start: Array | None,
    ) -> float:
        """Return the normal force on the corner's node, from the lowest levels alone.

        Parameters
        ----------
        load : Field
            The load (N/m).
        swept, amplitudes, start
            As in :meth:`.elimination.Elimination.substitute_up`; `swept` is not changed.
        edge : ndarray
            Edge values (m), shape (levels,).

        Returns
        -------
        float
            The force on the upper body (N/m).
        """

    def respond(
        self,
        load: Field,
        w: Array,
        edge: Array | None = None,
    ) -> Response:
        """Find the forces that hold the interface, the edge in balance.

        Parameters
        ----------
        load, w : Field, ndarray
            As in :meth:`.condensed.Operator.respond`.
        edge : ndarray, optional
            Edge values (m) that are assumed to be in balance; this saves half of the work.

        Returns
        -------
        Response
        """
        amplitudes = self.along_x.sine_amplitudes(w)
        given = np.zeros_like(load.edge) if edge is None else edge
        swept = self.swept_down(load, given)
        reduced, start = self.reduced(swept)
        tangential, normal = self.along_x.forces(
            self.modal,
            amplitudes,
            reduced,
        )
        if edge is not None:
            normal[-1] = self.corner_reaction(
                load,
                swept,
                edge,
                amplitudes,
                start,
            )
            return Response(
                w,
                tangential,
                normal,
                load,
                swept,
                start,
                edge,
            )
        self.substitute_up(swept, amplitudes, start)
        residual = self.edge.residual(load, swept, given)
        found = self.edge.correction(residual)
        transforms.add_edge(found, self.edge.felt, tangential, normal)
        normal[-1] = self.edge.schur[0] @ found - residual[0]
        return Response(w, tangential, normal, load, edge=found)

    def responses(
        self,
        load: Field,
        w: Array,
        expected: Expectation,
    ) -> Iterator[Response]:
        """Yield a response with predicted edge values, if that worked last time, then the full one.

        Far from slip and waves the right edge moves as predicted, to round-off.

        Parameters
        ----------
        load, w, expected
            As in :meth:`.condensed.Operator.responses`.
        """
        last_error = float(expected.memory)
        if last_error < self.edge.round_off:
            yield self.respond(load, w, predicted(expected))
        yield self.respond(load, w)

    def balance(
        self,
        response: Response,
        w: Array,
        expected: Expectation | None = None,
    ) -> Balance:
        """Find the displacement.

        Predicted edge values are corrected to the values in balance. The memory is the relative
        error of the prediction.

        Parameters
        ----------
        response, w, expected
            As in :meth:`.condensed.Operator.balance`.
        """
        given = response.edge
        assert given is not None
        edge = given
        if w is not response.w:
            edge = edge + self.edge.change(w - response.w)
        modes = response.swept
        start = response.start
        solved = modes is None
        if modes is None:
            modes = self.swept_down(response.load, edge)
            _, start = self.reduced(modes)
        self.substitute_up(modes, self.along_x.sine_amplitudes(w), start)
        own = edge
        if not solved:
            residual = self.edge.residual(
                response.load,
                modes,
                given,
            )
            own = given + self.edge.correction(residual)
        displacement = Field(modes, own)
        if expected is None:
            return Balance(displacement, self.along_x.no_memory, True)
        foreseen = predicted(expected) if solved else given
        error = field_kernels.relative_error(own, foreseen, edge)
        holds = solved or error < self.edge.round_off
        return Balance(displacement, np.array(error), holds)

    def apply(self, w: Array) -> Components:
        """Return ``D w``, (n_x,), and ``N w``, (n_x + 1,) (N/m), for w at nodes 1..n_x (m)."""
        tangential, normal = super().apply(w)
        transforms.add_edge_in_balance(
            w,
            self.edge.felt,
            self.edge.response_near,
            self.edge.schur[0],
            tangential,
            normal,
        )
        return tangential, normal

    @cached_property
    def _toeplitz(self) -> tuple[Array, Array]:
        """Kernels d and h with ``D_ij = d(i-j) - d(i+j)`` and ``N_ij = h(i+j) - h(i-j)``.

        Both hold the arguments 0..2 n_x; d is even and h is odd.
        """
        n = self.along_x.grid.n_x
        d = self.along_x.cosine_values(self.modal[0]) / n
        h = self.along_x.sine_values(self.modal[1])
        h = np.append(0.0, h) / n
        # about the right edge i = n_x, the cosine modes are odd and the sine modes even
        d = np.concatenate((d, [0.0], -d[:0:-1], [-d[0]]))
        h = np.concatenate((h, h[-2::-1]))
        return d, h

    @cached_property
    def diagonal(self) -> Array:
        """Diagonal of D at the nodes 1..n_x (N/m per m), with the contribution of the edge."""
        return self._diagonal_of_modes + self.edge.diagonal

    @cached_property
    def _diagonal_of_modes(self) -> Array:
        d, _ = self._toeplitz
        last = 2 * self.along_x.grid.n_x
        diagonal = d[0] - d[2 : last + 1 : 2]
        diagonal[-1] *= 0.25
        return diagonal

    @cached_property
    def _edge_reach(self) -> int:
        """The first node (1..n_x) on which the right edge acts beyond round-off."""
        felt = np.abs(self.edge.diagonal) > EDGE_FELT * self._diagonal_of_modes
        if not felt.any():
            return self.along_x.grid.n_x + 1
        return int(np.argmax(felt)) + 1

    def tangent(self, nodes: Nodes, dtype: type = float) -> Blocks:
        """Return dense blocks of D and N.

        The last blocks are kept: mostly the same nodes slip in the next step.

        Parameters
        ----------
        nodes, dtype
            As in :meth:`.condensed.Operator.tangent`.
        """
        key = (nodes.tobytes(), dtype)
        if key != self._last_key:
            self._last_key = key
            self._last_blocks = self._between(nodes, dtype)
        return self._last_blocks

    def _between(self, nodes: Nodes, dtype: type) -> Blocks:
        n = self.along_x.grid.n_x
        blocks: NDArray = np.empty((2, nodes.size, nodes.size), dtype=dtype)
        stiffness, coupling = blocks
        d, h = self._toeplitz
        field_kernels.interface_blocks(d, h, n, nodes, stiffness, coupling)
        near = int(np.searchsorted(nodes, self._edge_reach))
        if near == nodes.size:
            return stiffness, coupling
        own = nodes[near:]
        tangential, normal = self.edge.to_interface
        tangential = tangential[:, own - 1]
        corner = self.edge.schur[:, :1]
        normal = np.append(normal, corner, axis=1)[:, own]
        edge = self.edge.response[:, own - 1]
        stiffness[near:, near:] += tangential.T @ edge
        coupling[near:, near:] += normal.T @ edge
        if own[-1] == n:
            coupling[-1, near:] += tangential[0]
        return stiffness, coupling
