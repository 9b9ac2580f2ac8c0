"""Inverse problem: the values of one parameter at which a nucleation length fits a specimen."""

import dataclasses
import math
from collections.abc import Callable, Collection
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
from ..theory.values import Numbers
from ..types import Array
from .status import answers_of_theory

UNKNOWNS = Quantity(
    "parameter to find",
    choices=("normal_stress", "slip_distance", "shear_modulus"),
    kind="str",
)
CRITERIA: dict[str, Callable[..., Numbers]] = {
    "critical": critical_length,
    "stability": stability_length,
}
"""The lengths that may have to fit: L_c of homogeneous sliding, L_s of the creeping patch."""

NAMES = {"critical": "L_c", "stability": "L_s"}

SPECIMEN = dataclasses.replace(
    declarations(Geometry)["length"],
    description="length of the specimen along the fault",
)

Interval = tuple[float, float]
"""Least and largest value of a parameter, in SI units."""

_PER_DECADE = 12
"""Values in each decade between which roots are searched."""

_FAR = 4.0
"""L_s is assumed to be longer than the specimen where L_c exceeds the specimen by this factor.

The least L_s of 150 random faults is 0.39 L_c, and a patch that is very long compared with the
height takes seconds to compute.
"""


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
    monotonic: bool
    """Whether the length is a monotonic function of the parameter, wherever it exists."""
    status: str
    """``value`` if it fits; else ``beyond``, longer than the specimen; ``stable``; ``unknown``."""
    reason: str
    """Why it fits nowhere; empty if it fits."""


@takes_fault
def specimen_fit(
    unknown: str,
    length: Values,
    criterion: str = "critical",
    within: Interval | None = None,
    **fault: Any,
) -> Fit:
    """Values of one parameter at which a nucleation length fits a specimen.

    Parameters
    ----------
    unknown : {"normal_stress", "slip_distance", "shear_modulus"}
        The parameter to find: sigma0 (Pa), D (m) or mu (Pa) of the first body. The second body has
        the same mu unless `second_shear_modulus` is given and thus fixed.
    length : float
        Length of the specimen along the fault (m).
    criterion : {"critical", "stability"}
        The length that has to fit: L_c, or L_s of a creeping patch that is pushed at its edge, with
        constant a and b.
    within : (float, float), optional
        Range of the search, in SI units; by default all known values
        (:data:`nucleation.model.plausible.RANGES`).
    **fault
        The other parameters of :class:`~nucleation.api.fault.Fault`, single numbers.

    Returns
    -------
    Fit

    Raises
    ------
    ParameterError
        If a parameter is missing, unknown, outside its range, an array, or the unknown one.

    Notes
    -----
    Eq. (5) depends on sigma0 and D only by ``mu D/sigma0``, and L_c increases with it. So one end
    of the interval is decisive: ``sigma0 = mu k D G1(k)/h_plus`` at ``k = 2 pi/length`` unless L_c
    is discontinuous there. The dependence on mu beside another second body is less simple.
    Therefore the length is computed at 12 values in each decade, and each change between fitting
    and not fitting is located by Brent's method; an interval between two of these values is missed.

    Examples
    --------
    >>> fit = specimen_fit(
    ...     "normal_stress", 0.2, shear_modulus=3.1e9, poisson_ratio=0.35, height=0.1,
    ...     a=0.0068, zeta=0.016, slip_distance=0.5e-6,
    ... )
    >>> [[f"{value:.4g}" for value in interval] for interval in fit.intervals]
    [['2.212e+06', '1e+10']]
    """
    _require_choice("unknown", unknown, UNKNOWNS.choices)
    _require_choice("criterion", criterion, CRITERIA)
    if unknown in fault:
        raise ParameterError(f"{unknown} is not allowed: it is the parameter to find")
    entry = QUANTITIES[unknown]
    size = checked("length", length, SPECIMEN)
    ends = within or RANGES[unknown]
    low, high = (float(checked(unknown, end, entry)) for end in ends)
    if not low < high:
        raise ParameterError(f"within = ({low:g}, {high:g}) {entry.unit} is no range")
    if np.ndim(size) or any(np.ndim(value) for value in fault.values()):
        raise ParameterError("a specimen is one: its length and parameters are single numbers")

    def lengths(values: float | Array) -> Array:
        return _lengths(criterion, float(size), unknown, fault | {unknown: values})

    def excess(log_value: float) -> float:
        found = float(lengths(math.exp(log_value)))
        return math.log(found / float(size)) if math.isfinite(found) else 1.0

    count = 2 + math.ceil(_PER_DECADE * math.log10(high / low))
    values = np.geomspace(low, high, count)
    found = lengths(values)
    fits = found <= size
    bounds = [low] if fits[0] else []
    for i in np.flatnonzero(fits[1:] != fits[:-1]):
        around = np.log(values[i : i + 2])
        root = brentq(excess, *around, xtol=1e-12)
        bounds.append(math.exp(root))
    if fits[-1]:
        bounds.append(high)
    intervals = tuple(zip(bounds[::2], bounds[1::2], strict=True))

    exists = bool((found > 0.0).any())
    status, reason = VALUE, ""
    if not intervals and exists:
        status = BEYOND
        reason = _of_shortest(criterion, found, values, unknown)
    elif not intervals:
        middle = fault_of({**fault, unknown: values[values.size // 2]})
        answer = answers_of_theory(middle)[criterion]
        status, reason = str(answer.status), str(answer.reason)
    return Fit(
        unknown=unknown,
        unit=entry.unit,
        intervals=intervals,
        searched=(low, high),
        exists=exists,
        monotonic=_is_monotonic(found),
        status=status,
        reason=reason,
    )


def _require_choice(name: str, value: str, allowed: Collection[str]) -> None:
    if value not in allowed:
        raise ParameterError(f"{name} = {value!r} is not allowed: one of {', '.join(allowed)}")


def _lengths(
    criterion: str,
    size: float,
    unknown: str,
    fault: dict[str, Any],
) -> Array:
    """L_c or L_s (m) of faults; an L_s that is much longer than the specimen is inf."""
    critical = _plain(critical_length(**fault))
    if criterion == "critical":
        return critical
    near = ~(critical > _FAR * size)
    found = np.where(near, critical, np.inf)
    values = np.asarray(fault[unknown])
    chosen = fault | {unknown: values[near]}
    found[near] = _plain(stability_length(**chosen))
    return found


def _plain(found: Any) -> Array:
    """The numbers of an array or a pint quantity."""
    return np.array(getattr(found, "magnitude", found))


def _is_monotonic(found: Array) -> bool:
    steps = np.diff(found[np.isfinite(found)])
    return bool((steps > 0.0).all() or (steps < 0.0).all())


def _of_shortest(
    criterion: str,
    found: Array,
    values: Array,
    unknown: str,
) -> str:
    """The shortest length, as a reason why none fits."""
    if not np.isfinite(found).any():
        return f"L_c is more than {_FAR:g} times the specimen at all values"
    name = NAMES[criterion]
    unit = QUANTITIES[unknown].unit
    best = np.nanargmin(found)
    return f"{name} is {found[best]:.4g} m at least, at {unknown} = {values[best]:.4g} {unit}"
