"""The elastic body that parameters ask for: on a rigid base, or a pair; finite, or periodic."""

import dataclasses
from collections.abc import Callable
from typing import Any, TypeAlias

from ..model.parameters import Parameters
from .block import Block, BlockOperator
from .free_block import EvenHalf, FreeBlock
from .grid import Grid
from .pair import Pair, PairOperator
from .periodic import PeriodicBlock
from .periodic_pair import PeriodicPair

BodyOperator: TypeAlias = BlockOperator | PairOperator


def body_of(parameters: Parameters) -> Any:
    """The body of a run, by its loading: here a further kind of loading has its body.

    ParameterError if the parameters are not for one another.
    """
    parameters.require_consistent()
    return LOADED[parameters.loading.kind](parameters)


def pushed_block(parameters: Parameters) -> Block | Pair:
    """What is pushed at its left edge."""
    upper = Block(Grid.of(parameters.geometry, parameters.mesh), parameters.material)
    below = parameters.below
    if below is None:
        return upper
    grid = Grid.of(below.geometry, below.mesh)
    return Pair(upper, Block(grid, below.material, below.bottom))


def free_block(parameters: Parameters) -> FreeBlock:
    """What is moved at its top, its side edges free: either half of it, a block or a pair."""
    grid, below = Grid.of(parameters.geometry, parameters.mesh), parameters.below

    def half(kind: type[Block]) -> Block | Pair:
        upper = kind(_half(grid), parameters.material, "velocity")
        if below is None:
            return upper
        lower = kind(_half(Grid.of(below.geometry, below.mesh)), below.material, below.bottom)
        return Pair(upper, lower)

    return FreeBlock(grid, half(Block), half(EvenHalf))


def _half(grid: Grid) -> Grid:
    return dataclasses.replace(grid, length=grid.length / 2.0, n_x=grid.n_x // 2)


def period_of(parameters: Parameters) -> PeriodicBlock | PeriodicPair:
    """One period, as long as the block, of the layers that a run's body or bodies are."""
    far_side = "velocity" if parameters.loading.kind == "top" else "free"
    grid = Grid.of(parameters.geometry, parameters.mesh)
    upper = PeriodicBlock(grid, parameters.material, far_side)
    below = parameters.below
    if below is None:
        return upper
    grid = Grid.of(below.geometry, below.mesh)
    return PeriodicPair(upper, PeriodicBlock(grid, below.material, below.bottom))


LOADED: dict[str, Callable[[Parameters], Any]] = {
    "edge": pushed_block, "top": free_block, "remote": period_of,
}  # fmt: skip
"""The body that each kind of loading acts on."""
