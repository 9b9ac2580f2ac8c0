"""The faults of a table of lengths, as far as the theory tells them apart."""

from typing import Any, NamedTuple

import numpy as np
import xarray as xr

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
