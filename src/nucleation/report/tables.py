"""What the report says in numbers: its answer, verdicts, lengths with their cost, faults, CSV."""

import html
import math
import re
from collections import Counter
from collections.abc import Iterable
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from markupsafe import Markup

from ..analysis.lengths import over_realisations
from ..analysis.rows import rows_of, without_event
from ..configuration.roles import JUDGED, PAPERS
from ..model.identity import DIGITS

QUANTITIES = {
    "shear_modulus": ("μ (GPa)", 1e9), "poisson_ratio": ("ν", 1.0),
    "applied_stress": ("σ₀ (MPa)", 1e6), "friction_coefficient": ("f", 1.0),
    "direct_effect": ("a", 1.0), "velocity_weakening": ("ζ", 1.0),
    "slip_distance": ("ℓ = D (µm)", 1e-6), "velocity": ("V (µm/s)", 1e-6),
}  # fmt: skip
"""Columns that make a fault of its own for the theory, on what lies below (:data:`BELOW`), with
their titles and units. Runs of other heights, laws and ages are of the same one."""

BELOW = ("below", "far_side", "second_shear_modulus", "second_poisson_ratio", "plane")


class Fault(NamedTuple):
    """One fault of a table of lengths: its number, its values and its runs."""

    number: int  # from one on
    values: dict[str, float]  # by variable, SI
    runs: list[int]


def faults(lengths: xr.Dataset) -> list[Fault]:
    """The faults of a table of lengths, in the order of their first runs."""
    found: dict[tuple[Any, ...], list[int]] = {}
    columns = [lengths[name].values.tolist() for name in (*QUANTITIES, *BELOW)]
    for i, values in enumerate(zip(*columns, strict=True)):
        found.setdefault(tuple(map(_mark, values)), []).append(i)
    return [
        Fault(n, dict(zip(QUANTITIES, mark, strict=False)), runs)
        for n, (mark, runs) in enumerate(found.items(), start=1)
    ]


def _mark(value: Any) -> Any:
    """A value by which faults are told apart: numbers that differ by rounding are the same."""
    number = isinstance(value, float | int) and np.isfinite(value)
    return float(f"{value:.{DIGITS}g}") if number else str(value)


VERDICTS = {
    "replicated": ("✓", "yes"),
    "taken as given": ("=", "given"),
    "replicated with a deviation that is explained": ("≈", "nearly"),
    "not supported": ("✗", "no"),
    "not replicated": ("✗", "no"),
    "cannot be checked": ("?", "open"),
}
"""Every verdict with its sign and the class of its colour, from best to worst."""

TYPESET = ("statement", "method", "paper", "reason")
"""Texts of claims with symbols in them."""


def number(value: float, digits: int = 4) -> str:
    """A number with so many significant digits; a dash where there is none."""
    return f"{value:.{digits}g}" if math.isfinite(value) else "–"


