"""One elastic block: its dynamic stiffness ``K + s M``, condensed on the interface.

The modes (:mod:`.block_modes`) are eliminated from the top down, then the edge's values of ``u_y``
(:mod:`.right_edge`). The interface has ``u_y = 0`` (rigid substrate, no opening); what is left
between its nodes is in :mod:`.condensed_nodes`.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterator

import numpy as np

from ..types import Array
from .block_modes import BlockModes
from .condensed import Balance, Expectation
from .condensed_nodes import CondensedOnNodes
from .field import Field
from .right_edge import RightEdge, predicted, relative_error
from .separable import LoadedResponse, SeparableOperator


class Block(BlockModes):
    """One deformable rectangular block on the interface y = 0."""

    def operator(self, s: float) -> BlockOperator:
        """The dynamic stiffness ``K + s M`` (`s` in 1/s^2), condensed on the interface."""
        return BlockOperator(self, s)


@dataclasses.dataclass(frozen=True)
class BlockResponse(LoadedResponse):
    """A block's response to a load, with the edge values (m) in balance at the levels 0..n_y.

    Where the edge values were given and not found, `swept` holds the sweep down to the interface
    with them, (n_y + 1, 2, n_x): :meth:`BlockOperator.balance` goes on from there.
    """

    edge: Array
    swept: Array | None = None


class BlockOperator(SeparableOperator, CondensedOnNodes):
    """``K + s M`` of a :class:`Block` for one ``s`` (1/s^2), with ``s = 0`` for statics."""

    def __init__(self, body: Block, s: float) -> None:
        super().__init__(body, s)
        self.body: Block = body
        self.edge: RightEdge = RightEdge(body, s, self._inverse, self._lower)

    @property
    def along_x(self) -> Block:
        """The block itself."""
        return self.body

    @property
    def modal(self) -> Array:
        """D and N per mode: the first row of the stiffness, ``u_y`` being zero."""
        return self.pivot

    def _profiles(self, edge: Array) -> Array:
        """What given edge values do to the modes, as profiles along y."""
        return self.edge.profiles(edge)

    def respond(self, load: Field, w: Array, edge: Array | None = None) -> BlockResponse:
        """The forces that hold the interface at nodal `w` (m) under a load, the edge in balance.

        Given edge values (m) are taken to be in balance, which saves half of the work.
        """
        amplitudes = self.body.sine_amplitudes(w)
        if edge is not None:
            swept = self.swept(load, edge)
            tangential, normal = self.interface_forces(amplitudes, swept[0])
            lowest = swept[:2].copy()
            lowest[0, 0], lowest[0, 1] = amplitudes, 0.0
            self.substitute(lowest)
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
            self.substitute(modes)
            residual = self.edge.residual(response.load, modes, response.edge)
            displacement = Field(modes, response.edge + self.edge.correction(residual))
        if expected is None:
            return Balance(displacement, self.body.no_memory, True)
        foreseen = predicted(expected) if modes is None else response.edge
        error = relative_error(displacement.edge, foreseen, edge)
        holds = modes is None or error < self.edge.round_off
        return Balance(displacement, np.array(error), holds)
