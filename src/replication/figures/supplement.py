"""The supplement: Figures S1 and S2, and Table S1."""

import csv
import io
from fractions import Fraction
from typing import NamedTuple

import xarray as xr
from matplotlib.figure import Figure

from nucleation.model.friction import Friction
from nucleation.model.quantities import declarations
from nucleation.pictures import run, style

from ..tables.lengths import row as row_of

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


@style.styled
def figure_s1(theory: xr.Dataset) -> Figure:
    """Draw both steady-state friction curves and mark the driving velocity V."""
    figure, axes = style.column(6.4)
    rate = theory["slip_rate"].values
    full = theory["steady_friction"].values
    logarithmic = theory["steady_friction_logarithmic"].values
    velocity = float(theory["velocity"])
    axes.semilogx(
        rate,
        full,
        color=style.FULL_LAW,
        linewidth=2.2,
        label="full law",
    )
    axes.semilogx(
        rate,
        logarithmic,
        color=style.BLUE,
        linewidth=1.1,
        label="logarithmic law",
    )
    style.vertical(axes, velocity)
    across = axes.get_xaxis_transform()
    axes.annotate(
        "$V$",
        (velocity, 0.0),
        (4.0, 5.0),
        across,
        "offset points",
    )
    axes.set_xlabel(r"Slip rate $v$ (m/s)")
    axes.set_ylabel(r"Steady-state friction coefficient $f_{\mathrm{ss}}$")
    axes.set_xlim(rate.min(), rate.max())
    axes.legend(loc="upper right")
    return figure


def figure_s2(lengths: xr.Dataset, simulation: xr.Dataset, id: str) -> Figure:
    """Stress in space and time of a run in a table of lengths; its length is L_c, as there."""
    return run.draw(simulation, row_of(lengths, id), "$L_c$")


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


def table_s1(friction: Friction) -> dict[str, str]:
    """The table as CSV and Markdown, by suffix (rule ``table_s1``)."""
    found = rows(friction)
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["symbol", "value", "unit", "description"])
    writer.writerows(found)
    return {".csv": text.getvalue(), ".md": to_markdown(found)}
