"""Formulas: Figures 2 and S1, and Table S1."""

import csv
import io
from fractions import Fraction
from itertools import cycle

import numpy as np
import xarray as xr
from matplotlib.figure import Figure

from nucleation.model.friction import Friction
from nucleation.model.quantities import declarations
from nucleation.pictures import style
from nucleation.types import Array

DASHES = ("-", (0, (5, 1.5)), (0, (5, 1.5, 1, 1.5)), (0, (1.2, 1.2)), (0, (9, 1.5, 1, 1.5, 1, 1.5)))
HANDLE = 4.0  # length of the legend's lines over the font size: each pattern is shown entirely

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


def looks(weakenings: Array) -> dict[float, style.Options]:
    """Colour and dashes by zeta/a, from the highest to the lowest."""
    values = np.unique(weakenings)[::-1].tolist()
    kinds = zip(values, style.shades(len(values), 0.82), cycle(DASHES), strict=False)
    return {value: {"color": shade, "linestyle": dashes} for value, shade, dashes in kinds}


@style.styled()
def figure_2(theory: xr.Dataset) -> Figure:
    """Draw ``L_c / L_c^M`` against ``f beta`` (Eq. 9), one curve for each ``zeta / a``."""
    figure, axes = style.panels(6.6, style.SINGLE_COLUMN)
    ratio = theory["bimaterial_length_ratio"]
    f_beta = ratio["f_beta"].values
    for value, look in looks(ratio["zeta_over_a"].values).items():
        axes.plot(f_beta, ratio.sel(zeta_over_a=value), label=f"${style.number(value, 3)}$", **look)
    axes.set(xlabel=r"Bimaterial contrast $f\beta$", xlim=(f_beta.min(), f_beta.max()))
    axes.set(ylabel=r"Critical length $L_c/L_c^{\mathcal{M}}$", ylim=(0.0, 1.04))
    # the curves decrease from one, the highest zeta/a on top: the legend has their order
    axes.legend(loc="lower left", handlelength=HANDLE, title=r"$\zeta/a$")
    return figure


@style.styled()
def figure_s1(theory: xr.Dataset) -> Figure:
    """Draw both steady-state friction curves and mark the driving velocity V."""
    figure, axes = style.panels(6.4, style.SINGLE_COLUMN)
    rate = theory["slip_rate"].values
    full, logarithmic = theory["steady_friction"], theory["steady_friction_logarithmic"]
    axes.semilogx(rate, full, color=style.FULL_LAW, linewidth=2.2, label="full law")
    axes.semilogx(rate, logarithmic, color=style.BLUE, linewidth=1.1, label="logarithmic law")
    velocity = float(theory["velocity"])
    axes.axvline(velocity, linestyle="--", linewidth=0.9)
    across = axes.get_xaxis_transform()
    axes.annotate("$V$", (velocity, 0.0), (4.0, 5.0), across, "offset points")
    axes.set(xlabel="Slip rate $v$ (m/s)", xlim=(rate.min(), rate.max()))
    axes.set_ylabel(r"Steady-state friction coefficient $f_{\mathrm{ss}}$")
    axes.legend(loc="upper right")
    return figure


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


def table_s1(friction: Friction) -> dict[str, str]:
    """The parameters of a friction law as CSV and Markdown, by suffix (rule ``table_s1``).

    ``-`` is the unit of dimensionless numbers.
    """
    entries = declarations(type(friction))
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(("symbol", "value", "unit", "description"))
    lines = ["| Parameter | Value | Units | Description |", "|---|---|---|---|"]
    for name in _ORDER if set(_ORDER) <= set(entries) else entries:
        entry = entries[name]
        if not entry.choices:
            symbol = _PRINTED.get(entry.symbol, entry.symbol)
            unit = "-" if entry.unit == "1" else entry.unit
            value = float(getattr(friction, name))
            writer.writerow((symbol, value, unit, entry.description))
            cells = symbol.replace("*", r"\*"), value_text(value), unit, entry.description
            lines.append(f"| {' | '.join(cells)} |")
    return {".csv": text.getvalue(), ".md": "\n".join(lines) + "\n"}
