"""Quantiles of nucleation lengths whose parameters are known as ranges or as samples."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import ndtri

from ..model.quantities import ParameterError, Quantity, check
from ..model.units import NUMBER, magnitude, parse
from ..theory.arrays import critical_length, fault_of, without_aliases
from ..theory.creep.lengths import stability_values
from ..theory.fault import takes_fault
from ..theory.values import QUANTITIES, Values, checked, inside
from ..types import Array
from .in_use import LENGTHS, THIS_FAULT, WEAKENING_RATE, values_of

if TYPE_CHECKING:
    import xarray as xr

QUANTILES = (0.05, 0.16, 0.5, 0.84, 0.95)
DRAWS = Quantity("number of draws", low=20, high=1e6, closed="both", kind="int")
SEED = Quantity("seed", low=0, high=2**32, closed="both", kind="int")
SAMPLED = {k: x for k, x in QUANTITIES.items() if not x.worded} | {"weakening_rate": WEAKENING_RATE}
"""Declarations of the parameters that may be uncertain."""
_RANGE = re.compile(r"(.+)\((.+?)\s+(?:to|-|–)\s+(.+)\)\s*")
_TITLES = {"critical_length": "critical length L_c", "stability_length": "stability length L_s"}


class Range(float):
    """A value, the median, with the 5 and 95 % quantiles around it, in SI units.

    Notes
    -----
    Log-normal where the ends and all allowed values are positive, so that no stress or distance is
    drawn negative; normal otherwise, as for zeta. Each side of the median has its own width, so
    that the three numbers are quantiles as given.
    """

    low: float
    high: float

    def __new__(cls, value: float, low: float, high: float) -> Range:
        """The range; the caller has checked ``low <= value <= high``."""
        own = super().__new__(cls, value)
        own.low, own.high = low, high
        return own

    def quantiles(self, share: Array, entry: Quantity) -> Array:
        """The values below which given shares of all fluctuations lie, both of shape (n,)."""
        ends = np.array([self.low, float(self), self.high])
        positive = entry.low >= 0.0 and self.low > 0.0
        low, middle, high = np.log(ends) if positive else ends
        width = np.where(share < 0.5, middle - low, high - middle) / ndtri(0.95)
        found = middle + width * ndtri(share)
        return np.exp(found) if positive else found


def parse_range(key: str, text: str, entry: Quantity) -> Any:
    """The :class:`Range` that a text such as ``0.5um (0.3 to 1)`` means; a number as `parse` does.

    Ends without a unit have that of the value.

    Raises
    ------
    ParameterError
        If one of the numbers is not allowed, infinite or in the wrong place.
    """
    parts = _RANGE.fullmatch(text)
    if parts is None:
        return parse(key, text, entry)
    first = NUMBER.fullmatch(parts[1])
    unit = first[3] if first else ""
    ends = []
    for end in parts.groups()[1:]:
        number = NUMBER.fullmatch(end)
        ends.append(f"{end} {unit}" if number and not number[3] else end)
    low, value, high = (parse(key, one, entry) for one in (ends[0], parts[1], ends[1]))
    if not (low <= value <= high and low < high and np.isfinite([low, high]).all()):
        raise ParameterError(
            f"{key} = {text!r} is not allowed: it must be VALUE (LOW to HIGH), the median between "
            "the quantiles of 5 and 95 %, all finite"
        )
    return Range(value, low, high)


class Draws(NamedTuple):
    """Faults drawn from ranges and samples."""

    values: dict[str, Any]  # SI units; arrays of shape (n,) of what was drawn, numbers and words
    invalid: dict[str, int]  # draws left out, by the parameter outside its allowed range
    total: int  # number of draws, those left out among them


def draw(parameters: Mapping[str, Any], draws: int = 1000, seed: int = 0) -> Draws:
    """Draw faults: samples row by row, ranges independently of each other and of samples.

    Each range is cut into as many parts of equal probability as there are draws, and each part is
    used once (Latin hypercube sampling: McKay, Beckman and Conover, 1979). How a range is drawn
    does not depend on what else is uncertain.

    Parameters
    ----------
    parameters : mapping
        Numbers, words, :class:`Range` or texts of one, and arrays of shape (n,): joint samples.
    draws : int
        Number of draws; fewer if the samples are fewer, and of more samples as many, evenly spaced.
    seed : int
        Of the order in which parts of ranges meet.

    Raises
    ------
    ParameterError
        If nothing is uncertain, samples differ in number, or no draw is a valid fault.
    """
    check("draws", draws, DRAWS)
    check("seed", seed, SEED)
    fixed, ranges, samples = _sorted(parameters)
    sizes = {len(sample) for sample in samples.values()}
    if not (ranges or samples):
        raise ParameterError("no parameter has a range, VALUE (LOW to HIGH), or samples")
    if len(sizes) > 1 or 0 in sizes:
        told = ", ".join(f"{name} {len(sample)}" for name, sample in samples.items())
        raise ParameterError(f"samples must be equal in number, and one at least: {told}")
    size = max(sizes, default=draws)
    rows = np.linspace(0, size - 1, min(size, draws)).round().astype(int)
    drawn = {name: sample[rows] for name, sample in samples.items()}
    for name, own in ranges.items():
        order = np.random.default_rng([seed, list(SAMPLED).index(name)]).permutation(rows.size)
        drawn[name] = own.quantiles((order + 0.5) / rows.size, SAMPLED[name])
    allowed = {name: inside(values, SAMPLED[name]) for name, values in drawn.items()}
    valid = np.logical_and.reduce(list(allowed.values()))
    invalid = {name: int(np.sum(~own)) for name, own in allowed.items() if not own.all()}
    if not valid.any():
        raise ParameterError(f"no draw is a valid fault: not allowed are {invalid}")
    kept = {name: values[valid] for name, values in drawn.items()}
    return Draws(fixed | kept, invalid, rows.size)


def _sorted(
    parameters: Mapping[str, Any],
) -> tuple[dict[str, Any], dict[str, Range], dict[str, Array]]:
    """Parameters that are fixed, ranges and samples, in SI units; None is left out."""
    fixed: dict[str, Any] = {}
    ranges: dict[str, Range] = {}
    samples: dict[str, Array] = {}
    for name, value in parameters.items():
        entry = SAMPLED.get(name)
        own = parse_range(name, value, entry) if entry and isinstance(value, str) else value
        if entry is None or own is None:  # a word; Fault refuses unknown names
            fixed[name] = own
        elif isinstance(own, Range):
            ranges[name] = own
        elif np.ndim(own := np.asarray(magnitude(name, own, entry))) == 0:
            fixed[name] = checked(name, own, entry)
        elif own.ndim == 1 and own.dtype.kind in "iuf":
            samples[name] = own.astype(float)
        else:
            raise ParameterError(f"{name}: samples must be numbers in a row, not {own.shape}")
    return fixed, ranges, samples


def _stable_draws(key: str, there: NDArray[np.bool_], stable: NDArray[np.bool_]) -> Any:
    """The draws in which no patch nucleates by a length: for those of the theory, all without it.

    A formula of the literature has none where friction does not weaken; elsewhere it does not hold.
    """
    return ~there if key in _TITLES else ~there & stable


def _quantiles(values: Array, shares: Array) -> Array:
    """Quantiles by Hazen's rule, which is exact for the draws of one range; values may be infinite.

    NaN of no values.
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


