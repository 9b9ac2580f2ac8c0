"""Tables in the page: logarithms of a function at Chebyshev nodes; the page interpolates them."""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np

from nucleation.types import Array

from .encode import float32

HEIGHTS = (1e-3, 1e3)  # h = (1 - nu) b sigma0 H/(mu D)
CENTRE = 2.0  # h where lengths change most
POWER = 0.7  # how fast the place changes with h
LOGARITHMIC = ("zeta_over_a", "strengthening", "outside_a_over_a")
"""Arguments with nodes that are evenly spread over their logarithm."""


class Table(NamedTuple):
    """A tabulated function, the range of each argument and its number of nodes."""

    values: Callable[..., Array]
    ends: Mapping[str, tuple[float, float]]
    nodes: tuple[int, ...]


def place(height: float) -> float:
    """Where a height over the friction length is on an axis from -1 to 1."""
    ratio = (height / CENTRE) ** POWER
    return (ratio - 1.0) / (ratio + 1.0)


def height_at(places: Array) -> Array:
    """The heights over the friction length at places; the inverse of :func:`place`."""
    ratio = (1.0 + places) / (1.0 - places)
    return np.asarray(CENTRE * ratio ** (1.0 / POWER))


PLACES = (place(HEIGHTS[0]), place(HEIGHTS[1]))


def tabulate(table: Table) -> dict[str, Any]:
    """The ranges, the nodes of each argument, and the logarithms at all nodes, row by row."""
    nodes = {}
    for (name, ends), number in zip(table.ends.items(), table.nodes, strict=True):
        interval = np.log(ends) if name in LOGARITHMIC else np.array(ends)
        nodes[name] = _chebyshev(interval, number)
    grids = np.meshgrid(*nodes.values(), indexing="ij")
    places = dict(zip(nodes, grids, strict=True))
    for name in places.keys() & LOGARITHMIC:
        places[name] = np.exp(places[name])
    return {
        "ends": dict(table.ends),
        "nodes": {name: node.tolist() for name, node in nodes.items()},
        "logs": float32(np.log(table.values(**places))),
    }


def _chebyshev(ends: Array, number: int) -> Array:
    roots = np.cos(np.pi * (np.arange(number) + 0.5) / number)
    return ends.mean() + 0.5 * np.diff(ends) * roots
