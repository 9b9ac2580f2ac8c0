"""The elastic body that parameters ask for: one block on a rigid base, or a pair of blocks."""

from __future__ import annotations

from typing import TypeAlias

from ..model.parameters import Parameters
from .block import Block
from .grid import Grid
from .operator import BlockOperator
from .pair import Pair, PairOperator

BodyOperator: TypeAlias = BlockOperator | PairOperator


def body_of(parameters: Parameters) -> Block | Pair:
    """The body of a run."""
    upper = Block(Grid.of(parameters.geometry, parameters.mesh), parameters.material)
    below = parameters.below
    if below is None:
        return upper
    grid = Grid.of(below.geometry, below.mesh)
    return Pair(upper, Block(grid, below.material, below.bottom))
