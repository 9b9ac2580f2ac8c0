"""The claims with their verdicts as JSON, CSV and Markdown."""

import json
import re
from collections import Counter
from collections.abc import Iterable, Mapping
from importlib import resources
from typing import Any

import pandas as pd
import yaml

from .claim import Claim, Verdict
from .said import read
from .statements import finite_height, simulations, sliding, two_bodies

SUBJECTS = {
    "homogeneous sliding": sliding,
    "bimaterial interfaces": finite_height,
    "finite height": finite_height,
    "friction law": sliding,
    "critical lengths": simulations,
    "course of simulations": simulations,
    "two bodies, simulated": two_bodies,
}
"""Where the functions of each subject are; the last one has evidence and a table of its own."""

COLUMNS = (
    "id", "subject", "where", "statement", "paper", "ours", "ours_low", "ours_high",
    "on_papers_mesh", "unit", "verdict", "reason", "method",
)  # fmt: skip


def stated() -> dict[str, Any]:
    """The claims of ``claims.yaml``: subject, id, entry."""
    text = resources.files(__package__).joinpath("claims.yaml").read_text(encoding="utf-8")
    return dict(yaml.safe_load(text))


def claims_on(subject: str, entries: Mapping[str, Mapping[str, Any]]) -> list[Claim]:
    """The claims of one subject, each with the function that has its name."""
    module = SUBJECTS[subject]
    functions = {**{name.replace("_", "-"): f for name, f in vars(module).items()}, **module.OURS}
    return [
        Claim(
            id=id,
            compute=functions[id] if entry["method"] != "none" else None,
            **{**entry, "said": read(entry["said"]) if "said" in entry else None},
        )
        for id, entry in entries.items()
    ]


def evaluate(statements: Mapping[str, Any], evidence: Any) -> list[dict[str, Any]]:
    """A row for each claim of some subjects: what the paper says, our number and the verdict."""
    return [
        {"subject": subject, **claim.evaluate(evidence)}
        for subject, entries in statements.items()
        for claim in claims_on(subject, entries)
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
    flat = pd.DataFrame(rows)
    flat[["ours_low", "ours_high"]] = [row["uncertainty"] or (None, None) for row in rows]
    return flat.to_csv(columns=COLUMNS, index=False, float_format="%.6g")


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
        lines.append("| " + " | ".join(map(escaped, cells)) + " |")
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


def escaped(text: str) -> str:
    """A text in a cell of a Markdown table: between dollars stands mathematics."""
    parts = text.replace("\n", " ").split("$")
    parts[::2] = [re.sub(r"([|*_])", r"\\\1", part) for part in parts[::2]]
    return "$".join(parts)
