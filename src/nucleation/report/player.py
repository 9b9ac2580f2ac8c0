"""The data of the player: the run through nucleation, thinned to what a page can show."""

from typing import Any

import numpy as np
import xarray as xr

from ..analysis.definitions import ExtractionSettings
from ..analysis.moments import chosen_frames, event_interval, thinned
from ..analysis.record import Record, parameters_of
from .encode import float32

MOST_FRAMES = (150, 140, 40)  # before, in and after the event
MOST_NODES = 401
LEAST_RATE = 1e-9  # m/s, at the lower end of the axis


def thinned_run(
    simulation: xr.Dataset, row: xr.Dataset, settings: ExtractionSettings
) -> xr.Dataset:
    """What the player shows of one simulation.

    Parameters
    ----------
    simulation : Dataset
        The record of :func:`nucleation.simulation.run.simulate`.
    row : Dataset
        Its entry of the table of lengths, with ``id``, ``onset_time`` (s) and ``length`` (m).
    settings : ExtractionSettings
        How the edge of the patch is defined.

    Returns
    -------
    Dataset
        ``slip_rate`` (m/s), ``shear_stress`` (Pa) and ``state`` (s) on (time, x), ``patch_length``
        (m), the furthest that has crept until then, and ``force`` (N/m) on (time). Attributes are
        the row's ``id``, ``onset_time`` and ``length`` and, from
        :func:`nucleation.analysis.moments.event_interval`, ``event`` (s).
    """
    record = Record(simulation, settings)
    said = {name: row[name].item() for name in ("id", "onset_time", "length")}
    event = event_interval(simulation, said["onset_time"])
    frames = chosen_frames(record.time, event, MOST_FRAMES)
    nodes = thinned(np.arange(simulation.sizes["x"]), MOST_NODES)
    fields = simulation[["slip_rate", "shear_stress", "state"]].isel(time=frames, x=nodes)
    force = np.interp(record.time[frames], simulation["step_time"], simulation["driving_force"])
    return fields.assign(
        patch_length=("time", record.lengths[frames]), force=("time", force)
    ).assign_attrs(said, event=event)


def in_page(run: xr.Dataset) -> dict[str, Any]:
    """The player's data: times in seconds from the onset, lengths in m, fields by frame.

    Each field with the ends of its axis, of logarithms where it is logarithmic.
    """
    onset, length = (run.attrs[name] for name in ("onset_time", "length"))
    start = onset if np.isfinite(onset) else 0.0
    rate = np.where(run["slip_rate"] > 0.0, run["slip_rate"], np.nan)
    ratio = run["shear_stress"].values / parameters_of(run).loading.normal_stress
    state, margin = run["state"].values, 0.05 * np.ptp(ratio)
    return {
        "onset": start,
        "length": length if np.isfinite(length) else None,
        "event": [time - start for time in run.attrs["event"]],
        "frames": run.sizes["time"],
        "x": float32(run["x"]),
        "since": float32(run["time"] - start),
        "edge": float32(run["patch_length"]),
        "force": float32(-run["force"] / 1e3),
        "slip_rate": float32(rate),
        "stress_ratio": float32(ratio),
        "state": float32(state),
        "ranges": {
            "slip_rate": _decades(LEAST_RATE, np.nanmax(rate)),
            "stress_ratio": [float(ratio.min() - margin), float(ratio.max() + margin)],
            "state": _decades(state.min(), state.max()),
        },
    }


def _decades(low: float, high: float) -> list[float]:
    return [float(np.log10(low)) - 0.1, float(np.log10(high)) + 0.3]
