"""Tables of the report: verdicts, lengths with their cost, CSV."""

import html
import math
import re
from collections import Counter
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from markupsafe import Markup

from ..analysis.rows import rows_of
from ..model.identity import DIGITS


class Quantity(NamedTuple):
    """One number of the theory: a column of a table of lengths, and how it is shown."""

    variable: str
    symbol: str
    unit: str = ""
    factor: float = 1.0  # SI over the unit shown


QUANTITIES = (
    Quantity("shear_modulus", "μ", "GPa", 1e9), Quantity("poisson_ratio", "ν"),
    Quantity("applied_stress", "σ₀", "MPa", 1e6), Quantity("friction_coefficient", "f"),
    Quantity("direct_effect", "a"), Quantity("velocity_weakening", "ζ"),
    Quantity("slip_distance", "ℓ = D", "µm", 1e-6), Quantity("velocity", "V", "µm/s", 1e-6),
)  # fmt: skip
"""What makes a fault of its own for the theory, on what lies below (:data:`BELOW`). Runs of other
heights, laws and ages are of the same one."""

BELOW = ("below", "far_side", "second_shear_modulus", "second_poisson_ratio", "plane")


class Fault(NamedTuple):
    """One fault of a table of lengths: its number, its values and its runs."""

    number: int  # from one on
    values: dict[str, float]  # by variable, SI
    runs: list[int]


def faults(lengths: xr.Dataset) -> list[Fault]:
    """The faults of a table of lengths, in the order of their first runs."""
    found: dict[tuple[Any, ...], list[int]] = {}
    names = [quantity.variable for quantity in QUANTITIES]
    columns = [lengths[name].values.tolist() for name in (*names, *BELOW)]
    for i, values in enumerate(zip(*columns, strict=True)):
        found.setdefault(tuple(map(_mark, values)), []).append(i)
    return [
        Fault(n, dict(zip(names, mark, strict=False)), runs)
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
    names = {q: f"{q.symbol} ({q.unit})" if q.unit else q.symbol for q in QUANTITIES}
    return [
        {
            "Fault": str(fault.number),
            **{name: number(fault.values[q.variable] / q.factor) for q, name in names.items()},
            "Runs": str(len(fault.runs)),
        }
        for fault in faults(lengths)
    ]


def csv_text(dataset: xr.Dataset, variables: tuple[str, ...] = ()) -> str:
    """Some variables of a dataset (all if none is named) as CSV, units in the header."""
    chosen = dataset[list(variables)] if variables else dataset
    frame = chosen.to_dataframe().reset_index()
    frame = frame.drop(columns=[c for c in frame if c not in dataset.variables])
    units = {name: dataset[name].attrs.get("units", "1") for name in frame}
    titles = {n: n if unit == "1" else f"{n} ({unit})" for n, unit in units.items()}
    return frame.rename(columns=titles).to_csv(index=False)
