"""A claim: one quantitative statement of the paper, and the verdict on it.

The verdict follows from :func:`replication.claims.expected.holds` alone. The rule is in
docs/claims.md.
"""

import dataclasses
import enum
import math
from collections.abc import Callable
from typing import Any

from . import phrases
from .expected import Estimate, Estimates, Expected, Missing, holds

Row = dict[str, Any]
"""A row of the table of claims: values by column."""


class Verdict(enum.StrEnum):
    """Verdicts on claims."""

    REPLICATED = "replicated"
    GIVEN = "taken as given"
    EXPLAINED = "replicated with a deviation that is explained"
    NOT_SUPPORTED = "not supported"
    NOT_REPLICATED = "not replicated"
    UNCHECKED = "cannot be checked"


@dataclasses.dataclass(frozen=True)
class Result:
    """The result of a claim's function, if it is more than our number.

    Attributes
    ----------
    estimates : Estimates
        The number, or several, that the verdict depends on.
    expected : Expected, optional
        Replaces that of the claim, if it depends on the configuration.
    on_papers_mesh : Estimates, optional
        The same from the study ``paper``, if it was also evaluated.
    mesh : str
        Mesh of that study, in words.
    without_cause : Estimates, optional
        Our number, or several, without a possible cause of a difference.
    cause : str
        Start of the sentence that ends with that number.
    finding : str
        Section of docs/results.md about the cause.
    note : str
        Sentences after the reason.
    """

    estimates: Estimates
    expected: Expected | None = None
    on_papers_mesh: Estimates | None = None
    mesh: str = phrases.PAPERS
    without_cause: Estimates | None = None
    cause: str = ""
    finding: str = ""
    note: str = ""


Computation = Callable[[Any], Estimates | Result]
"""Computes our number from the evidence: the subject's datasets, such as
:class:`~replication.claims.evidence.Evidence`."""


@dataclasses.dataclass(frozen=True)
class Claim:
    """One statement of the paper and how our number for it is computed; texts are Markdown.

    Attributes
    ----------
    id : str
        Unique name.
    where : str
        Section, equation, figure or table of the paper.
    statement : str
        The statement in our words.
    quotation : str
        The paper's own words, LaTeX without spacing commands.
    method : str
        How our number is computed.
    compute : callable or None
        Computes our number; None if that is impossible.
    expected : Expected, optional
        The numbers that the statement allows; the function may give them instead.
    unit : str
        SI unit of the numbers.
    input : bool
        Whether our number is an input of the configuration, so that it is no result.
    carried : bool
        Whether the paper's statement is on homogeneous sliding and we apply it to a pushed patch.
    note : str
        Sentences after the reason; the reason itself if nothing can be computed.
    """

    id: str
    where: str
    statement: str
    quotation: str
    method: str
    compute: Computation | None
    expected: Expected | None = None
    unit: str = "1"
    input: bool = False
    carried: bool = False
    note: str = ""

    def evaluate(self, evidence: Any) -> Row:
        """The claim's row: the paper's number and ours, the verdict and its reason.

        Raises
        ------
        ValueError
            If neither the claim nor its function gives an expected range.
        """
        try:
            result = self._result(evidence)
        except Missing as missing:
            return self._row(self.expected, None, None, Verdict.UNCHECKED, f"{missing}.")
        expected = result.expected or self.expected
        if expected is None:
            raise ValueError(f"the claim {self.id} has nothing to compare with")
        if self.carried:
            expected = dataclasses.replace(expected, chosen=True)
        verdict, reason = judge(expected, result)
        if self.input:
            verdict, reason = _of_input(verdict, reason)
        note = result.note or self.note
        if note:
            reason += f" {note}"
        ours = expected.worst(result.estimates)
        other = None
        if result.on_papers_mesh is not None:
            other = expected.worst(result.on_papers_mesh)
        return self._row(expected, ours, other, verdict, reason)

    def _result(self, evidence: Any) -> Result:
        if self.compute is None:
            raise Missing(self.note)
        found = self.compute(evidence)
        return found if isinstance(found, Result) else Result(found)

    def _row(
        self,
        expected: Expected | None,
        ours: Estimate | None,
        other: Estimate | None,
        verdict: Verdict,
        reason: str,
    ) -> Row:
        if ours is not None and math.isnan(ours.value):
            ours = None
        return {
            "id": self.id,
            "where": self.where,
            "statement": self.statement,
            "quotation": self.quotation,
            "paper": expected and expected.text,
            "paper_range": expected and [_finite(expected.low), _finite(expected.high)],
            "kind": expected and expected.kind,
            "ours": ours and ours.value,
            "uncertainty": ours and [ours.low, ours.high],
            "on_papers_mesh": other and _finite(other.value),
            "unit": self.unit,
            "method": self.method,
            "verdict": str(verdict),
            "reason": reason,
        }


