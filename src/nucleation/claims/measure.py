"""What the claims need to know about one simulation, beyond onset and length."""

import dataclasses
import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..analysis.definitions import ExtractionSettings
from ..analysis.record import Record
from ..model.friction.law import Friction
from ..types import Array

SHAKEN = 0.1  # part of dphi/dt by which it may be off and still be well approximated
FAST = 1e-3  # m/s: a slip rate that only a rupture reaches
SETTLED = 0.5  # from this part of the onset time on the patch counts as developed


NONE = float("nan")


@dataclasses.dataclass(frozen=True)
class Measures:
    """Numbers read from one simulation, or the mean of several; SI units, NaN without an event."""

    rupture_time: float  # during which some point slips faster than FAST, zero if none does
    largest_rate: float  # of slip, ever
    usual_step: float  # median of the time steps
    largest_normal_stress_ever: float  # sigma_yy over the record, event and rupture among it
    lengths: Sequence[float] = (NONE,) * 9  # L_c: edges at three slip rates, at three instants
    acceleration_time: float = NONE  # in which the fastest slip rate rises from 10 to 100 V
    growth_time: float = NONE  # in which the patch would grow by its own length, before the onset
    front_speed: float = NONE  # mean speed of the patch's edge before the onset
    drop_time: float = NONE  # from the steep part of the force's drop to its end
    onset_rate: float = NONE  # largest slip rate at the onset
    patch_rates: Sequence[float] = (NONE,) * 3  # median in the developed patch: median, ends
    regular_share: float = NONE  # of the patch at the onset that slips at more than ten times v0
    middle_stress: float = NONE  # shear stress half-way along the block at the onset
    largest_normal_stress: float = NONE  # sigma_yy up to the onset, negative in compression
    shortest_step: float = NONE  # after the onset
    state_rate_share: float = NONE  # of interface and time to the onset: v for w gives dphi/dt well
    state_rate_share_patch: float = NONE  # the same within the creep patch


def mean(measures: Iterable[Measures]) -> Measures:
    """The mean of several simulations, number by number."""
    columns = zip(*map(dataclasses.astuple, measures), strict=True)
    return Measures(*(np.mean(column, axis=0) for column in columns))


def measure(simulation: xr.Dataset, settings: ExtractionSettings) -> Measures:
    """Read a simulation (the record of :func:`nucleation.simulation.run.simulate`)."""
    record = Record(simulation, settings)
    fastest = simulation["maximal_slip_rate"].values
    sizes = simulation["step_size"].values[1:]
    always: dict[str, Any] = {
        "rupture_time": float(sizes[fastest[1:] > FAST].sum()),
        "largest_rate": float(fastest.max()),
        "usual_step": float(np.median(sizes)),
        "largest_normal_stress_ever": float(simulation["normal_stress"].values.max()),
    }
    if record.onset is None:
        return Measures(**always)
    start = record.onset.start
    return Measures(**always, **_drop(record, start, fastest, sizes), **_patch(record))


def _drop(record: Record, start: int, fastest: Array, sizes: Array) -> dict[str, Any]:
    """How fast the event is that starts with a step."""
    velocity, steps = record.velocity, record.step_time
    _, steep, end = record.drop_times
    rates = fastest[start:]
    hundred = int(np.argmax(rates > 100.0 * velocity))  # zero also if it is never so fast
    slower = np.flatnonzero(rates[:hundred] < 10.0 * velocity)
    acceleration = steps[start + hundred] - steps[start + slower[-1]] if slower.size else NONE
    return {
        "acceleration_time": float(acceleration),
        "drop_time": float(end - steep),
        "onset_rate": float(fastest[start]),
        "shortest_step": float(sizes[start:].min()),
    }


def _patch(record: Record) -> dict[str, Any]:
    """The creeping patch up to the onset, and its length by every definition."""
    instants, times, x = record.drop_times, record.time, record.x
    frames, friction = record.frames_at(instants), record.parameters.friction
    at, length = int(frames[0]), record.lengths
    rate, state, stress, normal = (
        record.simulation[name].values[: at + 1]
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
        "lengths": tuple(float(edges[i]) for edges in record.all_lengths for i in frames),
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
