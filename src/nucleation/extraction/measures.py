"""More measures of a simulation: how fast its event is, and how the patch before it creeps.

They are columns of the table of :mod:`.lengths`; the claims of the paper are checked against them.
"""

import itertools
import math

import numpy as np
from numpy.typing import NDArray

from ..datasets.variables import Variable
from ..model.friction import Friction
from ..types import Array
from .extraction import Record

SHAKEN = 0.1  # largest relative error of a good approximation of dphi/dt
RUPTURE = 1e-3  # m/s: a slip rate that only a rupture reaches
SETTLED = 0.5  # part of the onset time after which the patch counts as developed

MEASURED = {
    "onset_time": Variable("s", "onset of the event", "t"),
    "onset_time_low": Variable("s", "earliest onset over the definitions of the drop", "t"),
    "onset_time_high": Variable("s", "latest onset over the definitions of the drop", "t"),
    "length": Variable("m", "length at the drop", "L"),
    "length_low": Variable("m", "smallest length over the definitions", "L"),
    "length_high": Variable("m", "largest length over the definitions", "L"),
}
"""Results of :func:`.extraction.extract`."""

EDGES = ("usual", "high", "low")
INSTANTS = ("start", "steepest", "end")
BY_DEFINITION = {
    f"length_{edge}_{instant}": Variable(
        "m",
        f"patch length at the {instant} of the drop, its edge at the {edge} slip rate",
        "L",
    )
    for edge, instant in itertools.product(EDGES, INSTANTS)
}
"""The length by every definition of the patch's edge and of the instant."""

ALWAYS = {
    "rupture_time": Variable("s", "time during which some point slips faster than 1 mm/s"),
    "largest_rate": Variable("m/s", "largest slip rate ever"),
    "usual_step": Variable("s", "median of the time steps"),
    "largest_normal_stress_ever": Variable("Pa", "largest sigma_yy on the interface, ever"),
}
"""Those of :data:`MEASURES` that a run without an event has as well."""

MEASURES = {
    **ALWAYS,
    "acceleration_time": Variable(
        "s", "time in which the fastest slip rate grows from 10 to 100 V"
    ),
    "growth_time": Variable("s", "time in which the patch would grow by its length at the onset"),
    "front_speed": Variable("m/s", "mean speed of the patch's edge before the onset"),
    "drop_time": Variable("s", "time from the steepest part of the force's drop to its end"),
    "onset_rate": Variable("m/s", "largest slip rate at the onset"),
    "patch_rate": Variable("m/s", "median slip rate in the developed patch, and over instants"),
    "patch_rate_low": Variable("m/s", "smallest of the medians over the patch"),
    "patch_rate_high": Variable("m/s", "largest of the medians over the patch"),
    "regular_share": Variable("1", "part of the patch at the onset that slips faster than 10 v0"),
    "middle_stress": Variable("Pa", "shear stress half-way along the block at the onset"),
    "largest_normal_stress": Variable("Pa", "largest sigma_yy on the interface up to the onset"),
    "shortest_step": Variable("s", "shortest time step after the onset"),
    "state_rate_share": Variable("1", "part of x and t to the onset where v does for w in dphi/dt"),
    "state_rate_share_patch": Variable("1", "the same within the creep patch"),
    **BY_DEFINITION,
}
"""Results of :func:`measure`; over realisations each is averaged."""


def measure(record: Record) -> dict[str, float]:
    """Compute :data:`MEASURES` of a simulation in SI units.

    Without an event all but :data:`ALWAYS` are NaN. The result is empty if the run is not loaded at
    its edge, or if its interface is not recorded.
    """
    given = record.run
    if given.fault.loading != "edge" or given.recording.record == "lengths":
        return {}
    sizes = record.simulation["step_size"].values[1:]
    normal = record.simulation["sigma_yy"].values
    found = dict.fromkeys(MEASURES, math.nan)
    found |= {
        "rupture_time": float(sizes[record.fastest[1:] > RUPTURE].sum()),
        "largest_rate": float(record.fastest.max()),
        "usual_step": float(np.median(sizes)),
        "largest_normal_stress_ever": float(normal.max()),
    }
    if record.onset is None:
        return found
    start = record.onset.start
    _, steep, end = record.drop_times
    found |= {
        "acceleration_time": _acceleration_time(record, start),
        "drop_time": float(end - steep),
        "onset_rate": float(record.fastest[start]),
        "shortest_step": float(sizes[start:].min()),
    }
    return found | _patch(record)


def _acceleration_time(record: Record, start: int) -> float:
    """Time (s) in which the largest slip rate grows from 10 V to 100 V after a step."""
    rates = record.fastest[start:]
    hundred = int(np.argmax(rates > 100.0 * record.velocity))  # zero also if it is never so fast
    slower = np.flatnonzero(rates[:hundred] < 10.0 * record.velocity)
    if not slower.size:
        return math.nan
    time = record.step_time[start:]
    return float(time[hundred] - time[slower[-1]])


def _patch(record: Record) -> dict[str, float]:
    """The creeping patch; its lengths alone, if fewer than two frames show the developed patch."""
    friction = record.run.law
    instants, times = record.drop_times, record.time
    x, length = record.x, record.lengths
    at = int(record.frames_at(instants)[0])
    until = slice(at + 1)
    lengths = record.lengths_at_drop.ravel().tolist()
    found = dict(zip(BY_DEFINITION, lengths, strict=True))
    developed = np.flatnonzero(times[until] >= SETTLED * instants[0])
    if developed.size < 2:
        return found
    rate = record.simulation["slip_rate"].values[until]
    state = record.simulation["state"].values[until]
    stress = record.simulation["shear_stress"].values[until]
    normal = record.simulation["sigma_yy"].values[until]
    inside = x <= length[until, None]
    medians = np.array([np.median(np.abs(rate[i, inside[i]])) for i in developed])
    first = developed[0]
    growth = length[at] - length[first]
    speed = growth / (times[at] - times[first])
    good = _state_rate_well_approximated(rate, state, friction)
    duration = np.gradient(times[until])
    weight = duration[:, None] * np.ones_like(rate)
    regular = np.abs(rate[at]) > 10.0 * friction.regularisation_slip_rate
    return found | {
        "growth_time": float(length[at] / speed) if speed > 0.0 else math.inf,
        "front_speed": float(speed),
        "patch_rate": float(np.median(medians)),
        "patch_rate_low": float(medians.min()),
        "patch_rate_high": float(medians.max()),
        "regular_share": float(regular[inside[at]].mean()),
        "middle_stress": float(np.abs(stress[at, x.size // 2])),
        "largest_normal_stress": float(normal.max()),
        "state_rate_share": _share(good, weight),
        "state_rate_share_patch": _share(good, weight * inside),
    }


def _share(good: NDArray[np.bool_], weight: Array) -> float:
    """Weighted part of frames and nodes that are good."""
    return float((weight * good).sum() / weight.sum())


def _state_rate_well_approximated(
    rate: Array,
    state: Array,
    friction: Friction,
) -> NDArray[np.bool_]:
    """Where ``dphi/dt`` with v in the place of ``w = sqrt(v^2 + v0^2)`` is nearly the same."""
    speed = np.maximum(np.abs(rate), 1e-300)
    omega = state * speed / friction.slip_distance
    full = friction.state_rate(rate, state)
    approximate = friction.evolution_law.growth(omega)
    return np.abs(approximate - full) <= SHAKEN * np.abs(full)
