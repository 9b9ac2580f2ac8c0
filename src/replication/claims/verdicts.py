"""What a statement allows, what we found, and the verdict that follows (docs/claims.md).

A statement of the paper allows a range of numbers (:class:`Expected`); its width follows from the
kind of statement. Our result is one number or several, each with or without a range.
"""

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

READINGS = (40, 33, 30, 25, 10)
"""Differences from one (%) for which numbers are counted beside words that are the reader's."""

_WORDS = """
perfect           |  0.98  | 1.02 | within 2 % of one
extremely well    |  0.98  | 1.02 | within 2 % of one
computed          |  0.99  | 1.01 | within 1 % of one
expected          |  0.75  | 1.25 | within 25 % of one
small variation   | -0.10  | 0.10 | less than 10 %
significant       |  0.10  | inf  | more than 10 %
negligible        | -0.01  | 0.01 | less than 1 %
typical           |  0.31622776601683794 | 3.1622776601683795 | within half an order of magnitude
about             |  0.1   | 10   | within an order of magnitude
most              |  0.5   | inf  | more than half
almost everywhere |  0.9   | inf  | more than 90 %
much              |  10    | inf  | at least ten times
dramatically      |  100   | inf  | at least a hundred times
huge range        |  3     | inf  | at least three orders of magnitude
"""
WORDS: dict[str, tuple[float, float, str]] = {
    words.strip(): (float(low), float(high), reading.strip())
    for words, low, high, reading in (line.split("|") for line in _WORDS.strip().splitlines())
}
"""How words are read: lower and upper end of the range that they allow, and the range in words."""

REASONED = ("perfect", "extremely well", "computed", "small variation", "significant")
"""Words whose reading follows from the paper or from the accuracy of a number. The readings of the
other words are our choice."""


class Verdict(enum.StrEnum):
    """Verdicts on claims, from best to worst."""

    REPLICATED = "replicated"
    GIVEN = "taken as given"
    WIDENED = "replicated within our uncertainty"
    EXPLAINED = "replicated with a deviation that is explained"
    NUMBER = "a number without a verdict"
    NOT_SUPPORTED = "not supported"
    NOT_REPLICATED = "not replicated"
    UNCHECKED = "cannot be checked"


class Missing(LookupError):
    """A claim needs a result that is not there; the message names it."""


Estimate = tuple[float, float, float]
"""A number of ours and the ends of its range."""

Found = Any
"""One number or several, also as an array; in a list each may be an Estimate."""


class Expected(NamedTuple):
    """The range of numbers that a statement of the paper allows.

    Its kind is number, formula, bound or words; `value` is the printed number or the formula's.
    `chosen`: the reading of the words is our choice.
    """

    kind: str
    low: float
    high: float
    text: str
    value: float | None = None
    chosen: bool = False


class Result(NamedTuple):
    """What a claim's function found, if it is more than our numbers.

    `expected` replaces that of the claim, `papers` are the numbers on the paper's mesh, which is
    `mesh` in words. `explained` has our number without the cause of a difference, and a sentence.
    `beside` has sentences on other numbers, which do not decide.
    """

    found: Found
    expected: Expected | None = None
    papers: Found = None
    mesh: str = ""
    explained: tuple[Found, str] | None = None
    beside: str = ""


Computation = Callable[[Any], Found | Result]
"""A claim's function: it computes our number from the evidence."""


def between(value: float, *ends: float) -> Estimate:
    """A number with the range that contains it and some ends."""
    numbers = [float(value), *map(float, ends)]
    return numbers[0], min(numbers), max(numbers)


def formula(value: float, text: str = "") -> Expected:
    """A formula's value, exact except for round-off, and the formula as Markdown."""
    margin = FORMULA_TOLERANCE * (abs(value) or 1.0)
    low, high = value - margin, value + margin
    return Expected("formula", low, high, text or f"{value:.6g}", value)


def read(entry: Mapping[str, Any]) -> Expected:
    """The range of an entry such as ``{number: "0.15"}`` or ``{formula: [1, Eq. (10)]}``."""
    match entry:
        case {"number": text}:  # exact to half a unit of its last digit
            printed = Decimal(text)
            half = Decimal(1).scaleb(int(printed.as_tuple().exponent)) / 2
            low, high = float(printed - half), float(printed + half)
            return Expected("number", low, high, text, float(printed))
        case {"formula": [value, text]}:
            return formula(value, text)
        case {"below": bound}:
            return Expected("bound", -math.inf, bound, f"< {bound:g}")
        case {"above": bound}:
            return Expected("bound", bound, math.inf, f"> {bound:g}")
        case {"words": text}:
            low, high, reading = WORDS[text]
            chosen = text not in REASONED
            return Expected("words", low, high, f"{text}: {reading}", chosen=chosen)
    raise ValueError(f"expected = {entry} has no known kind")


