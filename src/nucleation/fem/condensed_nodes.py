"""The condensed operators D and N between the nodes of the interface, from those between modes.

Eliminating the bulk and the right edge leaves, for the nodes of the interface, a linear relation
between ``w`` (nodes 1..n_x) and the nodal forces that the interface exerts on the upper body,
tangential ``p`` (nodes 1..n_x) and normal ``R`` (nodes 0..n_x):

    p = p0 + D w,    R = R0 + N w

with D symmetric positive definite. Without the right edge D and N are diagonal between modes;
the edge adds a term of low rank. One block and a pair of them differ in neither, nor in how they
follow the edge through a step.
"""

import dataclasses
from abc import ABC, abstractmethod
from collections.abc import Iterator
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..types import Array
from . import kernels, transforms
from .block_modes import BlockModes
from .condensed import Balance, Expectation
from .grid import Field
from .right_edge import EdgeValues, predicted
from .separable import LoadedResponse

EDGE_FELT = 1e-16  # share of a node's own stiffness, squared coupling: 1e-8 in the coupling


@dataclasses.dataclass(frozen=True)
class EdgedResponse(LoadedResponse):
    """A response to a load, with the edge values (m) in balance, of all levels.

    Where the edge values were given and not found, `swept` holds the sweep down to the interface
    with them, (levels, 2, n_x): :meth:`CondensedOnNodes.balance` goes on from there.
    """

    edge: Array
    start: Array | None  # of a pair, see `CondensedOnNodes.reduced`
    swept: Array | None = None


