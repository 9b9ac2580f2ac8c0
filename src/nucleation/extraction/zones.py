"""The accelerating zone of a period: its length by several definitions, and the fault far ahead."""

import math
from collections.abc import Callable
from typing import NamedTuple

import numpy as np
import xarray as xr

from ..simulation.event import slipping_zone
from ..types import Array


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
        share=0.5,
        part=0.5,
        words="twice the width at half the largest slip rate",
    ),
    "state_evolution": _Definition(
        share=0.5,
        part=1.0,
        words="width at half the largest slip rate",
    ),
}
"""In Rubin and Ampuero's solution 0.7434 L_b on either side slip faster than half the maximum; in
Viesca's, ``1 + cos(x/L)``, one half does."""


def zone_length(
    simulation: xr.Dataset,
    slip_rate: float,
    definition: _Definition,
) -> float:
    """Length of the accelerating zone when its largest slip rate passes a value.

    Between recorded times it is linear in the logarithm of the largest slip rate.

    Parameters
    ----------
    simulation : Dataset
        Slip rates and states of the interface on (time, x).
    slip_rate : float
        The largest slip rate (m/s).
    definition : _Definition
        How the length is read.

    Returns
    -------
    float
        In m; NaN if that slip rate is not reached.
    """
    x = simulation["x"].values

    def width(rates: Array, states: Array) -> float:
        threshold = definition.share * float(rates.max())
        if definition.between_tips:
            rates = _filled_between_tips(rates)
        begin, end = slipping_zone(x, rates, threshold, periodic=True)
        return (end - begin) / definition.part

    return _when_passing(simulation, slip_rate, width)


def _filled_between_tips(rates: Array) -> Array:
    """Raise the slip rates of a period, so that they fall from the fastest node to both sides.

    At each node the result is the smaller one of the largest slip rates on its left and right.
    """
    first = _opposite(rates)
    around = np.roll(rates[:-1], -first)
    from_left = np.maximum.accumulate(around)
    from_right = np.maximum.accumulate(around[::-1])[::-1]
    filled = np.roll(np.minimum(from_left, from_right), first)
    return np.append(filled, filled[0])


def far_ahead(
    simulation: xr.Dataset,
    slip_rate: float,
    slip_distance: float,
) -> tuple[float, float]:
    """Slip rate and ``v phi/D`` half a period from the fastest point.

    Parameters
    ----------
    simulation : Dataset
        Slip rates and states of the interface on (time, x).
    slip_rate : float
        The largest slip rate (m/s) at the instant.
    slip_distance : float
        D (m).

    Returns
    -------
    tuple of float
        In m/s, and dimensionless. NaN if the largest slip rate is not reached, or if the fault is
        stuck there.
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
    simulation: xr.Dataset,
    slip_rate: float,
    measure: Callable[[Array, Array], float],
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
    return float(
        np.interp(
            np.log(slip_rate),
            np.log(fastest[pair]),
            measured,
        )
    )
