"""The dynamic stiffness ``K + s M`` of a body: factorised, and condensed on the interface.

Eliminating the bulk and the right edge leaves, for the nodes of the interface, a linear relation
between the displacement ``w`` (nodes 1..n_x) and the nodal forces that the interface exerts on
the body, tangential ``p`` (nodes 1..n_x) and normal ``R`` (nodes 0..n_x):

    p = p0 + D w,    R = R0 + N w

with D symmetric positive definite. Without the right edge D and N are diagonal between modes;
the edge adds a term of low rank. The interface has ``u_y = 0`` (rigid substrate, no opening).
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..fem import kernels
from .condensed import Balance, Expectation
from .field import Field
from .right_edge import RightEdge, predicted, relative_error
from .separable import LoadedResponse, SeparableOperator

if TYPE_CHECKING:
    from .block import Block

Array = NDArray[np.float64]

EDGE_FELT = 1e-16  # share of a node's own stiffness, squared coupling: 1e-8 in the coupling


@dataclasses.dataclass(frozen=True)
class BlockResponse(LoadedResponse):
    """A block's response to a load, with the edge values (m) in balance at the levels 0..n_y.

    Where the edge values were given and not found, `swept` holds the sweep down to the interface
    with them, (n_y + 1, 2, n_x): :meth:`BlockOperator.balance` goes on from there.
    """

    edge: Array
    swept: Array | None = None


class BlockOperator(SeparableOperator):
    """``K + s M`` of a :class:`Block` for one ``s`` (1/s^2), with ``s = 0`` for statics."""

    def __init__(self, body: Block, s: float) -> None:
        super().__init__(body, s)
        self.body: Block = body
        self.edge = RightEdge(body, s, self._inverse, self._lower)

    def _profiles(self, edge: Array) -> Array:
        """What given edge values do to the modes, as profiles along y."""
        return self.edge.profiles(edge)

    def respond(self, load: Field, w: Array, edge: Array | None = None) -> BlockResponse:
        """The forces that hold the interface at nodal `w` (m) under a load, the edge in balance.

        Given edge values (m) are taken to be in balance, which saves half of the work.
        """
        amplitudes = self.body.sine_amplitudes(w)
        if edge is not None:
            swept = self._swept(load, edge)
            tangential, normal = self.interface_forces(amplitudes, swept[0])
            lowest = swept[:2].copy()
            lowest[0, 0], lowest[0, 1] = amplitudes, 0.0
            kernels.substitute(self._inverse[:2], self._lower[:1], lowest)
            corner = self.edge.corner_reaction(load, lowest, edge)
            return BlockResponse(w, tangential, np.append(normal, corner), load, edge, swept)
        held = np.zeros_like(load.edge)
        modes, reduced = self.solve(load, amplitudes, held)
        residual = self.edge.residual(load, modes, held)
        edge = self.edge.correction(residual)
        tangential, normal = self.interface_forces(amplitudes, reduced)
        near, edge_tangential, edge_normal = self.edge.felt
        tangential[near:] += edge @ edge_tangential
        normal[near:] += edge @ edge_normal
        corner = self.edge.schur[0] @ edge - residual[0]
        return BlockResponse(w, tangential, np.append(normal, corner), load, edge)

    def responses(self, load: Field, w: Array, expected: Expectation) -> Iterator[BlockResponse]:
        """Responses at nodal `w` (m) under a load; the last one holds whatever happens.

        Far from slip and waves the right edge moves as predicted, to round-off. Where it has done
        so in the last step, the first response takes it for granted.
        """
        edge = predicted(expected)
        if float(expected.memory) < self.edge.round_off:
            yield self.respond(load, w, edge)
        yield self.respond(load, w)

    def balance(
        self, response: BlockResponse, w: Array, expected: Expectation | None = None
    ) -> Balance:
        """The block at nodal `w` (m) under the load of a response, which is used up by it.

        Edge values that had been given to the response are corrected to the balance they are found
        in. The memory is the relative error of their prediction, which tells whether it served.
        """
        edge, modes = response.edge, response.swept
        if w is not response.w:
            edge = edge + self.edge.change(w - response.w)
        amplitudes = self.body.sine_amplitudes(w)
        if modes is None:
            displacement = Field(self.solve(response.load, amplitudes, edge)[0], edge)
        else:
            modes[0, 0], modes[0, 1] = amplitudes, 0.0
            kernels.substitute(self._inverse, self._lower, modes)
            residual = self.edge.residual(response.load, modes, response.edge)
            displacement = Field(modes, response.edge + self.edge.correction(residual))
        if expected is None:
            return Balance(displacement, self.body.no_memory, True)
        foreseen = predicted(expected) if modes is None else response.edge
        error = relative_error(displacement.edge, foreseen, edge)
        holds = modes is None or error < self.edge.round_off
        return Balance(displacement, np.array(error), holds)

    # -- the condensed operator on the interface ------------------------------------------------

    def apply(self, w: Array) -> tuple[Array, Array]:
        """``D w``, shape (n_x,), and ``N w``, (n_x + 1,), for nodal w at nodes 1..n_x (m)."""
        near, tangential, normal = self.edge.felt
        amplitudes = self.body.sine_amplitudes(w)
        p, reaction = self.interface_forces(amplitudes)
        edge = self.edge.change(w)
        corner = tangential[0] @ w[near:] + self.edge.schur[0] @ edge
        p[near:] += edge @ tangential
        reaction[near:] += edge @ normal
        return p, np.append(reaction, corner)

    @cached_property
    def _toeplitz(self) -> tuple[Array, Array]:
        """Kernels d and h with ``D_ij = d(i-j) - d(i+j)`` and ``N_ij = h(i+j) - h(i-j)``.

        Even and odd extended: d holds the arguments 0..2 n_x, h likewise (h(-n) = -h(n)).
        """
        n = self.body.grid.n_x
        d = self.body.cosine_values(self._pivot[0]) / n
        h = np.append(0.0, self.body.sine_values(self._pivot[1])) / n
        # the modes are odd (cosine) and even (sine) about the right edge i = n_x
        d = np.concatenate((d, [0.0], -d[:0:-1], [-d[0]]))
        h = np.concatenate((h, h[-2::-1]))
        return d, h

    @cached_property
    def diagonal(self) -> Array:
        """Diagonal of D at the nodes 1..n_x (N/m per m), the edge's share included."""
        return self._diagonal_of_modes + self.edge.diagonal

    @cached_property
    def _diagonal_of_modes(self) -> Array:
        d, _ = self._toeplitz
        diagonal = d[0] - d[2 : 2 * self.body.grid.n_x + 1 : 2]
        diagonal[-1] *= 0.25
        return diagonal

    @cached_property
    def _edge_reach(self) -> int:
        """The first node (1..n_x) that feels the right edge beyond round-off."""
        felt = np.abs(self.edge.diagonal) > EDGE_FELT * self._diagonal_of_modes
        return int(np.argmax(felt)) + 1 if felt.any() else self.body.grid.n_x + 1

    def tangent(self, nodes: NDArray[np.intp], dtype: type = float) -> tuple[NDArray, NDArray]:
        """Dense blocks of D and N between some interface nodes (sorted, in 1..n_x), (n, n).

        N is returned for the normal forces of those same nodes.
        """
        n = self.body.grid.n_x
        blocks: NDArray = np.empty((2, nodes.size, nodes.size), dtype=dtype)
        stiffness, coupling = blocks
        kernels.interface_blocks(*self._toeplitz, n, nodes, stiffness, coupling)
        near = int(np.searchsorted(nodes, self._edge_reach))
        if near < nodes.size:
            own = nodes[near:]
            tangential, normal = self.edge.to_interface
            edge = self.edge.response[:, own - 1]
            stiffness[near:, near:] += tangential[:, own - 1].T @ edge
            normal = np.append(normal, self.edge.schur[:, :1], axis=1)[:, own]
            coupling[near:, near:] += normal.T @ edge
            if own[-1] == n:
                coupling[-1, near:] += tangential[0, own - 1]
        return stiffness, coupling
