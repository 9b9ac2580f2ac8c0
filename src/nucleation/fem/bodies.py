"""The elastic body of a simulation: on a rigid base, or a pair; finite, or periodic."""

import dataclasses
from collections.abc import Callable

from ..model.parameters import Parameters
from .block import Block
from .condensed import ElasticBody
from .even_half import EvenHalf
from .free_block import FreeBlock
from .grid import Grid
from .pair import BlockPair
from .periodic import PeriodicBlock
from .periodic_pair import PeriodicPair


def body_of(parameters: Parameters) -> ElasticBody:
    """Make the body of a run, by its kind of loading.

    Parameters
    ----------
    parameters : Parameters
        Those of the run.

    Returns
    -------
    ElasticBody

    Raises
    ------
    ParameterError
        If the parameters contradict each other.
    """
    parameters.require_consistent()
    return BODIES[parameters.loading.kind](parameters)


def _pushed_block(parameters: Parameters) -> Block | BlockPair:
    """The body that is pushed at its left edge."""
    grid = Grid.of(parameters.geometry, parameters.mesh)
    upper = Block(grid, parameters.material)
    below = parameters.below
    if below is None:
        return upper
    grid = Grid.of(below.geometry, below.mesh)
    lower = Block(grid, below.material, below.far_side)
    return BlockPair(upper, lower)


def _free_block(parameters: Parameters) -> FreeBlock:
    """The body that is moved at its top, with free side edges."""
    grid = Grid.of(parameters.geometry, parameters.mesh)
    odd = _half_block(parameters, Block)
    even = _half_block(parameters, EvenHalf)
    return FreeBlock(grid, odd, even)


def _half_block(parameters: Parameters, kind: type[Block]) -> Block | BlockPair:
    """The odd or even half of a free block or pair."""
    grid = Grid.of(parameters.geometry, parameters.mesh)
    upper = kind(_half(grid), parameters.material, "velocity")
    below = parameters.below
    if below is None:
        return upper
    grid = Grid.of(below.geometry, below.mesh)
    lower = kind(_half(grid), below.material, below.far_side)
    return BlockPair(upper, lower)


def _half(grid: Grid) -> Grid:
    return dataclasses.replace(
        grid,
        length=grid.length / 2.0,
        n_x=grid.n_x // 2,
    )


def period_of(parameters: Parameters) -> PeriodicBlock | PeriodicPair:
    """Make one period, as long as the block, of the layers of a run's body or bodies.

    Parameters
    ----------
    parameters : Parameters
        Those of the run; ``mesh.n_x`` is odd.

    Returns
    -------
    PeriodicBlock or PeriodicPair
    """
    far_side = "velocity" if parameters.loading.kind == "top" else "free"
    grid = Grid.of(parameters.geometry, parameters.mesh)
    upper = PeriodicBlock(grid, parameters.material, far_side)
    below = parameters.below
    if below is None:
        return upper
    grid = Grid.of(below.geometry, below.mesh)
    lower = PeriodicBlock(grid, below.material, below.far_side)
    return PeriodicPair(upper, lower)


BODIES: dict[str, Callable[[Parameters], ElasticBody]] = {
    "edge": _pushed_block,
    "top": _free_block,
    "remote": period_of,
}
"""The body for each kind of loading; a further kind adds its own."""
