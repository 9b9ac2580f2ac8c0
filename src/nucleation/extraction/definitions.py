"""Definitions: how the onset of the event and the length of the patch are read from a run.

The onset is the start of the abrupt drop: the maximum from which ``|f_d|`` falls into the event.
Small rises during the fall, as under a fluctuating load, belong to the fall. A rupture may drive
the front on before the force at the pushed edge falls, and may raise that force when it arrives
there; the onset is then the maximum before the rupture. How far the patch extends is defined in
:mod:`nucleation.simulation.event`.

Lengths of the literature are those of the accelerating zone of a period, by several definitions.
"""

import dataclasses
import math
from collections.abc import Callable
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..model.quantities import quantity
from ..model.settings import EVENT_DROP
from ..model.units import Checked
from ..simulation.event import SLIPPING, DropWatch, slipping_zone
from ..types import Array

if TYPE_CHECKING:
    import xarray as xr

RUPTURE = 1000.0  # slip rate over V at which the loading no longer matters
REBOUND = 0.1  # a rise by less than this part of the fall that follows belongs to the fall


@dataclasses.dataclass(frozen=True)
class ExtractionSettings(Checked):
    """How the critical nucleation length is read from a simulation.

    Examples
    --------
    >>> ExtractionSettings(drop=0.02).drop
    0.02
    """

    edge_threshold: float = quantity(
        "slip rate at the edge of the creep patch over the imposed velocity",
        "(0.0, 1.0]",
        default=SLIPPING,
    )
    edge_threshold_high: float = quantity(
        "largest edge threshold of the error bar", "(0.0, 1.0]", default=0.5
    )
    edge_threshold_low: float = quantity(
        "smallest edge threshold of the error bar", "(0.0, 1.0]", default=1e-3
    )
    drop: float = quantity(
        "abrupt drop of the driving force that makes an event, as a fraction",
        "(0.0, 1.0)",
        default=EVENT_DROP,
    )


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
    ruptures: NDArray[np.bool_] | None = None,
) -> Onset | None:
    """Find the first abrupt drop of the force in a run.

    Parameters
    ----------
    time, force : ndarray, shape (steps,)
        Times (s) and magnitudes of the force (N/m).
    window, drop : float
        Time (s) within which the force has to fall, and the fraction by which
        (:class:`~nucleation.simulation.event.DropWatch`).
    fast : ndarray of bool, shape (steps,), optional
        Whether the patch slips fast at these times; by default it always does.
    long_enough : ndarray of bool, shape (steps,), optional
        Whether the patch has been longer than a few elements by then; by default it always has.
    ruptures : ndarray of bool, shape (steps,), optional
        Whether the interface slips as fast as in a rupture; by default it never does.

    Returns
    -------
    Onset or None
        None if there is no event.
    """
    watch = DropWatch(window, drop)
    always = np.ones(time.size, dtype=bool)
    fast = always if fast is None else fast
    long_enough = always if long_enough is None else long_enough

    def falls(step: int) -> bool:
        if not watch.dropped(
            time[step],
            force[step],
            fast[step],
        ):
            return False
        return bool(long_enough[np.searchsorted(time, watch.since)])

    end = next(filter(falls, range(time.size)), None)
    if end is None:
        return None
    start = _last_maximum(force, end)
    if ruptures is not None and ruptures[start]:
        (slower,) = np.nonzero(~ruptures[:start])
        start = _last_maximum(force, int(slower[-1]))
    loading_rate = (force[start] - force[0]) / max(time[start] - time[0], 1e-300)
    during = slice(start, end + 1)
    falling = -np.diff(force[during]) / np.diff(time[during])
    steep = end
    if falling.size:
        steep = start + int(np.argmax(falling > loading_rate))
    return Onset(start, steep, end)


def _last_maximum(force: Array, end: int) -> int:
    """Index of the maximum from which the force falls to its value at `end`.

    Going back from the end, rises by less than :data:`REBOUND` times the fall do not count.
    """
    start = end
    for step in range(end - 1, -1, -1):
        fall = force[start] - force[end]
        if force[step] < force[start] - REBOUND * fall:
            break
        if force[step] >= force[start]:
            start = step
    return start


