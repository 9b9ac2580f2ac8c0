"""Backwards: at which value of one parameter a nucleation length fits into a specimen."""

import dataclasses
import math
from typing import Any, NamedTuple

import numpy as np
from scipy.optimize import brentq

from ..model.parameters import Geometry
from ..model.plausible import RANGES
from ..model.quantities import ParameterError, Quantity, declarations
from ..theory.arrays import critical_length, fault_of
from ..theory.creep.lengths import stability_length
from ..theory.fault import QUANTITIES, Values, checked, takes_fault
from ..theory.status import BEYOND, VALUE
from ..types import Array
from .status import answers_of_theory

UNKNOWNS = Quantity(
    "what is looked for", choices=("normal_stress", "slip_distance", "shear_modulus"), kind="str"
)
CRITERIA = {"critical": critical_length, "stability": stability_length}
"""The lengths that can be asked to fit: L_c of homogeneous sliding, L_s of the creeping patch."""

NAMES = {"critical": "L_c", "stability": "L_s"}

SPECIMEN = dataclasses.replace(
    declarations(Geometry)["length"], description="length of the specimen along the fault"
)
PER_DECADE = 12  # values, in each decade, between which roots are looked for
FAR = 4.0
"""L_s is taken for longer than the specimen where L_c is this much longer: the least L_s of
150 random faults is 0.39 L_c, and a patch that is very long against its height takes seconds."""


class Fit(NamedTuple):
    """Where a nucleation length fits into a specimen.

    Where an end of `intervals` is one of `searched`, the length may fit beyond it too. The status
    is ``beyond`` where the length is longer than the specimen at all values.
    """

    unknown: str  # the parameter that was looked for
    unit: str
    intervals: tuple[tuple[float, float], ...]  # values at which the length is at most its own
    searched: tuple[float, float]  # values that were looked at
    exists: bool  # whether there is a nucleation length at any of them, of whatever length
    monotonic: bool  # whether the length rises or falls all along, wherever it exists
    status: str  # "value" where it fits; else "beyond", "stable" or "unknown"
    reason: str  # why it fits nowhere, empty where it fits


@takes_fault
def specimen_fit(
    unknown: str, length: Values, criterion: str = "critical",
    within: tuple[float, float] | None = None, **fault: Any,
) -> Fit:  # fmt: skip
    """Values of one parameter at which a nucleation length fits into a specimen.

    Parameters
    ----------
    unknown : {"normal_stress", "slip_distance", "shear_modulus"}
        What is looked for: sigma0 (Pa), D (m) or mu (Pa) of the first body. The second body has
        the same mu unless `second_shear_modulus` is given, which then stays.
    length : float
        Of the specimen along the fault (m).
    criterion : {"critical", "stability"}
        Which length has to fit: L_c, or L_s of the creeping patch that is pushed at its edge, with
        constant a and b.
    within : (float, float), optional
        Values to look at; by default all that occur (:data:`nucleation.model.plausible.RANGES`).
    **fault
        The other parameters of :class:`~nucleation.theory.fault.Fault`, single numbers.

    Returns
    -------
    Fit

    Raises
    ------
    ParameterError
        If a parameter is missing, unknown, outside its range, an array, or what is looked for.

    Notes
    -----
    Eq. (5) knows sigma0 and D by ``mu D/sigma0`` alone, and L_c rises with it, so that one end
    decides: ``sigma0 = mu k D G1(k)/h_plus`` at ``k = 2 pi/length`` unless L_c jumps there. That
    of the first body's mu against another second body is not as simple. So the length is computed
    at :data:`PER_DECADE` values in each decade, and each change between fitting and not fitting is
    followed by Brent's method; what happens between two of these values alone is missed.
    """
    for name, value, allowed in (
        ("unknown", unknown, UNKNOWNS.choices), ("criterion", criterion, CRITERIA)
    ):  # fmt: skip
        if value not in allowed:
            raise ParameterError(f"{name} = {value!r} is not allowed: one of {', '.join(allowed)}")
    if unknown in fault:
        raise ParameterError(f"{unknown} is not allowed: it is what is looked for")
    forward, entry = CRITERIA[criterion], QUANTITIES[unknown]
    size = checked("length", length, SPECIMEN)
    low, high = (float(checked(unknown, end, entry)) for end in within or RANGES[unknown])
    if not low < high:
        raise ParameterError(f"within = ({low:g}, {high:g}) {entry.unit} is no range")
    if np.ndim(size) or any(np.ndim(value) for value in fault.values()):
        raise ParameterError("a specimen is one: its length and parameters are single numbers")

    def plain(found: Any) -> Any:
        return np.array(getattr(found, "magnitude", found))

    def lengths(values: Any) -> Any:
        found = plain(critical_length(**fault, **{unknown: values}))
        if forward is not critical_length:
            near = ~(found > FAR * size)
            found[~near] = np.inf
            found[near] = plain(forward(**fault, **{unknown: np.asarray(values)[near]}))
        return found

    def excess(log_value: float) -> float:
        found = float(lengths(math.exp(log_value)))
        return math.log(found / float(size)) if math.isfinite(found) else 1.0

    values = np.geomspace(low, high, 2 + math.ceil(PER_DECADE * math.log10(high / low)))
    found = lengths(values)
    fits = found <= size
    ends = [low] if fits[0] else []
    for i in np.flatnonzero(fits[1:] != fits[:-1]):
        ends.append(math.exp(brentq(excess, *np.log(values[i : i + 2]), xtol=1e-12)))
    ends += [high] if fits[-1] else []
    steps = np.diff(found[np.isfinite(found)])
    intervals = tuple(zip(ends[::2], ends[1::2], strict=True))
    exists = bool((found > 0.0).any())
    monotonic = bool((steps > 0.0).all() or (steps < 0.0).all())
    status, reason = VALUE, ""
    if not intervals and exists:
        status, reason = BEYOND, _of_shortest(criterion, found, values, unknown)
    elif not intervals:
        middle = fault_of({**fault, unknown: values[values.size // 2]})
        answer = answers_of_theory(middle)[criterion]
        status, reason = str(answer.status), str(answer.reason)
    return Fit(unknown, entry.unit, intervals, (low, high), exists, monotonic, status, reason)


def _of_shortest(criterion: str, found: Array, values: Array, unknown: str) -> str:
    """How short the length is at best, where it fits at no value."""
    name, unit = NAMES[criterion], QUANTITIES[unknown].unit
    if not np.isfinite(found).any():
        return f"L_c is more than {FAR:g} times the specimen at all values"
    best = np.nanargmin(found)
    return f"{name} is {found[best]:.4g} m at least, at {unknown} = {values[best]:.4g} {unit}"