def claim_rows(claims: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """The claims, ready to be shown: numbers as text, the verdict's sign."""
    rows = []
    for claim in claims:
        sign, kind = VERDICTS[claim["verdict"]]
        shown = {name: _shown(claim[name]) for name in ("paper", "ours", "unit")}
        shown["unit"] = "" if shown["unit"] == "1" else shown["unit"]
        if re.fullmatch(r"[\d.e+-]+", shown["paper"]):  # a number, not words with their own units
            shown["paper"] = f"{shown['paper']} {shown['unit']}".rstrip()
        shown["spread"] = _spread(claim["ours"], claim["uncertainty"])
        typeset = {name: Markup(_typeset({**claim, **shown}.get(name) or "")) for name in TYPESET}
        rows.append({**claim, **shown, "sign": sign, "kind": kind, "typeset": typeset})
    return rows


def _typeset(text: str) -> str:
    """HTML of a text with mathematics between dollars, which browsers show without any script."""
    parts = re.split(r"\$([^$]+)\$", text)
    parts[::2] = [html.escape(part, quote=False) for part in parts[::2]]
    parts[1::2] = map(_mathml, parts[1::2])
    return "".join(parts)


def _mathml(tex: str) -> str:
    try:
        return tex2mathml(tex)
    except MathError:
        return html.escape(tex, quote=False)


def _shown(value: float | str | None) -> str:
    """A number with four digits, a text as it is, None as nothing."""
    if value is None or isinstance(value, str):
        return value or ""
    return number(float(value))


def _spread(ours: float | None, ends: list[float | None] | None) -> str:
    """The ends of a range about our number; nothing if they don't differ from it as shown."""
    low, high = (_shown(end) for end in ends or (None, None))
    if ours is None or low == high == _shown(ours):
        return ""
    return f"({low or '–∞'} to {high or '∞'})"


def verdict_counts(claims: list[dict[str, Any]]) -> list[dict[str, Any]]:
    """How many claims have each verdict, from best to worst; verdicts of none are left out."""
    counts = Counter(claim["verdict"] for claim in claims)
    return [
        {"verdict": verdict, "sign": sign, "kind": kind, "count": counts[verdict]}
        for verdict, (sign, kind) in VERDICTS.items()
        if counts[verdict]
    ]


LENGTH_COLUMNS = (
    "Simulation", "H (m)", "Onset (s)", "Length (m)", "Range (m)", "Over theory", "Elements",
    "Steps", "Time (s)", "Memory (MB)",
)  # fmt: skip
RUN_COLUMNS = (
    "Simulation", "Fault", "H (m)", "Onset (s)", "Length (m)", "Range (m)", "Theory (m)",
    "Over theory",
)  # fmt: skip


def run_rows(lengths: xr.Dataset, columns: tuple[str, ...]) -> list[dict[str, str]]:
    """One row for every simulation of a table of lengths: texts by column."""
    of_run = {i: fault.number for fault in faults(lengths) for i in fault.runs}
    rows = []
    for i, run in enumerate(rows_of(lengths)):
        low, high = (number(run[name], 3) for name in ("length_low", "length_high"))
        cells = {
            "Simulation": str(run["id"]),
            "Fault": str(of_run[i]),
            "H (m)": number(run["height"]),
            "Onset (s)": number(run["onset_time"]),
            "Length (m)": number(run["length"]),
            "Range (m)": f"{low} to {high}" if math.isfinite(run["length_low"]) else "–",
            "Theory (m)": number(run["theory_length"]),
            "Over theory": number(run["length"] / run["theory_length"], 3),
            "Elements": f"{run['n_x']} × {run['n_y']}",
            "Steps": str(run["steps"]),
            "Time (s)": number(run["wall_seconds"], 3),
            "Memory (MB)": number(run["peak_megabytes"], 3),
        }
        rows.append({name: cells[name] for name in columns})
    return rows


def fault_rows(lengths: xr.Dataset) -> list[dict[str, str]]:
    """The faults of a table of lengths, one row for each: texts by column."""
    return [
        {
            "Fault": str(fault.number),
            **{t: number(fault.values[name] / unit) for name, (t, unit) in QUANTITIES.items()},
            "Runs": str(len(fault.runs)),
        }
        for fault in faults(lengths)
    ]


def csv_of(dataset: xr.Dataset, variables: tuple[str, ...] = ()) -> bytes:
    """Some variables of a dataset as CSV, all if none is named; of a table its rows alone."""
    chosen = dataset[list(variables)] if variables else dataset
    others = {*chosen.dims} - {"run"} if "run" in chosen.dims else ()  # each pair were a line
    frame = chosen.drop_dims(others).to_dataframe().reset_index()
    frame = frame.drop(columns=[c for c in frame if c not in dataset.variables])
    units = {name: dataset[name].attrs.get("units", "1") for name in frame}
    titles = {n: n if unit == "1" else f"{n} ({unit})" for n, unit in units.items()}
    return bytes(frame.rename(columns=titles).to_csv(index=False).encode())


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