def _errors(values: Array) -> Array:
    """Standard errors of the quantiles, from the binomial scatter of their shares.

    Half the distance of the quantiles at ``q - s`` and ``q + s``, ``s^2 = q (1 - q)/n``; infinite
    if one of these is.
    """
    shares = np.array(QUANTILES)
    scatter = np.sqrt(shares * (1.0 - shares) / max(values.size, 1))
    low, high = (_quantiles(values, shares + sign * scatter) for sign in (-1.0, 1.0))
    with np.errstate(invalid="ignore"):
        return np.where(np.isinf(high), np.inf, 0.5 * (high - low))


@takes_fault
def length_quantiles(
    *, weakening_rate: Values | None = None, loading: str = "edge", draws: int = 1000,
    seed: int = 0, **fault: Any,
) -> xr.Dataset:  # fmt: skip
    """Quantiles of all nucleation lengths of a fault whose parameters are uncertain.

    Parameters
    ----------
    weakening_rate : float, text or array_like, optional
        Slip weakening W (Pa/m) of Uenishi and Rice's length.
    loading : {"edge", "top", "remote"}
        Where the creeping patch of L_s begins.
    draws, seed : int
        Number of faults, and where the random numbers start: see :func:`draw`.
    **fault
        The parameters of :class:`~nucleation.theory.fault.Fault`. A text such as
        ``"0.5um (0.3 to 1)"`` is a :class:`Range`: median, 5 and 95 % quantiles. Arrays of shape
        (n,) are joint samples.

    Returns
    -------
    Dataset
        ``value(key, quantile)`` (m), infinite where so many draws are stable, which no patch of
        any length nucleates; its standard ``error(key, quantile)`` (m) by the finite number of
        draws; and the ``share(key)`` of the valid draws that have the length. Draws for which a
        formula of the literature does not hold are left out of its quantiles. Keys:
        ``critical_length`` (L_c), ``stability_length`` (L_s) and those of
        :data:`~nucleation.answers.in_use.LENGTHS`. Attributes: ``draws``; ``invalid``,
        no valid faults, with parameters that were ``outside``; ``stable``, without L_c.

    Raises
    ------
    ParameterError
        If a parameter is wrong or missing, or none is uncertain.
    """
    import xarray as xr

    drawn = draw(without_aliases(fault) | {"weakening_rate": weakening_rate}, draws, seed)
    values = dict(drawn.values)
    rate = values.pop("weakening_rate", None)
    own = fault_of(values)
    others = [length for length in LENGTHS if length.system != THIS_FAULT]
    lengths = {
        "critical_length": critical_length(**values),
        "stability_length": stability_values(own, None, loading)[0],
        **values_of(own, rate, others),
    }
    size = next(np.size(x) for x in drawn.values.values() if np.ndim(x))
    arrays = np.array([np.broadcast_to(x, (size,)) for x in lengths.values()])
    there = np.isfinite(arrays)
    stable = np.broadcast_to(own.zeta <= 0.0, (size,))
    never = [_stable_draws(key, there, stable) for key, there in zip(lengths, there, strict=True)]
    counted = [
        np.append(x[has], np.full(np.sum(none), np.inf))
        for x, has, none in zip(arrays, there, never, strict=True)
    ]
    found = [_quantiles(x, np.array(QUANTILES)) for x in counted]
    errors = [_errors(x) for x in counted]
    titles = _TITLES | {length.key: length.title for length in others}
    return xr.Dataset(
        {
            "value": (("key", "quantile"), found, {"units": "m", "long_name": "length"}),
            "error": (
                ("key", "quantile"),
                errors,
                {"units": "m", "long_name": "standard error by the number of draws"},
            ),
            "share": ("key", there.mean(axis=1), {"units": "1", "long_name": "share of draws"}),
        },
        coords={
            "key": list(lengths), "title": ("key", [titles[key] for key in lengths]),
            "quantile": list(QUANTILES),
        },
        attrs={
            "draws": drawn.total, "invalid": drawn.total - size,
            "outside": ", ".join(drawn.invalid), "stable": int(np.sum(~there[0])), "seed": seed,
        },
    )  # fmt: skip
