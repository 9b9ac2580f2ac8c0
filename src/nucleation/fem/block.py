"""One elastic block: its dynamic stiffness ``K + s M``, condensed on the interface.

The modes (:mod:`.block_modes`) are eliminated from the top down, then the edge's values of ``u_y``
(:mod:`.right_edge`). On the interface ``u_y = 0`` (rigid substrate, no opening).
:mod:`.condensed_nodes` has the equations that are left between the interface's nodes.
"""

from __future__ import annotations

from ..types import Array
from .block_modes import BlockModes
from .condensed_nodes import CondensedOnNodes
from .grid import Field
from .right_edge import RightEdge
from .separable import SeparableOperator


class Block(BlockModes):
    """One deformable rectangular block on the interface y = 0."""

    def operator(self, s: float) -> BlockOperator:
        """Factorise the dynamic stiffness ``K + s M`` (`s` in 1/s^2)."""
        return BlockOperator(self, s)


class BlockOperator(SeparableOperator, CondensedOnNodes):
    """``K + s M`` of a :class:`Block` for one ``s`` (1/s^2), with ``s = 0`` for statics."""

    body: Block
    edge: RightEdge

    def __init__(self, body: Block, s: float) -> None:
        super().__init__(body, s)
        self.along_x = body
        self.modal = self.pivot[:2]  # the first row, as u_y is zero
        self.edge = RightEdge(body, s, self._inverse, self._lower)

    def _profiles(self, edge: Array) -> Array:
        """Profiles along y of the forces that edge values exert on the modes."""
        return self.edge.profiles(edge)

    def swept_down(self, load: Field, edge: Array) -> Array:
        """Sweep a load (N/m) down to the interface, with given edge values (m).

        Parameters
        ----------
        load, edge
            As in :meth:`.condensed_nodes.CondensedOnNodes.swept_down`.
        """
        return self.swept(load, edge)

    def reduced(self, swept: Array) -> tuple[Array, None]:
        """Return the load in level 0; on a rigid base it does not move the interface."""
        return swept[0].copy(), None

    def substitute_up(
        self,
        swept: Array,
        amplitudes: Array,
        start: Array | None,
    ) -> None:
        """Sweep back from the interface in place.

        Parameters
        ----------
        swept, amplitudes, start
            As in :meth:`.condensed_nodes.CondensedOnNodes.substitute_up`.
        """
        swept[0, 0] = amplitudes
        swept[0, 1] = 0.0
        self.substitute(swept)

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
        lowest = swept[:2].copy()
        self.substitute_up(lowest, amplitudes, start)
        return self.edge.corner_reaction(load, lowest, edge)
