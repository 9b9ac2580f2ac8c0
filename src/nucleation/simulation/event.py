"""The abrupt drop of the driving force that marks the onset of accelerating slip (Text S2.2).

While the patch creeps, the driving force changes over seconds; in the event it falls within
milliseconds. An event needs three things:

- the force falls by a given fraction below its largest value of the last memory time D/V;
- the interface slips fast at that moment. Otherwise a decaying oscillation of the creeping patch or
  a fluctuating load would count as an event. Where an edge is pushed, the patch itself has to slip
  fast: fast slip at the free corner of the far end does not drive an event;
- the patch is longer than a few elements, since slip that the mesh cannot resolve is fast as well.
"""

import enum
from collections import deque

import numpy as np
from numpy.typing import NDArray

from ..model.settings import EVENT_DROP
from ..run.run import Run
from ..types import Array


class Outcome(enum.Enum):
    """How a run ended."""

    END_TIME = "completed: the end time was reached"
    AFTER_EVENT = "completed: the event and the time asked for after it are covered"
    STEP_UNDERFLOW = "failed: the step size fell below the shortest step allowed"
    TENSION = "failed: the interface came under tension, where the friction law has no meaning"
    NOT_FINITE = "failed: a recorded value is not finite"

    INTERRUPTED = "interrupted: what had been recorded until then"

    @property
    def completed(self) -> bool:
        """Whether the run reached its planned end."""
        return self.value.startswith("completed")


WINDOW = 1.0  # in units of D/V
FAST = 10.0  # slip rate over V that the creeping patch does not reach
NEAR = 0.5  # part of the block, from a pushed edge, in which its patch is sought
SLIPPING = 0.01  # slip rate over V at the edge of the patch
FEW = 4  # elements: a patch has more of them when its event begins


def where_patch_is_sought(run: Run, x: Array) -> NDArray[np.bool_]:
    """Select the nodes at which the patch may be: those near the edge, if an edge is pushed."""
    if run.fault.loading != "edge":
        return np.ones(x.size, dtype=bool)
    return x <= NEAR * run.block.length


def long_after(
    run: Run,
    x: Array,
    times: Array,
    slip_rates: Array,
) -> float:
    """Find the time (s) after which the patch has been longer than :data:`FEW` elements.

    Between two frames the nearest one counts, as for the length of the patch.
    """
    near = np.abs(slip_rates[:, where_patch_is_sought(run, x)])
    nodes = np.count_nonzero(near > SLIPPING * run.fault.velocity, axis=1)
    (long,) = np.nonzero(nodes > FEW + 1)
    if not long.size:
        return np.inf
    first = int(long[0])
    if first == 0:
        return -np.inf
    return float(times[first - 1 : first + 1].mean())


Burst = tuple[float, float, float]
"""Time (s), largest slip rate (m/s) and its position (m)."""


class PatchBursts:
    """Detects from step to step whether the patch slips fast.

    A burst lasts as long as the interface slips faster than :data:`FAST` anywhere. Where an edge is
    pushed, a burst belongs to the patch once its fastest point is in the half of the block next to
    the edge, later than the memory time D/V. Under other loads the patch may be anywhere.
    """

    def __init__(self, run: Run) -> None:
        pushed = run.fault.loading == "edge"
        self._fast = FAST * run.fault.velocity
        self._from = run.memory_time if pushed else -np.inf
        self._end = NEAR * run.block.length if pushed else np.inf
        self.own = False  # whether the present burst belongs to the patch

    def at(
        self,
        time: float,
        rate: float,
        position: float,
    ) -> bool:
        """Take in the next step and return whether the patch slips fast."""
        if rate <= self._fast:
            self.own = False
        elif time > self._from and position <= self._end:
            self.own = True
        return self.own


class DropWatch:
    """Detects from step to step whether the force has dropped by a fraction in a time (s)."""

    def __init__(
        self,
        window: float,
        drop: float = EVENT_DROP,
    ) -> None:
        self._window = window
        self._drop = drop
        self._largest: deque[tuple[float, float]] = deque()  # falling maxima of the window

    @property
    def maxima(self) -> Array:
        """Times (s) and force magnitudes (N/m) that may still matter, shape (n, 2)."""
        return np.array(self._largest).reshape(-1, 2)

    @maxima.setter
    def maxima(self, values: Array) -> None:
        self._largest = deque((time, force) for time, force in values.tolist())

    @property
    def since(self) -> float:
        """Time (s) of the window's largest force, from which a drop is counted."""
        return self._largest[0][0]

    def dropped(
        self,
        time: float,
        force: float,
        fast: bool = True,
    ) -> bool:
        """Take in the next force and return whether it completes an abrupt drop."""
        while self._largest and self._largest[-1][1] <= force:
            self._largest.pop()
        self._largest.append((time, force))
        while self._largest[0][0] < time - self._window:
            self._largest.popleft()
        largest = self._largest[0][1]
        return bool(fast) and force < (1.0 - self._drop) * largest
