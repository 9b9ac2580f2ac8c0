"""Remarks in the status of a run: reasons to doubt its event, or that it has none."""

import numpy as np

from ..run.run import Run
from ..types import Array
from .event import FAST, FEW, Burst, PatchBursts, where_patch_is_sought

RESOLVED = 1.25
"""Smallest width of a resolved front, in elements.

Below it, four fifths or more of the state's change are within one element. With two to three
elements to a process zone the width is 1.4 to 3.
"""

FRONT = 1.0
"""Change of the logarithm of the state that makes a front."""


def front_width(
    run: Run,
    x: Array,
    state: Array,
) -> float:
    """Width of the front in elements: total change of log(phi) over the steepest one."""
    with np.errstate(divide="ignore", invalid="ignore"):
        log_state = np.log(state[where_patch_is_sought(run, x)])
        changes = np.abs(np.diff(log_state))
    known = log_state[np.isfinite(log_state)]
    if not known.size or np.ptp(known) < FRONT:
        return np.inf
    steepest = changes[np.isfinite(changes)].max()
    return float(np.ptp(known) / steepest)


def fastest_elsewhere(
    run: Run,
    times: Array,
    rates: Array,
    positions: Array,
    until: float,
) -> Burst | None:
    """Find the fastest slip outside the patch before a given time."""
    bursts = PatchBursts(run)
    steps = list(
        zip(
            times.tolist(),
            rates.tolist(),
            positions.tolist(),
            strict=True,
        )
    )
    own = np.array([bursts.at(*step) for step in steps], dtype=bool)
    fast = rates > FAST * run.fault.velocity
    counts = fast & ~own & (times < until)
    if not counts.any():
        return None
    return steps[int(np.where(counts, rates, 0.0).argmax())]


def of_front(width: float) -> list[str]:
    """Remark on an unresolved front at the onset, by its width in elements."""
    if width >= RESOLVED:
        return []
    return [f"not resolved: at the onset the front is {width:.1f} elements wide"]


def of_slip_elsewhere(found: Burst | None) -> list[str]:
    """Remark on fast slip outside the patch, as :func:`fastest_elsewhere` finds it."""
    if found is None:
        return []
    time, rate, place = found
    return [f"slip elsewhere: {rate:.3g} m/s at x = {place:.4g} m and t = {time:.4g} s"]


def of_short_patch(time: float) -> list[str]:
    """Remark on a drop at a time (s) with too short a patch; infinite if there was none."""
    if not np.isfinite(time):
        return []
    return [f"no event: the drop at t = {time:.4g} s began with a patch of {FEW} elements or fewer"]
