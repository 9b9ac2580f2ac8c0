"""The abrupt drop of the driving force that marks the onset of accelerating slip (Text S2.2).

While the patch creeps, the magnitude of the driving force changes over seconds; in the event it
falls within milliseconds. The event is found when the force has fallen by a given fraction below
its largest value of a short time window, the memory time D/V of friction, while the interface slips
fast somewhere: a slow decrease, as in an oscillation of the creeping patch that decays again, is no
event, nor is a force that follows a fluctuating load. Where an edge is pushed the fast slip has to
be the patch's: a free corner at the far end may slip fast as well, and drives nothing. And the
patch has to be longer than a few elements: what a mesh can't resolve slips fast too.
"""

import enum
from collections import deque

import numpy as np
from numpy.typing import NDArray

from ..model.parameters import EVENT_DROP, Parameters
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
SLIPPING = 0.01  # slip rate over V above which an element's node is the patch's
FEW = 4  # elements: a patch has more of them when its event begins


def where_patch_is_sought(parameters: Parameters, x: Array) -> NDArray[np.bool_]:
    """The nodes, at x (m), at which a run's patch may be: next to an edge that is pushed."""
    if parameters.loading.kind != "edge":
        return np.ones(x.size, dtype=bool)
    return x <= NEAR * parameters.geometry.length


def long_after(parameters: Parameters, x: Array, times: Array, slip_rates: Array) -> float:
    """Time (s) after which the patch has been longer than :data:`FEW` elements.

    Parameters
    ----------
    parameters : Parameters
        Of the run.
    x, times : ndarray, shape (n,) and (frames,)
        Positions (m) of the nodes, and times (s) of the frames.
    slip_rates : ndarray, shape (frames, n)
        Slip rates (m/s). Between frames the nearest one counts, as for the patch's length.

    Returns
    -------
    float
        Minus infinity if it always was, infinity if it never was.
    """
    near = np.abs(slip_rates[:, where_patch_is_sought(parameters, x)])
    nodes = np.count_nonzero(near > SLIPPING * parameters.loading.velocity, axis=1)
    (long,) = np.nonzero(nodes > FEW + 1)
    if not long.size:
        return np.inf
    if long[0] == 0:
        return -np.inf
    return float(times[long[0] - 1 : long[0] + 1].mean())


class PatchBursts:
    """Tells whether the interface slips fast because its patch does; fed step by step.

    A burst lasts as long as the interface slips faster than :data:`FAST` anywhere. Where an edge is
    pushed, a burst is the patch's once its fastest point is in the half of the block next to the
    edge, later than the memory time D/V. Under other loads a patch may be anywhere.
    """

    def __init__(self, parameters: Parameters) -> None:
        pushed = parameters.loading.kind == "edge"
        self._fast = FAST * parameters.loading.velocity
        self._from = parameters.memory_time if pushed else -np.inf
        self._end = NEAR * parameters.geometry.length if pushed else np.inf
        self.own = False  # whether the burst that goes on is the patch's

    def at(self, time: float, rate: float, position: float) -> bool:
        """Whether the patch slips fast at a time (s): by the largest rate (m/s) and its x (m)."""
        if rate <= self._fast:
            self.own = False
        elif time > self._from and position <= self._end:
            self.own = True
        return self.own


class DropWatch:
    """Tells when the force has dropped abruptly; fed with one value after another."""

    def __init__(self, window: float, drop: float = EVENT_DROP) -> None:
        """`window` in seconds, `drop` as a fraction of the force."""
        self._window, self._drop = window, drop
        self._largest: deque[tuple[float, float]] = deque()  # falling maxima of the window

    @property
    def maxima(self) -> Array:
        """Times (s) and force magnitudes (N/m) that are still of interest, shape (n, 2)."""
        return np.array(self._largest).reshape(-1, 2)

    @maxima.setter
    def maxima(self, values: Array) -> None:
        self._largest = deque((time, force) for time, force in values.tolist())

    @property
    def since(self) -> float:
        """Time (s) of the window's largest force, from which a drop is counted."""
        return self._largest[0][0]

    def dropped(self, time: float, force: float, fast: bool = True) -> bool:
        """Whether the force magnitude (N/m) at this time (s) completes an abrupt drop.

        `fast` tells whether the patch slips fast now (:class:`PatchBursts`).
        """
        while self._largest and self._largest[-1][1] <= force:
            self._largest.pop()
        self._largest.append((time, force))
        while self._largest[0][0] < time - self._window:
            self._largest.popleft()
        return bool(fast) and force < (1.0 - self._drop) * self._largest[0][1]
