"""Backwards for uncertain faults: the share of them whose length fits into a specimen."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ..theory.arrays import without_aliases
from ..theory.fault import Values, checked, takes_fault
from ..types import Array
from .draws import Progress, draw
from .specimen import CRITERIA, SPECIMEN, Fit, specimen_fit
from .uncertainty import QUANTILES

Interval = tuple[float, float]


class SpecimenQuantiles(NamedTuple):
    """At which values of a parameter a length fits into a specimen, in which share of the draws.

    Where an end of an interval is one of `searched`, the length may fit beyond it too.
    """

    unknown: str  # the parameter that was looked for
    unit: str
    intervals: dict[float, tuple[Interval, ...]]  # by share: values at which so many draws fit
    errors: dict[float, tuple[Interval, ...]]  # standard errors of their ends, NaN if not known
    searched: Interval  # values that were looked at
    draws: int  # number of draws, invalid ones among them
    invalid: int  # draws that are no valid fault
    outside: tuple[str, ...]  # parameters outside their range in these
    share: float  # of the draws, in which it fits at the parameter's own value; NaN without one
    share_error: float  # its standard error by the number of draws


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
    """Values of one parameter at which a length fits into a specimen, for uncertain faults.

    Parameters
    ----------
    unknown : {"normal_stress", "slip_distance", "shear_modulus"}
        The parameter to find, as for :func:`~nucleation.answers.specimen.specimen_fit`. If `fault`
        has it too, the share of the draws that nucleate with it is computed.
    length : float
        Of the specimen along the fault (m).
    criterion : {"critical", "stability"}
        The length that has to fit, L_c or L_s.
    within : (float, float), optional
        Values to look at.
    draws, seed : int
        Number of faults, and where the random numbers start. A fault takes 0.1 s for L_c and about
        2 s for L_s.
    progress : callable, optional
        Called with the number of draws that are done and that of all.
    **fault
        The parameters of :class:`~nucleation.theory.fault.Fault`, some of them a
        :class:`~nucleation.answers.draws.Range`, a text of one, or samples of shape (n,).

    Returns
    -------
    SpecimenQuantiles

    Raises
    ------
    ParameterError
        If a parameter is wrong or missing, or none is uncertain.
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
    intervals = {q: at_share(fits, q) for q in QUANTILES}
    errors = {q: _errors(fits, q) for q in QUANTILES}
    return SpecimenQuantiles(
        unknown,
        fits[0].unit,
        intervals,
        errors,
        fits[0].searched,
        drawn.total,
        drawn.total - drawn.size,
        tuple(drawn.invalid),
        share,
        _scatter(share, len(fits)),
    )


def at_share(fits: Sequence[Fit], share: float) -> tuple[Interval, ...]:
    """Values at which the length fits in a share of several cases, or in more.

    Parameters
    ----------
    fits : sequence of Fit
        One for each case, of one unknown and one range that was searched.
    share : float
        From 0 to 1.
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
    first, last = bounds[np.flatnonzero(edges > 0)], bounds[np.flatnonzero(edges < 0)]
    return tuple(zip(first.tolist(), last.tolist(), strict=True))


def _errors(fits: Sequence[Fit], share: float) -> tuple[Interval, ...]:
    """Standard errors of the ends of the intervals: half their distance a standard error apart.

    NaN where there are more or fewer intervals a standard error of the share away.
    """
    scatter = _scatter(share, len(fits))
    own, *near = (at_share(fits, share + sign * scatter) for sign in (0.0, -1.0, 1.0))
    if any(len(other) != len(own) for other in near):
        return tuple((math.nan, math.nan) for _ in own)
    less, more = (np.array(other, dtype=float).reshape(-1, 2) for other in near)
    half: Array = 0.5 * np.abs(more - less)
    return tuple((float(first), float(last)) for first, last in half)


def _scatter(share: float, number: int) -> float:
    """Standard error of a share of a number of draws."""
    return math.sqrt(share * (1.0 - share) / number)
