"""The claims with their verdicts as JSON, CSV and Markdown."""

from __future__ import annotations

import csv
import io
import json
from collections import Counter
from collections.abc import Iterable
from typing import Any

from .claim import Claim, Verdict
from .evidence import Evidence
from .statements import bimaterial, course, finite_height, friction_law, simulations, sliding
from .symbols import as_markdown

SUBJECTS: dict[str, list[Claim]] = {
    "homogeneous sliding": sliding.CLAIMS,
    "bimaterial interfaces": bimaterial.CLAIMS,
    "finite height": finite_height.CLAIMS,
    "friction law": friction_law.CLAIMS,
    "critical lengths": simulations.CLAIMS,
    "course of simulations": course.CLAIMS,
}
"""All claims by subject, in the paper's order."""

COLUMNS = (
    "id", "subject", "where", "statement", "paper", "ours", "ours_low", "ours_high",
    "on_papers_mesh", "unit", "verdict", "reason", "method",
)  # fmt: skip


def evaluate(evidence: Evidence) -> list[dict[str, Any]]:
    """A row for each claim: what the paper says, our number and the verdict."""
    return [
        {"subject": subject, **claim.evaluate(evidence)}
        for subject, claims in SUBJECTS.items()
        for claim in claims
    ]


def counts(rows: Iterable[dict[str, Any]]) -> dict[str, int]:
    """How many claims have each verdict, in the order of :class:`Verdict`."""
    found = Counter(row["verdict"] for row in rows)
    return {str(verdict): found[verdict] for verdict in Verdict}


def to_json(rows: list[dict[str, Any]]) -> str:
    """The rows as a JSON list, valid by docs/claims.schema.json."""
    return json.dumps(rows, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def to_csv(rows: list[dict[str, Any]]) -> str:
    """The rows as comma-separated text; numbers to six digits, missing ones empty."""
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(COLUMNS)
    for row in rows:
        low, high = row["uncertainty"] or (None, None)
        flat = {**row, "ours_low": low, "ours_high": high}
        writer.writerow([_cell(flat[name]) for name in COLUMNS])
    return text.getvalue()


def to_markdown(rows: list[dict[str, Any]]) -> str:
    """The rows as a Markdown table, below a line that counts the verdicts."""
    summary = ", ".join(f"{number} {verdict}" for verdict, number in counts(rows).items())
    lines = [
        f"{len(rows)} claims: {summary}.",
        "",
        "| where | what the paper says | paper | ours (range) | how ours was computed | verdict | "
        "reason |",
        "|---|---|---|---|---|---|---|",
    ]
    for row in rows:
        cells = (
            row["where"], row["statement"], row["paper"] or "", number_text(row), row["method"],
            row["verdict"], row["reason"],
        )  # fmt: skip
        lines.append("| " + " | ".join(map(as_markdown, cells)) + " |")
    return "\n".join(lines) + "\n"


def number_text(row: dict[str, Any]) -> str:
    """Our number of a row with its range and unit, to four digits."""
    if row["ours"] is None:
        return ""
    unit = "" if row["unit"] == "1" else f" {row['unit']}"
    value, ends = f"{row['ours']:.4g}", [f"{end:.4g}" for end in row["uncertainty"]]
    if ends == [value, value]:
        return f"{value}{unit}"
    return f"{value} ({ends[0]} to {ends[1]}){unit}"


def _cell(value: Any) -> str:
    if value is None:
        return ""
    return f"{value:.6g}" if isinstance(value, float) else str(value)
