"""Sections of a configuration, values in lists and ranges, identifiers of runs."""

import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from nucleation.model.quantities import Quantity, declared
from nucleation.run.names import in_type, parameters, sections
from nucleation.run.run import Run

SECTIONS = {name: keys for name, keys in sections().items() if name != "block"}
"""The sections with parameters that all runs have unless a study sets them, and their keys."""

RANGE: dict[str, Quantity] = {
    "num": declared("number of values", "[2, 10000]", kind="int"),
    "scale": Quantity("spacing of the values", choices=("linear", "log")),
}
"""Keys of a range beside ``start`` and ``stop``, which have the parameter's own declaration."""

LARGEST_GRID = 10000
"""Most simulations of one entry of a study."""


def expand(value: Any) -> tuple[Any, ...]:
    """The values of a value, a list of values or a range, in the order given.

    Values of a range are rounded to six significant digits, so that identifiers have them exactly.
    """
    if isinstance(value, list):
        return tuple(value)
    if not isinstance(value, dict):
        return (value,)
    logarithmic = value.get("scale") == "log"
    spaced = np.geomspace if logarithmic else np.linspace
    numbers = spaced(value["start"], value["stop"], value["num"])
    return tuple(float(f"{number:.6g}") for number in numbers)


def grid_size(entry: Mapping[str, Any]) -> int:
    """The number of simulations of an entry of a study."""
    sizes = []
    for key, value in entry.items():
        if key == "defaults":
            continue
        if isinstance(value, dict):
            sizes.append(value["num"])
        elif isinstance(value, list):
            sizes.append(len(value))
    return math.prod(sizes)


def range_problem(value: Any) -> str | None:
    """The reason why a range can't be expanded, or None."""
    if not isinstance(value, dict):
        return None
    start = value["start"]
    stop = value["stop"]
    number = value["num"]
    if not start < stop:
        return f"start {start!r} must be less than stop {stop!r}"
    if value.get("scale") == "log" and not start > 0.0:
        return f"start {start!r} must be positive on a log scale"
    if len(set(expand(value))) < number:
        return f"its {number} values from {start!r} on are not all different"
    return None


def typed(entry: Quantity, value: Any) -> Any:
    """An allowed value, list or range in its declared type."""
    if value is None or not entry.many:
        return in_type(entry, value)
    return tuple(map(float, expand(value)))


def identifier(study: str, run: Run, varied: Mapping[str, Any]) -> str:
    """Readable, file-name-safe name of a run, such as ``paper-aging-H0.005-phi1-n_x800``.

    It has the study, the evolution law, the height (m), the initial state (s) and the other varied
    values. Their order does not depend on the configuration: sections are in their order, in a
    section words come before numbers, then the names are sorted; constants come last.
    """
    groups = list(sections().values())
    declared = parameters()

    def position(name: str) -> tuple[int, bool, str]:
        group = next((i for i, names in enumerate(groups) if name in names), len(groups))
        return group, not declared[name].choices, name

    parts = [
        study,
        run.law.evolution,
        f"H{_text(run.fault.height)}",
        f"phi{_text(run.fault.initial_state)}",
    ]
    others = varied.keys() - {"evolution", "height", "initial_state"}
    for name in sorted(others, key=position):
        parts.append(f"{name}{_text(varied[name])}")
    return "-".join(parts)


def _text(value: Any) -> str:
    """A number in its shortest form without a plus sign, ``4e9`` for 4.0e+9."""
    if value is None:
        return "same"  # as the first body's
    if isinstance(value, str):
        return value
    mantissa, _, exponent = f"{value:.12g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if exponent else mantissa
