"""What the status of a run adds to how it ended: whatever makes its event, or none, doubtful."""

import numpy as np

from ..model.parameters import Parameters
from ..types import Array
from .event import FAST, FEW, PatchBursts, where_patch_is_sought

RESOLVED = 1.25
"""Least width of the front in elements: below, four fifths of the state's change, or more, are
within one element. With two to three elements to a process zone the width is 1.4 to 3."""

FRONT = 1.0
"""Change of the logarithm of the state that makes a front."""


def front_width(parameters: Parameters, x: Array, state: Array) -> float:
    """Width of the front in elements: the state's change over the steepest between two nodes.

    Parameters
    ----------
    parameters : Parameters
        Of the run, which say where its patch is sought.
    x : ndarray, shape (n,)
        Positions (m) of the nodes.
    state : ndarray, shape (n,)
        State variable (s) at one instant. Zero where it was not recorded, as nothing slips there.

    Returns
    -------
    float
        Infinite if the state changes by less than a factor e, so that there is no front.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        log_state = np.log(state[where_patch_is_sought(parameters, x)])
        changes = np.abs(np.diff(log_state))
    known = log_state[np.isfinite(log_state)]
    if not known.size or np.ptp(known) < FRONT:
        return np.inf
    return float(np.ptp(known) / changes[np.isfinite(changes)].max())


def fastest_elsewhere(
    parameters: Parameters, times: Array, rates: Array, positions: Array, until: float
) -> tuple[float, float, float] | None:
    """The fastest slip before a time that is not the patch's, by all steps of a run.

    Parameters
    ----------
    parameters : Parameters
        Of the run.
    times, rates, positions : ndarray, shape (steps,)
        Time (s), largest slip rate (m/s), and where it is (m).
    until : float
        Onset of the event (s), or infinity.

    Returns
    -------
    tuple or None
        Its time (s), slip rate (m/s) and place (m), if anything but the patch slips fast.
    """
    bursts = PatchBursts(parameters)
    steps = zip(times.tolist(), rates.tolist(), positions.tolist(), strict=True)
    own = np.array([bursts.at(*step) for step in steps], dtype=bool)
    fast = rates > FAST * parameters.loading.velocity
    elsewhere = np.where(fast & ~own & (times < until), rates, 0.0)
    if not elsewhere.any():
        return None
    at = int(elsewhere.argmax())
    return float(times[at]), float(rates[at]), float(positions[at])


def of_front(width: float) -> list[str]:
    """What to say of a front at the onset, by its width in elements."""
    if width >= RESOLVED:
        return []
    return [f"not resolved: at the onset the front is {width:.1f} elements wide"]


def of_slip_elsewhere(found: tuple[float, float, float] | None) -> list[str]:
    """What to say of fast slip that is not the patch's."""
    if found is None:
        return []
    time, rate, place = found
    return [f"slip elsewhere: {rate:.3g} m/s at x = {place:.4g} m and t = {time:.4g} s"]


def of_short_patch(time: float) -> list[str]:
    """What to say of a drop at a time (s), infinite if there is none, with too short a patch."""
    if not np.isfinite(time):
        return []
    return [f"no event: the drop at t = {time:.4g} s, whose patch had {FEW} elements or fewer"]
