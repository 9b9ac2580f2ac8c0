"""The elastic body of a simulation: on a rigid base, or a pair; finite, or periodic."""

import dataclasses
from collections.abc import Callable

from ..model.parameters import Geometry, Mesh, Parameters
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


def _pushed_block(parameters: Parameters) -> ElasticBody:
    """The body that is pushed at its left edge."""
    return _block(parameters, Block, "free")


def _free_block(parameters: Parameters) -> FreeBlock:
    """The body that is moved at its top, with free side edges."""
    grid = Grid.of(parameters.geometry, parameters.mesh)
    odd = _block(parameters, Block, "velocity", parts=2)
    even = _block(parameters, EvenHalf, "velocity", parts=2)
    return FreeBlock(grid, odd, even)


def _block(
    parameters: Parameters,
    kind: type[Block],
    far_side: str,
    parts: int = 1,
) -> Block | BlockPair:
    """One of some equal parts along x of a block or pair."""
    upper = kind(_part(parameters.geometry, parameters.mesh, parts), parameters.material, far_side)
    below = parameters.below
    if below is None:
        return upper
    lower = kind(_part(below.geometry, below.mesh, parts), below.material, below.far_side)
    return BlockPair(upper, lower)


def _part(geometry: Geometry, mesh: Mesh, parts: int) -> Grid:
    grid = Grid.of(geometry, mesh)
    return dataclasses.replace(
        grid,
        length=grid.length / parts,
        n_x=grid.n_x // parts,
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
