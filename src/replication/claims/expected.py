"""What a statement allows, what we found, and the verdict that follows (docs/claims.md).

A statement of the paper allows a range of numbers (:class:`Expected`); its width follows from the
kind of statement. Our result is one number or several, each with or without a range.
"""

import dataclasses
import enum
import math
from collections.abc import Callable, Mapping
from decimal import Decimal
from typing import Any, NamedTuple

import numpy as np

from nucleation.types import Array

FORMULA_TOLERANCE = 1e-6
"""Relative error up to which a formula holds; absolute error if its value is zero."""

WIDEST_ALLOWANCE = 0.10
"""Our uncertainty widens the range of a printed number by at most this part of the number."""

READINGS = (0.4, 0.33, 0.3, 0.25, 0.1)
"""Differences from one for which numbers are counted, where words are left to the reader."""

WORDS: dict[str, tuple[float, float, str]] = {
    "perfect": (0.98, 1.02, "within 2 % of one"),
    "extremely well": (0.98, 1.02, "within 2 % of one"),
    "computed": (0.99, 1.01, "within 1 % of one"),
    "expected": (0.75, 1.25, "within 25 % of one"),
    "small variation": (-0.10, 0.10, "less than 10 %"),
    "significant": (0.10, math.inf, "more than 10 %"),
    "negligible": (-0.01, 0.01, "less than 1 %"),
    "typical": (
        1.0 / math.sqrt(10.0),
        math.sqrt(10.0),
        "within half an order of magnitude",
    ),
    "about": (0.1, 10.0, "within an order of magnitude"),
    "most": (0.5, math.inf, "more than half"),
    "almost everywhere": (0.9, math.inf, "more than 90 %"),
    "much": (10.0, math.inf, "at least ten times"),
    "dramatically": (100.0, math.inf, "at least a hundred times"),
    "huge range": (
        3.0,
        math.inf,
        "at least three orders of magnitude",
    ),
}
"""How words are read: lower and upper end of the range that they allow, and the range in words."""

REASONED = (
    "perfect",
    "extremely well",
    "computed",
    "small variation",
    "significant",
)
"""Words whose reading follows from the paper or from the accuracy of a number. The readings of the
other words are our choice."""


class Verdict(enum.StrEnum):
    """Verdicts on claims, from best to worst."""

    REPLICATED = "replicated"
    GIVEN = "taken as given"
    WIDENED = "replicated within our uncertainty"
    EXPLAINED = "replicated with a deviation that is explained"
    OPEN = "left to the reader"
    NOT_SUPPORTED = "not supported"
    NOT_REPLICATED = "not replicated"
    UNCHECKED = "cannot be checked"


class Missing(LookupError):
    """A claim needs a result that is not there; the message names it."""


class Estimate(NamedTuple):
    """A number of ours and the ends of its range."""

    value: float
    low: float
    high: float


def between(value: float, *ends: float) -> Estimate:
    """A number with the range that contains it and some ends."""
    numbers = [float(value), *map(float, ends)]
    return Estimate(
        numbers[0],
        min(numbers),
        max(numbers),
    )


Found = Any
"""One number or several, also as an array; in a list each may be an Estimate."""


def listed(found: Found) -> list[Estimate | float]:
    """The numbers one by one."""
    if isinstance(found, Estimate):
        return [found]
    return found if isinstance(found, list) else np.ravel(found).tolist()


def value_of(one: Estimate | float) -> float:
    """A number without its range."""
    return one.value if isinstance(one, Estimate) else float(one)


@dataclasses.dataclass(frozen=True)
class Expected:
    """The range of numbers that a statement of the paper allows.

    Its kind is number, formula, bound, words or reading; `value` is the printed number or the
    formula's. `chosen`: the reading of the words is our choice.
    """

    kind: str
    low: float
    high: float
    text: str
    value: float | None = None
    chosen: bool = False

    def worst(self, found: Found) -> Estimate:
        """The least favourable of our numbers; NaN if one of them is NaN.

        A number without a range gets the range of all numbers, except for a formula.
        """
        several = listed(found)
        values = np.array([value_of(one) for one in several])
        if not np.isfinite(values).all():
            return between(math.nan)
        worst = several[int(np.argmax(self._distance(values)))]
        if isinstance(worst, Estimate):
            return worst
        if self.kind == "formula":
            return between(worst)
        return between(worst, values.min(), values.max())

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
    half = Decimal(1).scaleb(int(decimal.as_tuple().exponent)) / 2
    ends = float(decimal - half), float(decimal + half)
    return Expected(
        "number",
        *ends,
        printed,
        float(decimal),
    )


def formula(value: float, text: str = "") -> Expected:
    """A formula's value, exact except for round-off, and the formula as Markdown."""
    margin = FORMULA_TOLERANCE * (abs(value) or 1.0)
    text = text or f"{value:.6g}"
    return Expected(
        "formula",
        value - margin,
        value + margin,
        text,
        value,
    )


def words(expression: str) -> Expected:
    """Words, read by the table :data:`WORDS`."""
    low, high, reading = WORDS[expression]
    chosen = expression not in REASONED
    return Expected(
        "words",
        low,
        high,
        f"{expression}: {reading}",
        chosen=chosen,
    )


