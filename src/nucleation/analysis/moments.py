"""Which of the recorded moments of a run are shown when it is played or filmed."""

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..types import Array

Indices = NDArray[np.intp]

MARGIN = 0.05  # s: the event begins so long before the onset, and ends so long after its peak
LONGEST_EVENT = 1.0  # s from the onset to the peak


def thinned(indices: Indices, most: int) -> Indices:
    """At most so many of some indices, evenly spaced, with the first and the last."""
    if indices.size <= most:
        return indices
    return indices[np.linspace(0, indices.size - 1, most).round().astype(int)]


def event_interval(simulation: xr.Dataset, onset: float) -> tuple[float, float]:
    """Beginning and end (s) of the event: from the onset (s) to its highest slip rate, and more.

    Without an onset, nothing: the end of the run, twice.
    """
    time = simulation["step_time"].values
    if not np.isfinite(onset):
        return float(time[-1]), float(time[-1])
    during = np.flatnonzero((time >= onset) & (time <= onset + LONGEST_EVENT))
    peak = time[during[simulation["maximal_slip_rate"].values[during].argmax()]]
    return onset - MARGIN, float(peak) + MARGIN


def chosen_frames(time: Array, event: tuple[float, float], most: tuple[int, int, int]) -> Indices:
    """Indices of recorded times (s): at most so many before, in and after the event (s).

    The record has more frames where more happens, so that in each stretch every so many will do.
    """
    stretch = np.digitize(time, event)
    parts = [thinned(np.flatnonzero(stretch == i), count) for i, count in enumerate(most)]
    return np.concatenate(parts)
