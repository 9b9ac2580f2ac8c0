"""The critical nucleation length, read from a simulation by the drop of its driving force.

Onset is the start of the abrupt drop: the instant from which ``|f_d|`` falls without rising again
until the event. The critical length is the extent of the creep patch at that instant, out to the
furthest point at which the slip rate has exceeded a fraction of the imposed velocity V: what has
crept belongs to the patch, though its slip rate oscillates before the onset. Both are definitions;
the error bar spans other reasonable ones: edges from 0.5 V to 1e-3 V, and instants up to the one
where the drop is complete.
"""

from __future__ import annotations

import dataclasses
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from ..model.parameters import Parameters
from ..model.quantities import Checked, quantity
from ..simulation.event import DROP, WINDOW, DropWatch

if TYPE_CHECKING:  # the configuration has settings from here
    import xarray as xr

Array = NDArray[np.float64]

SEARCHED = 0.5  # part of the block, from the loaded edge, in which the patch's edge is sought


@dataclasses.dataclass(frozen=True)
class ExtractionSettings(Checked):
    """How the critical nucleation length is read from a simulation."""

    edge_threshold: float = quantity(
        "slip rate at the edge of the creep patch over the imposed velocity", low=0.0, high=1.0,
        closed="high", default=0.01,
    )  # fmt: skip
    edge_threshold_high: float = quantity(
        "largest edge threshold of the error bar", low=0.0, high=1.0, closed="high", default=0.5
    )
    edge_threshold_low: float = quantity(
        "smallest edge threshold of the error bar", low=0.0, high=1.0, closed="high", default=1e-3
    )
    drop: float = quantity(
        "abrupt drop of the driving force that makes an event, as a fraction", low=0.0, high=1.0,
        default=DROP,
    )  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Onset:
    """Indices into the steps of a run that mark its first event."""

    start: int  # the last maximum of |f_d| before the drop
    steep: int  # from here |f_d| falls faster than loading has raised it on average
    end: int  # the drop is complete


def find_onset(time: Array, force: Array, window: float, drop: float) -> Onset | None:
    """The first abrupt drop of a force magnitude (N/m) over time (s), or None.

    Parameters
    ----------
    time, force : of every step, shape (steps,).
    window, drop : of :class:`~nucleation.simulation.event.DropWatch`, in s and as a fraction.
    """
    watch = DropWatch(window, drop)
    end = next(
        (i for i, at in enumerate(zip(time, force, strict=True)) if watch.dropped(*at)), None
    )
    if end is None:
        return None
    start = end
    while start > 0 and force[start - 1] >= force[start]:
        start -= 1
    loading_rate = (force[start] - force[0]) / max(time[start] - time[0], 1e-300)
    falling = -np.diff(force[start : end + 1]) / np.diff(time[start : end + 1])
    steep = start + int(np.argmax(falling > loading_rate)) if falling.size else end
    return Onset(start, steep, end)


def patch_edge(x: Array, slip_rate: Array, threshold: float) -> float:
    """Position (m) of the creep patch's edge: the furthest crossing of a slip rate (m/s).

    Between nodes log v is taken as linear in x. Only the part of the block next to the loaded
    edge is searched, so that slip at the far corner does not count. Zero if nothing slips faster.
    """
    near = x <= SEARCHED * x[-1]
    rate = np.maximum(np.abs(slip_rate), 1e-300)
    faster = np.flatnonzero(near & (rate > threshold))
    if faster.size == 0:
        return 0.0
    last = int(faster[-1])
    if last + 1 >= x.size or rate[last + 1] >= threshold:
        return float(x[last])
    inside, outside = np.log(rate[last]), np.log(rate[last + 1])
    part = (inside - np.log(threshold)) / (inside - outside)
    return float(x[last] + part * (x[last + 1] - x[last]))


def patch_lengths(simulation: xr.Dataset, threshold: float) -> Array:
    """Length of the creep patch (m) at every recorded time, for an edge slip rate (m/s)."""
    x = simulation["x"].values
    return np.array([patch_edge(x, v, threshold) for v in simulation["slip_rate"].values])


def extract(
    simulation: xr.Dataset, settings: ExtractionSettings = ExtractionSettings()
) -> dict[str, float]:
    """Onset time and critical length of one simulation, each with its spread.

    Parameters
    ----------
    simulation : the record of :func:`nucleation.simulation.run.simulate`.
    settings : definitions of the patch's edge.

    Returns
    -------
    ``onset_time``, ``onset_time_low``, ``onset_time_high`` (s) and ``length``, ``length_low``,
    ``length_high`` (m); all NaN if the run has no event.
    """
    parameters = Parameters.from_json(simulation.attrs["parameters"])
    velocity = parameters.loading.velocity
    time = simulation["step_time"].values
    onset = find_onset(
        time,
        np.abs(simulation["driving_force"].values),
        WINDOW * parameters.memory_time,
        settings.drop,
    )
    names = ("onset_time", "onset_time_low", "onset_time_high")
    names += ("length", "length_low", "length_high")  # type: ignore[assignment]
    if onset is None:
        return dict.fromkeys(names, float("nan"))
    instants = time[[onset.start, onset.steep, onset.end]]
    frames = np.abs(simulation["time"].values[:, None] - instants).argmin(axis=0)
    before = simulation.isel(time=slice(0, int(frames.max()) + 1))
    thresholds = (
        settings.edge_threshold, settings.edge_threshold_high, settings.edge_threshold_low,
    )  # fmt: skip
    reach = [np.maximum.accumulate(patch_lengths(before, share * velocity)) for share in thresholds]
    edges = np.array(reach).T[frames]
    lengths = (edges[0, 0], edges.min(), edges.max())
    values = (instants[0], instants.min(), instants.max(), *lengths)
    return dict(zip(names, map(float, values), strict=True))
