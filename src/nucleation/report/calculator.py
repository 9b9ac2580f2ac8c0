"""A calculator of a fault's lengths: one HTML file that needs no network (``make calculator``).

The page computes L_c, L_s and the lengths in use by the report's own code (``theory.js`` and
``stability.js``); what they are called, their sources and limits come from the library.
"""

import dataclasses
import math
import sys
import urllib.parse
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from ..answers import finite_patch, formulas
from ..answers.in_use import HALF_SPACES, LENGTHS, THIS_FAULT, TWO_MATERIALS
from ..model.units import bounds, parse
from ..theory.fault import QUANTITIES
from . import encode, stability

SCRIPTS = ("page.js", "theory.js", "stability.js", "lengths.js", "calculator.js")
"""What runs in this page and in the report, in this order."""


class Field(NamedTuple):
    """A number that the page asks for: the library's parameter, and how it is shown."""

    key: str
    label: str
    symbol: str
    value: str = ""  # at first, in the first of the units
    units: tuple[str, ...] = ()
    empty: str = ""  # what it means to leave it out, where that is allowed


MODULI, LENGTH_UNITS = ("GPa", "MPa", "Pa"), ("m", "cm", "mm", "km")
FIELDS = (
    Field("shear_modulus", "Shear modulus", "μ", "30", MODULI),
    Field("poisson_ratio", "Poisson's ratio", "ν", "0.25"),
    Field("height", "Height", "H", "", LENGTH_UNITS, "half-space"),
    Field("normal_stress", "Normal stress", "σ₀", "50", ("MPa", "kPa", "GPa", "Pa")),
    Field("a", "Direct effect, natural log", "a", "0.01"),
    Field("b", "Effect of the state, natural log", "b", "0.015"),
    Field("slip_distance", "Slip distance", "D", "5", ("um", "mm", "cm", "m")),
    Field("friction", "Friction coefficient", "f", "0.6", (), "if bodies are alike"),
    Field("velocity", "Sliding velocity", "V", "", ("um/s", "mm/yr", "mm/s", "m/s"), "optional"),
    Field("second_shear_modulus", "Its shear modulus", "μ₂", "10", MODULI),
    Field("second_poisson_ratio", "Its Poisson's ratio", "ν₂", "0.25"),
    Field("second_height", "Its height", "H₂", "", LENGTH_UNITS, "half-space"),
)

FAR_SIDES = {
    "traction": "free, or under a given stress",
    "velocity": "pushed along, free to rise",
    "clamped": "glued to a rigid body",
    "roller": "on rollers",
}
"""Conditions on the sides away from the fault, with words for them."""

THICK = 20.0
"""Heights over L_c from which on layers have the L_s of half-spaces, within the precision."""


def build() -> str:
    """The whole page as HTML."""
    return encode.template("calculator.html").render(shown(), level=2)


def shown(given: Mapping[str, Any] | None = None) -> dict[str, Any]:
    """What a template with the calculator needs.

    Parameters
    ----------
    given : mapping, optional
        What the fields begin with, as :class:`~nucleation.theory.fault.Fault` has it; else they are
        read from the page's address, and stand there.
    """
    return {
        "styles": encode.source("page.css"), "scripts": [*map(encode.source, SCRIPTS)],
        "asked": ((FIELDS[:3], "The body"), (FIELDS[3:9], "The interface"), (FIELDS[9:], "")),
        "far_sides": FAR_SIDES, "precision": stability.PRECISION,
        "ends": stability.TABLES["half_spaces"].ends["zeta_over_a"],
        "data": encode.script_json(data() if given is None else data() | {"given": _words(given)}),
    }  # fmt: skip


def _words(given: Mapping[str, Any]) -> str:
    """A fault on a rigid base as the page's address has it, each value in its first unit."""
    words = {"second-body": "rigid", "plane": given["plane"]}
    for field in FIELDS:
        if field.key in given:
            unit = "".join(field.units[:1])
            value = given[field.key] / _in_page(field)["units"].get(unit, 1.0)
            words[field.key.replace("_", "-")] = f"{value:.10g}{unit}"
    return urllib.parse.urlencode(words)


def data() -> dict[str, Any]:
    """What the page's code reads."""
    return {
        "fields": [_in_page(field) for field in FIELDS],
        "lengths": [
            {"key": length.key, **length.words()}
            for length in LENGTHS if length.system != THIS_FAULT
        ],
        "two_materials": TWO_MATERIALS, "half_spaces": HALF_SPACES,
        "thick": THICK, "stability": stability.in_page(),
        "limits": {
            "localised": formulas.LOCALISED_LIMIT,
            "crack": formulas.CRACK_LIMIT,
            "thin": formulas.THIN,
            "patch": formulas.FINITE_PATCH,
            "negligible": formulas.NEGLIGIBLE,
            "nearest": finite_patch.NEAREST,
            "chebyshev": finite_patch.polynomial().tolist(),
        },
    }  # fmt: skip


def _in_page(field: Field) -> dict[str, Any]:
    """A field with its units in SI units and its range; the second body is not rigid here."""
    entry = QUANTITIES[field.key.removeprefix("second_")]
    unbounded = dataclasses.replace(entry, low=-math.inf, high=math.inf)  # of which a unit is one
    return {
        "key": field.key, "label": field.label, "optional": bool(field.empty),
        "units": {unit: parse(field.key, f"1{unit}", unbounded) for unit in field.units},
        "low": entry.low, "high": min(entry.high, 1e99), "closed": entry.closed,
        "range": bounds(entry),
    }  # fmt: skip


if __name__ == "__main__":
    Path(sys.argv[1]).parent.mkdir(parents=True, exist_ok=True)
    Path(sys.argv[1]).write_text(build(), encoding="utf-8")
