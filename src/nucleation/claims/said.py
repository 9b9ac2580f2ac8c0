"""What the paper says and what we find as numbers with ranges, and when the two agree.

What the paper says is a range of numbers (:class:`Said`), with a width that follows from the kind
of statement; ours is a number with a range (:class:`Ours`). docs/claims.md states the rule.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable, Mapping
from decimal import Decimal
from typing import Any, SupportsFloat

import numpy as np

from ..types import Array

FORMULA_TOLERANCE = 1e-6
"""A formula holds if it is met to this part of its value (of one, if the value is zero)."""

WIDEST_ALLOWANCE = 0.10
"""Our uncertainty widens a stated number by no more than this part of it."""

WORDS: dict[str, tuple[float, float, str]] = {
    "perfect": (0.98, 1.02, "within 2 % of one"),
    "extremely well": (0.98, 1.02, "within 2 % of one"),
    "computed": (0.99, 1.01, "within 1 % of one"),
    "reasonably good": (0.6, 1.4, "within 40 % of one"),
    "expected": (0.75, 1.25, "within 25 % of one"),
    "small variation": (-0.10, 0.10, "less than 10 %"),
    "significant": (0.10, math.inf, "more than 10 %"),
    "negligible": (-0.01, 0.01, "less than 1 %"),
    "typical": (1.0 / math.sqrt(10.0), math.sqrt(10.0), "within half an order of magnitude"),
    "about": (0.1, 10.0, "within an order of magnitude"),
    "most": (0.5, math.inf, "more than half"),
    "almost everywhere": (0.9, math.inf, "more than 90 %"),
    "much": (10.0, math.inf, "at least ten times"),
    "dramatically": (100.0, math.inf, "at least a hundred times"),
    "huge range": (3.0, math.inf, "at least three orders of magnitude"),
}
"""How words are read: lower and upper end of what they allow, and the reading in words."""

REASONED = (
    "perfect",
    "extremely well",
    "computed",
    "reasonably good",
    "small variation",
    "significant",
)
"""Words whose reading follows from the paper or from how a number is had; the others are a choice
of ours (docs/claims.md)."""


class Missing(LookupError):
    """What a claim needs is not among the results; the message says what."""


@dataclasses.dataclass(frozen=True)
class Ours:
    """A number of ours with the range in which it lies."""

    value: float
    low: float
    high: float

    @classmethod
    def exactly(cls, value: SupportsFloat) -> Ours:
        """A number without uncertainty."""
        return cls(float(value), float(value), float(value))

    @classmethod
    def between(cls, value: float, low: float, high: float) -> Ours:
        """A number and the ends of its range, which may come in either order."""
        return cls(float(value), float(min(low, high, value)), float(max(low, high, value)))

    @classmethod
    def within(cls, value: float, error: float) -> Ours:
        """A number with a symmetric uncertainty."""
        return cls.between(value, value - abs(error), value + abs(error))

    def __float__(self) -> float:
        return self.value


Found = Ours | SupportsFloat | Iterable[SupportsFloat]
"""What a claim's function gives: our number, with or without a range, or several."""


@dataclasses.dataclass(frozen=True)
class Said:
    """What the paper says: a number as printed, or what it allows, and the ends of that."""

    kind: str  # number, formula, bound or words
    low: float
    high: float
    text: str
    value: float | None = None
    chosen: bool = False  # whether the reading is a choice of ours

    def worst(self, found: Found) -> Ours:
        """Of our numbers that which speaks most against what is said; NaN if one is NaN.

        Those without a range get that of all, but for a formula; others keep their own.
        """
        several = np.ravel(np.asarray(found))
        values = several.astype(float)
        if not np.isfinite(values).all():
            return Ours.exactly(math.nan)
        worst = several[np.argmax(self._against(values))]
        if isinstance(worst, Ours):
            return worst
        ends = (worst, worst) if self.kind == "formula" else (values.min(), values.max())
        return Ours.between(worst, *ends)

    def _against(self, values: Array) -> Array:
        """How far numbers are from where the statement holds best."""
        if self.value is None and math.isinf(self.high - self.low):
            return -values if math.isinf(self.high) else values
        best = 1.0 if self.low > 0.0 else 0.0
        return np.abs(values - (best if self.value is None else self.value))


def number(printed: str) -> Said:
    """A printed number, meant to half a unit of its last digit, such as ``"0.15"``."""
    decimal = Decimal(printed)
    half = Decimal(1).scaleb(int(decimal.as_tuple().exponent)) / 2
    return Said("number", float(decimal - half), float(decimal + half), printed, float(decimal))


def formula(value: float, text: str = "") -> Said:
    """A formula's value, exact but for round-off."""
    margin = FORMULA_TOLERANCE * (abs(value) or 1.0)
    return Said("formula", value - margin, value + margin, text or f"{value:.6g}", value=value)


def below(bound: float, text: str = "") -> Said:
    """Less than a bound."""
    return Said("bound", -math.inf, bound, text or f"< {bound:g}")


def above(bound: float, text: str = "") -> Said:
    """More than a bound."""
    return Said("bound", bound, math.inf, text or f"> {bound:g}")


def words(expression: str) -> Said:
    """Words, read by the table :data:`WORDS`."""
    low, high, reading = WORDS[expression]
    return Said("words", low, high, f"{expression}: {reading}", chosen=expression not in REASONED)


def read(entry: Mapping[str, Any]) -> Said:
    """What an entry such as ``{number: "0.15"}`` or ``{formula: [1, Eq. (10)]}`` says."""
    ((kind, values),) = entry.items()
    said = {kind.__name__: kind for kind in (number, formula, below, above, words)}[kind]
    return said(*values) if isinstance(values, list) else said(values)


def holds(said: Said, ours: Ours) -> bool | None:
    """Whether our number is what the paper says; None if ours can't decide.

    - A stated *number* holds if ours lies within half a unit of its last digit, widened by our
      uncertainty towards it, but by no more than :data:`WIDEST_ALLOWANCE` of the number.
    - A *formula* holds to :data:`FORMULA_TOLERANCE`; a number of ours that is less certain than
      that does not decide.
    - A *bound*, or *words* with their reading, hold if ours lies inside; ours without its range.
    """
    if not math.isfinite(ours.value):
        return None
    up, down = ours.high - ours.value, ours.value - ours.low
    if said.kind == "number":
        widest = WIDEST_ALLOWANCE * abs(said.value or 0.0)
        return said.low - min(up, widest) <= ours.value <= said.high + min(down, widest)
    if said.kind == "formula":
        known = max(up, down) <= 0.5 * (said.high - said.low)
        return said.low <= ours.value <= said.high if known else None
    return said.low < ours.value < said.high
