"""The claims with their verdicts: the table as JSON, CSV and Markdown; and the article on them."""

import json
import math
import re
from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import jinja2
import pandas as pd
import xarray as xr

from nucleation.extraction.definitions import ExtractionSettings
from nucleation.run.run import Run

from ..tables.lengths import lengths_table, over_realisations
from ..tables.rows import Row, rows_of
from . import friction, simulations, theory
from . import pairs as of_two_bodies
from .changes import CHANGES, FORMULA, least_change
from .evidence import Evidence, caution, mesh, span
from .verdicts import (
    Computation,
    Expected,
    Missing,
    Result,
    Verdict,
    holds,
    judge,
    nearest_end,
    read,
    worst,
)

Statements = Sequence[tuple[str, Iterable[tuple[str, Mapping[str, Any]]]]]
"""The entries of ``claims.yaml`` by subject and id, in pairs, which keep the paper's order."""

NUMBERS: dict[str, Computation] = {
    **friction.NUMBERS,
    **theory.NUMBERS,
    **simulations.NUMBERS,
    **of_two_bodies.NUMBERS,
}
"""The function that computes our number for each claim, by its id."""


COLUMNS = (
    *("id", "subject", "where", "statement", "paper", "ours", "ours_low", "ours_high"),
    *("on_papers_mesh", "unit", "distance", "change", "verdict", "reason", "method"),
)

_SHOWN = (
    *("where", "statement", "paper", "ours", "distance", "change", "method", "verdict", "reason"),
)

_HEADER = (
    "| where | statement | paper | ours (range) | distance | change | method | verdict | reason |",
    "|---|---|---|---|---|---|---|---|---|",
)


def evaluate(statements: Statements, evidence: Evidence | of_two_bodies.Tables) -> list[Row]:
    """The rows of all claims: the paper's number and ours, the verdict and its reason."""
    return [
        {"subject": subject} | evaluate_one(id, entry, evidence)
        for subject, entries in statements
        for id, entry in entries
    ]


def evaluate_one(id: str, entry: Mapping[str, Any], evidence: Any) -> Row:
    """The row of one claim.

    `distance` is that of our number from the nearest one with another outcome, `change` the least
    change of the evidence that has it, if simulations decide (docs/claims.md).
    """
    note = entry.get("note", "")
    row: Row = {name: entry[name] for name in ("where", "statement", "method")}
    row |= {"id": id, "unit": entry.get("unit", "1"), "change": ""}
    row |= dict.fromkeys(("ours", "uncertainty", "on_papers_mesh", "distance"))
    stated = read(entry["expected"]) if "expected" in entry else None
    try:
        if entry["method"] == "none":
            raise Missing(note.rstrip("."))
        expected, result = compared(id, entry, evidence)
    except Missing as missing:
        paper = stated and stated.text
        return row | {"paper": paper, "verdict": str(Verdict.UNCHECKED), "reason": f"{missing}."}
    verdict, reason = judge(expected, result)
    ours = worst(expected, result.found)
    if not math.isnan(ours[0]):
        row |= {"ours": ours[0], "uncertainty": list(ours[1:])}
        row["distance"] = nearest_end(expected, ours) - ours[0]
    if result.papers is not None:
        other, *_ = worst(expected, result.papers)
        row["on_papers_mesh"] = None if math.isnan(other) else other
    if verdict is not Verdict.UNCHECKED and entry["decided_by"] != FORMULA:
        change = CHANGES[entry["decided_by"]]
        amount = least_change(change, lambda e: outcome(id, entry, e), evidence)
        if amount is not None:
            row["change"] = change.text(amount)
        elif outcome(id, entry, evidence):  # what fails by far has failed
            verdict = Verdict.NUMBER
            reason = (
                f"{reason} It would hold as well with {change.text(change.reasonable)}, or as "
                "much less, so it is no test of the runs: a number, or a nearer bound, would be."
            )
    if entry.get("input"):  # the paper's or another
        same = verdict is Verdict.REPLICATED
        verdict = Verdict.GIVEN if same else Verdict.UNCHECKED
        whose = " of the paper and of our runs" if same else ", and these runs have another"
        reason = f"It is an input{whose}. {reason}"
    reason = f"{reason} {note}".rstrip()
    return row | {"paper": expected.text, "verdict": str(verdict), "reason": reason}


def compared(id: str, entry: Mapping[str, Any], evidence: Any) -> tuple[Expected, Result]:
    """What a claim allows, and our result; raises Missing without one."""
    found = NUMBERS[id](evidence)
    result = found if isinstance(found, Result) else Result(found)
    expected = result.expected or (read(entry["expected"]) if "expected" in entry else None)
    if expected is None:
        raise ValueError(f"the claim {id} has nothing to compare with")
    if entry.get("carried"):  # the paper says it of another problem
        expected = expected._replace(chosen=True)
    return expected, result


def outcome(id: str, entry: Mapping[str, Any], evidence: Any) -> bool | None:
    """Whether a claim holds on some evidence; None without our number."""
    try:
        expected, result = compared(id, entry, evidence)
    except Missing:
        return None
    return holds(expected, worst(expected, result.found))


