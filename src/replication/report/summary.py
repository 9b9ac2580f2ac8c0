"""The first section of the report: the answer on the paper, or the user's own studies."""

from collections.abc import Iterable
from typing import Any

import numpy as np
import xarray as xr

from ..claims import phrases
from ..claims.phrases import span
from ..configuration.roles import JUDGED, PAPERS
from ..tables.lengths import over_realisations
from ..tables.rows import rows_of, without_event
from .tables import RUN_COLUMNS, run_rows

Row = dict[str, Any]


def of_paper(lengths: xr.Dataset) -> dict[str, Any] | None:
    """Numbers of the answer, as text; None if no run of the paper had an event.

    Returns
    -------
    dict
        For the lowest block: ``height``, ``length`` at the drop with its range ``low`` and
        ``high`` over the definitions of edge and drop, ``theory`` (L_c) and ``stability`` (L_s),
        all in m. For all runs: ``thickest``, the largest height (m); ``ratios``, the range of
        length over L_c by role; ``creep``, the range of L_s/L_c; ``mesh`` in words, and the
        ``caution`` that a coarse one needs. ``declared``: the same fault with a declared
        perturbation, its ``kind``, relative ``strength`` (%) and ``mesh``, or None.
    """
    rows = _with_event(rows_of(over_realisations(lengths)))
    paper = [row for row in rows if row["role"] == PAPERS]
    judged = [row for row in rows if row["role"] == JUDGED]
    if not paper:
        return None
    first = min(paper, key=lambda row: row["height"])
    declared = [row for row in judged if row["fault"] == first["fault"]]
    ratios = {PAPERS: _over_theory(paper, "length")}
    if judged:
        ratios[JUDGED] = _over_theory(judged, "length")
    return {
        **_numbers(first),
        "thickest": f"{max(row['height'] for row in paper):g}",
        "declared": _numbers(declared[0]) if declared else None,
        "ratios": ratios,
        "creep": _over_theory(paper, "stability_length"),
        "caution": phrases.caution(paper),
    }


def _with_event(rows: Iterable[Row]) -> list[Row]:
    return [row for row in rows if np.isfinite(row["length"])]


def _numbers(row: Row) -> dict[str, str]:
    return {
        "height": f"{row['height']:g}",
        "mesh": phrases.mesh([row]),
        "kind": row["kind"].replace("_", " "),
        "strength": f"{100.0 * row['strength']:g}",
        "length": f"{row['length']:.3g}",
        "low": f"{row['length_low']:.3g}",
        "high": f"{row['length_high']:.3g}",
        "theory": f"{row['critical_length']:.3g}",
        "stability": f"{row['stability_length']:.3g}",
    }


def of_studies(
    descriptions: dict[str, str],
    warnings: dict[str, list[str]],
    lengths: xr.Dataset,
) -> list[dict[str, Any]]:
    """Texts and rows of each study, for the page's template.

    Parameters
    ----------
    descriptions : dict
        The description of each study of the user.
    warnings : dict
        Warnings about each study before its runs (:mod:`replication.configuration.advice`).
    lengths : Dataset
        Table of their lengths.

    Returns
    -------
    list of dict
        For each study ``name``, ``description``, ``rows`` (:data:`.tables.RUN_COLUMNS`), ``quiet``
        (runs without an event), ``answer`` (ranges) and ``warnings``.
    """
    studies = []
    shown = run_rows(lengths, RUN_COLUMNS)
    for study, description in descriptions.items():
        chosen = np.flatnonzero(lengths["study"].values == study).tolist()
        rows = rows_of(lengths, chosen)
        studies.append(
            {
                "name": study,
                "description": description,
                "rows": [shown[i] for i in chosen],
                "quiet": without_event(rows),
                "answer": _answer(_with_event(rows)),
                "warnings": warnings.get(study, []),
            }
        )
    return studies


def _answer(rows: list[Row]) -> dict[str, str] | None:
    """Ranges of length, L_c and L_s (m) and of length over L_c; None without an event."""
    if not rows:
        return None
    return {
        "length": span((row["length"] for row in rows), ".3g"),
        "critical": span((row["critical_length"] for row in rows), ".3g"),
        "stability": span((row["stability_length"] for row in rows), ".3g"),
        "ratio": _over_theory(rows, "length"),
    }


def _over_theory(rows: list[Row], column: str) -> str:
    return span((row[column] / row["critical_length"] for row in rows), ".2f")
