"""A claim, one quantitative statement of the paper, and the verdict that follows from our number.

The verdict follows from :func:`nucleation.claims.said.holds` alone; docs/claims.md states the rule.
"""

import dataclasses
import enum
import math
from collections.abc import Callable
from typing import Any

from .said import Missing, Ours, Said, holds


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
    """Why ours may differ: a section of docs/findings.md, and our number without that cause."""

    finding: str
    text: str
    ours: Ours


@dataclasses.dataclass(frozen=True)
class Result:
    """What the computation of a claim gives.

    Attributes
    ----------
    ours : the number that the verdict stands on.
    said : replaces what the claim says, if that depends on the configuration.
    on_papers_mesh : the same number from the study ``paper``, if the two studies differ.
    cause : a cause of a difference.
    note : words after the reason.
    """

    ours: Ours
    said: Said | None = None
    on_papers_mesh: Ours | None = None
    cause: Cause | None = None
    note: str = ""


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
    compute : gives ours.
    said : what is compared with; may be left to the function.
    unit : SI unit of the numbers.
    input : whether ours is what the configuration was given, and so no result.
    """

    id: str
    where: str
    statement: str
    quotation: str
    method: str
    compute: Callable[[Any], Ours | Result]
    said: Said | None = None
    unit: str = "1"
    input: bool = False

    def evaluate(self, evidence: Any) -> dict[str, Any]:
        """The claim's row: what the paper says, ours, the verdict and its reason."""
        try:
            result = self.compute(evidence)
        except Missing as missing:
            return self._row(self.said, None, Verdict.UNCHECKED, f"{missing}.")
        if isinstance(result, Ours):
            result = Result(result)
        said = result.said or self.said
        if said is None:
            raise ValueError(f"the claim {self.id} says nothing to compare with")
        verdict, reason = judge(said, result)
        if self.input and verdict is Verdict.REPLICATED:
            verdict, reason = Verdict.GIVEN, f"An input of ours as of the paper's. {reason}"
        return self._row(said, result, verdict, reason)

    def _row(
        self, said: Said | None, result: Result | None, verdict: Verdict, reason: str
    ) -> dict[str, Any]:
        ours = result.ours if result and math.isfinite(result.ours.value) else None
        other = result.on_papers_mesh if result else None
        return {
            "id": self.id,
            "where": self.where,
            "statement": self.statement,
            "quotation": self.quotation,
            "paper": None if said is None else said.text,
            "paper_range": None if said is None else [_end(said.low), _end(said.high)],
            "kind": None if said is None else said.kind,
            "ours": None if ours is None else ours.value,
            "uncertainty": None if ours is None else [ours.low, ours.high],
            "on_papers_mesh": None if other is None else _end(other.value),
            "unit": self.unit,
            "method": self.method,
            "verdict": str(verdict),
            "reason": reason,
        }


def judge(said: Said, result: Result) -> tuple[Verdict, str]:
    """The verdict and the reason for it."""
    ours, note = result.ours, f" {result.note}" if result.note else ""
    held = holds(said, ours)
    if held is None:
        if math.isfinite(ours.value):
            return Verdict.UNCHECKED, f"Our number is known to {_width(ours):.1g} only.{note}"
        return Verdict.UNCHECKED, f"A run has no such event.{note}"
    text = f"{_compared(said, ours, held)}{_reach(said, ours)}"
    if held:
        return Verdict.REPLICATED, f"{text}{_other_mesh(said, result)}{note}"
    cause = result.cause
    if cause is not None and holds(said, cause.ours):
        why = f"{cause.text} {cause.ours.value:.4g} (findings: {cause.finding})."
        return Verdict.EXPLAINED, f"{text} {why}{note}"
    verdict = Verdict.NOT_SUPPORTED if said.chosen else Verdict.NOT_REPLICATED
    return verdict, f"{text}{_other_mesh(said, result)}{note}"


def _compared(said: Said, ours: Ours, held: bool) -> str:
    """One sentence on our number and what the paper says."""
    if said.kind == "formula" and said.value is not None:
        difference = abs(ours.value - said.value) / (abs(said.value) or 1.0)
        return f"The difference is {difference:.1g}."
    if said.kind == "number":
        side = "within" if said.low <= ours.value <= said.high else "outside"
        widened = ", but not outside it by more than its own range" if side == "outside" else ""
        return f"{ours.value:.4g} is {side} {said.low:g} to {said.high:g}{widened * held}."
    if said.kind == "bound":
        return f"{ours.value:.4g} is {'' if held else 'not '}{said.text}."
    return f"{ours.value:.4g} is {'' if held else 'not '}{said.text.partition(': ')[2]}."


def _reach(said: Said, ours: Ours) -> str:
    """The bound that decides, where the range of ours reaches across it."""
    if said.kind not in ("bound", "words"):
        return ""
    ends = [end for end in (said.low, said.high) if math.isfinite(end)]
    bound = min(ends, key=lambda end: abs(end - ours.value))
    if not ours.low <= bound <= ours.high:
        return ""
    return f" Its range reaches across the bound, {bound:g}."


def _other_mesh(said: Said, result: Result) -> str:
    other = result.on_papers_mesh
    if other is None or not math.isfinite(other.value):
        return ""
    held = "holds as well" if holds(said, other) else "does not hold"
    return f" On the paper's mesh it {held}, with {other.value:.4g}."


def _width(ours: Ours) -> float:
    return max(ours.high - ours.value, ours.value - ours.low)


def _end(value: float) -> float | None:
    return value if math.isfinite(value) else None
