"""Inverse problem of uncertain faults: the share of faults for which a length fits a specimen."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ..theory.arrays import without_aliases
from ..theory.fault import Values, checked, takes_fault
from .draws import Progress, draw
from .specimen import CRITERIA, SPECIMEN, Fit, Interval, specimen_fit
from .uncertainty import QUANTILES


class SpecimenQuantiles(NamedTuple):
    """The values of a parameter at which a length fits a specimen, for shares of the draws.

    Where an end of an interval is an end of `searched`, the length may fit beyond it too.
    """

    unknown: str
    """Name of the parameter to find."""
    unit: str
    intervals: dict[float, tuple[Interval, ...]]
    """Values at which the length fits in this share of the draws, by share."""
    errors: dict[float, tuple[Interval, ...]]
    """Standard errors of the ends of the intervals; NaN if unknown."""
    searched: Interval
    """Range of the search."""
    draws: int
    """Number of draws, invalid ones included."""
    invalid: int
    """Number of draws that are no valid fault."""
    outside: tuple[str, ...]
    """Parameters outside their range in invalid draws."""
    share: float
    """Share of the draws in which the length fits at the given value; NaN without a value."""
    share_error: float
    """Standard error of `share` by the number of draws."""


@takes_fault
def specimen_quantiles(
    unknown: str,
    length: Values,
    criterion: str = "critical",
    within: Interval | None = None,
    draws: int = 200,
    seed: int = 0,
    progress: Progress | None = None,
    **fault: Any,
) -> SpecimenQuantiles:
    """Values of one parameter at which a length fits a specimen, for uncertain faults.

    Parameters
    ----------
    unknown : {"normal_stress", "slip_distance", "shear_modulus"}
        The parameter to find, as for :func:`~nucleation.lengths.specimen.specimen_fit`. If `fault`
        has it too, the share of the draws that nucleate at the given value is computed.
    length : float
        Length of the specimen along the fault (m).
    criterion : {"critical", "stability"}
        The length that has to fit, L_c or L_s.
    within : (float, float), optional
        Range of the search, in SI units.
    draws : int
        Number of faults. A fault takes 0.1 s for L_c and about 2 s for L_s.
    seed : int
        Random seed.
    progress : callable, optional
        Called with the number of finished draws and the total number.
    **fault
        The parameters of :class:`~nucleation.api.fault.Fault`, some of them a
        :class:`~nucleation.lengths.draws.Range`, its text, or samples of shape (n,).

    Returns
    -------
    SpecimenQuantiles

    Raises
    ------
    ParameterError
        If a parameter is wrong or missing, or none is uncertain.

    Examples
    --------
    >>> found = specimen_quantiles(
    ...     "normal_stress", 0.2, draws=20, shear_modulus=3.1e9, poisson_ratio=0.35, height=0.1,
    ...     a=0.0068, zeta=0.016, slip_distance="0.5um (0.3 to 1)",
    ... )
    >>> [f"{low:.2g}" for share in (0.05, 0.95) for low, _ in found.intervals[share]]
    ['1.2e+06', '4.1e+06']
    """
    drawn = draw(without_aliases(fault), draws, seed)
    size = float(checked("length", length, SPECIMEN))
    fits: list[Fit] = []
    nucleates: list[bool] = []
    for i in range(drawn.size):
        one = drawn.at(i)
        own = one.pop(unknown, None)
        fits.append(specimen_fit(unknown, length, criterion, within, **one))
        if own is not None:
            found = CRITERIA[criterion](**one, **{unknown: own})
            nucleates.append(bool(found <= size))
        if progress is not None:
            progress(i + 1, drawn.size)
    share = float(np.mean(nucleates)) if nucleates else math.nan
    return SpecimenQuantiles(
        unknown=unknown,
        unit=fits[0].unit,
        intervals={q: at_share(fits, q) for q in QUANTILES},
        errors={q: _errors(fits, q) for q in QUANTILES},
        searched=fits[0].searched,
        draws=drawn.total,
        invalid=drawn.total - drawn.size,
        outside=tuple(drawn.invalid),
        share=share,
        share_error=_scatter(share, len(fits)),
    )


def at_share(
    fits: Sequence[Fit],
    share: float,
) -> tuple[Interval, ...]:
    """Values at which the length fits in a share of several cases, or in more.

    Parameters
    ----------
    fits : sequence of Fit
        One for each case, all with the same unknown and range of the search.
    share : float
        Between 0 and 1.

    Returns
    -------
    tuple of (float, float)
        Intervals in SI units, in increasing order.
    """
    starts = np.sort([first for fit in fits for first, _ in fit.intervals])
    ends = np.sort([last for fit in fits for _, last in fit.intervals])
    bounds = np.unique(np.concatenate([starts, ends]))
    if bounds.size < 2:
        return ()
    middles = np.sqrt(bounds[1:] * bounds[:-1])
    number = np.searchsorted(starts, middles) - np.searchsorted(ends, middles)
    enough = number >= max(share * len(fits), 1.0) - 1e-9
    edges = np.diff(np.concatenate([[0], enough.astype(int), [0]]))
    first = bounds[np.flatnonzero(edges > 0)]
    last = bounds[np.flatnonzero(edges < 0)]
    return tuple(zip(first.tolist(), last.tolist(), strict=True))


def _errors(
    fits: Sequence[Fit],
    share: float,
) -> tuple[Interval, ...]:
    """Standard errors of the ends of the intervals.

    Half the distance between the ends at shares a standard error lower and higher; NaN where the
    number of intervals differs.
    """
    scatter = _scatter(share, len(fits))
    own = at_share(fits, share)
    less = at_share(fits, share - scatter)
    more = at_share(fits, share + scatter)
    if not len(less) == len(own) == len(more):
        return tuple((math.nan, math.nan) for _ in own)
    difference = np.reshape(more, (-1, 2)) - np.reshape(less, (-1, 2))
    half = 0.5 * np.abs(difference)
    return tuple((float(first), float(last)) for first, last in half)


def _scatter(
    share: float,
    number: int,
) -> float:
    """Standard error of a share of a number of draws."""
    return math.sqrt(share * (1.0 - share) / number)
