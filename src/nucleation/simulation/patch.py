"""Where the patch is: its edge, its zone and its length, from the slip rates of an instant.

The patch extends to the furthest point at which the slip rate has exceeded a fraction of the
imposed velocity V so far. A point that has crept belongs to the patch, even if its slip rate
oscillates before the onset. Between nodes log v is linear in x.
"""

import numpy as np
from numpy.typing import NDArray

from ..types import Array
from .event import NEAR

STUCK = 1e-300  # m/s, in place of zero: its logarithm is finite


def slipping_edge(
    x: Array,
    slip_rate: Array,
    threshold: float,
) -> Array:
    """The furthest position (m) that slips faster than a threshold (m/s), if an edge is pushed.

    Only the part of the block next to the pushed edge is searched: slip at the far corner does not
    count. Before the event this position moves back and forth; the patch is as long as it has ever
    been. Slip rates (m/s) have the shape (..., nodes); the position is zero where nothing slips.
    """
    rate = np.maximum(np.abs(slip_rate), STUCK, dtype=float)  # in double precision
    near = int(
        np.searchsorted(
            x,
            NEAR * x[-1],
            side="right",
        )
    )
    faster = rate[..., :near] > threshold
    from_far = faster[..., ::-1]
    inside = near - 1 - from_far.argmax(axis=-1)
    outside = np.minimum(inside + 1, x.size - 1)
    edge = _between(x, rate, inside, outside, threshold)
    return np.where(faster.any(axis=-1), edge, 0.0)


def _between(
    x: Array,
    rate: Array,
    inside: NDArray[np.intp],
    outside: NDArray[np.intp],
    threshold: float,
) -> Array:
    """Position (m) where log v passes a threshold between two neighbours.

    Both neighbours are given by their nodes. If log v does not pass the threshold, the position is
    that of the inside node.
    """

    def log_rate(nodes: NDArray[np.intp]) -> Array:
        chosen = np.take_along_axis(rate, nodes[..., None], -1)
        return np.log(chosen[..., 0])

    edge = np.log(threshold)
    faster = log_rate(inside)
    slower = log_rate(outside)
    passes = (slower < edge) & (edge < faster)
    fall = np.where(passes, faster - slower, np.inf)
    part = (faster - edge) / fall
    distance = x[outside] - x[inside]
    return x[inside] + part * distance


def slipping_zone(
    x: Array,
    slip_rate: Array,
    threshold: float,
    periodic: bool = False,
) -> tuple[float, float]:
    """Find the zone about the fastest node that slips faster than a threshold at one instant."""
    rate = np.maximum(np.abs(slip_rate), STUCK, dtype=float)
    fastest = int(np.argmax(rate))
    if rate[fastest] <= threshold:
        return 0.0, 0.0
    if periodic:  # one period about the fastest node; node n_x repeats node 0
        n = x.size - 1
        first = fastest - n // 2
        order = np.arange(first, first + n)
        x = (x[1] - x[0]) * order
        rate = rate[order % n]
        fastest = n // 2

    def end(step: int) -> float:
        outer = np.flatnonzero(rate[fastest::step] < threshold)
        if not outer.size:
            return float(x[::step][-1])
        outside = np.array(fastest + step * outer[0])
        return float(_between(x, rate, outside - step, outside, threshold))

    return end(-1), end(1)


def patch_lengths(
    kind: str,
    x: Array,
    slip_rates: Array,
    threshold: float,
) -> Array:
    """Length of the patch at every instant, by the slip rates of that instant alone.

    A pushed edge is one end of the patch. Otherwise the patch is the zone about the fastest node.
    """
    if kind == "edge":
        return slipping_edge(x, slip_rates, threshold)
    periodic = kind == "remote"
    zones = [slipping_zone(x, rate, threshold, periodic) for rate in slip_rates]
    return np.array([end - begin for begin, end in zones])
