"""Hops of the front from node to node, and the oscillation of the patch that they shake.

On a mesh the creep patch grows by one node at a time. Each hop loads the patch a little, so that
the front, advancing at dL/dt, shakes it with the angular frequency ``2 pi (dL/dt) / dx``.
"""

from __future__ import annotations

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from .drop import WINDOW
from .extraction import SEARCHED, find_onset, patch_lengths
from .parameters import Parameters
from .settings import ExtractionSettings

Array = NDArray[np.float64]

INSIDE = 0.5  # position inside the patch at which its slip rate is shown, over its last length
SPAN = 0.05  # length over which the frequency of hops is averaged, over the patch's last length


def crossing_times(time: Array, length: Array, positions: Array) -> Array:
    """Times (s) at which a growing length (m) first exceeds each position (m), NaN if never."""
    reach = np.maximum.accumulate(length)
    index = np.searchsorted(reach, positions, side="right")
    found = np.full(positions.size, np.nan)
    inner = (index > 0) & (index < reach.size)
    i = index[inner]
    part = (positions[inner] - reach[i - 1]) / (reach[i] - reach[i - 1])
    found[inner] = time[i - 1] + part * (time[i] - time[i - 1])
    return found


def follow_hops(
    simulation: xr.Dataset, settings: ExtractionSettings = ExtractionSettings()
) -> xr.Dataset:
    """The front's hops up to the onset, and the slip rate inside the patch.

    Parameters
    ----------
    simulation : Dataset
        The record of a run with an event.
    settings : ExtractionSettings
        Definitions of the patch's edge and of the drop.

    Returns
    -------
    Dataset
        On ``hop``: ``hop_time`` (s), ``hop_length`` (m), the position of the node that begins to
        slip, and ``hop_frequency`` (1/s), an angular frequency. On ``time`` (s):
        ``inner_slip_rate`` (m/s). Also ``onset_time`` (s), ``velocity`` (m/s) and ``n_x``.

    Raises
    ------
    ValueError
        If the run has no event.
    """
    parameters = Parameters.from_json(simulation.attrs["parameters"])
    velocity, x = parameters.loading.velocity, simulation["x"].values
    steps, force = simulation["step_time"].values, np.abs(simulation["driving_force"].values)
    onset = find_onset(steps, force, WINDOW * parameters.memory_time, settings.drop)
    if onset is None:
        raise ValueError("the run has no event")
    before = simulation["time"].values <= steps[onset.start]
    time = simulation["time"].values[before]
    rates = simulation["slip_rate"].values
    creep = simulation.isel(time=np.flatnonzero(before))
    length = patch_lengths(creep, settings.edge_threshold * velocity)
    nodes = x[1:][x[1:] <= SEARCHED * x[-1]]
    hops = crossing_times(time, length, nodes)
    seen = np.isfinite(hops)
    inner = int(np.argmin(np.abs(x - INSIDE * length.max())))
    return xr.Dataset(
        {
            "hop_time": ("hop", hops[seen]),
            "hop_length": ("hop", nodes[seen]),
            "hop_frequency": (
                "hop", hop_frequency(hops[seen], x[1] - x[0], SPAN * float(length.max()))
            ),
            "inner_slip_rate": ("time", rates[:, inner]),
            "onset_time": steps[onset.start],
            "n_x": x.size - 1,
            "velocity": velocity,
        },
        coords={"time": simulation["time"].values},
        attrs={"parameters": parameters.to_json()},
    )  # fmt: skip


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
