"""The patch, and the abrupt drop of the driving force that marks its event (Text S2.2).

The patch extends to the furthest point at which the slip rate has exceeded a fraction of the
imposed velocity V so far. A point that has crept belongs to the patch, even if its slip rate
oscillates before the onset. Between nodes log v is linear in x.

While the patch creeps, the driving force changes over seconds; in the event it falls within
milliseconds. An event needs three things:

- the force falls by a given fraction below its largest value of the last memory time D/V;
- the patch runs away: in the same burst it has slipped at 1000 V, or at the rate at which inertia
  limits it. A burst of the creeping patch comes to rest, and under a strong fluctuating load it may
  slip at tens of V and lower the force. Where an edge is pushed, the patch itself has to be the
  fastest: fast slip at the free corner of the far end does not drive an event;
- the patch is longer than a few elements, since slip that the mesh cannot resolve is fast as well.
"""

import enum
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from ..run.run import Run
from ..types import Array


class Outcome(enum.StrEnum):
    """How a run ended."""

    END_TIME = "completed: the end time was reached"
    AFTER_EVENT = "completed: the event and the time asked for after it are covered"
    STEP_UNDERFLOW = "failed: the step size fell below the shortest step allowed"
    TENSION = "failed: the interface came under tension, where the friction law has no meaning"
    IMPOSSIBLE = (
        "failed: the slip rate is none that elastic waves allow, or falls to nothing at once"
    )
    MOMENTUM = "failed: the body as a whole has a momentum that no load has given it"
    NOT_FINITE = "failed: a recorded value is not finite"

    INTERRUPTED = "interrupted: what had been recorded until then"


WINDOW = 1.0  # in units of D/V
FAST = 10.0  # slip rate over V below which a burst is over
RUNAWAY = 1000.0  # slip rate over V that no burst that comes to rest reaches
NEAR = 0.5  # part of the block, from a pushed edge, in which its patch is sought
SLIPPING = 0.01  # slip rate over V at the edge of the patch
FEW = 4  # elements: a patch has more of them when its event begins
STUCK = 1e-300  # m/s, in place of zero: its logarithm is finite

RESOLVED = 1.25
"""Smallest width of a resolved front, in elements.

Below it, four fifths or more of the state's change are within one element. With two to three
elements to a process zone the width is 1.4 to 3.
"""

FRONT = 1.0
"""Change of the logarithm of the state that makes a front."""


def where_patch_is_sought(run: Run, x: Array) -> NDArray[np.bool_]:
    """Select the nodes at which the patch may be: those near the edge, if an edge is pushed."""
    if run.fault.loading != "edge":
        return np.ones(x.size, dtype=bool)
    return x <= NEAR * run.block.length


def long_after(run: Run, x: Array, times: Array, slip_rates: Array) -> float:
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


def patch_runs_away(run: Run, before: bool, time: float, rate: float, position: float) -> bool:
    """Whether the patch runs away after a step (s, m/s, m), given whether it did before.

    It does from :func:`runaway_rate` on until the burst is over, when nothing slips faster than
    :data:`FAST`. Where an edge is pushed, the burst belongs to the patch if its fastest point is in
    the half of the block next to the edge, later than the memory time D/V. Under other loads the
    patch may be anywhere.
    """
    if rate <= FAST * run.fault.velocity:
        return False
    if before:
        return True
    if rate <= runaway_rate(run):
        return False
    if run.fault.loading != "edge":
        return True
    return bool(time > run.memory_time and position <= NEAR * run.block.length)


@lru_cache(maxsize=16)  # asked for after each step
def runaway_rate(run: Run) -> float:
    """Slip rate (m/s) at which a patch runs away: the lower one of 1000 V and v_d.

    At ``v_d = 2 a sigma0 c_s/mu`` radiation damps slip as much as the direct effect does (Rice,
    1993), so that a rupture need not be faster.
    """
    fault = run.fault
    speed = run.upper.material.shear_wave_speed
    inertial = 2.0 * fault.single("a") * fault.single("normal_stress") * speed
    inertial /= fault.single("shear_modulus")
    return max(min(RUNAWAY * fault.single("velocity"), inertial), FAST * fault.single("velocity"))


def has_dropped(
    maxima: list[tuple[float, float]],
    window: float,
    drop: float,
    time: float,
    force: float,
    fast: bool = True,
) -> bool:
    """Take in the next force (N/m) and return whether it completes an abrupt drop.

    `maxima` are the times (s) and forces that may still matter, the falling maxima of the window
    (s): it is kept up to date, and the drop counts from the first.
    """
    while maxima and maxima[-1][1] <= force:
        maxima.pop()
    maxima.append((time, force))
    while maxima[0][0] < time - window:
        maxima.pop(0)
    return bool(fast) and force < (1.0 - drop) * maxima[0][1]


def front_width(run: Run, x: Array, state: Array) -> float:
    """Width of the front in elements: total change of log(phi) over the steepest one."""
    with np.errstate(divide="ignore", invalid="ignore"):
        log_state = np.log(state[where_patch_is_sought(run, x)])
        changes = np.abs(np.diff(log_state))
    known = log_state[np.isfinite(log_state)]
    if not known.size or np.ptp(known) < FRONT:
        return np.inf
    steepest = changes[np.isfinite(changes)].max()
    return float(np.ptp(known) / steepest)


def slipping_edge(x: Array, slip_rate: Array, threshold: float) -> Array:
    """The furthest position (m) that slips faster than a threshold (m/s), if an edge is pushed.

    Only the part of the block next to the pushed edge is searched: slip at the far corner does not
    count. Before the event this position moves back and forth; the patch is as long as it has ever
    been. Slip rates (m/s) have the shape (..., nodes); the position is zero where nothing slips.
    """
    rate = np.maximum(np.abs(slip_rate), STUCK, dtype=float)  # in double precision
    near = np.count_nonzero(x <= NEAR * x[-1])
    faster = rate[..., :near] > threshold
    from_far = faster[..., ::-1]
    inside = near - 1 - from_far.argmax(axis=-1)
    outside = np.minimum(inside + 1, x.size - 1)
    edge = _between(x, rate, inside, outside, threshold)
    return np.where(faster.any(axis=-1), edge, 0.0)


def _between(
    x: Array, rate: Array, inside: NDArray[np.intp], outside: NDArray[np.intp], threshold: float
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
    x: Array, slip_rate: Array, threshold: float, periodic: bool = False
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


def patch_lengths(kind: str, x: Array, slip_rates: Array, threshold: float) -> Array:
    """Length of the patch at every instant, by the slip rates of that instant alone.

    A pushed edge is one end of the patch. Otherwise the patch is the zone about the fastest node.
    """
    if kind == "edge":
        return slipping_edge(x, slip_rates, threshold)
    periodic = kind == "remote"
    zones = [slipping_zone(x, rate, threshold, periodic) for rate in slip_rates]
    return np.array([end - begin for begin, end in zones])
