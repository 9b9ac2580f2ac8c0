"""The answer with which the report opens: how long the patch is when the force drops."""

from typing import Any

import numpy as np
import xarray as xr

from ..analysis.lengths import over_realisations
from ..analysis.rows import rows_of
from ..configuration.roles import JUDGED, PAPERS


def answer(lengths: xr.Dataset) -> dict[str, Any] | None:
    """Numbers of the first sentences, as text; None where no run of the paper had an event.

    Returns
    -------
    dict
        ``height`` of the lowest block and ``thickest``, ``length`` at the
        drop with its range ``low`` and ``high`` over the definitions of edge and drop, ``theory``
        (L_c) and ``stability`` (L_s), all in m; ``ratios``, the ends of length over L_c for all
        runs of each role; ``creep``, those of L_s/L_c; ``declared``, the same fault under a
        declared perturbation, its ``kind`` and relative ``strength``, or None.
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
        "declared": {**_numbers(declared[0]), **_noise(declared[0])} if declared else None,
        "ratios": {role: _ends(chosen, "length") for role, chosen in own.items() if chosen},
        "creep": _ends(own[PAPERS], "creep_length"),
    }


def _numbers(row: dict[str, Any]) -> dict[str, str]:
    names = {"length": "length", "low": "length_low", "high": "length_high"}
    names |= {"theory": "theory_length", "stability": "creep_length"}
    return {"height": f"{row['height']:g}"} | {
        name: f"{row[column]:.3g}" for name, column in names.items()
    }


def _noise(row: dict[str, Any]) -> dict[str, str]:
    return {"kind": row["kind"].replace("_", " "), "strength": _power(float(row["strength"]))}


def _power(strength: float) -> str:
    """A strength with a power of ten, as it is written by hand: 10⁻⁵, 3 × 10⁻⁴."""
    digits, exponent = f"{strength:.1e}".split("e")
    power = "10" + str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    return power if float(digits) == 1.0 else f"{float(digits):g} × {power}"


def _ends(rows: list[dict[str, Any]], column: str) -> str:
    """The least and the largest of a length over the theory's."""
    ratios = [row[column] / row["theory_length"] for row in rows]
    low, high = f"{min(ratios):.2f}", f"{max(ratios):.2f}"
    return low if low == high else f"{low} to {high}"