class CondensedOnNodes(ABC):
    """``K + s M`` of what has the nodes and the modes of a block (:mod:`.block_modes`)."""

    body: Any
    edge: EdgeValues
    _last_asked: tuple[bytes, type] | None = None

    @property
    @abstractmethod
    def along_x(self) -> BlockModes:
        """A block with the modes."""

    @property
    @abstractmethod
    def modal(self) -> Array:
        """D and N per mode, the right edge held, times 2/n_x (N/m per m); (2, n_x)."""

    @abstractmethod
    def swept_down(self, load: Field, edge: Array) -> Array:
        """The forward sweep of a load to the interface, with given edge values (m)."""

    @abstractmethod
    def reduced(self, swept: Array) -> tuple[Array, Array | None]:
        """What a sweep takes from the modal forces at w = 0; where it moves a pair's interface."""

    @abstractmethod
    def substitute_up(self, swept: Array, amplitudes: Array, start: Array | None) -> None:
        """The backward sweep from amplitudes of w at the interface, in place."""

    @abstractmethod
    def corner_reaction(
        self, load: Field, swept: Array, edge: Array, amplitudes: Array, start: Array | None
    ) -> float:
        """Normal force (N/m) on the corner's node, from the lowest levels alone."""

    def respond(self, load: Field, w: Array, edge: Array | None = None) -> EdgedResponse:
        """The forces that hold the interface at nodal `w` (m) under a load, the edge in balance.

        Given edge values (m) are taken to be in balance, which saves half of the work.
        """
        amplitudes = self.along_x.sine_amplitudes(w)
        given = np.zeros_like(load.edge) if edge is None else edge
        swept = self.swept_down(load, given)
        reduced, start = self.reduced(swept)
        tangential, normal = self.along_x.forces(self.modal, amplitudes, reduced)
        if edge is not None:
            normal[-1] = self.corner_reaction(load, swept, edge, amplitudes, start)
            return EdgedResponse(w, tangential, normal, load, edge, start, swept)
        self.substitute_up(swept, amplitudes, start)
        residual = self.edge.residual(load, swept, given)
        found = self.edge.correction(residual)
        transforms.add_edge(found, self.edge.felt, tangential, normal)
        normal[-1] = self.edge.schur[0] @ found - residual[0]
        return EdgedResponse(w, tangential, normal, load, found, start)

    def responses(self, load: Field, w: Array, expected: Expectation) -> Iterator[EdgedResponse]:
        """Responses at nodal `w` (m) under a load; the last one holds whatever happens.

        Far from slip and waves the right edge moves as predicted, to round-off. Where it has done
        so in the last step, the first response takes it for granted.
        """
        if float(expected.memory) < self.edge.round_off:
            yield self.respond(load, w, predicted(expected))
        yield self.respond(load, w)

    def balance(
        self, response: EdgedResponse, w: Array, expected: Expectation | None = None
    ) -> Balance:
        """The body at nodal `w` (m) under the load of a response, which is used up by it.

        Edge values that had been given to the response are corrected to the balance they are found
        in. The memory is the relative error of their prediction, which tells whether it served.
        """
        edge, modes, start = response.edge, response.swept, response.start
        if w is not response.w:
            edge = edge + self.edge.change(w - response.w)
        amplitudes = self.along_x.sine_amplitudes(w)
        found = modes is None
        if modes is None:
            modes = self.swept_down(response.load, edge)
            start = self.reduced(modes)[1]
        self.substitute_up(modes, amplitudes, start)
        own = edge
        if not found:
            residual = self.edge.residual(response.load, modes, response.edge)
            own = response.edge + self.edge.correction(residual)
        displacement = Field(modes, own)
        if expected is None:
            return Balance(displacement, self.body.no_memory, True)
        foreseen = predicted(expected) if found else response.edge
        error = kernels.relative_error(own, foreseen, edge)
        return Balance(displacement, np.array(error), found or error < self.edge.round_off)

    def apply(self, w: Array) -> tuple[Array, Array]:
        """``D w``, shape (n_x,), and ``N w``, (n_x + 1,), for nodal w at nodes 1..n_x (m)."""
        edge, amplitudes = self.edge, self.along_x.sine_amplitudes(w)
        tangential, normal = self.along_x.forces(self.modal, amplitudes, self._no_load)
        transforms.add_edge_in_balance(
            w, edge.felt, edge.response_near, edge.schur[0], tangential, normal
        )
        return tangential, normal

    @cached_property
    def _no_load(self) -> Array:
        return np.zeros(self.modal.shape)

    @cached_property
    def _toeplitz(self) -> tuple[Array, Array]:
        """Kernels d and h with ``D_ij = d(i-j) - d(i+j)`` and ``N_ij = h(i+j) - h(i-j)``.

        Even and odd extended: d holds the arguments 0..2 n_x, h likewise (h(-n) = -h(n)).
        """
        n = self.along_x.grid.n_x
        d = self.along_x.cosine_values(self.modal[0]) / n
        h = np.append(0.0, self.along_x.sine_values(self.modal[1])) / n
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
        diagonal = d[0] - d[2 : 2 * self.along_x.grid.n_x + 1 : 2]
        diagonal[-1] *= 0.25
        return diagonal

    @cached_property
    def _edge_reach(self) -> int:
        """The first node (1..n_x) that feels the right edge beyond round-off."""
        felt = np.abs(self.edge.diagonal) > EDGE_FELT * self._diagonal_of_modes
        return int(np.argmax(felt)) + 1 if felt.any() else self.along_x.grid.n_x + 1

    def tangent(self, nodes: NDArray[np.intp], dtype: type = float) -> tuple[NDArray, NDArray]:
        """Dense blocks of D and N between some interface nodes (sorted, in 1..n_x), (n, n).

        N is returned for the normal forces of those same nodes. The last blocks are kept, as the
        nodes that slip are mostly those of the step before.
        """
        asked = nodes.tobytes(), dtype
        if asked != self._last_asked:
            self._last_asked, self._last_blocks = asked, self._between(nodes, dtype)
        return self._last_blocks

    def _between(self, nodes: NDArray[np.intp], dtype: type) -> tuple[NDArray, NDArray]:
        n = self.along_x.grid.n_x
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
