"""A calculator of a fault's lengths: one HTML file that needs no network (``make calculator``).

The page computes L_c and the lengths in use by formulas, L_s, L_run and W_c by tables. Their names,
sources and limits come from the library.
"""

import dataclasses
import json
import math
import sys
import urllib.parse
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

from nucleation.lengths import finite_patch, formulas
from nucleation.lengths.in_use import LENGTHS
from nucleation.lengths.length import HALF_SPACES, THIS_FAULT, TWO_MATERIALS
from nucleation.model.units import bounds, parse
from nucleation.theory.fault import QUANTITIES

from . import encode, stability

SCRIPTS = (
    "page.js",
    "theory.js",
    "tables.js",
    "stability.js",
    "patch.js",
    "lengths.js",
    "calculator.js",
)
"""Scripts of this page and of the report, in this order."""


class _Input(NamedTuple):
    """An input field of the page: the library's parameter and its display."""

    key: str
    label: str
    symbol: str
    value: str = ""  # the first value, in the first unit
    units: tuple[str, ...] = ()
    empty: str = ""  # meaning of an empty field, if it may be empty


_MODULI = ("GPa", "MPa", "Pa")
_HEIGHTS = ("m", "cm", "mm", "km")
_STRESSES = ("MPa", "kPa", "GPa", "Pa")
_DISTANCES = ("um", "mm", "cm", "m")
_VELOCITIES = ("um/s", "mm/yr", "mm/s", "m/s")

_BODY = (
    _Input("shear_modulus", "Shear modulus", "μ", "30", _MODULI),
    _Input("poisson_ratio", "Poisson's ratio", "ν", "0.25"),
    _Input("height", "Height", "H", "", _HEIGHTS, "half-space"),
)
_INTERFACE = (
    _Input("normal_stress", "Normal stress", "σ₀", "50", _STRESSES),
    _Input("a", "Direct effect, natural log", "a", "0.01"),
    _Input("b", "Effect of the state, natural log", "b", "0.015"),
    _Input("slip_distance", "Slip distance", "D", "5", _DISTANCES),
    _Input(
        "friction",
        "Friction coefficient",
        "f",
        "0.6",
        (),
        "if bodies are alike",
    ),
    _Input("velocity", "Sliding velocity", "V", "", _VELOCITIES, "optional"),
)
_SECOND_BODY = (
    _Input("second_shear_modulus", "Its shear modulus", "μ₂", "10", _MODULI),
    _Input("second_poisson_ratio", "Its Poisson's ratio", "ν₂", "0.25"),
    _Input("second_height", "Its height", "H₂", "", _HEIGHTS, "half-space"),
)
_SURROUNDINGS = (
    _Input("outside_zeta", "ζ = b − a around the patch", "ζₒ", "", (), "the patch's"),
    _Input("outside_a", "Direct effect around the patch", "aₒ", "", (), "the patch's"),
)
FIELDS = (*_BODY, *_INTERFACE, *_SECOND_BODY, *_SURROUNDINGS)

FAR_SIDES = {
    "traction": "free, or under a given stress",
    "velocity": "pushed along, free to rise",
    "clamped": "glued to a rigid body",
    "roller": "on rollers",
}
"""Boundary conditions on the sides away from the fault, with their labels."""

_THICK = 20.0
"""Height over L_c above which layers have the L_s of half-spaces, within the precision."""


def build(patch_tables: Path) -> str:
    """The whole page as HTML, with the tables of :func:`.patch_tables.files`."""
    return encode.template("calculator.html").render(shown(patch_tables), level=2)


def shown(
    patch_tables: Path,
    given: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """Values for a template that contains the calculator.

    Parameters
    ----------
    patch_tables : Path
        JSON of :func:`.patch_tables.files`.
    given : mapping, optional
        The first fault on a rigid base, parameters as of :class:`~nucleation.api.fault.Fault`.
        Without it the page reads the fault from its address, and writes it there.

    Returns
    -------
    dict
        By the names in the template.
    """
    tables = json.loads(patch_tables.read_text("utf-8"))
    read_by_page = data() | {"patch_tables": tables}
    if given is not None:
        read_by_page["given"] = _address(given)
    return {
        "styles": encode.source("page.css"),
        "scripts": [encode.source(script) for script in SCRIPTS],
        "asked": (
            (_BODY, "The body"),
            (_INTERFACE, "The interface"),
            (_SECOND_BODY, ""),
            (_SURROUNDINGS, "If only a patch weakens: its surroundings"),
        ),
        "far_sides": FAR_SIDES,
        "precision": stability.PRECISION,
        "runaway_precision": tables["runaway_precision"],
        "weak": tables["runaway"]["rigid_base"]["ends"]["zeta_over_a"],
        "patch_precision": tables["patch_precision"],
        "ends": stability.TABLES["half_spaces"].ends["zeta_over_a"],
        "data": encode.script_json(read_by_page),
    }


def _address(given: Mapping[str, Any]) -> str:
    """A fault on a rigid base as part of the page's address, each value in its first unit."""
    words = {"second-body": "rigid", "plane": given["plane"]}
    for field in FIELDS:
        if field.key in given:
            unit = field.units[0] if field.units else ""
            value = given[field.key] / _in_page(field)["units"].get(unit, 1.0)
            words[field.key.replace("_", "-")] = f"{value:.10g}{unit}"
    return urllib.parse.urlencode(words)


def data() -> dict[str, Any]:
    """Values for the page's scripts."""
    lengths = []
    for length in LENGTHS:
        if length.system != THIS_FAULT:
            lengths.append({"key": length.key, **length.words()})
    return {
        "fields": [_in_page(field) for field in FIELDS],
        "lengths": lengths,
        "two_materials": TWO_MATERIALS,
        "half_spaces": HALF_SPACES,
        "thick": _THICK,
        "stability": stability.in_page(),
        "limits": {
            "localised": formulas.LOCALISED_LIMIT,
            "crack": formulas.CRACK_LIMIT,
            "thin": formulas.THIN,
            "patch": formulas.FINITE_PATCH,
            "negligible": formulas.NEGLIGIBLE,
            "nearest": finite_patch.NEAREST,
            "chebyshev": finite_patch.polynomial().tolist(),
        },
    }


def _in_page(field: _Input) -> dict[str, Any]:
    """A field with its units (in SI units) and its range; here the second body is not rigid."""
    entry = QUANTITIES[field.key.removeprefix("second_").removeprefix("outside_")]
    # a range without ends, as one unit may be outside the range of the parameter
    unbounded = dataclasses.replace(entry, low=-math.inf, high=math.inf)
    return {
        "key": field.key,
        "label": field.label,
        "optional": bool(field.empty),
        "units": {unit: parse(field.key, f"1{unit}", unbounded) for unit in field.units},
        "low": entry.low,
        "high": min(entry.high, 1e99),
        "closed": entry.closed,
        "range": bounds(entry),
    }


if __name__ == "__main__":
    output = Path(sys.argv[1])
    output.parent.mkdir(parents=True, exist_ok=True)
    output.write_text(build(Path(sys.argv[2])), encoding="utf-8")
