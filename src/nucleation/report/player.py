"""The data of the player: the run through nucleation, thinned to what a page can show."""

from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..analysis.definitions import ExtractionSettings
from ..analysis.moments import chosen_frames, event_interval, thinned
from ..analysis.record import Record, parameters_of
from ..types import Array
from .encode import float32

MOST_FRAMES = (150, 140, 40)  # before, in and after the event
MOST_NODES = 401
MOST_STEPS = 1200  # values of the force


def thinned_curve(time: Array, value: Array, most: int) -> NDArray[np.intp]:
    """Indices that keep a curve's look: the least and the greatest value of each of many bins."""
    if time.size <= most:
        return np.arange(time.size)
    bins = np.array_split(np.arange(time.size), most // 2)
    kept = [part[[value[part].argmin(), value[part].argmax()]] for part in bins]
    return np.unique(np.concatenate([*kept, [0, time.size - 1]]))


def thinned_run(
    simulation: xr.Dataset, row: xr.Dataset, settings: ExtractionSettings
) -> xr.Dataset:
    """What the player shows of one simulation.

    Parameters
    ----------
    simulation : Dataset
        The record of :func:`nucleation.simulation.run.simulate`.
    row : Dataset
        Its entry of the table of lengths, with ``onset_time`` (s).
    settings : ExtractionSettings
        How the edge of the patch is defined.

    Returns
    -------
    Dataset
        ``slip_rate`` (m/s), ``shear_stress`` (Pa) and ``state`` (s) on (time, x), ``patch_length``
        (m) on (time), the furthest that has crept until then; ``driving_force`` (N/m) on (step).
        The attributes ``event_start`` and ``event_end`` (s) are those of
        :func:`nucleation.analysis.moments.event_interval`.
    """
    record = Record(simulation, settings)
    event = event_interval(simulation, float(row["onset_time"]))
    frames = chosen_frames(record.time, event, MOST_FRAMES)
    nodes = thinned(np.arange(simulation.sizes["x"]), MOST_NODES)
    fields = simulation[["slip_rate", "shear_stress", "state"]].isel(time=frames, x=nodes)
    step_time, force = simulation["step_time"].values, simulation["driving_force"].values
    inside = np.flatnonzero((step_time >= event[0]) & (step_time <= event[1]))
    steps = np.concatenate(
        [
            thinned_curve(step_time, force, MOST_STEPS),
            inside[thinned_curve(step_time[inside], force[inside], MOST_STEPS)],
        ]
    )
    kept = np.unique(steps)
    return fields.assign(
        patch_length=("time", record.lengths[frames]),
        step_time=("step", step_time[kept]),
        driving_force=("step", force[kept]),
    ).assign_attrs(event_start=event[0], event_end=event[1])


def in_page(run: xr.Dataset, row: xr.Dataset) -> dict[str, Any]:
    """The player's data: times in seconds from the onset, lengths in m, fields by frame."""
    loading = parameters_of(run).loading
    onset, length = (float(row[name]) for name in ("onset_time", "length"))
    start = onset if np.isfinite(onset) else 0.0
    fields = {
        "slip_rate": np.where(run["slip_rate"] > 0.0, run["slip_rate"], np.nan),
        "stress_ratio": run["shear_stress"].values / loading.normal_stress,
        "state": run["state"].values,
    }
    return {
        "onset": start,
        "length": length if np.isfinite(length) else None,
        "event": [run.attrs["event_start"] - start, run.attrs["event_end"] - start],
        "frames": run.sizes["time"],
        "x": float32(run["x"]),
        "since": float32(run["time"] - start),
        "edge": float32(run["patch_length"]),
        "force_since": float32(run["step_time"] - start),
        "force": float32(-run["driving_force"] / 1e3),
        **{name: float32(values) for name, values in fields.items()},
    }
