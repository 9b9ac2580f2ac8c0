"""What the theory knows of a fault: the page's sliders over it, and the faults of a table."""

import dataclasses
from typing import Any, NamedTuple

import numpy as np
import xarray as xr

from ..figures import style
from ..model.identity import DIGITS
from ..model.linearised import InterfaceState
from ..model.material import Material, in_plane_ratio


class Quantity(NamedTuple):
    """One number of the theory: its names, and how a slider over it is shown."""

    variable: str  # of a table of lengths
    group: type
    parameter: str
    key: str  # in the page's code
    label: str
    symbol: str
    unit: str
    factor: float  # SI over the unit shown
    low: float  # ends of the slider, in the unit shown
    high: float
    logarithmic: bool = True


QUANTITIES = tuple(Quantity(*row) for row in (
    ("shear_modulus", Material, "shear_modulus", "mu", "Shear modulus", "μ", "GPa", 1e9, 0.1, 1e2),
    ("poisson_ratio", Material, "poisson_ratio", "nu", "Poisson's ratio", "ν", "", 1.0, 0.0, 0.49,
     False),
    ("applied_stress", InterfaceState, "normal_stress", "sigma0", "Normal stress", "σ₀", "MPa", 1e6,
     0.1, 2e2),
    ("friction_coefficient", InterfaceState, "friction", "f", "Friction coefficient", "f", "", 1.0,
     0.0, 1.0, False),
    ("direct_effect", InterfaceState, "a", "a", "Direct effect", "a", "", 1.0, 0.001, 0.05),
    ("velocity_weakening", InterfaceState, "zeta", "zeta", "Velocity weakening", "ζ", "", 1.0,
     0.001, 0.05),
    ("slip_distance", InterfaceState, "slip_length", "ell", "Slip distance", "ℓ = D", "µm", 1e-6,
     0.05, 1e3),
    ("velocity", InterfaceState, "velocity", "V", "Sliding velocity", "V", "µm/s", 1e-6, 1e-3, 1e4),
))  # fmt: skip
"""What makes a fault of its own for the theory, on what lies below (:data:`BELOW`). Runs of other
heights, laws and ages are of the same one: they lie about one curve."""

BELOW = ("below", "far_side", "second_shear_modulus", "second_poisson_ratio", "plane")


def controls(material: Material, interface: InterfaceState) -> list[dict[str, Any]]:
    """The sliders as the page needs them, at the configuration's values.

    Parameters
    ----------
    material : Material
        Of the block; the page computes in plane strain.
    interface : InterfaceState
        On which the theory's curve of Figure 3 stands.

    Returns
    -------
    list of dict
        ``key``, ``label``, ``symbol``, ``unit``, ``factor`` (SI over the unit), ``low``, ``high``,
        ``log`` and ``value``; the ends and the value in the unit, the range widened to hold it.
    """
    given: dict[type, dict[str, Any]] = {
        Material: dataclasses.asdict(material) | {"poisson_ratio": material.in_plane_ratio},
        InterfaceState: dataclasses.asdict(interface),
    }
    result = []
    for quantity in QUANTITIES:
        value = float(f"{given[quantity.group][quantity.parameter] / quantity.factor:.12g}")
        names = ("key", "label", "symbol", "unit", "factor")
        ends = {"low": min(quantity.low, value), "high": max(quantity.high, value)}
        shown = {name: getattr(quantity, name) for name in names}
        result.append({**shown, **ends, "log": quantity.logarithmic, "value": value})
    return result


SYMBOLS = (
    "circle", "square", "diamond", "triangle-up", "triangle-down", "star", "cross", "x",
    "triangle-left", "triangle-right", "pentagon", "hourglass", "bowtie", "hexagram",
)  # fmt: skip
COLOURS = (
    style.VERMILLION, style.BLACK, style.PURPLE, style.GREEN, style.OLD_AGE, style.SKY_BLUE,
)  # fmt: skip
"""Markers of faults in the page's plot, and their colours."""


def look(number: int) -> tuple[str, str]:
    """Marker and colour of a fault; no two of the first 84 have the same of both."""
    turn, place = divmod(number - 1, len(SYMBOLS))
    return SYMBOLS[place], COLOURS[(place + turn) % len(COLOURS)]


class Fault(NamedTuple):
    """One fault of a table of lengths: its number, its values and its runs."""

    number: int  # from one on
    values: dict[str, float]  # by variable, SI
    runs: list[int]
    rigid: bool  # the base below, the only one that the page's theory knows
    plane: str

    def in_page(self) -> dict[str, Any]:
        """The fault as the page's code reads it, in plane strain."""
        ratio = in_plane_ratio(self.values["poisson_ratio"], self.plane)
        values = self.values | {"poisson_ratio": ratio}
        return {
            "label": f"fault {self.number}",
            "colour": look(self.number)[1],
            "values": {quantity.key: values[quantity.variable] for quantity in QUANTITIES},
        }


def faults(lengths: xr.Dataset) -> list[Fault]:
    """The faults of a table of lengths, in the order of their first runs."""
    found: dict[tuple[Any, ...], list[int]] = {}
    names = [quantity.variable for quantity in QUANTITIES]
    columns = [lengths[name].values.tolist() for name in (*names, *BELOW)]
    for i, values in enumerate(zip(*columns, strict=True)):
        found.setdefault(tuple(map(_mark, values)), []).append(i)
    return [
        Fault(n, dict(zip(names, mark, strict=False)), runs, mark[len(names)] == "rigid", mark[-1])
        for n, (mark, runs) in enumerate(found.items(), start=1)
    ]


def _mark(value: Any) -> Any:
    """A value by which faults are told apart: numbers that differ by rounding are the same."""
    number = isinstance(value, float | int) and np.isfinite(value)
    return float(f"{value:.{DIGITS}g}") if number else str(value)