class _Definition(NamedTuple):
    """How a simulated length is read: the zone that slips faster than a share of the fastest."""

    share: float
    part: float  # length of the zone over the whole length, in the source's own solution
    words: str
    between_tips: bool = False  # slip may be slower within the zone, as in a crack


DEFINITIONS = {
    "rubin_ampuero_localised": _Definition(
        share=0.5,
        part=0.7434 / 1.3774,
        words="width at half the largest slip rate, times 1.3774/0.7434",
    ),
    "rubin_ampuero_crack": _Definition(
        share=0.1,
        part=1.0,
        words="distance of the outermost points at a tenth of the largest slip rate",
        between_tips=True,
    ),
    "thin_layer": _Definition(
        share=0.5,
        part=0.5,
        words="twice the width at half the largest slip rate",
    ),
    "state_evolution": _Definition(
        share=0.5,
        part=1.0,
        words="width at half the largest slip rate",
    ),
}
"""In Rubin and Ampuero's solution 0.7434 L_b on either side slip faster than half the maximum; in
Viesca's, ``1 + cos(x/L)``, one half does."""


def zone_length(
    simulation: "xr.Dataset",
    slip_rate: float,
    definition: _Definition,
) -> float:
    """Length of the accelerating zone when its largest slip rate passes a value.

    In m and m/s; between recorded times the length is linear in the logarithm of the largest slip
    rate, and NaN if that slip rate is not reached.
    """
    x = simulation["x"].values

    def width(rates: Array, states: Array) -> float:
        threshold = definition.share * float(rates.max())
        if definition.between_tips:
            rates = _filled_between_tips(rates)
        begin, end = slipping_zone(x, rates, threshold, periodic=True)
        return (end - begin) / definition.part

    return _when_passing(simulation, slip_rate, width)


def _filled_between_tips(rates: Array) -> Array:
    """Raise the slip rates of a period, so that they fall from the fastest node to both sides.

    At each node the result is the smaller one of the largest slip rates on its left and right.
    """
    first = _opposite(rates)
    around = np.roll(rates[:-1], -first)
    from_left = np.maximum.accumulate(around)
    from_right = np.maximum.accumulate(around[::-1])[::-1]
    filled = np.roll(np.minimum(from_left, from_right), first)
    return np.append(filled, filled[0])


def far_ahead(
    simulation: "xr.Dataset",
    slip_rate: float,
    slip_distance: float,
) -> tuple[float, float]:
    """Slip rate (m/s) and ``v phi/D`` half a period from the fastest point, when it slips as fast.

    NaN if the largest slip rate (m/s) is not reached, or if the fault is stuck there.
    """
    rate = _when_passing(simulation, slip_rate, lambda rates, _: rates[_opposite(rates)])
    if not rate > 0.0:  # slip rates of a stuck fault are not recorded
        return math.nan, math.nan
    state = _when_passing(simulation, slip_rate, lambda rates, states: states[_opposite(rates)])
    return rate, rate * state / slip_distance


def _opposite(rates: Array) -> int:
    """The node half a period from the fastest; the first and the last node are the same."""
    period = rates.size - 1
    return (int(rates.argmax()) + period // 2) % period


def _when_passing(
    simulation: "xr.Dataset",
    slip_rate: float,
    measure: Callable[[Array, Array], float],
) -> float:
    """The measure of slip rates (m/s) and states (s) when the fastest passes a value (m/s)."""
    rates = np.abs(simulation["slip_rate"].values.astype(float))
    states = simulation["state"].values
    fastest = rates.max(axis=1)
    above = np.flatnonzero(fastest >= slip_rate)
    if not above.size or above[0] == 0:
        return math.nan
    pair = [above[0] - 1, above[0]]
    measured = [measure(rates[i], states[i]) for i in pair]
    return float(
        np.interp(
            np.log(slip_rate),
            np.log(fastest[pair]),
            measured,
        )
    )
