"""Definitions: the onset of the event, and the length of the creep patch.

Onset is the start of the abrupt drop: the maximum from which ``|f_d|`` falls into the event, but
for rises too small to count, as loads that fluctuate make them. The patch extends to the furthest
point at which the slip rate has exceeded a fraction of the imposed velocity V so far: what has
crept belongs to the patch, though its slip rate oscillates before the onset.
"""

import dataclasses

import numpy as np
from numpy.typing import NDArray

from ..model.checked import Checked
from ..model.parameters import EVENT_DROP
from ..model.quantities import quantity
from ..simulation.event import NEAR, DropWatch
from ..types import Array

REBOUND = 0.1  # a rise by this part of the fall that follows belongs to the fall


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
        default=EVENT_DROP,
    )  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Onset:
    """Indices into the steps of a run that mark its first event."""

    start: int  # the maximum of |f_d| from which it falls into the event
    steep: int  # from here |f_d| falls faster than loading has raised it on average
    end: int  # the drop is complete


def find_onset(
    time: Array,
    force: Array,
    window: float,
    drop: float,
    fast: NDArray[np.bool_] | None = None,
    long_enough: NDArray[np.bool_] | None = None,
) -> Onset | None:
    """The first abrupt drop of a force over the steps of a run, or None.

    Parameters
    ----------
    time, force : ndarray, shape (steps,)
        Times (s) and magnitudes of the force (N/m).
    window, drop : float
        Of :class:`~nucleation.simulation.event.DropWatch`: in seconds, and a fraction.
    fast : ndarray of bool, shape (steps,), optional
        Whether the patch slips fast at these times; always, if left out.
    long_enough : ndarray of bool, shape (steps,), optional
        Whether the patch has been longer than a few elements by then; always, if left out.
    """
    watch = DropWatch(window, drop)
    always = np.ones(time.size, dtype=bool)
    fast = always if fast is None else fast
    long_enough = always if long_enough is None else long_enough

    def falls(step: int) -> bool:
        dropped = watch.dropped(time[step], force[step], fast[step])
        return dropped and bool(long_enough[np.searchsorted(time, watch.since)])

    end = next(filter(falls, range(time.size)), None)
    if end is None:
        return None
    start = _last_maximum(force, end)
    loading_rate = (force[start] - force[0]) / max(time[start] - time[0], 1e-300)
    falling = -np.diff(force[start : end + 1]) / np.diff(time[start : end + 1])
    steep = start + int(np.argmax(falling > loading_rate)) if falling.size else end
    return Onset(start, steep, end)


def _last_maximum(force: Array, end: int) -> int:
    """Index of the maximum from which a force falls to its value at `end`, small rises apart."""
    start = i = end
    while i > 0 and force[i - 1] >= force[start] - REBOUND * (force[start] - force[end]):
        i -= 1
        if force[i] >= force[start]:
            start = i
    return start


def slipping_edge(x: Array, slip_rate: Array, threshold: float) -> Array:
    """Position (m) up to which the interface slips, faster than a rate (m/s), at every instant.

    With an edge that is pushed; `slip_rate` (m/s) is (..., x). Before the event the patch's edge
    goes to and fro: it is needed for the patch's length alone, the furthest that it has come.
    Between nodes log v is taken as linear in x. Only the part of the block next to the loaded edge
    is searched, so that slip at the far corner does not count. Zero if nothing slips faster.
    """
    rate = np.maximum(np.abs(slip_rate), 1e-300, dtype=float)  # also of single precision
    near = int(np.searchsorted(x, NEAR * x[-1], side="right"))
    faster = rate[..., :near] > threshold
    inside = near - 1 - faster[..., ::-1].argmax(axis=-1)
    ends = np.array([inside, np.minimum(inside + 1, x.size - 1)])
    return np.where(faster.any(axis=-1), _between(x, rate, ends, threshold), 0.0)


def _between(x: Array, rate: Array, ends: NDArray[np.intp], threshold: float) -> Array:
    """Where log v, linear between two neighbours, passes a threshold; the first if it does not."""
    (first, second), edge = ends, np.log(threshold)
    faster, slower = (np.log(np.take_along_axis(rate, i[..., None], -1)[..., 0]) for i in ends)
    part = (faster - edge) / np.where((slower < edge) & (edge < faster), faster - slower, np.inf)
    return x[first] + part * (x[second] - x[first])


def slipping_zone(
    x: Array, slip_rate: Array, threshold: float, periodic: bool = False
) -> tuple[float, float]:
    """Positions (m) between which the interface slips faster than a rate (m/s) at one instant.

    The zone is that about the fastest node. Between nodes log v is taken as linear in x. Where
    nothing slips faster both are zero; in a period the zone may begin below zero or end beyond L.
    """
    rate = np.maximum(np.abs(slip_rate), 1e-300, dtype=float)
    fastest = int(np.argmax(rate))
    if rate[fastest] <= threshold:
        return 0.0, 0.0
    if periodic:  # one period about the fastest node, of which node 0 and node n_x are the same
        n = x.size - 1
        order = np.arange(fastest - n // 2, fastest - n // 2 + n)
        x, rate, fastest = (x[1] - x[0]) * order, rate[order % n], n // 2

    def end(step: int) -> float:
        outer = np.flatnonzero(rate[fastest::step] < threshold)
        if not outer.size:
            return float(x[::step][-1])
        i = fastest + step * int(outer[0])
        return float(_between(x, rate, np.array([i - step, i]), threshold))

    return end(-1), end(1)


def patch_lengths(kind: str, x: Array, slip_rates: Array, threshold: float) -> Array:
    """Length (m) of the patch at every instant, by the kind of loading; slip rates (instant, x).

    An edge that is pushed is one end of the patch; otherwise the patch is the zone about the
    fastest node.
    """
    if kind == "edge":
        return slipping_edge(x, slip_rates, threshold)
    zones = [slipping_zone(x, rate, threshold, kind == "remote") for rate in slip_rates]
    return np.array([end - begin for begin, end in zones])


class Extent:
    """The patch's length in a run that is going on, fed with one instant after another."""

    def __init__(self, x: Array, threshold: float, kind: str = "edge") -> None:
        """`x` (m) along the interface, the slip rate (m/s) at the edge, and the loading's kind."""
        self._x, self._threshold, self._kind = x, threshold, kind
        self.length = 0.0  # m

    def reach(self, slip_rate: Array) -> float:
        """The patch's length (m) now that the slip rates are these (m/s)."""
        (now,) = patch_lengths(self._kind, self._x, slip_rate[None], self._threshold)
        self.length = max(self.length, float(now))
        return self.length
