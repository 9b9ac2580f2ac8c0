"""The elastic body that parameters ask for: on a rigid base, or a pair; finite, or periodic."""

from __future__ import annotations

from typing import TypeAlias

from ..model.parameters import Parameters
from .block import Block, BlockOperator
from .grid import Grid
from .pair import Pair, PairOperator
from .periodic import PeriodicBlock
from .periodic_pair import PeriodicPair

BodyOperator: TypeAlias = BlockOperator | PairOperator


def body_of(parameters: Parameters) -> Block | Pair:
    """The body of a run."""
    upper = Block(Grid.of(parameters.geometry, parameters.mesh), parameters.material)
    below = parameters.below
    if below is None:
        return upper
    grid = Grid.of(below.geometry, below.mesh)
    return Pair(upper, Block(grid, below.material, below.bottom))


def period_of(parameters: Parameters) -> PeriodicBlock | PeriodicPair:
    """One period, as long as the block, of the layers that a run's body or bodies are."""
    upper = PeriodicBlock(Grid.of(parameters.geometry, parameters.mesh), parameters.material)
    below = parameters.below
    if below is None:
        return upper
    grid = Grid.of(below.geometry, below.mesh)
    return PeriodicPair(upper, PeriodicBlock(grid, below.material, below.bottom))
