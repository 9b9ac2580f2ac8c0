"""The claims with their verdicts as JSON, CSV and Markdown."""

import json
import re
from collections import Counter
from collections.abc import Iterable, Mapping
from importlib import resources
from types import ModuleType
from typing import Any

import pandas as pd
import yaml

from .claim import Claim, Computation, Row, Verdict
from .evidence import Evidence
from .expected import read
from .pair_evidence import Tables
from .statements import bimaterial, course, finite_height, friction, lengths, sliding, two_bodies

Entry = Mapping[str, Any]
"""An entry of ``claims.yaml``: the attributes of one claim."""

SUBJECTS = {
    "homogeneous sliding": sliding,
    "bimaterial interfaces": bimaterial,
    "finite height": finite_height,
    "friction law": friction,
    "critical lengths": lengths,
    "course of simulations": course,
    "two bodies, simulated": two_bodies,
}
"""The module with the functions of each subject. The last one has its own evidence and table."""

COLUMNS = (
    "id",
    "subject",
    "where",
    "statement",
    "paper",
    "ours",
    "ours_low",
    "ours_high",
    "on_papers_mesh",
    "unit",
    "verdict",
    "reason",
    "method",
)

_HEADER = (
    "| where | statement | paper | ours (range) | method | verdict | reason |",
    "|---|---|---|---|---|---|---|",
)


def stated() -> dict[str, dict[str, Entry]]:
    """The entries of ``claims.yaml``, by subject and id."""
    text = resources.files(__package__).joinpath("claims.yaml").read_text(encoding="utf-8")
    return dict(yaml.safe_load(text))


def claims_on(
    subject: str,
    entries: Mapping[str, Entry],
) -> list[Claim]:
    """The claims of one subject, each with the function that has its name.

    Parameters
    ----------
    subject : str
        A key of :data:`SUBJECTS`.
    entries : mapping
        The subject's entries by id.

    Raises
    ------
    KeyError
        For an unknown subject, or a claim without a function.
    """
    functions = _functions(SUBJECTS[subject])
    claims = []
    for id, entry in entries.items():
        fields = dict(entry)
        if "expected" in fields:
            fields["expected"] = read(fields["expected"])
        compute = None if entry["method"] == "none" else functions[id]
        claims.append(Claim(id=id, compute=compute, **fields))
    return claims


def _functions(module: ModuleType) -> dict[str, Computation]:
    """The functions of a subject's module by the ids of their claims."""
    functions = {}
    for name, value in vars(module).items():
        functions[name.replace("_", "-")] = value
    return {**functions, **module.SHORT}


def evaluate(
    statements: Mapping[str, Mapping[str, Entry]],
    evidence: Evidence | Tables,
) -> list[Row]:
    """The rows of all claims: the paper's number and ours, the verdict and its reason.

    Parameters
    ----------
    statements : mapping
        Entries by subject and id.
    evidence : Evidence or mapping
        The datasets that these subjects need.
    """
    rows = []
    for subject, entries in statements.items():
        for claim in claims_on(subject, entries):
            rows.append({"subject": subject, **claim.evaluate(evidence)})
    return rows


def counts(rows: Iterable[Row]) -> dict[str, int]:
    """The number of claims with each verdict, in the order of :class:`Verdict`."""
    found = Counter(row["verdict"] for row in rows)
    return {str(verdict): found[verdict] for verdict in Verdict}


def to_json(rows: list[Row]) -> str:
    """The rows as a JSON list, valid by docs/claims.schema.json."""
    return json.dumps(rows, indent=1, ensure_ascii=False, allow_nan=False) + "\n"


def to_csv(rows: list[Row]) -> str:
    """The rows as comma-separated text; numbers to six digits, missing ones empty."""
    flat = pd.DataFrame(rows)
    flat[["ours_low", "ours_high"]] = [row["uncertainty"] or (None, None) for row in rows]
    return flat.to_csv(columns=COLUMNS, index=False, float_format="%.6g")


def to_markdown(rows: list[Row]) -> str:
    """The rows as a Markdown table, below a line that counts the verdicts."""
    summary = ", ".join(f"{number} {verdict}" for verdict, number in counts(rows).items())
    lines = [f"{len(rows)} claims: {summary}.", "", *_HEADER]
    for row in rows:
        cells = (
            row["where"],
            row["statement"],
            row["paper"] or "",
            _number_text(row),
            row["method"],
            row["verdict"],
            row["reason"],
        )
        lines.append("| " + " | ".join(map(escaped, cells)) + " |")
    return "\n".join(lines) + "\n"


def _number_text(row: Row) -> str:
    """Our number of a row with its range and unit, to four digits."""
    if row["ours"] is None:
        return ""
    unit = "" if row["unit"] == "1" else f" {row['unit']}"
    value = f"{row['ours']:.4g}"
    low, high = (f"{end:.4g}" for end in row["uncertainty"])
    if low == high == value:
        return f"{value}{unit}"
    return f"{value} ({low} to {high}){unit}"


def escaped(text: str) -> str:
    """A text for a cell of a Markdown table; formulas between dollars stay as they are."""
    parts = text.replace("\n", " ").split("$")
    parts[::2] = [re.sub(r"([|*_])", r"\\\1", part) for part in parts[::2]]
    return "$".join(parts)
