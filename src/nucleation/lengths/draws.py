"""Uncertain parameters: ranges and samples become arrays of draws, and lengths their quantiles."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from ..model.quantities import ParameterError, check
from ..model.units import magnitude
from ..theory.status import BEYOND, STABLE
from ..theory.values import checked
from ..types import Array
from .ranges import DRAWS, SAMPLED, Range, parse_range

QUANTILES = (0.05, 0.16, 0.5, 0.84, 0.95)


class Draws(NamedTuple):
    """Arrays of draws by parameter; those outside a parameter's allowed range are left out."""

    values: dict[str, Any]
    """Parameters in SI units: arrays of shape (n,) if uncertain, else as given."""
    invalid: dict[str, int]
    """Number of draws outside the allowed range of each parameter."""
    total: int
    """Number of all draws, valid or not."""
    uncertain: tuple[str, ...]
    """Names of the uncertain parameters."""


def draw_samples(parameters: Mapping[str, Any], draws: int = 200, seed: int = 0) -> Draws:
    """Draw the uncertain parameters of a fault: ranges independently, samples row by row.

    The ranges are drawn by Latin hypercube sampling (McKay, Beckman and Conover, 1979): each range
    is divided into as many intervals of equal probability as there are draws, and each interval
    is used once. The draws of a range do not depend on the other parameters.

    Parameters
    ----------
    parameters : mapping
        Of :class:`~nucleation.fault.Fault`, by name. A text such as ``"5um (3 to 10)"`` is a
        median with its 5 and 95 % quantiles; arrays of shape (n,) are joint samples.
    draws : int
        Number of draws. Of more samples, this many evenly spaced rows are used; of fewer all.
    seed : int
        Random seed.

    Returns
    -------
    Draws

    Raises
    ------
    ParameterError
        If nothing is uncertain, samples differ in number, or no draw is a valid fault.

    Examples
    --------
    >>> from nucleation.api import Fault
    >>> drawn = draw_samples({"slip_distance": "5um (3 to 10)", "a": 0.010, "b": 0.015}, draws=100)
    >>> rock = Fault(shear_modulus=30e9, poisson_ratio=0.25, normal_stress=50e6, **drawn.values)
    >>> quantiles(rock.critical_length()).round(2)
    array([1.51, 1.85, 2.52, 3.82, 5.03])
    """
    check("draws", draws, DRAWS)
    fixed, ranges, samples = _by_kind(parameters)
    if not (ranges or samples):
        raise ParameterError("no parameter has a range, VALUE (LOW to HIGH), or samples")
    sizes = {len(sample) for sample in samples.values()}
    if len(sizes) > 1 or 0 in sizes:
        counts = ", ".join(f"{name} {len(sample)}" for name, sample in samples.items())
        raise ParameterError(f"samples must be equal in number, and one at least: {counts}")
    size = max(sizes, default=draws)
    rows = np.linspace(0, size - 1, min(size, draws)).round().astype(int)
    drawn = {name: sample[rows] for name, sample in samples.items()}
    for name, own in ranges.items():
        position = list(SAMPLED).index(name)
        order = np.random.default_rng([seed, position]).permutation(rows.size)
        drawn[name] = own.values_at((order + 0.5) / rows.size, SAMPLED[name])
    allowed = {name: SAMPLED[name].inside(values) for name, values in drawn.items()}
    valid = np.all(list(allowed.values()), axis=0)
    invalid = {name: int(np.sum(~own)) for name, own in allowed.items() if not own.all()}
    if not valid.any():
        raise ParameterError(f"no draw is a valid fault: not allowed are {invalid}")
    kept = {name: values[valid] for name, values in drawn.items()}
    return Draws(fixed | kept, invalid, rows.size, tuple(drawn))


def _by_kind(
    parameters: Mapping[str, Any],
) -> tuple[dict[str, Any], dict[str, Range], dict[str, Array]]:
    """Fixed parameters, ranges and samples, in SI units."""
    fixed: dict[str, Any] = {}
    ranges: dict[str, Range] = {}
    samples: dict[str, Array] = {}
    for name, value in parameters.items():
        if name not in SAMPLED or value is None:  # a word; Fault refuses unknown names
            fixed[name] = value
            continue
        entry = SAMPLED[name]
        if isinstance(value, str):
            value = parse_range(name, value, entry)
        if isinstance(value, Range):
            ranges[name] = value
            continue
        array = np.asarray(magnitude(name, value, entry))
        if array.ndim == 0:
            fixed[name] = float(checked(name, array, entry))
        elif array.ndim == 1 and array.dtype.kind in "iuf":
            samples[name] = array.astype(float)
        else:
            raise ParameterError(f"{name}: samples must be numbers in a row, not {array.shape}")
    return fixed, ranges, samples


def quantiles(values: Any, shares: Any = QUANTILES) -> Array:
    """Quantiles of the lengths of draws by Hazen's rule, which is exact for draws of one range.

    Parameters
    ----------
    values : array_like
        Of the draws, shape (n,); some may be infinite.
    shares : array_like
        Probabilities between 0 and 1, shape (m,).

    Returns
    -------
    ndarray
        Shape (m,); NaN if there are no values.

    Examples
    --------
    >>> quantiles([3.0, 1.0, 2.0], [0.5])
    array([2.])
    """
    ordered = np.sort(np.ravel(values))
    shares = np.asarray(shares)
    if not ordered.size:
        return np.full(shares.size, np.nan)
    position = np.clip(shares * ordered.size - 0.5, 0.0, ordered.size - 1.0)
    below = np.floor(position).astype(int)
    above = np.ceil(position).astype(int)
    found = np.full(shares.size, np.inf)
    finite = np.isfinite(ordered[above])
    low = ordered[below[finite]]
    high = ordered[above[finite]]
    found[finite] = low + (position - below)[finite] * (high - low)
    return found


def errors_of_quantiles(values: Array) -> Array:
    """Standard errors of the :data:`QUANTILES` by the binomial scatter of their shares.

    Half the distance between the quantiles at ``q - s`` and ``q + s``, ``s^2 = q (1 - q)/n``;
    infinite if one of them is.
    """
    shares = np.array(QUANTILES)
    scatter = np.sqrt(shares * (1.0 - shares) / max(values.size, 1))
    low = quantiles(values, shares - scatter)
    high = quantiles(values, shares + scatter)
    with np.errstate(invalid="ignore"):
        return np.where(np.isinf(high), np.inf, 0.5 * (high - low))


def with_never(lengths: Any, statuses: Any) -> Array:
    """Lengths for quantiles: infinite where no patch nucleates, without unknown ones."""
    never = np.isin(statuses, [STABLE, BEYOND])
    counted = np.where(never, np.inf, lengths)
    return counted[np.isfinite(lengths) | never]
