"""Hops of the front from node to node, and the oscillation of the patch that they shake.

On a mesh the creep patch grows by one node at a time. Each hop loads the patch a little, so that
the front, advancing at dL/dt, shakes it with the angular frequency ``2 pi (dL/dt) / dx``. What this
stirs is seen as the oscillation of the slip rate at a point well inside the patch.
"""

import numpy as np
import xarray as xr
from scipy.signal import savgol_filter

from ..analysis.definitions import SEARCHED, ExtractionSettings
from ..analysis.extraction import MEASURED
from ..analysis.record import Record
from ..datasets.shared import SHARED
from ..datasets.variables import Variable, annotate
from ..simulation.recorded import RECORDED
from ..types import Array

INSIDE = 0.5  # position inside the patch at which its slip rate is shown, over its last length
SPAN = 0.05  # length over which the frequency of hops is averaged, over the patch's last length
PASSED = 0.6  # the oscillation is followed from here on, over the patch's last length
SAMPLES = 5  # of the oscillation, in a time D/V
SMOOTHED = 20.0  # window of the trend and of the amplitude, in units of D/V: some two periods
TREND = 3  # degree of the trend within the window

FOLLOWED = {
    "time": RECORDED["time"],
    "hop_time": Variable("s", "time at which the front reaches the node", "t"),
    "hop_length": Variable("m", "position of the node", "x"),
    "hop_frequency": Variable("1/s", "angular frequency of the hops", "2 pi (dL/dt)/dx"),
    "inner_slip_rate": Variable("m/s", "slip rate half-way along the patch", "v"),
    "sample_time": Variable("s", "middle of the window of the amplitude", "t"),
    "oscillation_amplitude": Variable("m/s", "amplitude of the slip rate about its trend"),
    "onset_time": MEASURED["onset_time"],
    "n_x": SHARED["n_x"],
    "velocity": SHARED["velocity"],
}


def crossing_times(time: Array, length: Array, positions: Array) -> Array:
    """Times (s) at which a length (m) that never falls exceeds each position (m), NaN if never."""
    index = np.searchsorted(length, positions, side="right")
    found = np.full(positions.size, np.nan)
    inner = (index > 0) & (index < length.size)
    i = index[inner]
    part = (positions[inner] - length[i - 1]) / (length[i] - length[i - 1])
    found[inner] = time[i - 1] + part * (time[i] - time[i - 1])
    return found


def follow_hops(
    simulation: xr.Dataset, settings: ExtractionSettings = ExtractionSettings()
) -> xr.Dataset:
    """The front's hops up to the onset, and the slip rate inside the patch.

    The dataset has :data:`FOLLOWED`: each node that begins to slip on ``hop``, the slip rate inside
    the patch on ``time``, the amplitude of its oscillation on ``sample``.

    Raises
    ------
    ValueError
        If the run has no event.
    """
    record = Record(simulation, settings)
    onset_time, x, creep = record.drop_times[0], record.x, record.creep
    time, length = record.time[creep], record.lengths[creep]
    rates, parameters = simulation["slip_rate"].values, record.parameters
    nodes = x[1:][x[1:] <= SEARCHED * x[-1]]
    hops = crossing_times(time, length, nodes)
    seen = np.isfinite(hops)
    inner = int(np.argmin(np.abs(x - INSIDE * length.max())))
    passed = time >= time[np.argmax(length >= PASSED * length.max())]
    sample_time, amplitude = oscillation(
        time[passed], rates[creep[passed], inner], parameters.memory_time
    )
    found = xr.Dataset(
        {
            "hop_time": ("hop", hops[seen]),
            "hop_length": ("hop", nodes[seen]),
            "hop_frequency": (
                "hop", hop_frequency(hops[seen], x[1] - x[0], SPAN * float(length.max()))
            ),
            "inner_slip_rate": ("time", rates[:, inner]),
            "sample_time": ("sample", sample_time),
            "oscillation_amplitude": ("sample", amplitude),
            "onset_time": onset_time,
            "n_x": x.size - 1,
            "velocity": record.velocity,
        },
        coords={"time": record.time},
        attrs={"parameters": parameters.to_json()},
    )  # fmt: skip
    return annotate(found, FOLLOWED)


def hop_frequency(hops: Array, spacing: float, span: float) -> Array:
    """Angular frequency (1/s) of hops (s) over nodes, averaged over a span (m) about each.

    NaN where the span reaches beyond the first or the last hop.
    """
    each_way = max(1, round(0.5 * span / spacing))
    frequency = np.full(hops.size, np.nan)
    if hops.size > 2 * each_way:
        duration = hops[2 * each_way :] - hops[: -2 * each_way]
        frequency[each_way:-each_way] = 2.0 * np.pi * 2 * each_way / duration
    return frequency


def oscillation(time: Array, rate: Array, memory_time: float) -> tuple[Array, Array]:
    """Times (s) and amplitude (m/s) of a slip rate's oscillation about its trend.

    The trend is a polynomial fitted within a sliding window; the amplitude is the root of twice the
    mean square within another. Both windows are left out at either end; nothing is left of a record
    that is shorter.
    """
    spacing = memory_time / SAMPLES
    even = np.arange(time[0], time[-1], spacing)
    window = 2 * round(0.5 * SMOOTHED * SAMPLES) + 1
    if even.size < 2 * window:
        return np.empty(0), np.empty(0)
    sampled = np.interp(even, time, rate)
    off_trend = (sampled - savgol_filter(sampled, window, TREND))[window // 2 : -(window // 2)]
    mean_square = np.convolve(off_trend**2, np.full(window, 1.0 / window), mode="valid")
    return even[window - 1 : even.size - window + 1], np.sqrt(2.0 * mean_square)
