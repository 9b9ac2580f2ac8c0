"""More measures of a simulation: how fast its event is, and how the patch before it creeps.

They are columns of the table of :mod:`replication.tables.lengths`; the claims of the paper are
checked against them. Simulated lengths of the literature are those of the accelerating zone of a
period, by several definitions.
"""

import functools
import itertools
import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..datasets.variables import Column, columns
from ..model.friction import Friction
from ..simulation.event import slipping_zone
from ..types import Array
from .extraction import Record

SHAKEN = 0.1  # largest relative error of a good approximation of dphi/dt
RUPTURE = 1e-3  # m/s: a slip rate that only a rupture reaches
SETTLED = 0.5  # part of the onset time after which the patch counts as developed

_averaged = functools.partial(Column, realisations=np.mean)

EDGES = ("usual", "high", "low")
INSTANTS = ("start", "steepest", "end")
BY_DEFINITION = columns(
    *(
        _averaged(
            f"length_{edge}_{instant}",
            "m",
            f"patch length at the {instant} of the drop, its edge at the {edge} slip rate",
            "L",
        )
        for edge, instant in itertools.product(EDGES, INSTANTS)
    )
)
"""The length by every definition of the patch's edge and of the instant."""

ALWAYS = columns(
    _averaged("rupture_time", "s", "time during which some point slips faster than 1 mm/s"),
    _averaged("largest_rate", "m/s", "largest slip rate ever"),
    _averaged("usual_step", "s", "median of the time steps"),
    _averaged("largest_normal_stress_ever", "Pa", "largest sigma_yy on the interface, ever"),
)
"""Those of :data:`MEASURES` that a run without an event has as well."""

_OF_EVENT = columns(
    _averaged(
        "acceleration_time", "s", "time in which the fastest slip rate grows from 10 to 100 V"
    ),
    _averaged("growth_time", "s", "time in which the patch would grow by its length at the onset"),
    _averaged("front_speed", "m/s", "mean speed of the patch's edge before the onset"),
    _averaged("drop_time", "s", "time from the steepest part of the force's drop to its end"),
    _averaged("onset_rate", "m/s", "largest slip rate at the onset"),
    _averaged("patch_rate", "m/s", "median slip rate in the developed patch, and over instants"),
    _averaged("patch_rate_low", "m/s", "smallest of the medians over the patch"),
    _averaged("patch_rate_high", "m/s", "largest of the medians over the patch"),
    _averaged("regular_share", "1", "part of the patch at the onset that slips faster than 10 v0"),
    _averaged("shortest_step", "s", "shortest time step after the onset"),
    _averaged(
        "state_rate_share_patch",
        "1",
        "part of patch and time to the onset where v does for w in dphi/dt",
    ),
)

MEASURES = ALWAYS | _OF_EVENT | BY_DEFINITION
"""Results of :func:`measure`; over realisations each is averaged."""


def measure(record: Record) -> dict[str, float]:
    """Compute :data:`MEASURES` of a simulation in SI units.

    Without an event all but :data:`ALWAYS` are NaN. The result is empty if the run is not loaded at
    its edge, or if its interface is not recorded.
    """
    given = record.run
    if given.fault.loading != "edge" or given.stepping.record == "lengths":
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
        "drop_time": float(end - steep),
        "onset_rate": float(record.fastest[start]),
        "shortest_step": float(sizes[start:].min()),
    }
    # from the last step below 10 V to the first one above 100 V
    rates, time = record.fastest[start:], record.step_time[start:]
    hundred = int(np.argmax(rates > 100.0 * record.velocity))  # zero also if it is never so fast
    slower = np.flatnonzero(rates[:hundred] < 10.0 * record.velocity)
    if slower.size:
        found["acceleration_time"] = float(time[hundred] - time[slower[-1]])
    return found | _patch(record)


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
    inside = x <= length[until, None]
    slip_speed = np.abs(rate)
    medians = np.array([np.median(slip_speed[i, inside[i]]) for i in developed])
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
        "state_rate_share_patch": float(np.average(good, weights=weight * inside)),
    }


