"""Table S1: the parameters of the friction law, in the paper's order."""

import csv
import io
from fractions import Fraction
from typing import NamedTuple

from nucleation.model.friction.law import Friction
from nucleation.model.quantities import declarations

_ORDER = (
    "slip_distance",
    "aging_coefficient",
    "slip_rate_scale",
    "base_friction",
    "state_scale",
    "regularisation_slip_rate",
    "rate_coefficient",
)

# symbols that are declared in ASCII
_PRINTED = {"theta": "θ", "phi*": "φ*", "v0": "v₀", "xi": "ξ"}
_SUPERSCRIPTS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class _Parameter(NamedTuple):
    """One row of the table: the paper's symbol, value in SI units, unit and description."""

    symbol: str
    value: float
    unit: str
    description: str


def rows(friction: Friction) -> list[_Parameter]:
    """The rows of the table for a friction law; ``-`` is the unit of dimensionless numbers."""
    entries = declarations(type(friction))
    names = _ORDER if set(_ORDER) <= set(entries) else entries
    found = []
    for name in names:
        entry = entries[name]
        if entry.choices:
            continue
        symbol = _PRINTED.get(entry.symbol, entry.symbol)
        unit = "-" if entry.unit == "1" else entry.unit
        value = float(getattr(friction, name))
        found.append(_Parameter(symbol, value, unit, entry.description))
    return found


def value_text(value: float) -> str:
    """A value as the paper writes it: ``5e-07`` as 5×10⁻⁷, 0.2777... as 5/18, 0.075 as is."""
    fraction = Fraction(value).limit_denominator(100)
    if len(f"{value:.12g}") > 8 and float(fraction) == value:
        return str(fraction)
    mantissa, exponent = f"{value:.6e}".split("e")
    if value == 0.0 or -4 < int(exponent) < 5:
        return f"{value:.6g}"
    raised = str(int(exponent)).translate(_SUPERSCRIPTS)
    factor = f"{float(mantissa):g}"
    return f"10{raised}" if factor == "1" else f"{factor}×10{raised}"


def to_markdown(table: list[_Parameter]) -> str:
    """The table as Markdown, ending in a newline."""
    lines = ["| Parameter | Value | Units | Description |", "|---|---|---|---|"]
    for row in table:
        symbol = row.symbol.replace("*", r"\*")
        lines.append(f"| {symbol} | {value_text(row.value)} | {row.unit} | {row.description} |")
    return "\n".join(lines) + "\n"


def files(friction: Friction) -> dict[str, str]:
    """The table as CSV and Markdown, by suffix (rule ``table_s1``)."""
    found = rows(friction)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["symbol", "value", "unit", "description"])
    writer.writerows(found)
    return {".csv": text.getvalue(), ".md": to_markdown(found)}
