"""The claims in the report: their verdicts, numbers and typeset texts."""

import html
import re
from collections import Counter
from typing import Any

from docutils.utils.math import MathError
from docutils.utils.math.latex2mathml import tex2mathml
from markupsafe import Markup

from .tables import number

VERDICTS = {
    "replicated": ("✓", "yes"),
    "taken as given": ("=", "given"),
    "replicated with a deviation that is explained": ("≈", "nearly"),
    "not supported": ("✗", "no"),
    "not replicated": ("✗", "no"),
    "cannot be checked": ("?", "open"),
}
"""Verdicts from best to worst, each with its sign and the class of its colour."""

_TYPESET = ("statement", "method", "paper", "reason")
"""Texts of claims that may contain mathematics."""

Claim = dict[str, Any]


def claim_rows(claims: list[Claim]) -> list[Claim]:
    """The claims with numbers as text, the verdict's sign and typeset texts."""
    rows = []
    for claim in claims:
        sign, kind = VERDICTS[claim["verdict"]]
        shown = _shown_values(claim)
        row = {**claim, **shown, "sign": sign, "kind": kind}
        typeset = {name: Markup(_typeset(row.get(name) or "")) for name in _TYPESET}
        rows.append({**row, "typeset": typeset})
    return rows


def _shown_values(claim: Claim) -> dict[str, str]:
    unit = _text(claim["unit"])
    if unit == "1":
        unit = ""
    paper = _text(claim["paper"])
    if re.fullmatch(r"[\d.e+-]+", paper):  # a number; words have their own units
        paper = f"{paper} {unit}".rstrip()
    return {
        "paper": paper,
        "ours": _text(claim["ours"]),
        "unit": unit,
        "spread": _spread(claim["ours"], claim["uncertainty"]),
    }


def verdict_counts(claims: list[Claim]) -> list[dict[str, Any]]:
    """The number of claims with each verdict, from best to worst; zeros are left out."""
    counts = Counter(claim["verdict"] for claim in claims)
    rows = []
    for verdict, (sign, kind) in VERDICTS.items():
        if counts[verdict]:
            count = counts[verdict]
            rows.append(
                {
                    "verdict": verdict,
                    "sign": sign,
                    "kind": kind,
                    "count": count,
                }
            )
    return rows


def _typeset(text: str) -> str:
    """HTML of a text with mathematics between dollars, which browsers show without a script."""
    parts = re.split(r"\$([^$]+)\$", text)
    parts[::2] = [html.escape(part, quote=False) for part in parts[::2]]
    parts[1::2] = [_mathml(part) for part in parts[1::2]]
    return "".join(parts)


def _mathml(tex: str) -> str:
    try:
        return tex2mathml(tex)
    except MathError:
        return html.escape(tex, quote=False)


def _text(value: float | str | None) -> str:
    """A number with four digits, a text as it is, None as an empty text."""
    if value is None or isinstance(value, str):
        return value or ""
    return number(float(value))


def _spread(ours: float | None, ends: list[float | None] | None) -> str:
    """The range of our number; empty if its rounded ends are the rounded number."""
    low, high = (_text(end) for end in ends or (None, None))
    if ours is None or low == high == _text(ours):
        return ""
    return f"({low or '–∞'} to {high or '∞'})"
