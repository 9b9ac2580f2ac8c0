"""Random draws of faults with uncertain parameters, which are given as ranges or samples."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
from scipy.special import ndtri

from ..model.quantities import ParameterError, Quantity, check, declared
from ..model.units import NUMBER, magnitude, parse
from ..theory.values import QUANTITIES, checked, inside
from ..types import Array
from .in_use import WEAKENING_RATE

DRAWS = declared("number of draws", "[20, 1e6]", kind="int")
_SEED = declared("seed", "[0, 4294967296]", kind="int")
SAMPLED = {name: entry for name, entry in QUANTITIES.items() if not entry.worded}
SAMPLED["weakening_rate"] = WEAKENING_RATE
"""Declarations of the parameters that may be uncertain."""
_RANGE = re.compile(r"(.+)\((.+?)\s+(?:to|-|–)\s+(.+)\)\s*")

Progress = Callable[[int, int], None]
"""A function of the number of finished faults and the total number."""


class Range(float):
    """A median with its 5 and 95 % quantiles, in SI units.

    Notes
    -----
    The distribution is log-normal where the ends and all allowed values are positive, so that no
    stress or distance is drawn negative; otherwise it is normal, as for zeta. The two sides of the
    median have different widths, so that the three numbers are exact quantiles.
    """

    low: float
    high: float

    def __new__(
        cls,
        value: float,
        low: float,
        high: float,
    ) -> Range:
        """Make a range; the caller has checked that the three values are in order.

        Parameters
        ----------
        value : float
            Median, in SI units.
        low, high : float
            Quantiles of 5 and 95 %, in the same unit.
        """
        own = super().__new__(cls, value)
        own.low = low
        own.high = high
        return own

    def quantiles(
        self,
        share: Array,
        entry: Quantity,
    ) -> Array:
        """Quantiles of the distribution.

        Parameters
        ----------
        share : ndarray
            Probabilities between 0 and 1, shape (n,).
        entry : Quantity
            Declaration of the parameter.

        Returns
        -------
        ndarray
            Values in SI units, shape (n,).
        """
        ends = np.array([self.low, float(self), self.high])
        positive = entry.low >= 0.0 and self.low > 0.0
        low, middle, high = np.log(ends) if positive else ends
        side = np.where(share < 0.5, middle - low, high - middle)
        width = side / ndtri(0.95)
        found = middle + width * ndtri(share)
        return np.exp(found) if positive else found


def parse_range(
    key: str,
    text: str,
    entry: Quantity,
) -> Any:
    """Read a range such as ``0.5um (0.3 to 1)``, or a single value.

    Parameters
    ----------
    key : str
        Name of the parameter, for messages.
    text : str
        The value, with the unit of the parameter or none; ends without a unit have that of the
        median.
    entry : Quantity
        Declaration of the parameter.

    Returns
    -------
    Range, float, int or str
        In SI units.

    Raises
    ------
    ParameterError
        If a number is not allowed or infinite, or the three are not in order.
    """
    parts = _RANGE.fullmatch(text)
    if parts is None:
        return parse(key, text, entry)
    median, *ends = parts.groups()
    value = parse(key, median.strip(), entry)
    number = NUMBER.fullmatch(median)
    unit = number[3] if number else ""
    low, high = (parse(key, with_default_unit(end, unit), entry) for end in ends)
    in_order = low <= value <= high and low < high
    if not in_order or not np.isfinite([low, high]).all():
        raise ParameterError(
            f"{key} = {text!r} is not allowed: it must be VALUE (LOW to HIGH), the median between "
            "the quantiles of 5 and 95 %, all finite"
        )
    return Range(value, low, high)


def with_default_unit(
    text: str,
    unit: str,
) -> str:
    """A number with a unit.

    Parameters
    ----------
    text : str
        The number, with its own unit or without one.
    unit : str
        The unit of a number without one.

    Returns
    -------
    str
    """
    number = NUMBER.fullmatch(text)
    lacks_unit = number is not None and not number[3]
    return f"{text} {unit}" if lacks_unit else text


class Draws(NamedTuple):
    """Faults drawn from ranges and samples."""

    values: dict[str, Any]
    """Parameters in SI units: arrays of shape (n,) if uncertain, else numbers and words."""
    invalid: dict[str, int]
    """Number of draws outside the allowed range of each parameter; they are left out."""
    total: int
    """Number of all draws, valid or not."""

    @property
    def size(self) -> int:
        """Number of valid draws."""
        arrays = [value for value in self.values.values() if np.ndim(value)]
        return np.size(arrays[0])

    def at(
        self,
        rows: Any,
    ) -> dict[str, Any]:
        """The parameters of one draw, by its index, or of a slice of draws."""
        chosen = {}
        for name, value in self.values.items():
            chosen[name] = value[rows] if np.ndim(value) else value
        return chosen


def draw(
    parameters: Mapping[str, Any],
    draws: int = 1000,
    seed: int = 0,
    known: Mapping[str, Quantity] = SAMPLED,
) -> Draws:
    """Draw faults: samples row by row, ranges independently of each other and of samples.

    The ranges are drawn by Latin hypercube sampling (McKay, Beckman and Conover, 1979): each range
    is divided into as many intervals of equal probability as there are draws, and each interval
    is used once. The draws of a range do not depend on the other parameters.

    Parameters
    ----------
    parameters : mapping
        Numbers, words, :class:`Range` or its text, and arrays of shape (n,) of joint samples.
    draws : int
        Number of draws. Of more samples, this many evenly spaced rows are used; of fewer samples
        all.
    seed : int
        Random seed.
    known : mapping
        Declarations of the parameters that may be uncertain.

    Returns
    -------
    Draws

    Raises
    ------
    ParameterError
        If nothing is uncertain, samples differ in number, or no draw is a valid fault.
    """
    check("draws", draws, DRAWS)
    check("seed", seed, _SEED)
    fixed, ranges, samples = _by_kind(parameters, known)
    if not (ranges or samples):
        raise ParameterError("no parameter has a range, VALUE (LOW to HIGH), or samples")
    sizes = {len(sample) for sample in samples.values()}
    if len(sizes) > 1 or 0 in sizes:
        counts = ", ".join(f"{name} {len(sample)}" for name, sample in samples.items())
        raise ParameterError(f"samples must be equal in number, and one at least: {counts}")
    size = max(sizes, default=draws)
    rows = np.linspace(0, size - 1, min(size, draws))
    rows = rows.round().astype(int)
    drawn = {name: sample[rows] for name, sample in samples.items()}
    for name, own in ranges.items():
        position = list(known).index(name)
        order = np.random.default_rng([seed, position]).permutation(rows.size)
        drawn[name] = own.quantiles((order + 0.5) / rows.size, known[name])

    valid = np.full(rows.size, True)
    invalid = {}
    for name, values in drawn.items():
        allowed = inside(values, known[name])
        valid &= allowed
        if not allowed.all():
            invalid[name] = int(np.sum(~allowed))
    if not valid.any():
        raise ParameterError(f"no draw is a valid fault: not allowed are {invalid}")
    kept = {name: values[valid] for name, values in drawn.items()}
    return Draws(fixed | kept, invalid, rows.size)


def _by_kind(
    parameters: Mapping[str, Any],
    known: Mapping[str, Quantity],
) -> tuple[dict[str, Any], dict[str, Range], dict[str, Array]]:
    """Fixed parameters, ranges and samples, in SI units."""
    fixed: dict[str, Any] = {}
    ranges: dict[str, Range] = {}
    samples: dict[str, Array] = {}
    for name, value in parameters.items():
        if name not in known or value is None:  # a word; Fault refuses unknown names
            fixed[name] = value
            continue
        entry = known[name]
        if isinstance(value, str):
            value = parse_range(name, value, entry)
        if isinstance(value, Range):
            ranges[name] = value
            continue
        array = np.asarray(magnitude(name, value, entry))
        if array.ndim == 0:
            fixed[name] = checked(name, array, entry)
        elif array.ndim == 1 and array.dtype.kind in "iuf":
            samples[name] = array.astype(float)
        else:
            raise ParameterError(f"{name}: samples must be numbers in a row, not {array.shape}")
    return fixed, ranges, samples
