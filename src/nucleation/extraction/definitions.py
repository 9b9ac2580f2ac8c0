"""Definitions: how the onset of the event and the length of the patch are read from a run.

The onset is the start of the abrupt drop: the maximum from which ``|f_d|`` falls into the event.
Small rises during the fall, as under a fluctuating load, belong to the fall. A rupture may drive
the front on before the force at the pushed edge falls, and may raise that force when it arrives
there; the onset is then the maximum before the rupture. How far the patch extends is defined in
:mod:`nucleation.simulation.event`.
"""

import dataclasses

import numpy as np
from numpy.typing import NDArray

from ..datasets.variables import Column, columns, first
from ..model.quantities import quantity
from ..model.settings import EVENT_DROP
from ..model.units import Checked
from ..simulation.event import SLIPPING, has_dropped
from ..types import Array

REBOUND = 0.1  # a rise by less than this part of the fall that follows belongs to the fall

ONSET_TIME = Column("onset_time", "s", "onset of the event", "t", np.mean)
ONSET_TIME_LOW = Column(
    "onset_time_low", "s", "earliest onset over the definitions of the drop", "t", np.min
)
ONSET_TIME_HIGH = Column(
    "onset_time_high", "s", "latest onset over the definitions of the drop", "t", np.max
)
LENGTH = Column("length", "m", "length at the drop", "L", np.mean)
LENGTH_LOW = Column("length_low", "m", "smallest length over the definitions", "L", np.min)
LENGTH_HIGH = Column("length_high", "m", "largest length over the definitions", "L", np.max)

MEASURED = columns(ONSET_TIME, ONSET_TIME_LOW, ONSET_TIME_HIGH, LENGTH, LENGTH_LOW, LENGTH_HIGH)
"""Results of a run (s, m): onset and length, each with the ends of its error bar."""

STABILITY_LENGTH = Column("stability_length", "m", "patch length where growth begins", "L_s", first)
STABILITY_LENGTH_LOW = Column(
    "stability_length_low", "m", "L_s less the scatter as the front hops", "L_s", first
)
STABILITY_LENGTH_HIGH = Column(
    "stability_length_high", "m", "L_s with the scatter as the front hops", "L_s", first
)
STABILITY_LENGTH_ERROR = Column(
    "stability_length_error", "m", "standard error of L_s", "L_s", first
)
STABILITY_FREQUENCY = Column(
    "stability_frequency", "1/s", "angular frequency where growth begins", "omega", first
)

FITTED = columns(
    STABILITY_LENGTH,
    STABILITY_LENGTH_LOW,
    STABILITY_LENGTH_HIGH,
    STABILITY_LENGTH_ERROR,
    STABILITY_FREQUENCY,
)
"""Results of :mod:`.growth`: of the patch where its growth begins."""


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
    runs_away: NDArray[np.bool_],
    long_enough: NDArray[np.bool_],
    ruptures: NDArray[np.bool_],
) -> Onset | None:
    """Find the first abrupt drop of the force in a run.

    Parameters
    ----------
    time, force : ndarray, shape (steps,)
        Times (s) and magnitudes of the force (N/m).
    window, drop : float
        Time (s) within which the force has to fall, and the fraction by which
        (:func:`~nucleation.simulation.event.has_dropped`).
    runs_away, long_enough, ruptures : ndarray of bool, shape (steps,)
        Whether the patch runs away at these times, whether it has been longer than a few elements
        by then, and whether the interface slips as fast as in a rupture.

    Returns
    -------
    Onset or None
        None if there is no event.
    """
    maxima: list[tuple[float, float]] = []
    steps = list(zip(time.tolist(), force.tolist(), runs_away.tolist(), strict=True))

    def falls(step: int) -> bool:
        dropped = has_dropped(maxima, window, drop, *steps[step])
        return dropped and bool(long_enough[np.searchsorted(time, maxima[0][0])])

    end = next(filter(falls, range(time.size)), None)
    if end is None:
        return None
    start = _last_maximum(force, end)
    if ruptures[start]:
        (slower,) = np.nonzero(~ruptures[:start])
        start = _last_maximum(force, int(slower[-1]))
    elapsed = time[start] - time[0]
    loading_rate = (force[start] - force[0]) / max(elapsed, 1e-300)
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
