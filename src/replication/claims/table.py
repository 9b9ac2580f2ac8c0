"""The claims with their verdicts: the table as JSON, CSV and Markdown, and its steps."""

import dataclasses
import json
import math
import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from importlib import resources
from typing import Any

import pandas as pd
import xarray as xr
import yaml

from nucleation.extraction.definitions import ExtractionSettings
from nucleation.run.run import Run

from ..tables import lengths as table_of_lengths
from . import friction as of_friction
from . import pairs as of_two_bodies
from . import simulations, theory
from .evidence import Evidence, Row
from .expected import Computation, Estimate, Expected, Found, Missing, Result, Verdict, judge, read

Statements = Mapping[str, Mapping[str, Mapping[str, Any]]]
"""The entries of ``claims.yaml`` by subject and id."""

NUMBERS: dict[str, Computation] = (
    theory.NUMBERS | of_friction.NUMBERS | simulations.NUMBERS | of_two_bodies.NUMBERS
)
"""The function that computes our number for each claim, by its id."""

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


def stated() -> dict[str, dict[str, Mapping[str, Any]]]:
    """The entries of ``claims.yaml``, by subject and id."""
    text = resources.files(__package__).joinpath("claims.yaml").read_text(encoding="utf-8")
    return dict(yaml.safe_load(text))


def evaluate(statements: Statements, evidence: Evidence | of_two_bodies.Tables) -> list[Row]:
    """The rows of all claims: the paper's number and ours, the verdict and its reason."""
    return [
        {"subject": subject, **evaluate_one(id, entry, evidence)}
        for subject, entries in statements.items()
        for id, entry in entries.items()
    ]


def evaluate_one(id: str, entry: Mapping[str, Any], evidence: Any) -> Row:
    """The row of one claim."""
    expected = read(entry["expected"]) if "expected" in entry else None
    ours = other = None
    note = entry.get("note", "")
    try:
        if entry["method"] == "none":
            raise Missing(note.rstrip("."))
        found = NUMBERS[id](evidence)
    except Missing as missing:
        verdict, reason = Verdict.UNCHECKED, f"{missing}."
    else:
        result = found if isinstance(found, Result) else Result(found)
        expected = result.expected or expected
        if expected is None:
            raise ValueError(f"the claim {id} has nothing to compare with")
        if entry.get("carried"):  # the paper says it of another problem
            expected = dataclasses.replace(expected, chosen=True)
        verdict, reason = judge(expected, result)
        if entry.get("input"):
            verdict, reason = _of_input(verdict, reason)
        reason = f"{reason} {result.note or note}".rstrip()
        ours, other = (_worst(expected, found) for found in (result.found, result.papers))
    return {
        "id": id,
        "where": entry["where"],
        "statement": entry["statement"],
        "quotation": entry["quotation"],
        "paper": expected and expected.text,
        "ours": ours and ours.value,
        "uncertainty": ours and [ours.low, ours.high],
        "on_papers_mesh": other and other.value,
        "unit": entry.get("unit", "1"),
        "method": entry["method"],
        "verdict": str(verdict),
        "reason": reason,
    }


def _of_input(verdict: Verdict, reason: str) -> tuple[Verdict, str]:
    """The verdict on an input of ours: no result, whether it is the paper's or another."""
    if verdict is Verdict.REPLICATED:
        return Verdict.GIVEN, f"It is an input of the paper and of our runs. {reason}"
    return Verdict.UNCHECKED, f"It is an input, and these runs have another. {reason}"


def _worst(expected: Expected, found: Found) -> Estimate | None:
    """The number that is judged; None without one."""
    worst = None if found is None else expected.worst(found)
    return None if worst is None or math.isnan(worst.value) else worst


def counts(rows: Iterable[Row]) -> dict[str, int]:
    """The number of claims with each verdict, in the order of :class:`Verdict`."""
    found = Counter(row["verdict"] for row in rows)
    return {str(verdict): found[verdict] for verdict in Verdict}


def to_json(rows: list[Row]) -> str:
    """The rows as a JSON list."""
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
            number_text(row),
            row["method"],
            row["verdict"],
            row["reason"],
        )
        lines.append("| " + " | ".join(map(escaped, cells)) + " |")
    return "\n".join(lines) + "\n"


def number_text(row: Row) -> str:
    """Our number of a row with its range and unit, to four digits."""
    if row["ours"] is None:
        return ""
    unit = "" if row["unit"] == "1" else f" {row['unit']}"
    value, low, high = (f"{end:.4g}" for end in (row["ours"], *row["uncertainty"]))
    return f"{value}{unit}" if low == high == value else f"{value} ({low} to {high}){unit}"


def escaped(text: str) -> str:
    """A text for a cell of a Markdown table; formulas between dollars stay as they are."""
    parts = text.replace("\n", " ").split("$")
    parts[::2] = [
        re.sub(
            r"([|*_])",
            r"\\\1",
            part,
        )
        for part in parts[::2]
    ]
    return "$".join(parts)


def of_paper(
    statements: Statements,
    base: Run,
    settings: ExtractionSettings,
    theory: xr.Dataset,
    dispersion: xr.Dataset,
    lengths: Iterable[xr.Dataset],
    longer: Sequence[xr.Dataset],
    longer_runs: list[dict[str, Any]],
    patches: Iterable[xr.Dataset],
    patch_ids: Sequence[str],
) -> dict[str, str]:
    """The step ``claims``: the table's text by file extension.

    `longer` are simulations with longer blocks and those that they are compared with, of the runs
    `longer_runs`; `patch_ids` are the names of the runs with the `patches`.
    """
    tables = list(lengths)
    if len(longer):
        tables.append(table_of_lengths.lengths_table(longer_runs, longer, settings))
    evidence = Evidence(
        base=base,
        theory=theory,
        dispersion=dispersion,
        lengths=tuple(tables),
        patches=dict(zip(patch_ids, patches, strict=True)),
    )
    rows = evaluate(statements, evidence)
    return _files(rows) | {".json": to_json(rows)}


def of_pairs(statements: Statements, pairs: xr.Dataset, modes: xr.Dataset) -> dict[str, str]:
    """The step ``claims_pairs``: verdicts on the theory of two bodies, by simulations."""
    return _files(evaluate(statements, {"pairs": pairs, "modes": modes}))


def _files(rows: list[Row]) -> dict[str, str]:
    return {".csv": to_csv(rows), ".md": to_markdown(rows)}
