"""A parameter with a range, ``5um (3 to 10)``: its text and its distribution."""

from __future__ import annotations

import re
from typing import Any

import numpy as np

from ..model.friction.constants import ZETA_OVER_A
from ..model.quantities import ParameterError, Quantity, declared
from ..model.units import NUMBER, parse
from ..theory.values import QUANTITIES
from ..types import Array

WEAKENING_RATE = declared(
    "rate of linear slip weakening of the shear strength", "(0.0, 1e25) Pa/m", symbol="W"
)
DRAWS = declared("number of draws", "[20, 1e6]", kind="int")
SAMPLED = {name: entry for name, entry in QUANTITIES.items() if not entry.worded}
SAMPLED["weakening_rate"] = WEAKENING_RATE
SAMPLED["zeta_over_a"] = ZETA_OVER_A
"""Declarations of the parameters that may be uncertain."""

_RANGE = re.compile(r"(.+)\((.+?)\s+(?:to|-|–)\s+(.+)\)\s*")


class Range(float):
    """A median with its 5 and 95 % quantiles, in SI units.

    The distribution is log-normal where the ends and all allowed values are positive, so that no
    stress or distance is drawn negative; otherwise it is normal, as for zeta. The two sides of the
    median have different widths, so that the three numbers are exact quantiles.
    """

    low: float
    high: float

    def __new__(cls, value: float, low: float, high: float) -> Range:
        own = super().__new__(cls, value)
        own.low = low
        own.high = high
        return own

    def values_at(self, share: Array, entry: Quantity) -> Array:
        """Values at probabilities between 0 and 1."""
        from scipy.special import ndtri

        ends = np.array([self.low, float(self), self.high])
        positive = entry.low >= 0.0 and self.low > 0.0
        low, middle, high = np.log(ends) if positive else ends
        side = np.where(share < 0.5, middle - low, high - middle)
        width = side / ndtri(0.95)
        found = middle + width * ndtri(share)
        return np.exp(found) if positive else found


def parse_range(key: str, text: str, entry: Quantity) -> Any:
    """Read ``0.5um (0.3 to 1)``, a :class:`Range`, or a single value, in SI units.

    Ends without a unit have that of the median.
    """
    parts = _RANGE.fullmatch(text)
    if parts is None:
        return parse(key, text, entry)
    median, *ends = parts.groups()
    value = parse(key, median.strip(), entry)
    number = NUMBER.fullmatch(median)
    unit = number[3] if number else ""
    for i, end in enumerate(ends):
        own = NUMBER.fullmatch(end)
        ends[i] = f"{end} {unit}" if own is not None and not own[3] else end
    low, high = (parse(key, end, entry) for end in ends)
    in_order = low <= value <= high and low < high
    if not in_order or not np.isfinite([low, high]).all():
        raise ParameterError(
            f"{key} = {text!r} is not allowed: it must be VALUE (LOW to HIGH), the median between "
            "the quantiles of 5 and 95 %, all finite"
        )
    return Range(value, low, high)
