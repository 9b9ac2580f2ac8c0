"""The elastic body of a simulation: on a rigid base, or a pair; finite, or periodic."""

from collections.abc import Callable
from typing import TypeVar

from ..model.material import Material
from ..model.parameters import Geometry, Mesh, Parameters
from .block import Block
from .condensed import ElasticBody
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
    return _layers(parameters, Block, BlockPair)


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
    return _layers(parameters, PeriodicBlock, PeriodicPair)


def _layers(
    parameters: Parameters,
    kind: Callable[[Grid, Material, str], Layer],
    pair: Callable[[Layer, Layer], Pair],
) -> Layer | Pair:
    """The run's layer, or the pair of its two."""

    def layer(geometry: Geometry, mesh: Mesh, material: Material, far_side: str) -> Layer:
        return kind(Grid.of(geometry, mesh), material, far_side)

    upper = layer(parameters.geometry, parameters.mesh, parameters.material, "free")
    below = parameters.below
    if below is None:
        return upper
    return pair(upper, layer(below.geometry, below.mesh, below.material, below.far_side))


BODIES: dict[str, Callable[[Parameters], ElasticBody]] = {
    "edge": _pushed_block,
    "remote": period_of,
}
"""The body for each kind of loading; a further kind adds its own."""