def _state_rate_well_approximated(
    rate: Array, state: Array, friction: Friction
) -> NDArray[np.bool_]:
    """Where ``dphi/dt`` with v in the place of ``w = sqrt(v^2 + v0^2)`` is nearly the same."""
    speed = np.maximum(np.abs(rate), 1e-300)
    omega = state * speed / friction.slip_distance
    full = friction.state_rate(rate, state)
    approximate = friction.evolution_law.growth(omega)
    return np.abs(approximate - full) <= SHAKEN * np.abs(full)


class _Definition(NamedTuple):
    """How a simulated length is read: the zone that slips faster than a share of the fastest."""

    share: float
    part: float  # length of the zone over the whole length, in the source's own solution
    words: str
    between_tips: bool = False  # slip may be slower within the zone, as in a crack


DEFINITIONS = {
    "rubin_ampuero_localised": _Definition(
        share=0.5,
        part=0.7434 / 1.3774,
        words="width at half the largest slip rate, times 1.3774/0.7434",
    ),
    "rubin_ampuero_crack": _Definition(
        share=0.1,
        part=1.0,
        words="distance of the outermost points at a tenth of the largest slip rate",
        between_tips=True,
    ),
    "thin_layer": _Definition(
        share=0.5, part=0.5, words="twice the width at half the largest slip rate"
    ),
    "state_evolution": _Definition(
        share=0.5, part=1.0, words="width at half the largest slip rate"
    ),
}
"""In Rubin and Ampuero's solution 0.7434 L_b on either side slip faster than half the maximum; in
Viesca's, ``1 + cos(x/L)``, one half does."""


def zone_length(simulation: xr.Dataset, slip_rate: float, definition: _Definition) -> float:
    """Length of the accelerating zone when its largest slip rate passes a value.

    In m and m/s; between recorded times the length is linear in the logarithm of the largest slip
    rate, and NaN if that slip rate is not reached.
    """
    x = simulation["x"].values

    def width(rates: Array, states: Array) -> float:
        threshold = definition.share * float(rates.max())
        if definition.between_tips:
            # each node has the smaller one of the largest slip rates on its left and right, so that
            # they fall from the fastest one to both sides
            first = _opposite(rates)
            around = np.roll(rates[:-1], -first)
            from_left = np.maximum.accumulate(around)
            from_right = np.maximum.accumulate(around[::-1])[::-1]
            filled = np.roll(np.minimum(from_left, from_right), first)
            rates = np.append(filled, filled[0])
        begin, end = slipping_zone(x, rates, threshold, periodic=True)
        return (end - begin) / definition.part

    return _when_passing(simulation, slip_rate, width)


def far_ahead(
    simulation: xr.Dataset, slip_rate: float, slip_distance: float
) -> tuple[float, float]:
    """Slip rate (m/s) and ``v phi/D`` half a period from the fastest point, when it slips as fast.

    NaN if the largest slip rate (m/s) is not reached, or if the fault is stuck there.
    """
    rate = _when_passing(simulation, slip_rate, lambda rates, _: rates[_opposite(rates)])
    if not rate > 0.0:  # slip rates of a stuck fault are not recorded
        return math.nan, math.nan
    state = _when_passing(simulation, slip_rate, lambda rates, states: states[_opposite(rates)])
    return rate, rate * state / slip_distance


def _opposite(rates: Array) -> int:
    """The node half a period from the fastest; the first and the last node are the same."""
    period = rates.size - 1
    return (int(rates.argmax()) + period // 2) % period


def _when_passing(
    simulation: xr.Dataset, slip_rate: float, measure: Callable[[Array, Array], float]
) -> float:
    """The measure of slip rates (m/s) and states (s) when the fastest passes a value (m/s)."""
    rates = np.abs(simulation["slip_rate"].values.astype(float))
    states = simulation["state"].values
    fastest = rates.max(axis=1)
    above = np.flatnonzero(fastest >= slip_rate)
    if not above.size or above[0] == 0:
        return math.nan
    pair = [above[0] - 1, above[0]]
    measured = [measure(rates[i], states[i]) for i in pair]
    return float(np.interp(np.log(slip_rate), np.log(fastest[pair]), measured))
