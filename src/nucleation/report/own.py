"""The report's part on studies of one's own: faults, runs, what had no event, warnings."""

from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from markupsafe import Markup

from ..analysis.events import without_event
from ..analysis.rows import rows_of
from .faults import FAULT, faults
from .tables import Cell, number


class OwnStudies(NamedTuple):
    """Studies that the paper does not have, with which the report begins.

    Attributes
    ----------
    descriptions : what each study is for, by name.
    warnings : of each, given before the runs (:mod:`nucleation.configuration.advice`).
    """

    descriptions: dict[str, str]
    warnings: dict[str, list[str]]


FAULT_COLUMNS = (
    "Fault", *(f"{c.label} ({c.unit})" if c.unit else c.label for c in FAULT), "Runs",
)  # fmt: skip


def fault_rows(lengths: xr.Dataset) -> list[list[Cell]]:
    """The faults as rows of :data:`FAULT_COLUMNS`, of several each with its marker."""
    known = faults(lengths)
    mark = '<span class="mark" style="color: {}" aria-hidden="true">{}</span> '
    return [
        [
            Cell(Markup(mark).format(f.colour, f.sign) * (len(known) > 1) + f.letter, f.letter),
            *(number(f.values[c.variable] / c.factor) for c in FAULT),
            Cell(str(len(f.runs)), len(f.runs)),
        ]
        for f in known
    ]


RUN_COLUMNS = (
    "Simulation", "Fault", "H (m)", "Onset (s)", "Length (m)", "Range (m)", "Theory (m)",
    "Over theory",
)  # fmt: skip


def sections(own: OwnStudies, lengths: xr.Dataset) -> list[dict[str, Any]]:
    """Each study's words and rows (:data:`RUN_COLUMNS`), for the page's template."""
    letters = {i: fault.letter for fault in faults(lengths) for i in fault.runs}
    result = []
    for study, description in own.descriptions.items():
        chosen = np.flatnonzero(lengths["study"].values == study).tolist()
        rows = rows_of(lengths, chosen)
        result.append(
            {
                "name": study,
                "description": description,
                "rows": [_row(row, letters[i]) for i, row in zip(chosen, rows, strict=True)],
                "quiet": without_event(rows),
                "answer": _answer(rows),
                "warnings": own.warnings.get(study, []),
            }
        )
    return result


def _answer(rows: list[dict[str, Any]]) -> dict[str, str] | None:
    """Ends of the runs' lengths (m), L_c and L_s (m), and their ratios; None without an event."""
    found = [row for row in rows if np.isfinite(row["length"])]
    if not found:
        return None

    def ends(values: list[float]) -> str:
        known = [value for value in values if np.isfinite(value)]
        texts = dict.fromkeys(f"{end:.3g}" for end in (min(known), max(known))) if known else ()
        return " to ".join(texts)

    lengths = {"length": "length", "critical": "theory_length", "stability": "creep_length"}
    said = {name: ends([row[column] for row in found]) for name, column in lengths.items()}
    ratios = [round(row["length"] / row["theory_length"], 2) for row in found]
    return said | {"ratio": ends(ratios)}


def _row(row: dict[str, Any], letter: str) -> list[Cell]:
    low, high = (number(row[name], 3) for name in ("length_low", "length_high"))
    event = bool(np.isfinite(row["onset_time"]))
    return [
        Cell(str(row["id"]), str(row["id"])),
        Cell(letter, letter),
        *(number(row[name]) for name in ("height", "onset_time", "length")),
        Cell(f"{low.text} to {high.text}" if event else "–", low.key),
        number(row["theory_length"]),
        number(row["length"] / row["theory_length"], 3),
    ]
