"""Definitions: the onset of the event, and the length of the creep patch.

Onset is the start of the abrupt drop: the instant from which ``|f_d|`` falls without rising again
until the event. The patch extends to the furthest point at which the slip rate has exceeded a
fraction of the imposed velocity V so far: what has crept belongs to the patch, though its slip rate
oscillates before the onset.
"""

from __future__ import annotations

import dataclasses

import numpy as np
from numpy.typing import NDArray

from ..model.quantities import Checked, quantity
from ..simulation.event import DROP, DropWatch

Array = NDArray[np.float64]

SEARCHED = 0.5  # part of the block, from the loaded edge, in which the patch's edge is sought


@dataclasses.dataclass(frozen=True)
class ExtractionSettings(Checked):
    """How the critical nucleation length is read from a simulation."""

    edge_threshold: float = quantity(
        "slip rate at the edge of the creep patch over the imposed velocity", low=0.0, high=1.0,
        closed="high", default=0.01,
    )  # fmt: skip
    edge_threshold_high: float = quantity(
        "largest edge threshold of the error bar", low=0.0, high=1.0, closed="high", default=0.5
    )
    edge_threshold_low: float = quantity(
        "smallest edge threshold of the error bar", low=0.0, high=1.0, closed="high", default=1e-3
    )
    drop: float = quantity(
        "abrupt drop of the driving force that makes an event, as a fraction", low=0.0, high=1.0,
        default=DROP,
    )  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Onset:
    """Indices into the steps of a run that mark its first event."""

    start: int  # the last maximum of |f_d| before the drop
    steep: int  # from here |f_d| falls faster than loading has raised it on average
    end: int  # the drop is complete


def find_onset(time: Array, force: Array, window: float, drop: float) -> Onset | None:
    """The first abrupt drop of a force magnitude (N/m) over time (s), or None.

    Parameters
    ----------
    time, force : of every step, shape (steps,).
    window, drop : of :class:`~nucleation.simulation.event.DropWatch`, in s and as a fraction.
    """
    watch = DropWatch(window, drop)
    end = next(
        (i for i, at in enumerate(zip(time, force, strict=True)) if watch.dropped(*at)), None
    )
    if end is None:
        return None
    start = end
    while start > 0 and force[start - 1] >= force[start]:
        start -= 1
    loading_rate = (force[start] - force[0]) / max(time[start] - time[0], 1e-300)
    falling = -np.diff(force[start : end + 1]) / np.diff(time[start : end + 1])
    steep = start + int(np.argmax(falling > loading_rate)) if falling.size else end
    return Onset(start, steep, end)


def slipping_edge(x: Array, slip_rate: Array, threshold: float) -> float:
    """Position (m) up to which the interface slips at one instant, faster than a rate (m/s).

    Before the event the slip rate oscillates, and this edge with it, to and fro. It is needed to
    find the patch's length, the furthest that it has come (:class:`Extent`), and for nothing else.
    Between nodes log v is taken as linear in x. Only the part of the block next to the loaded
    edge is searched, so that slip at the far corner does not count. Zero if nothing slips faster.
    """
    near = x <= SEARCHED * x[-1]
    rate = np.maximum(np.abs(slip_rate), 1e-300)
    faster = np.flatnonzero(near & (rate > threshold))
    if faster.size == 0:
        return 0.0
    last = int(faster[-1])
    if last + 1 >= x.size or rate[last + 1] >= threshold:
        return float(x[last])
    inside, outside = np.log(rate[last]), np.log(rate[last + 1])
    part = (inside - np.log(threshold)) / (inside - outside)
    return float(x[last] + part * (x[last + 1] - x[last]))


class Extent:
    """The patch's length in a run that is going on, fed with one instant after another."""

    def __init__(self, x: Array, threshold: float) -> None:
        """`x` (m) along the interface, and the slip rate (m/s) at the edge."""
        self._x, self._threshold = x, threshold
        self.length = 0.0  # m

    def reach(self, slip_rate: Array) -> float:
        """The patch's length (m) now that the slip rates are these (m/s)."""
        self.length = max(self.length, slipping_edge(self._x, slip_rate, self._threshold))
        return self.length
