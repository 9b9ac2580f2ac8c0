"""Quantiles of nucleation lengths of faults with uncertain parameters."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from ..theory.arrays import fault_of, without_aliases
from ..theory.fault import Values, takes_fault
from ..theory.status import BEYOND, STABLE
from ..types import Array
from .draws import Draws, Progress, draw
from .status import TITLES_OF_ALL, Answers, answers_of

if TYPE_CHECKING:
    import xarray as xr

QUANTILES = (0.05, 0.16, 0.5, 0.84, 0.95)
_AT_ONCE = 10
"""Number of draws that are computed between two reports of progress."""


def quantiles(
    values: Array,
    shares: Array = np.array(QUANTILES),
) -> Array:
    """Quantiles by Hazen's rule, which is exact for the draws of one range.

    Parameters
    ----------
    values : ndarray
        Values of the draws, shape (n,); some may be infinite.
    shares : ndarray
        Probabilities between 0 and 1, shape (m,).

    Returns
    -------
    ndarray
        Shape (m,); NaN if there are no values.
    """
    if not values.size:
        return np.full(shares.size, np.nan)
    ordered = np.sort(values)
    position = np.clip(shares * values.size - 0.5, 0.0, values.size - 1.0)
    below = np.floor(position).astype(int)
    above = np.ceil(position).astype(int)
    found = np.full(shares.size, np.inf)
    finite = np.isfinite(ordered[above])
    low = ordered[below[finite]]
    high = ordered[above[finite]]
    part = (position - below)[finite]
    found[finite] = low + part * (high - low)
    return found


def _errors_of(values: Array) -> Array:
    """Standard errors of the quantiles, from the binomial scatter of their shares.

    Half the distance between the quantiles at ``q - s`` and ``q + s``, ``s^2 = q (1 - q)/n``;
    infinite if one of them is.
    """
    shares = np.array(QUANTILES)
    scatter = np.sqrt(shares * (1.0 - shares) / max(values.size, 1))
    low = quantiles(values, shares - scatter)
    high = quantiles(values, shares + scatter)
    with np.errstate(invalid="ignore"):
        return np.where(np.isinf(high), np.inf, 0.5 * (high - low))


@takes_fault
def length_quantiles(
    *,
    weakening_rate: Values | None = None,
    draws: int = 1000,
    seed: int = 0,
    progress: Progress | None = None,
    **fault: Any,
) -> xr.Dataset:
    """Quantiles of all nucleation lengths of a fault whose parameters are uncertain.

    Parameters
    ----------
    weakening_rate : float, text or array_like, optional
        Slip weakening W (Pa/m) of Uenishi and Rice's length.
    draws : int
        Number of faults; see :func:`~nucleation.lengths.draws.draw`.
    seed : int
        Random seed.
    progress : callable, optional
        Called with the number of finished draws and the total number.
    **fault
        The parameters of :class:`~nucleation.api.fault.Fault`. A text such as
        ``"0.5um (0.3 to 1)"`` is a :class:`~nucleation.lengths.draws.Range`: median, 5 and 95 %
        quantiles. Arrays of shape (n,) are joint samples.

    Returns
    -------
    Dataset
        ``value(key, quantile)`` (m), its standard ``error(key, quantile)`` (m) by the finite number
        of draws, and the ``share(key)`` of the valid draws that have the length. A length counts as
        infinite if the draw is stable, so that no patch nucleates, or if L_s exceeds the range of
        the search. Draws for which a theory or formula is not applicable are left out of its
        quantiles. Keys: ``critical_length`` (L_c), ``stability_length`` (L_s) and those of
        :data:`~nucleation.lengths.in_use.LENGTHS`. Attributes, numbers of draws: ``draws``, all;
        ``invalid``, no valid faults, because the parameters in ``outside`` are not allowed;
        ``stable``, without L_c; ``beyond``, with L_c and an L_s beyond the range of the search.

    Raises
    ------
    ParameterError
        If a parameter is wrong or missing, or none is uncertain.

    Examples
    --------
    >>> fault = {"shear_modulus": 30e9, "poisson_ratio": 0.25, "normal_stress": 50e6}
    >>> found = length_quantiles(
    ...     **fault, a=0.010, b=0.015, slip_distance="5um (3 to 10)", draws=50
    ... )
    >>> median = found["value"].sel(key="critical_length", quantile=0.5)
    >>> round(float(median), 2)
    2.52
    """
    parameters = without_aliases(fault) | {"weakening_rate": weakening_rate}
    drawn = draw(parameters, draws, seed)
    answers = _answers_of_draws(drawn, progress)
    lengths = np.array([answer.length for answer in answers.values()])
    statuses = np.array([answer.status for answer in answers.values()])
    counted = {
        key: with_never(length, status)
        for key, length, status in zip(answers, lengths, statuses, strict=True)
    }
    there = np.isfinite(lengths)
    attributes = {
        "draws": drawn.total,
        "invalid": drawn.total - drawn.size,
        "outside": ", ".join(drawn.invalid),
        "stable": int(np.sum(~there[0])),
        "beyond": int(np.sum(statuses == BEYOND)),
        "seed": seed,
    }
    return table_of_quantiles(counted, TITLES_OF_ALL, there.mean(axis=1), attributes)


def _answers_of_draws(
    drawn: Draws,
    progress: Progress | None,
) -> dict[str, Answers]:
    """The lengths of all draws, computed in parts."""
    parts: dict[str, list[list[Array]]] = {}
    for start in range(0, drawn.size, _AT_ONCE):
        stop = min(start + _AT_ONCE, drawn.size)
        values = drawn.at(slice(start, stop))
        rate = values.pop("weakening_rate", None)
        found = answers_of(fault_of(values), rate)
        for key, answer in found.items():
            columns = [np.broadcast_to(column, (stop - start,)) for column in answer]
            parts.setdefault(key, []).append(columns)
        if progress is not None:
            progress(stop, drawn.size)

    answers = {}
    for key, of_key in parts.items():
        columns = [np.concatenate(pieces) for pieces in zip(*of_key, strict=True)]
        answers[key] = Answers(*columns)
    return answers


def with_never(
    lengths: Array,
    statuses: Any,
) -> Array:
    """The lengths for quantiles: infinite where no patch nucleates.

    Parameters
    ----------
    lengths : ndarray
        Lengths of the draws (m), shape (n,).
    statuses : array_like
        Their statuses, shape (n,).

    Returns
    -------
    ndarray
        Shape (m,): inf where the status is ``stable`` or ``beyond``, without ``unknown`` lengths.
    """
    never = np.isin(statuses, [STABLE, BEYOND])
    counted = np.where(never, np.inf, lengths)
    return counted[np.isfinite(lengths) | never]


def table_of_quantiles(
    counted: Mapping[str, Array],
    titles: Mapping[str, str],
    share: ArrayLike,
    attributes: Mapping[str, Any],
) -> xr.Dataset:
    """Quantiles and their errors for several lengths.

    Parameters
    ----------
    counted : mapping
        Lengths of the draws (m), arrays of shape (n,) by key; some lengths may be infinite.
    titles : mapping
        Titles by key.
    share : array_like
        Share of the draws that have the length, in the order of the keys.
    attributes : mapping
        Attributes of the dataset.

    Returns
    -------
    Dataset
        ``value`` and ``error`` (m) over ``key`` and ``quantile``, and ``share`` over ``key``.
    """
    import xarray as xr

    values = [quantiles(x) for x in counted.values()]
    errors = [_errors_of(x) for x in counted.values()]
    both = ("key", "quantile")
    of_value = {"units": "m", "long_name": "length"}
    of_error = {"units": "m", "long_name": "standard error by the number of draws"}
    of_share = {"units": "1", "long_name": "share of draws"}
    return xr.Dataset(
        {
            "value": (both, values, of_value),
            "error": (both, errors, of_error),
            "share": ("key", np.asarray(share), of_share),
        },
        coords={
            "key": list(counted),
            "title": ("key", [titles[key] for key in counted]),
            "quantile": list(QUANTILES),
        },
        attrs=attributes,
    )
