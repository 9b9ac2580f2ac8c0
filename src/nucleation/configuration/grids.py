"""Values in the configuration that stand for many: lists, ranges, and grids of these."""

import math
from typing import Any

import numpy as np

from ..model.quantities import Quantity

RANGE: dict[str, Quantity] = {
    "num": Quantity("number of values", low=2, high=10000, closed="both", kind="int"),
    "scale": Quantity("spacing of the values", choices=("linear", "log")),
}
"""Keys of a range beside ``start`` and ``stop``, which have the parameter's own declaration."""

LARGEST_GRID = 10000
"""Simulations that one entry of a study may stand for."""


def expand(value: Any) -> tuple[Any, ...]:
    """The values meant by a value, a list of values or a range, in the order given.

    Values of a range are rounded to six significant digits, which identifiers then state exactly.
    """
    if isinstance(value, list):
        return tuple(value)
    if not isinstance(value, dict):
        return (value,)
    spaced = np.geomspace if value.get("scale", "linear") == "log" else np.linspace
    return tuple(float(f"{x:.6g}") for x in spaced(value["start"], value["stop"], value["num"]))


def grid_size(entry: dict[str, Any]) -> int:
    """The number of simulations that an entry of a study stands for."""
    return math.prod(
        value["num"] if isinstance(value, dict) else len(value) if isinstance(value, list) else 1
        for key, value in entry.items()
        if key != "defaults"
    )


def range_problem(value: Any) -> str | None:
    """Why a range can't be expanded, or None."""
    if not isinstance(value, dict):
        return None
    if not value["start"] < value["stop"]:
        return f"start {value['start']!r} must be less than stop {value['stop']!r}"
    if value.get("scale") == "log" and not value["start"] > 0.0:
        return f"start {value['start']!r} must be positive on a log scale"
    if len(set(expand(value))) < value["num"]:
        return f"its {value['num']} values from {value['start']!r} on are not all different"
    return None
