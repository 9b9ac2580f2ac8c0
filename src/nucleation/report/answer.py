"""The answer with which the report opens: how long the patch is when the force drops."""

from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ..analysis.lengths import over_realisations
from ..analysis.rows import rows_of, without_event
from ..configuration.roles import JUDGED, PAPERS
from .tables import RUN_COLUMNS, run_rows


class OwnStudies(NamedTuple):
    """Studies that the paper does not have, with which the report begins.

    Attributes
    ----------
    descriptions : what each study is for, by name.
    warnings : of each, given before the runs (:mod:`nucleation.configuration.advice`).
    """

    descriptions: dict[str, str]
    warnings: dict[str, list[str]]


def of_paper(lengths: xr.Dataset) -> dict[str, Any] | None:
    """Numbers of the first sentences, as text; None where no run of the paper had an event.

    Returns
    -------
    dict
        ``height`` of the lowest block and ``thickest``, ``length`` at the
        drop with its range ``low`` and ``high`` over the definitions of edge and drop, ``theory``
        (L_c) and ``stability`` (L_s), all in m; ``ratios``, the ends of length over L_c for all
        runs of each role; ``creep``, those of L_s/L_c; ``declared``, the same fault under a
        declared perturbation, its ``kind`` and relative ``strength`` (%), or None.
    """
    rows = [row for row in rows_of(over_realisations(lengths)) if np.isfinite(row["length"])]
    own = {role: [row for row in rows if row["role"] == role] for role in (PAPERS, JUDGED)}
    if not own[PAPERS]:
        return None
    first = min(own[PAPERS], key=lambda row: row["height"])
    declared = [row for row in own[JUDGED] if row["fault"] == first["fault"]]
    return {
        **_numbers(first),
        "thickest": f"{max(row['height'] for row in own[PAPERS]):g}",
        "declared": _numbers(declared[0]) if declared else None,
        "ratios": {role: _over_theory(chosen, "length") for role, chosen in own.items() if chosen},
        "creep": _over_theory(own[PAPERS], "creep_length"),
    }


def _numbers(row: dict[str, Any]) -> dict[str, str]:
    names = {"length": "length", "low": "length_low", "high": "length_high"}
    names |= {"theory": "theory_length", "stability": "creep_length"}
    return {
        "height": f"{row['height']:g}",
        "kind": row["kind"].replace("_", " "),
        "strength": f"{100.0 * row['strength']:g}",
        **{name: f"{row[column]:.3g}" for name, column in names.items()},
    }


def of_studies(own: OwnStudies, lengths: xr.Dataset) -> list[dict[str, Any]]:
    """Each study's words and rows (:data:`.tables.RUN_COLUMNS`), for the page's template."""
    result = []
    shown = run_rows(lengths, RUN_COLUMNS)
    for study, description in own.descriptions.items():
        chosen = np.flatnonzero(lengths["study"].values == study).tolist()
        rows = rows_of(lengths, chosen)
        result.append(
            {
                "name": study,
                "description": description,
                "rows": [shown[i] for i in chosen],
                "quiet": without_event(rows),
                "answer": _of_study([row for row in rows if np.isfinite(row["length"])]),
                "warnings": own.warnings.get(study, []),
            }
        )
    return result


def _of_study(rows: list[dict[str, Any]]) -> dict[str, str] | None:
    """Ends of the runs' lengths, L_c and L_s (m), and their ratios; None without an event."""
    columns = {"length": "length", "critical": "theory_length", "stability": "creep_length"}
    said = {name: _ends((row[column] for row in rows), ".3g") for name, column in columns.items()}
    return said | {"ratio": _over_theory(rows, "length")} if rows else None


def _over_theory(rows: list[dict[str, Any]], column: str) -> str:
    return _ends((row[column] / row["theory_length"] for row in rows), ".2f")


def _ends(values: Iterable[float], digits: str) -> str:
    """The least and the largest of some values, nothing without any."""
    known = [value for value in values if np.isfinite(value)]
    ends = (min(known), max(known)) if known else ()
    return " to ".join(dict.fromkeys(format(end, digits) for end in ends))
