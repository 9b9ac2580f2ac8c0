"""The condensed operators D and N between the nodes of the interface, from those between modes.

Eliminating the bulk and the right edge leaves, for the nodes of the interface, a linear relation
between ``w`` (nodes 1..n_x) and the nodal forces that the interface exerts on the upper body,
tangential ``p`` (nodes 1..n_x) and normal ``R`` (nodes 0..n_x):

    p = p0 + D w,    R = R0 + N w

with D symmetric positive definite. Without the right edge D and N are diagonal between modes;
the edge adds a term of low rank. One block and a pair of them differ in neither.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..types import Array
from . import kernels
from .block_modes import BlockModes
from .right_edge import EdgeValues

EDGE_FELT = 1e-16  # share of a node's own stiffness, squared coupling: 1e-8 in the coupling


class CondensedOnNodes(ABC):
    """D and N of what has the nodes and the modes of a block (:mod:`.block_modes`)."""

    edge: EdgeValues

    @property
    @abstractmethod
    def along_x(self) -> BlockModes:
        """A block with the modes."""

    @property
    @abstractmethod
    def modal(self) -> Array:
        """D and N per mode, the right edge held, times 2/n_x (N/m per m); (2, n_x) or more."""

    @abstractmethod
    def interface_forces(
        self, amplitudes: Array, reduced: Array | float = 0.0
    ) -> tuple[Array, Array]:
        """Nodal tangential forces at 1..n_x and normal forces at 0..n_x - 1 (N/m), edge apart."""

    def apply(self, w: Array) -> tuple[Array, Array]:
        """``D w``, shape (n_x,), and ``N w``, (n_x + 1,), for nodal w at nodes 1..n_x (m)."""
        near, tangential, normal = self.edge.felt
        amplitudes = self.along_x.sine_amplitudes(w)
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

        N is returned for the normal forces of those same nodes.
        """
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