def counts(rows: Iterable[Row]) -> dict[str, int]:
    """The number of claims with each verdict, in the order of :class:`Verdict`."""
    found = Counter(row["verdict"] for row in rows)
    return {str(verdict): found[verdict] for verdict in Verdict}


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
        distance = "" if row["distance"] is None else f"{row['distance']:+.2g}"
        shown = row | {"paper": row["paper"] or "", "ours": number_text(row), "distance": distance}
        lines.append("| " + " | ".join(escaped(shown[name]) for name in _SHOWN) + " |")
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
    parts[::2] = [re.sub(r"([|*_])", r"\\\1", part) for part in parts[::2]]
    return "$".join(parts)


def of_paper(
    statements: Statements,
    base: Run,
    settings: ExtractionSettings,
    theory: xr.Dataset,
    dispersion: xr.Dataset,
    lengths: Iterable[xr.Dataset],
    longer: Iterable[xr.Dataset],
    longer_runs: list[Row],
    patches: Iterable[xr.Dataset],
    patch_ids: Sequence[str],
) -> dict[str, str]:
    """The step ``claims``: the table's text by file extension.

    `longer` are simulations with longer blocks and those that they are compared with, of the runs
    `longer_runs`; `patch_ids` are the names of the runs with the `patches`.
    """
    tables = list(lengths)
    if longer_runs:
        tables.append(lengths_table(longer_runs, longer, settings))
    by_id = dict(zip(patch_ids, patches, strict=True))
    evidence = Evidence(base, theory, dispersion, tuple(tables), by_id)
    rows = evaluate(statements, evidence)
    listed = json.dumps(rows, indent=1, ensure_ascii=False, allow_nan=False)
    return {".csv": to_csv(rows), ".md": to_markdown(rows), ".json": listed + "\n"}


def of_pairs(statements: Statements, pairs: xr.Dataset, modes: xr.Dataset) -> dict[str, str]:
    """The step ``claims_pairs``: verdicts on the theory of two bodies, by simulations."""
    rows = evaluate(statements, {"pairs": pairs, "modes": modes})
    return {".csv": to_csv(rows), ".md": to_markdown(rows)}


# -- the article --------------------------------------------------------------------------------


def write_article(
    template: Path, claims: Path, lengths: Iterable[xr.Dataset], beyond: bool = False
) -> dict[str, str]:
    """The step ``article``: its text from the template, the claims as JSON and the lengths."""
    rows = json.loads(claims.read_text("utf-8"))
    return {".md": render(template.read_text("utf-8"), rows, lengths, beyond)}


def render(
    template: str, claims: list[Row], lengths: Iterable[xr.Dataset], beyond: bool = False
) -> str:
    """The article's text; `beyond` includes the figures of L_s, the drop and the map.

    The template is Markdown with Jinja2's expressions. It can use ``claim(id)``, a claim's row;
    ``ours(id)``, our number with range and unit; ``checked(id)``, whether it has a verdict;
    ``mesh``, that of the role ``paper`` in words, and the ``caution`` that a coarse one needs;
    ``verdicts``, their counts; ``verdict``, :class:`Verdict`; ``claims``, all rows; ``runs(role)``,
    the role's rows of lengths, one for each fault; ``pairs``, the faults of the paper's study, each
    with its row of the converged study; ``by_theory(role)``, the range of L_s/L_c by theory; and
    the filters ``digits(n)``, ``span(n)`` of numbers, ``percent(n)`` and ``typeset``, the last for
    texts with formulas. A name that the results lack is an error.
    """
    environment = jinja2.Environment(
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    environment.filters |= {
        "digits": digits,
        "percent": lambda value, places=0: (
            "–" if value is None else f"{100.0 * value:.{places}f} %"
        ),
        "span": lambda values, number: span(values, lambda value: digits(value, number)),
        "typeset": escaped,
    }
    by_id = {row["id"]: row for row in claims}
    faults = [row for table in lengths for row in rows_of(over_realisations(table))]

    def runs(role: str) -> list[Row]:
        return [row for row in faults if row["role"] == role]

    def by_theory(role: str) -> str:
        ratios = (row["stability_length"] / row["critical_length"] for row in runs(role))
        return span(ratios, "{:.2f}".format)

    converged = {row["fault"]: row for row in runs("converged")}
    return environment.from_string(template).render(
        claim=by_id.__getitem__,
        ours=lambda id: number_text(by_id[id]) or "not computed",
        checked=lambda id: by_id[id]["verdict"] != Verdict.UNCHECKED,
        mesh=mesh(runs("paper")),
        caution=caution(runs("paper")),
        verdicts=counts(claims),
        verdict=Verdict,
        claims=claims,
        runs=runs,
        pairs=[(row, converged.get(row["fault"])) for row in runs("paper")],
        by_theory=by_theory,
        beyond=beyond,
    )


def digits(value: float | None, number: int) -> str:
    """A value with some significant digits, or a dash for None."""
    if value is None:
        return "–"
    mantissa, _, power = f"{value:.{number}g}".partition("e")
    if not power:
        return mantissa
    factor = "" if mantissa == "1" else rf"{mantissa}\times "
    return f"${factor}10^{{{int(power)}}}$"