def judge(
    expected: Expected,
    result: Result,
) -> tuple[Verdict, str]:
    """The verdict and the reason for it.

    Parameters
    ----------
    expected : Expected
        The numbers that the statement allows.
    result : Result
        Our numbers, in the same unit.

    Returns
    -------
    verdict : Verdict
    reason : str
        Sentences in Markdown.
    """
    ours = expected.worst(result.estimates)
    held = holds(expected, ours)
    if held is None:
        return Verdict.UNCHECKED, _why_undecided(ours)
    comparison = _comparison(expected, ours, held) + _reach(expected, ours)
    if not held and result.without_cause is not None:
        without = expected.worst(result.without_cause)
        if holds(expected, without):
            why = f"{result.cause} {without.value:.4g} (results: {result.finding})."
            return Verdict.EXPLAINED, f"{comparison} {why}"
    reason = comparison + _other_mesh(expected, result)
    if held:
        return Verdict.REPLICATED, reason
    if expected.chosen:
        return Verdict.NOT_SUPPORTED, reason
    return Verdict.NOT_REPLICATED, reason


def _of_input(
    verdict: Verdict,
    reason: str,
) -> tuple[Verdict, str]:
    """The verdict on an input of ours: no result, whether it is the paper's or another."""
    if verdict is Verdict.REPLICATED:
        return Verdict.GIVEN, f"It is an input of the paper and of our runs. {reason}"
    return Verdict.UNCHECKED, f"It is an input, and these runs have another. {reason}"


def _why_undecided(ours: Estimate) -> str:
    if math.isnan(ours.value):
        return "A run has no such event."
    width = max(ours.high - ours.value, ours.value - ours.low)
    return f"Our number is known to {width:.1g} only."


def _comparison(
    expected: Expected,
    ours: Estimate,
    held: bool,
) -> str:
    """One sentence that compares our number with the paper's."""
    if expected.kind == "formula" and expected.value is not None:
        difference = abs(ours.value - expected.value) / (abs(expected.value) or 1.0)
        return f"The difference is {difference:.1g}."
    if expected.kind == "number":
        interval = f"{expected.low:g} to {expected.high:g}"
        if expected.low <= ours.value <= expected.high:
            return f"{ours.value:.4g} is within {interval}."
        widened = ", but not outside it by more than its own range" if held else ""
        return f"{ours.value:.4g} is outside {interval}{widened}."
    bound = expected.text
    if expected.kind == "words":
        bound = bound.partition(": ")[2]
    return f"{ours.value:.4g} is {'' if held else 'not '}{bound}."


def _reach(expected: Expected, ours: Estimate) -> str:
    """A sentence with the bound that decides, if our range contains it."""
    if expected.kind not in ("bound", "words"):
        return ""
    ends = (expected.low, expected.high)
    bound = min(ends, key=lambda end: abs(end - ours.value))
    if not ours.low <= bound <= ours.high:
        return ""
    return f" Its range reaches across the bound, {bound:g}."


def _other_mesh(expected: Expected, result: Result) -> str:
    """A sentence on whether the statement holds for the study ``paper`` too."""
    if result.on_papers_mesh is None:
        return ""
    other = expected.worst(result.on_papers_mesh)
    if not math.isfinite(other.value):
        return ""
    held = "holds as well" if holds(expected, other) else "does not hold"
    return f" On {result.mesh} it {held}, with {other.value:.4g}."


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
