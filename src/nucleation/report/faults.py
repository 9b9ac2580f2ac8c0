"""The faults of a table of lengths: what differs to the theory, each with a look of its own."""

import string
from typing import Any, NamedTuple

import xarray as xr

from ..figures import style
from ..model.identity import DIGITS
from ..model.material import in_plane_ratio


class Column(NamedTuple):
    """A column of the table of faults: the variable, what is shown, and its unit."""

    variable: str
    label: str
    unit: str
    factor: float  # SI over the unit
    key: str  # the parameter's name in the page's code, or nothing


FAULT = (
    Column("shear_modulus", "μ", "GPa", 1e9, "mu"),
    Column("poisson_ratio", "ν", "", 1.0, "nu"),
    Column("density", "ρ", "kg/m³", 1.0, ""),
    Column("friction_coefficient", "f", "", 1.0, "f"),
    Column("direct_effect", "a", "", 1.0, "a"),
    Column("velocity_weakening", "ζ", "", 1.0, "zeta"),
    Column("slip_distance", "D", "µm", 1e-6, "ell"),
    Column("applied_stress", "σ₀", "MPa", 1e6, "sigma0"),
    Column("velocity", "V", "µm/s", 1e-6, "V"),
)
"""What makes a fault of its own for the theory, with the density, which the theory doesn't need.
Runs of other heights, laws and ages are of the same one here: they lie about one curve."""

BELOW = ("below", "far_side", "second_shear_modulus", "second_poisson_ratio", "plane")
"""And what lies below, and the plane of both."""

SYMBOLS = dict(zip(
    ("circle", "square", "diamond", "triangle-up", "triangle-down", "star", "cross", "x",
     "triangle-left", "triangle-right", "pentagon", "hourglass", "bowtie", "hexagram"),
    "●■◆▲▼★✚✖◀▶⬟⧗⋈✶", strict=True,
))  # fmt: skip
COLOURS = (
    style.VERMILLION, style.BLACK, style.PURPLE, style.GREEN, style.OLD_AGE, style.SKY_BLUE,
)  # fmt: skip
"""Markers of faults in the page's plot, and as text, and their colours."""


def look(number: int) -> tuple[str, str, str]:
    """Marker, sign and colour of a fault; no two of the first 84 have the same of both."""
    turn, place = divmod(number, len(SYMBOLS))
    return *list(SYMBOLS.items())[place], COLOURS[(place + turn) % len(COLOURS)]


class Fault(NamedTuple):
    """One fault of a table of lengths: its letter, its look, its values and its runs."""

    letter: str
    symbol: str
    sign: str
    colour: str
    values: dict[str, float]  # by variable, SI
    runs: list[int]
    rigid: bool  # the base below, the only one that the page's theory knows
    plane: str

    def in_page(self) -> dict[str, Any]:
        """The fault as the page's code reads it, which has plane strain and no zeta below 0."""
        ratio = in_plane_ratio(self.values["poisson_ratio"], self.plane)
        values = self.values | {"poisson_ratio": ratio}
        return {
            "label": f"fault {self.letter}",
            "colour": self.colour,
            "values": {c.key: values[c.variable] for c in FAULT if c.key},
        }


def faults(lengths: xr.Dataset) -> list[Fault]:
    """The faults of a table of lengths, in the order of their first runs."""
    found: dict[tuple[Any, ...], list[int]] = {}
    columns = [lengths[c.variable].values.tolist() for c in FAULT]
    columns += [lengths[name].values.tolist() for name in BELOW]
    for i, values in enumerate(zip(*columns, strict=True)):
        found.setdefault(tuple(_mark(value) for value in values), []).append(i)
    names = [column.variable for column in FAULT]
    return [
        Fault(
            _letter(n), *look(n), dict(zip(names, mark, strict=False)), runs,
            mark[len(FAULT)] == "rigid", mark[-1],
        )
        for n, (mark, runs) in enumerate(found.items())
    ]  # fmt: skip


def _mark(value: Any) -> Any:
    """A value by which faults are told apart: numbers that differ by rounding are the same."""
    number = isinstance(value, float | int) and value == value
    return float(f"{value:.{DIGITS}g}") if number else str(value)


def _letter(number: int) -> str:
    """A, B, ... Z, AA, AB, ..."""
    text = ""
    number += 1
    while number:
        number, digit = divmod(number - 1, 26)
        text = string.ascii_uppercase[digit] + text
    return text
