"""Table S1: the parameters of the friction law, in the paper's order."""

import csv
import io
from fractions import Fraction
from typing import NamedTuple

from ...model.friction.law import Friction
from ...model.quantities import declarations

ORDER = (
    "characteristic_slip_distance",
    "aging_coefficient",
    "slip_rate_scale",
    "base_friction",
    "state_scale",
    "regularisation_slip_rate",
    "rate_coefficient",
)

PRINTED = {"theta": "θ", "phi*": "φ*", "v0": "v₀", "xi": "ξ"}  # symbols spelled out elsewhere


class Row(NamedTuple):
    """One parameter: paper symbol, value in SI units, its unit, and what it is."""

    symbol: str
    value: float
    unit: str
    description: str


def rows(friction: Friction) -> list[Row]:
    """The rows of the table for a friction law, dimensionless units written as ``-``."""
    entries = declarations(type(friction))
    return [
        Row(
            PRINTED.get(entries[name].symbol, entries[name].symbol),
            float(getattr(friction, name)),
            "-" if entries[name].unit == "1" else entries[name].unit,
            entries[name].description,
        )
        for name in (ORDER if set(ORDER) <= set(entries) else entries)
        if not entries[name].choices
    ]


def value_text(value: float) -> str:
    """A value as the paper writes it: ``5e-07`` as 5×10⁻⁷, 0.2777... as 5/18, 0.075 as is."""
    fraction = Fraction(value).limit_denominator(100)
    if len(f"{value:.12g}") > 8 and float(fraction) == value:
        return str(fraction)
    mantissa, exponent = f"{value:.6e}".split("e")
    if value == 0.0 or -4 < int(exponent) < 5:
        return f"{value:.6g}"
    raised = str(int(exponent)).translate(str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"))
    factor = f"{float(mantissa):g}"
    return f"10{raised}" if factor == "1" else f"{factor}×10{raised}"


def to_markdown(table: list[Row]) -> str:
    """The table as Markdown, ending in a newline."""
    lines = ["| Parameter | Value | Units | Description |", "|---|---|---|---|"]
    for row in table:
        symbol = row.symbol.replace("*", r"\*")
        lines.append(f"| {symbol} | {value_text(row.value)} | {row.unit} | {row.description} |")
    return "\n".join(lines) + "\n"


def files(friction: Friction) -> dict[str, str]:
    """The step ``table_s1``: CSV and Markdown."""
    found, text = rows(friction), io.StringIO()
    csv.writer(text, lineterminator="\n").writerows([Row._fields, *found])
    return {".csv": text.getvalue(), ".md": to_markdown(found)}
