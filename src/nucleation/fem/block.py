"""One elastic block: its dynamic stiffness ``K + s M``, condensed on the interface.

The modes (:mod:`.block_modes`) are eliminated from the top down, then the edge's values of ``u_y``
(:mod:`.right_edge`). The interface has ``u_y = 0`` (rigid substrate, no opening); what is left
between its nodes is in :mod:`.condensed_nodes`.
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
        """The dynamic stiffness ``K + s M`` (`s` in 1/s^2), condensed on the interface."""
        return BlockOperator(self, s)


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
        return self.pivot[:2]

    def _profiles(self, edge: Array) -> Array:
        """What given edge values do to the modes, as profiles along y."""
        return self.edge.profiles(edge)

    def swept_down(self, load: Field, edge: Array) -> Array:
        """The forward sweep of a load to the interface, with given edge values (m)."""
        return self.swept(load, edge)

    def reduced(self, swept: Array) -> tuple[Array, None]:
        """The reduced load; without a load an interface at w = 0 is where it was."""
        return swept[0].copy(), None

    def substitute_up(self, swept: Array, amplitudes: Array, start: Array | None) -> None:
        """The backward sweep from amplitudes of w at the interface, in place."""
        swept[0, 0], swept[0, 1] = amplitudes, 0.0
        self.substitute(swept)

    def corner_reaction(
        self, load: Field, swept: Array, edge: Array, amplitudes: Array, start: Array | None
    ) -> float:
        """Normal force (N/m) on the corner's node, from the lowest levels alone."""
        lowest = swept[:2].copy()
        self.substitute_up(lowest, amplitudes, start)
        return self.edge.corner_reaction(load, lowest, edge)
