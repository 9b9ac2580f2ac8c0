"""Faults drawn from parameters that are known as ranges or as samples."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
from scipy.special import ndtri

from ..model.quantities import ParameterError, Quantity, check
from ..model.units import NUMBER, magnitude, parse
from ..theory.values import QUANTITIES, checked, inside
from ..types import Array
from .in_use import WEAKENING_RATE

DRAWS = Quantity("number of draws", low=20, high=1e6, closed="both", kind="int")
SEED = Quantity("seed", low=0, high=2**32, closed="both", kind="int")
SAMPLED = {k: x for k, x in QUANTITIES.items() if not x.worded} | {"weakening_rate": WEAKENING_RATE}
"""Declarations of the parameters that may be uncertain."""
_RANGE = re.compile(r"(.+)\((.+?)\s+(?:to|-|–)\s+(.+)\)\s*")

Progress = Callable[[int, int], None]
"""Called with the number of faults that are done and the number of all."""


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
    value = parse(key, parts[1].strip(), entry)
    first = NUMBER.fullmatch(parts[1])
    unit = first[3] if first else ""
    ends = []
    for end in parts.groups()[1:]:
        number = NUMBER.fullmatch(end)
        ends.append(f"{end} {unit}" if number and not number[3] else end)
    low, high = (parse(key, end, entry) for end in ends)
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

    @property
    def size(self) -> int:
        """Number of valid draws."""
        return next(np.size(x) for x in self.values.values() if np.ndim(x))

    def at(self, rows: Any) -> dict[str, Any]:
        """The parameters of some draws: of one, by its index, or of a slice."""
        return {name: x[rows] if np.ndim(x) else x for name, x in self.values.items()}


def draw(
    parameters: Mapping[str, Any],
    draws: int = 1000,
    seed: int = 0,
    known: Mapping[str, Quantity] = SAMPLED,
) -> Draws:
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
        Where the random numbers start that combine the parts of ranges.
    known : mapping
        Declarations of the parameters that may be uncertain.

    Raises
    ------
    ParameterError
        If nothing is uncertain, samples differ in number, or no draw is a valid fault.
    """
    check("draws", draws, DRAWS)
    check("seed", seed, SEED)
    fixed, ranges, samples = _sorted(parameters, known)
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
        order = np.random.default_rng([seed, list(known).index(name)]).permutation(rows.size)
        drawn[name] = own.quantiles((order + 0.5) / rows.size, known[name])
    allowed = {name: inside(values, known[name]) for name, values in drawn.items()}
    valid = np.logical_and.reduce(list(allowed.values()))
    invalid = {name: int(np.sum(~own)) for name, own in allowed.items() if not own.all()}
    if not valid.any():
        raise ParameterError(f"no draw is a valid fault: not allowed are {invalid}")
    kept = {name: values[valid] for name, values in drawn.items()}
    return Draws(fixed | kept, invalid, rows.size)


def _sorted(
    parameters: Mapping[str, Any], known: Mapping[str, Quantity]
) -> tuple[dict[str, Any], dict[str, Range], dict[str, Array]]:
    """Parameters that are fixed, ranges and samples, in SI units; None is left out."""
    fixed: dict[str, Any] = {}
    ranges: dict[str, Range] = {}
    samples: dict[str, Array] = {}
    for name, value in parameters.items():
        entry = known.get(name)
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
