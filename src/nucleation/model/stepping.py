"""Control of the time integration."""

import dataclasses

from .checked import Checked
from .quantities import quantity

EVENT_DROP = 0.02
"""Default drop of the driving force that defines an event, as a fraction of the force."""

FIRST_STEP = 2.0e-6
"""First time step over the memory time D/V."""


@dataclasses.dataclass(frozen=True)
class Stepping(Checked):
    """Control of the time integration.

    Examples
    --------
    >>> Stepping(end_time=10.0).end_time
    10.0
    """

    end_time: float = quantity("simulated time", "(0.0, 1e12) s", symbol="t", default=16.0)
    time_after_event: float = quantity(
        "time simulated after the event's onset before the run may end",
        "[0.0, 1e12) s",
        default=1e12 / 2,
    )
    event_drop: float = quantity(
        "fall of the driving force with which the event has begun, as a fraction; in the workflow "
        "extraction.drop if that is larger",
        "(0.0, 1.0)",
        default=EVENT_DROP,
    )
    tolerance: float = quantity(
        "tolerance of the local error of log slip rate and log state per step",
        "(0.0, 1.0)",
        default=1.0e-2,
    )
    longest_step: float = quantity(
        "longest time step over the memory time D/V", "(0.0, 1.0]", default=0.1
    )
    shortest_step: float = quantity(
        "shortest time step, below which the run ends as failed", "(0.0, 1.0) s", default=1.0e-12
    )