def _listed(found: Found) -> Array:
    """Value and ends of each number, (n, 3); the ends are NaN for one without a range."""
    several = found if isinstance(found, list) else np.ravel(found).tolist()
    if isinstance(found, tuple):
        several = [found]
    rows = [one if isinstance(one, tuple) else (one, math.nan, math.nan) for one in several]
    return np.array(rows, float).reshape(-1, 3)


def worst(expected: Expected, found: Found) -> Estimate:
    """The least favourable of our numbers; NaN if one of them is NaN.

    A number without a range gets the range of all numbers, except for a formula.
    """
    rows = _listed(found)
    values = rows[:, 0]
    if not np.isfinite(values).all():
        return between(math.nan)
    if expected.value is not None:
        distance = np.abs(values - expected.value)
    elif math.isinf(expected.high):
        distance = -values
    elif math.isinf(expected.low):
        distance = values
    else:
        best = 1.0 if expected.low > 0.0 else 0.0
        distance = np.abs(values - best)
    value, *ends = rows[np.argmax(distance)]
    if np.isfinite(ends).all():
        return between(value, *ends)
    if expected.kind == "formula":
        return between(value)
    return between(value, values.min(), values.max())


def holds(expected: Expected, ours: Estimate) -> bool | None:
    """Whether our number agrees with the statement; None if it is NaN.

    Our uncertainty towards a printed number widens its range; otherwise ranges do not matter.
    """
    value, *_ = ours
    if math.isnan(value):
        return None
    low, high = allowed(expected, ours)
    if expected.kind in ("number", "formula"):
        return low <= value <= high
    return low < value < high


def allowed(expected: Expected, ours: Estimate) -> tuple[float, float]:
    """The ends of the range in which our number agrees with the statement."""
    value, least, most = ours
    low, high = expected.low, expected.high
    if expected.kind == "number":
        widest = WIDEST_ALLOWANCE * abs(expected.value or 0.0)
        low -= min(most - value, widest)
        high += min(value - least, widest)
    return low, high


def nearest_end(expected: Expected, ours: Estimate) -> float:
    """The value of our number at which it begins, or ceases, to agree with the statement."""
    return min(allowed(expected, ours), key=lambda end: abs(end - ours[0]))


def judge(expected: Expected, result: Result) -> tuple[Verdict, str]:
    """The verdict on our numbers, and the reason in Markdown sentences."""
    ours = worst(expected, result.found)
    held = holds(expected, ours)
    if held is None:
        return Verdict.UNCHECKED, "A run has no such event."
    inside = expected.low <= ours[0] <= expected.high
    reason = _comparison(expected, ours, held, inside)
    if not held and result.explained is not None:
        without, sentence = result.explained
        if holds(expected, worst(expected, without)):
            return Verdict.EXPLAINED, f"{reason} {sentence}"
    if result.papers is not None:
        other = worst(expected, result.papers)
        same = holds(expected, other)
        if same is not None:
            agrees = "holds as well" if held and same else "holds" if same else "does not hold"
            reason += f" On {result.mesh} it {agrees}, with {other[0]:.4g}."
    reason = f"{reason} {result.beside}".rstrip()
    if held:
        return (Verdict.REPLICATED if inside else Verdict.WIDENED), reason
    return (Verdict.NOT_SUPPORTED if expected.chosen else Verdict.NOT_REPLICATED), reason


def near_one(found: Found) -> str:
    """How many of our numbers are within each difference from one."""
    differences = np.abs(_listed(found)[:, 0] - 1.0)
    if differences.size == 1:
        return f"the difference from one is {100.0 * differences[0]:.0f} %"
    near = [str(np.count_nonzero(differences < width / 100.0)) for width in READINGS]
    widths = ", ".join(map(str, READINGS))
    return f"within {widths} % of one are {', '.join(near)} of {differences.size}"


def _comparison(expected: Expected, ours: Estimate, held: bool, inside: bool) -> str:
    """Sentences that compare our number with the paper's."""
    value, least, most = ours
    if expected.kind == "formula":
        exact = expected.value or 0.0
        difference = abs(value - exact) / (abs(exact) or 1.0)
        return f"The difference is {difference:.1g}."
    if expected.kind == "number":
        widened = ", but by less than its own range" if held and not inside else ""
        where = "within" if inside else "outside"
        return f"{value:.4g} is {where} {expected.low:.4g} to {expected.high:.4g}{widened}."
    bound = expected.text.partition(": ")[2] or expected.text
    reason = f"{value:.4g} is {'' if held else 'not '}{bound}."
    nearest = min((expected.low, expected.high), key=lambda end: abs(end - value))
    if least <= nearest <= most:
        reason += f" Its range reaches across the bound, {nearest:g}."
    return reason