KINDS: dict[str, Callable[..., Expected]] = {
    "number": number,
    "formula": formula,
    "below": lambda bound: Expected(
        "bound",
        -math.inf,
        bound,
        f"< {bound:g}",
    ),
    "above": lambda bound: Expected(
        "bound",
        bound,
        math.inf,
        f"> {bound:g}",
    ),
    "words": words,
    "reading": lambda text: Expected(
        "reading",
        -math.inf,
        math.inf,
        text,
        1.0,
    ),
}


def read(entry: Mapping[str, Any]) -> Expected:
    """The range of an entry such as ``{number: "0.15"}`` or ``{formula: [1, Eq. (10)]}``."""
    ((kind, values),) = entry.items()
    return KINDS[kind](*(values if isinstance(values, list) else [values]))


@dataclasses.dataclass(frozen=True)
class Result:
    """What a claim's function found, if it is more than our numbers.

    `expected` replaces that of the claim, `papers` are the numbers on the paper's mesh, which is
    `mesh` in words. `explained` has our number without the cause of a difference, and a sentence.
    """

    found: Found
    expected: Expected | None = None
    papers: Found = None
    mesh: str = ""
    explained: tuple[Found, str] | None = None
    note: str = ""


Computation = Callable[[Any], Found | Result]
"""A claim's function: it computes our number from the evidence."""


def holds(expected: Expected, ours: Estimate) -> bool | None:
    """Whether our number agrees with the statement; None if it is NaN.

    Our uncertainty towards a printed number widens its range; otherwise ranges do not matter.
    """
    if math.isnan(ours.value):
        return None
    low, high = expected.low, expected.high
    if expected.kind == "number":
        widest = WIDEST_ALLOWANCE * abs(expected.value or 0.0)
        low -= min(ours.high - ours.value, widest)
        high += min(ours.value - ours.low, widest)
    if expected.kind in ("number", "formula"):
        return low <= ours.value <= high
    return low < ours.value < high


def judge(expected: Expected, result: Result) -> tuple[Verdict, str]:
    """The verdict on our numbers, and the reason in Markdown sentences."""
    ours = expected.worst(result.found)
    held = holds(expected, ours)
    if held is None:
        return Verdict.UNCHECKED, "A run has no such event."
    if expected.kind == "reading":
        return Verdict.OPEN, _by_reading(result)
    reason = _comparison(expected, ours, held)
    if not held and result.explained is not None:
        without, sentence = result.explained
        if holds(expected, expected.worst(without)):
            return Verdict.EXPLAINED, f"{reason} {sentence}"
    reason += _on_papers_mesh(expected, result, held)
    if held and (expected.low <= ours.value <= expected.high):
        return Verdict.REPLICATED, reason
    if held:
        return Verdict.WIDENED, reason
    return (Verdict.NOT_SUPPORTED if expected.chosen else Verdict.NOT_REPLICATED), reason


def _by_reading(result: Result) -> str:
    """How many of our numbers are within each difference from one."""

    def counts(found: Found) -> str:
        values = np.array([value_of(one) for one in listed(found)])
        if values.size == 1:
            return f"the difference from one is {100.0 * abs(values[0] - 1.0):.0f} %"
        near = [int(np.count_nonzero(np.abs(values - 1.0) < width)) for width in READINGS]
        widths = ", ".join(f"{100 * width:.0f}" for width in READINGS)
        return f"within {widths} % of one are {', '.join(map(str, near))} of {values.size}"

    first = counts(result.found)
    reason = f"{first[0].upper()}{first[1:]}."
    if result.papers is not None:
        reason += f" On {result.mesh} {counts(result.papers)}."
    return reason


def _comparison(
    expected: Expected,
    ours: Estimate,
    held: bool,
) -> str:
    """Sentences that compare our number with the paper's."""
    value = expected.value or 0.0
    if expected.kind == "formula":
        difference = abs(ours.value - value) / (abs(value) or 1.0)
        return f"The difference is {difference:.1g}."
    if expected.kind == "number":
        inside = expected.low <= ours.value <= expected.high
        widened = ", but by less than its own range" if held and not inside else ""
        where = "within" if inside else "outside"
        return f"{ours.value:.4g} is {where} {expected.low:g} to {expected.high:g}{widened}."
    bound = expected.text.partition(": ")[2] if expected.kind == "words" else expected.text
    reason = f"{ours.value:.4g} is {'' if held else 'not '}{bound}."
    nearest = min((expected.low, expected.high), key=lambda end: abs(end - ours.value))
    if ours.low <= nearest <= ours.high:
        reason += f" Its range reaches across the bound, {nearest:g}."
    return reason


def _on_papers_mesh(
    expected: Expected,
    result: Result,
    held: bool,
) -> str:
    """A sentence on whether the statement holds for the study ``paper`` too."""
    if result.papers is None:
        return ""
    other = expected.worst(result.papers)
    if not math.isfinite(other.value):
        return ""
    agrees = "does not hold"
    if holds(expected, other):
        agrees = "holds as well" if held else "holds"
    return f" On {result.mesh} it {agrees}, with {other.value:.4g}."
