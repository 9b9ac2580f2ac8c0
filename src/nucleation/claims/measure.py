"""What the claims need to know about one simulation, beyond onset and length."""

from __future__ import annotations

import dataclasses
import math

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..analysis.extraction import ExtractionSettings, Onset, find_onset, patch_lengths
from ..model.friction.law import Friction
from ..model.parameters import Parameters
from ..simulation.event import WINDOW

Array = NDArray[np.float64]

SHAKEN = 0.1  # part of dphi/dt by which it may be off and still be well approximated
FAST = 1e-3  # m/s: a slip rate that only a rupture reaches
SETTLED = 0.5  # from this part of the onset time on the patch counts as developed


@dataclasses.dataclass(frozen=True)
class Measures:
    """Numbers read from one simulation; SI units, NaN without an event."""

    lengths: tuple[float, ...]
    """L_c (m) by every definition: edges at three slip rates, at three instants of the drop."""
    acceleration_time: float
    """Time (s) in which the fastest slip rate rises from 10 to 100 V."""
    growth_time: float
    """Time (s) in which the creeping patch would grow by its own length, before the onset."""
    front_speed: float
    """Mean speed (m/s) of the patch's edge before the onset."""
    drop_time: float
    """Time (s) from the steep part of the force's drop to its end."""
    rupture_time: float
    """Time (s) during which some point slips faster than FAST, zero if none does."""
    largest_rate: float
    """Largest slip rate (m/s)."""
    onset_rate: float
    """Largest slip rate (m/s) at the onset."""
    patch_rates: tuple[float, float, float]
    """Median slip rate (m/s) within the developed patch: median, lowest, highest over time."""
    regular_share: float
    """Part of the patch at the onset that slips at more than ten times v0."""
    middle_stress: float
    """Shear stress (Pa) half-way along the block at the onset."""
    largest_normal_stress: float
    """Largest sigma_yy (Pa) up to the onset, negative in compression."""
    usual_step: float
    """Median time step (s)."""
    shortest_step: float
    """Shortest time step (s) after the onset."""
    state_rate_share: float
    """Part of interface and time up to the onset where v in place of w gives dphi/dt well."""
    state_rate_share_patch: float
    """The same within the creep patch."""


NONE = float("nan")


def measure(simulation: xr.Dataset, settings: ExtractionSettings) -> Measures:
    """Read a simulation (the record of :func:`nucleation.simulation.run.simulate`)."""
    parameters = Parameters.from_json(simulation.attrs["parameters"])
    steps = simulation["step_time"].values
    force = np.abs(simulation["driving_force"].values)
    onset = find_onset(steps, force, WINDOW * parameters.memory_time, settings.drop)
    fastest = simulation["maximal_slip_rate"].values
    sizes = simulation["step_size"].values[1:]
    always = {
        "rupture_time": float(sizes[fastest[1:] > FAST].sum()),
        "largest_rate": float(fastest.max()),
        "usual_step": float(np.median(sizes)),
    }
    if onset is None:
        names = {field.name for field in dataclasses.fields(Measures)} - set(always)
        many = {"lengths": (NONE,) * 9, "patch_rates": (NONE,) * 3}
        return Measures(**{**dict.fromkeys(names, NONE), **many, **always})
    return Measures(
        **always,
        **_drop(steps, fastest, sizes, onset, parameters),
        **_patch(simulation, steps, onset, parameters, settings),
    )


def _drop(
    steps: Array, fastest: Array, sizes: Array, onset: Onset, parameters: Parameters
) -> dict[str, float]:
    """How fast the event is."""
    velocity = parameters.loading.velocity
    rates = fastest[onset.start :]
    hundred = int(np.argmax(rates > 100.0 * velocity)) if rates.max() > 100.0 * velocity else 0
    slower = np.flatnonzero(rates[:hundred] < 10.0 * velocity)
    acceleration = NONE
    if hundred and slower.size:
        acceleration = steps[onset.start + hundred] - steps[onset.start + slower[-1]]
    return {
        "acceleration_time": float(acceleration),
        "drop_time": float(steps[onset.end] - steps[onset.steep]),
        "onset_rate": float(fastest[onset.start]),
        "shortest_step": float(sizes[onset.start :].min()),
    }


def _patch(
    simulation: xr.Dataset,
    steps: Array,
    onset: Onset,
    parameters: Parameters,
    settings: ExtractionSettings,
) -> dict[str, float | tuple[float, ...]]:
    """The creeping patch up to the onset, and its length by every definition."""
    instants = steps[[onset.start, onset.steep, onset.end]]
    times, x = simulation["time"].values, simulation["x"].values
    frames = np.abs(times[:, None] - instants).argmin(axis=0)
    velocity, friction = parameters.loading.velocity, parameters.friction
    record = simulation.isel(time=slice(0, int(frames.max()) + 1))
    thresholds = (
        settings.edge_threshold, settings.edge_threshold_high, settings.edge_threshold_low,
    )  # fmt: skip
    reach = [np.maximum.accumulate(patch_lengths(record, part * velocity)) for part in thresholds]
    at, length = int(frames[0]), reach[0]
    rate, state, stress, normal = (
        simulation[name].values[: at + 1]
        for name in ("slip_rate", "state", "shear_stress", "normal_stress")
    )
    inside = x <= length[: at + 1, None]
    developed = np.flatnonzero(times[: at + 1] >= SETTLED * instants[0])
    medians = np.array([np.median(np.abs(rate[i][inside[i]])) for i in developed])
    speed = (length[at] - length[developed[0]]) / (times[at] - times[developed[0]])
    good = _state_rate_well_approximated(rate, state, friction)
    weight = np.gradient(times[: at + 1])[:, None] * np.ones_like(rate)
    regular = np.abs(rate[at]) > 10.0 * friction.regularisation_slip_rate
    return {
        "lengths": tuple(float(edges[i]) for edges in reach for i in frames),
        "growth_time": float(length[at] / speed) if speed > 0.0 else math.inf,
        "front_speed": float(speed),
        "patch_rates": (float(np.median(medians)), float(medians.min()), float(medians.max())),
        "regular_share": float(regular[inside[at]].mean()),
        "middle_stress": float(np.abs(stress[at, x.size // 2])),
        "largest_normal_stress": float(normal.max()),
        "state_rate_share": float((weight * good).sum() / weight.sum()),
        "state_rate_share_patch": float((weight * good * inside).sum() / (weight * inside).sum()),
    }


def _state_rate_well_approximated(
    rate: Array, state: Array, friction: Friction
) -> NDArray[np.bool_]:
    """Where ``dphi/dt`` with v in the place of ``w = sqrt(v^2 + v0^2)`` is nearly the same."""
    speed = np.maximum(np.abs(rate), 1e-300)
    omega = state * speed / friction.characteristic_slip_distance
    full = friction.state_rate(rate, state)
    approximate = friction.evolution_law.growth(omega)
    return np.abs(approximate - full) <= SHAKEN * np.abs(full)
