"""Quantiles of nucleation lengths whose parameters are known as ranges or as samples."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..theory.arrays import fault_of, without_aliases
from ..theory.fault import Values, takes_fault
from ..theory.status import BEYOND, STABLE
from ..types import Array
from .draws import Draws, Progress, draw
from .status import LITERATURE, TITLES, Answers, answers_of

if TYPE_CHECKING:
    import xarray as xr

QUANTILES = (0.05, 0.16, 0.5, 0.84, 0.95)
AT_ONCE = 10
"""Number of draws that are computed between two reports of progress."""


def quantiles(values: Array, shares: Array = np.array(QUANTILES)) -> Array:
    """Quantiles by Hazen's rule, which is exact for the draws of one range.

    Parameters
    ----------
    values : ndarray
        Of the draws, shape (n,); some may be infinite.
    shares : ndarray
        From 0 to 1, shape (m,).

    Returns
    -------
    ndarray
        Of shape (m,); NaN of no values.
    """
    if not values.size:
        return np.full(shares.size, np.nan)
    ordered = np.sort(values)
    position = np.clip(shares * values.size - 0.5, 0.0, values.size - 1.0)
    below = np.floor(position).astype(int)
    above = np.ceil(position).astype(int)
    found = np.full(shares.size, np.inf)
    finite = np.isfinite(ordered[above])
    low, high = ordered[below[finite]], ordered[above[finite]]
    found[finite] = low + (position - below)[finite] * (high - low)
    return found


def errors_of(values: Array) -> Array:
    """Standard errors of the quantiles, from the binomial scatter of their shares.

    Half the distance of the quantiles at ``q - s`` and ``q + s``, ``s^2 = q (1 - q)/n``; infinite
    if one of these is.

    Parameters
    ----------
    values : ndarray
        Of the draws, shape (n,); some may be infinite.

    Returns
    -------
    ndarray
        Of the shape of :data:`QUANTILES`.
    """
    shares = np.array(QUANTILES)
    scatter = np.sqrt(shares * (1.0 - shares) / max(values.size, 1))
    low, high = (quantiles(values, shares + sign * scatter) for sign in (-1.0, 1.0))
    with np.errstate(invalid="ignore"):
        return np.where(np.isinf(high), np.inf, 0.5 * (high - low))


@takes_fault
def length_quantiles(
    *, weakening_rate: Values | None = None, loading: str = "edge", draws: int = 1000,
    seed: int = 0, progress: Progress | None = None, **fault: Any,
) -> xr.Dataset:  # fmt: skip
    """Quantiles of all nucleation lengths of a fault whose parameters are uncertain.

    Parameters
    ----------
    weakening_rate : float, text or array_like, optional
        Slip weakening W (Pa/m) of Uenishi and Rice's length.
    loading : {"edge", "top", "remote"}
        Where the creeping patch of L_s begins.
    draws, seed : int
        Number of faults, and where the random numbers start: see
        :func:`~nucleation.answers.draws.draw`.
    progress : callable, optional
        Called now and then with the number of draws that are done and that of all.
    **fault
        The parameters of :class:`~nucleation.theory.fault.Fault`. A text such as
        ``"0.5um (0.3 to 1)"`` is a :class:`~nucleation.answers.draws.Range`: median, 5 and 95 %
        quantiles. Arrays of shape (n,) are joint samples.

    Returns
    -------
    Dataset
        ``value(key, quantile)`` (m), infinite where so many draws are stable, in which no patch of
        any length nucleates, or have an L_s beyond the longest that is searched; its standard
        ``error(key, quantile)`` (m) by the finite number of draws; and the ``share(key)`` of the
        valid draws that have the length. Draws for which a theory or formula does not apply are
        left out of its quantiles. Keys: ``critical_length`` (L_c), ``stability_length`` (L_s) and
        those of :data:`~nucleation.answers.in_use.LENGTHS`. Attributes: ``draws``; ``invalid``,
        no valid faults, with parameters that were ``outside``; ``stable``, without L_c;
        ``beyond``, with L_c and an L_s that is longer than searched.

    Raises
    ------
    ParameterError
        If a parameter is wrong or missing, or none is uncertain.
    """
    drawn = draw(without_aliases(fault) | {"weakening_rate": weakening_rate}, draws, seed)
    size = drawn.size
    answers = _answers_of_draws(drawn, loading, progress)
    lengths = np.array([answer.length for answer in answers.values()])
    statuses = np.array([answer.status for answer in answers.values()])
    counted = [with_never(x, status) for x, status in zip(lengths, statuses, strict=True)]
    there = np.isfinite(lengths)
    titles = TITLES | {length.key: length.title for length in LITERATURE}
    attributes = {
        "draws": drawn.total,
        "invalid": drawn.total - size,
        "outside": ", ".join(drawn.invalid),
        "stable": int(np.sum(~there[0])),
        "beyond": int(np.sum(statuses == BEYOND)),
        "seed": seed,
    }
    return table_of_quantiles(
        dict(zip(titles, counted, strict=True)), titles, there.mean(axis=1), attributes
    )


def _answers_of_draws(drawn: Draws, loading: str, progress: Progress | None) -> dict[str, Answers]:
    """The lengths of all draws, some at a time."""
    parts = []
    for start in range(0, drawn.size, AT_ONCE):
        rows = slice(start, min(start + AT_ONCE, drawn.size))
        values = drawn.at(rows)
        rate = values.pop("weakening_rate", None)
        found = answers_of(fault_of(values), rate, loading)
        shape = (rows.stop - rows.start,)
        parts.append({k: [np.broadcast_to(x, shape) for x in one] for k, one in found.items()})
        if progress is not None:
            progress(rows.stop, drawn.size)
    return {
        key: Answers(*(np.concatenate(x) for x in zip(*(part[key] for part in parts), strict=True)))
        for key in parts[0]
    }


def with_never(lengths: Array, statuses: Any) -> Array:
    """The lengths that count for quantiles: infinite where no patch nucleates.

    Parameters
    ----------
    lengths : ndarray
        Of the draws (m), shape (n,).
    statuses : ndarray
        Of the draws, shape (n,): those that are stable or longer than searched count as infinite;
        unknown ones are left out.
    """
    never = np.isin(statuses, [STABLE, BEYOND])
    counted = np.where(never, np.inf, lengths)
    return counted[np.isfinite(lengths) | never]


def table_of_quantiles(
    counted: dict[str, Array], titles: dict[str, str], share: Any, attributes: dict[str, Any]
) -> xr.Dataset:
    """Quantiles and their errors by length.

    Parameters
    ----------
    counted : dict
        Lengths of the draws (m) by key; some may be infinite.
    titles : dict
        The length in words, by key.
    share : array_like
        Share of the draws that have the length, in the order of the keys.
    attributes : dict
        Attributes of the dataset.

    Returns
    -------
    Dataset
        ``value`` and ``error`` (m) over ``key`` and ``quantile``, and ``share`` over ``key``.
    """
    import xarray as xr

    values = [quantiles(x) for x in counted.values()]
    errors = [errors_of(x) for x in counted.values()]
    error = {"units": "m", "long_name": "standard error by the number of draws"}
    return xr.Dataset(
        {
            "value": (("key", "quantile"), values, {"units": "m", "long_name": "length"}),
            "error": (("key", "quantile"), errors, error),
            "share": ("key", np.asarray(share), {"units": "1", "long_name": "share of draws"}),
        },
        coords={
            "key": list(counted),
            "title": ("key", [titles[key] for key in counted]),
            "quantile": list(QUANTILES),
        },
        attrs=attributes,
    )
