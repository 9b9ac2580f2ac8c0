"""Inverse problem: the values of one parameter at which a nucleation length fits a specimen."""

import dataclasses
import math
from typing import NamedTuple

import numpy as np

from ..model.hints import RANGES
from ..model.quantities import ParameterError, Quantity, declarations
from ..model.settings import Block
from ..model.units import in_metres
from ..theory.status import BEYOND, VALUE
from ..theory.values import QUANTITIES, FaultLike, Values, checked, numbers_of
from ..types import Array
from . import theory

UNKNOWNS = Quantity(
    "parameter to find", choices=("normal_stress", "slip_distance", "shear_modulus"), kind="str"
)
CRITERIA = {"critical": "critical_length", "stability": "stability_length"}
"""The lengths that may have to fit: L_c of homogeneous sliding, L_s of the creeping patch."""

NAMES = {"critical": "L_c", "stability": "L_s"}

SPECIMEN = dataclasses.replace(
    declarations(Block)["length"], description="length of the specimen along the fault"
)

Interval = tuple[float, float]
"""Least and largest value of a parameter, in SI units."""

_PER_DECADE = 12
"""Values in each decade between which roots are searched."""

_LONGEST, _SHORTEST = 4.0, 0.3
"""L_c over the specimen's length beyond which L_s is longer than the specimen, and below which it
is shorter if it exists: the least L_s of 150 random faults is 0.39 L_c, and 3 L_c is the longest
that is searched."""

_SPARSE = 6
"""Each of so many values is tried where L_s is shorter than the specimen if it exists."""


class Fit(NamedTuple):
    """The values of a parameter at which a nucleation length fits a specimen.

    Where an end of `intervals` is an end of `searched`, the length may fit beyond it too.
    """

    unknown: str
    """Name of the parameter to find."""
    unit: str
    intervals: tuple[Interval, ...]
    """Values at which the length is at most that of the specimen."""
    searched: Interval
    """Range of the search."""
    exists: bool
    """Whether a nucleation length, long or short, exists at any value."""
    status: str
    """``value`` if it fits; else ``beyond``, longer than the specimen; ``stable``; ``unknown``."""
    reason: str
    """Why it fits nowhere; empty if it fits."""


def specimen_fit(
    fault: FaultLike,
    unknown: str,
    length: Values,
    criterion: str = "critical",
    within: Interval | None = None,
) -> Fit:
    """Values of one parameter of a single fault at which a nucleation length (m) fits.

    The length is computed at 12 values in each decade, and each change between fitting and not
    fitting is located by Brent's method; an interval between two of these values is missed.
    """
    choices = (("unknown", unknown, UNKNOWNS.choices), ("criterion", criterion, CRITERIA))
    for name, value, allowed in choices:
        if value not in allowed:
            raise ParameterError(f"{name} = {value!r} is not allowed: one of {', '.join(allowed)}")
    given = checked("length", length, SPECIMEN)
    from scipy.optimize import brentq  # slow to load, and few processes need it

    low, high = _range(unknown, within)
    others = numbers_of(fault).items()
    if np.ndim(given) or any(np.size(x) != 1 for name, x in others if name != unknown):
        raise ParameterError("a specimen is one: its length and parameters are single numbers")
    size = float(given)

    def lengths(values: float | Array) -> Array:
        return _lengths(fault.replace(**{unknown: values}), criterion, size)

    def excess(log_value: float) -> float:
        found = float(lengths(math.exp(log_value)))
        return math.log(found / size) if math.isfinite(found) else 1.0

    count = 2 + math.ceil(_PER_DECADE * math.log10(high / low))
    values = np.geomspace(low, high, count)
    found = lengths(values)
    fits = found <= size
    bounds = [low] if fits[0] else []
    for i in np.flatnonzero(fits[1:] != fits[:-1]):
        around = np.log(values[i : i + 2])
        bounds.append(math.exp(brentq(excess, *around, xtol=1e-9)))
    if fits[-1]:
        bounds.append(high)
    intervals = tuple(zip(bounds[::2], bounds[1::2], strict=True))

    exists = bool((found > 0.0).any())
    status, reason = VALUE, ""
    if not intervals and exists:
        status = BEYOND
        reason = _of_shortest(criterion, found, values, unknown)
    elif not intervals:
        middle = fault.replace(**{unknown: values[values.size // 2]})
        answer = getattr(theory, CRITERIA[criterion])(middle)
        status, reason = str(answer.status), str(answer.reason)
    unit = QUANTITIES[unknown].unit
    return Fit(unknown, unit, intervals, (low, high), exists, status, reason)


def _range(unknown: str, within: Interval | None) -> Interval:
    """The range of the search, by default all known values."""
    entry = QUANTITIES[unknown]
    low, high = (float(checked(unknown, end, entry)) for end in within or RANGES[unknown])
    if not low < high:
        raise ParameterError(f"within = ({low:g}, {high:g}) {entry.unit} is no range")
    return low, high


def _lengths(fault: FaultLike, criterion: str, size: float) -> Array:
    """L_c or L_s (m) of faults; an L_s far from the size is inf, or L_c where it is shorter."""
    critical = np.array(_plain(fault.critical_length()))
    if criterion == "critical" or not critical.ndim:
        return _plain(getattr(fault, CRITERIA[criterion])())
    found = np.where(critical > _LONGEST * size, np.inf, critical)
    short = critical < _SHORTEST * size
    tried = ~(short | (critical > _LONGEST * size))
    tried |= short & (np.arange(critical.size) % _SPARSE == 0)
    chosen = {
        name: value[tried] if np.ndim(value) else value for name, value in numbers_of(fault).items()
    }
    chosen.pop("b")
    found[tried] = _plain(fault.replace(**chosen).stability_length())
    return found


def _plain(found: object) -> Array:
    """The numbers of an array or a pint quantity."""
    return np.asarray(getattr(found, "magnitude", found))


def _of_shortest(criterion: str, found: Array, values: Array, unknown: str) -> str:
    """The shortest length, as a reason why none fits."""
    if not np.isfinite(found).any():
        return f"L_c is more than {_LONGEST:g} times the specimen at all values"
    unit = QUANTITIES[unknown].unit
    best = np.nanargmin(found)
    shortest = f"{in_metres(found[best])} at least, at {unknown} = {values[best]:.4g} {unit}"
    return f"{NAMES[criterion]} is {shortest}"
