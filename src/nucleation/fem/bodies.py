"""The elastic body of a simulation: on a rigid base, or a pair; finite, or periodic."""

import dataclasses
from collections.abc import Callable
from typing import TypeVar

from ..model.material import Material
from ..model.parameters import Geometry, Mesh, Parameters
from .block import Block
from .condensed import ElasticBody
from .even_half import EvenHalf
from .free_block import FreeBlock
from .grid import Grid
from .pair import BlockPair
from .periodic import PeriodicBlock
from .periodic_pair import PeriodicPair

Layer = TypeVar("Layer", Block, PeriodicBlock)
Pair = TypeVar("Pair", BlockPair, PeriodicPair)


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
    return _layers(parameters, Block, BlockPair, "free")


def _free_block(parameters: Parameters) -> FreeBlock:
    """The body that is moved at its top, with free side edges."""
    grid = Grid.of(parameters.geometry, parameters.mesh)
    odd = _layers(parameters, Block, BlockPair, "velocity", parts=2)
    even = _layers(parameters, EvenHalf, BlockPair, "velocity", parts=2)
    return FreeBlock(grid, odd, even)


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
    return _layers(parameters, PeriodicBlock, PeriodicPair, far_side)


def _layers(
    parameters: Parameters,
    kind: Callable[[Grid, Material, str], Layer],
    pair: Callable[[Layer, Layer], Pair],
    far_side: str,
    parts: int = 1,
) -> Layer | Pair:
    """The run's layer, or the pair of its two, as one of some equal parts along x."""

    def layer(geometry: Geometry, mesh: Mesh, material: Material, far_side: str) -> Layer:
        grid = Grid.of(geometry, mesh)
        part = dataclasses.replace(grid, length=grid.length / parts, n_x=grid.n_x // parts)
        return kind(part, material, far_side)

    upper = layer(parameters.geometry, parameters.mesh, parameters.material, far_side)
    below = parameters.below
    if below is None:
        return upper
    return pair(upper, layer(below.geometry, below.mesh, below.material, below.far_side))


BODIES: dict[str, Callable[[Parameters], ElasticBody]] = {
    "edge": _pushed_block,
    "top": _free_block,
    "remote": period_of,
}
"""The body for each kind of loading; a further kind adds its own."""
