"""A claim, one quantitative statement of the paper, and the verdict that follows from our number.

The verdict follows from :func:`nucleation.claims.said.holds` alone; docs/claims.md states the rule.
"""

import dataclasses
import enum
import math
from collections.abc import Callable
from typing import Any

from .said import Found, Missing, Ours, Said, holds


class Verdict(enum.StrEnum):
    """What becomes of a claim."""

    REPLICATED = "replicated"
    GIVEN = "taken as given"
    EXPLAINED = "replicated with a deviation that is explained"
    NOT_SUPPORTED = "not supported"
    NOT_REPLICATED = "not replicated"
    UNCHECKED = "cannot be checked"


@dataclasses.dataclass(frozen=True)
class Cause:
    """Why ours may differ: a section of docs/results.md, and our number without that cause."""

    finding: str
    text: str
    ours: Found


@dataclasses.dataclass(frozen=True)
class Result:
    """What the computation of a claim gives, if it is more than our number.

    Attributes
    ----------
    ours : the number that the verdict stands on.
    said : replaces what the claim says, if that depends on the configuration.
    on_papers_mesh : the same number from the study ``paper``, if the two studies differ.
    cause : a cause of a difference.
    note : words after the reason.
    """

    ours: Found
    said: Said | None = None
    on_papers_mesh: Found | None = None
    cause: Cause | None = None
    note: str = ""


Computation = Callable[[Any], Found | Result]
"""Gives our number from the evidence."""


@dataclasses.dataclass(frozen=True)
class Claim:
    """One statement of the paper and how our number for it is computed; texts are Markdown.

    Attributes
    ----------
    id : unique name.
    where : section, equation, figure or table of the paper.
    statement : what it says, in our words.
    quotation : the paper's own words, LaTeX without spacing commands.
    method : how ours is computed.
    compute : gives ours; None if it can't be had.
    said : what is compared with; may be left to the function.
    unit : SI unit of the numbers.
    input : whether ours is what the configuration was given, and so no result.
    carried : whether the paper says it of homogeneous sliding, and we try it on a pushed patch.
    note : words after the reason, or the reason if ours can't be had.
    """

    id: str
    where: str
    statement: str
    quotation: str
    method: str
    compute: Computation | None
    said: Said | None = None
    unit: str = "1"
    input: bool = False
    carried: bool = False
    note: str = ""

    def evaluate(self, evidence: Any) -> dict[str, Any]:
        """The claim's row: what the paper says, ours, the verdict and its reason.

        Raises
        ------
        ValueError
            If neither the claim nor its function says what to compare with.
        """
        said, ours, other = self.said, None, None
        try:
            if self.compute is None:
                raise Missing(self.note)
            found = self.compute(evidence)
        except Missing as missing:
            verdict, reason = Verdict.UNCHECKED, f"{missing}."
        else:
            result = found if isinstance(found, Result) else Result(found)
            said = result.said or said
            if said is None:
                raise ValueError(f"the claim {self.id} says nothing to compare with")
            if self.carried:
                said = dataclasses.replace(said, chosen=True)
            verdict, reason = judge(said, result)
            if self.input and verdict is Verdict.REPLICATED:
                verdict, reason = Verdict.GIVEN, f"An input of ours as of the paper's. {reason}"
            if note := result.note or self.note:
                reason += f" {note}"
            ours = said.worst(result.ours)
            if result.on_papers_mesh is not None:
                other = _finite(said.worst(result.on_papers_mesh).value)
        if ours is not None and math.isnan(ours.value):
            ours = None
        return {
            "id": self.id,
            "where": self.where,
            "statement": self.statement,
            "quotation": self.quotation,
            "paper": said and said.text,
            "paper_range": said and [_finite(said.low), _finite(said.high)],
            "kind": said and said.kind,
            "ours": ours and ours.value,
            "uncertainty": ours and [ours.low, ours.high],
            "on_papers_mesh": other,
            "unit": self.unit,
            "method": self.method,
            "verdict": str(verdict),
            "reason": reason,
        }


def judge(said: Said, result: Result) -> tuple[Verdict, str]:
    """The verdict and the reason for it."""
    ours = said.worst(result.ours)
    held = holds(said, ours)
    if held is None:
        if math.isnan(ours.value):
            return Verdict.UNCHECKED, "A run has no such event."
        width = max(ours.high - ours.value, ours.value - ours.low)
        return Verdict.UNCHECKED, f"Our number is known to {width:.1g} only."
    text = f"{_compared(said, ours, held)}{_reach(said, ours)}"
    if not held and result.cause is not None:
        without = said.worst(result.cause.ours)
        if holds(said, without):
            why = f"{result.cause.text} {without.value:.4g} (results: {result.cause.finding})."
            return Verdict.EXPLAINED, f"{text} {why}"
    failed = Verdict.NOT_SUPPORTED if said.chosen else Verdict.NOT_REPLICATED
    return Verdict.REPLICATED if held else failed, f"{text}{_other_mesh(said, result)}"


def _compared(said: Said, ours: Ours, held: bool) -> str:
    """One sentence on our number and what the paper says."""
    if said.kind == "formula" and said.value is not None:
        difference = abs(ours.value - said.value) / (abs(said.value) or 1.0)
        return f"The difference is {difference:.1g}."
    if said.kind == "number":
        side = "within" if said.low <= ours.value <= said.high else "outside"
        widened = ", but not outside it by more than its own range" if side == "outside" else ""
        return f"{ours.value:.4g} is {side} {said.low:g} to {said.high:g}{widened * held}."
    bound = said.text if said.kind == "bound" else said.text.partition(": ")[2]
    return f"{ours.value:.4g} is {'' if held else 'not '}{bound}."


def _reach(said: Said, ours: Ours) -> str:
    """The bound that decides, where the range of ours reaches across it."""
    if said.kind not in ("bound", "words"):
        return ""
    bound = min(said.low, said.high, key=lambda end: abs(end - ours.value))
    if not ours.low <= bound <= ours.high:
        return ""
    return f" Its range reaches across the bound, {bound:g}."


def _other_mesh(said: Said, result: Result) -> str:
    """Whether the statement holds on the paper's mesh too."""
    if result.on_papers_mesh is None:
        return ""
    other = said.worst(result.on_papers_mesh)
    if not math.isfinite(other.value):
        return ""
    held = "holds as well" if holds(said, other) else "does not hold"
    return f" On the paper's mesh it {held}, with {other.value:.4g}."


def _finite(value: float) -> float | None:
    return value if math.isfinite(value) else None
