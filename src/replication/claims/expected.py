"""The paper's statements and our results as numbers with ranges, and the rule that compares them.

A statement of the paper allows a range of numbers (:class:`Expected`); its width follows from the
kind of statement. Our result is a number with a range (:class:`Estimate`). The rule is in
docs/claims.md.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Callable, Iterable, Mapping
from decimal import Decimal
from typing import Any, Literal, SupportsFloat

import numpy as np

from nucleation.types import Array

FORMULA_TOLERANCE = 1e-6
"""Relative error up to which a formula holds; absolute error if its value is zero."""

WIDEST_ALLOWANCE = 0.10
"""Our uncertainty widens the range of a printed number by at most this part of the number."""

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
"""How words are read: lower and upper end of the range that they allow, and the range in words."""

REASONED = (
    "perfect",
    "extremely well",
    "computed",
    "reasonably good",
    "small variation",
    "significant",
)
"""Words whose reading follows from the paper or from the accuracy of a number. The readings of the
other words are our choice (docs/claims.md)."""


class Missing(LookupError):
    """A claim needs a result that is not there; the message names it."""


@dataclasses.dataclass(frozen=True)
class Estimate:
    """A number of ours and its range."""

    value: float
    low: float
    high: float

    @classmethod
    def exactly(cls, value: SupportsFloat) -> Estimate:
        """A number without uncertainty."""
        return cls(float(value), float(value), float(value))

    @classmethod
    def between(
        cls,
        value: float,
        low: float,
        high: float,
    ) -> Estimate:
        """A number and two ends of its range.

        Parameters
        ----------
        value : float
            The number.
        low, high : float
            The ends, in either order. The range is widened if it does not contain the number.
        """
        return cls(
            value=float(value),
            low=float(min(low, high, value)),
            high=float(max(low, high, value)),
        )

    @classmethod
    def within(
        cls,
        value: float,
        error: float,
    ) -> Estimate:
        """A number with a symmetric uncertainty.

        Parameters
        ----------
        value : float
            The number.
        error : float
            Half the width of the range; its sign is ignored.
        """
        error = abs(error)
        return cls.between(value, value - error, value + error)

    def __float__(self) -> float:
        return self.value


Estimates = Estimate | SupportsFloat | Iterable[SupportsFloat]
"""The result of a claim's function: one number or several, each with or without a range."""


@dataclasses.dataclass(frozen=True)
class Expected:
    """The range of numbers that a statement of the paper allows.

    Attributes
    ----------
    kind : "number", "formula", "bound" or "words"
        Kind of statement.
    low, high : float
        Ends of the range.
    text : str
        The number, formula, bound or words as Markdown.
    value : float, optional
        The printed number, or the formula's value.
    chosen : bool
        Whether the reading of the words is our choice.
    """

    kind: Literal["number", "formula", "bound", "words"]
    low: float
    high: float
    text: str
    value: float | None = None
    chosen: bool = False

    def worst(self, estimates: Estimates) -> Estimate:
        """The least favourable of our numbers; NaN if one of them is NaN.

        A number without a range gets the range of all numbers, except for a formula.
        """
        several = np.ravel(np.asarray(estimates))
        values = several.astype(float)
        if not np.isfinite(values).all():
            return Estimate.exactly(math.nan)
        worst = several[np.argmax(self._distance(values))]
        if isinstance(worst, Estimate):
            return worst
        if self.kind == "formula":
            return Estimate.exactly(worst)
        return Estimate.between(worst, values.min(), values.max())

    def _distance(self, values: Array) -> Array:
        """Distances from the number at which the statement holds best."""
        if self.value is not None:
            return np.abs(values - self.value)
        if math.isinf(self.high):
            return -values
        if math.isinf(self.low):
            return values
        best = 1.0 if self.low > 0.0 else 0.0
        return np.abs(values - best)


def number(printed: str) -> Expected:
    """A printed number such as ``"0.15"``, exact to half a unit of its last digit."""
    decimal = Decimal(printed)
    unit = Decimal(1).scaleb(int(decimal.as_tuple().exponent))
    return Expected(
        kind="number",
        low=float(decimal - unit / 2),
        high=float(decimal + unit / 2),
        text=printed,
        value=float(decimal),
    )


def formula(
    value: float,
    text: str = "",
) -> Expected:
    """A formula's value, exact except for round-off.

    Parameters
    ----------
    value : float
        The value.
    text : str
        The formula as Markdown; by default the value with six digits.
    """
    margin = FORMULA_TOLERANCE * (abs(value) or 1.0)
    return Expected(
        kind="formula",
        low=value - margin,
        high=value + margin,
        text=text or f"{value:.6g}",
        value=value,
    )


def below(bound: float) -> Expected:
    """Less than a bound."""
    return Expected("bound", -math.inf, bound, f"< {bound:g}")


def above(bound: float) -> Expected:
    """More than a bound."""
    return Expected("bound", bound, math.inf, f"> {bound:g}")


def words(expression: str) -> Expected:
    """Words, read by the table :data:`WORDS`."""
    low, high, reading = WORDS[expression]
    return Expected(
        kind="words",
        low=low,
        high=high,
        text=f"{expression}: {reading}",
        chosen=expression not in REASONED,
    )


_KINDS: dict[str, Callable[..., Expected]] = {
    "number": number,
    "formula": formula,
    "below": below,
    "above": above,
    "words": words,
}


def read(entry: Mapping[str, Any]) -> Expected:
    """The range of an entry such as ``{number: "0.15"}`` or ``{formula: [1, Eq. (10)]}``."""
    ((kind, values),) = entry.items()
    arguments = values if isinstance(values, list) else [values]
    return _KINDS[kind](*arguments)


def holds(
    expected: Expected,
    ours: Estimate,
) -> bool | None:
    """Whether our number agrees with the statement.

    - A printed *number* holds if ours is within half a unit of its last digit. Our uncertainty
      towards the number widens this range, by at most :data:`WIDEST_ALLOWANCE` of the number.
    - A *formula* holds to :data:`FORMULA_TOLERANCE`. If our number is less certain than that, it
      decides nothing.
    - A *bound* or *words* hold if our number, without its range, is inside.

    Parameters
    ----------
    expected : Expected
        The statement.
    ours : Estimate
        Our number, in the same unit.

    Returns
    -------
    bool or None
        None if our number decides nothing.
    """
    if not math.isfinite(ours.value):
        return None
    up = ours.high - ours.value
    down = ours.value - ours.low
    if expected.kind == "number":
        widest = WIDEST_ALLOWANCE * abs(expected.value or 0.0)
        low = expected.low - min(up, widest)
        high = expected.high + min(down, widest)
        return low <= ours.value <= high
    if expected.kind == "formula":
        margin = 0.5 * (expected.high - expected.low)
        if max(up, down) > margin:
            return None
        return expected.low <= ours.value <= expected.high
    return expected.low < ours.value < expected.high
