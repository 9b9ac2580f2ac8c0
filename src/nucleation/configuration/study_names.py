"""Names of parameters in studies: which there are, what they stand for, identifiers made of them.

A parameter goes by one name there, the short one (:class:`nucleation.model.names.Names`), however
a configuration calls it: identifiers and tables do not depend on that.
"""

import math
from collections.abc import Mapping
from functools import cache
from types import MappingProxyType
from typing import Any

import numpy as np

from ..model.parameters import GROUPS, Parameters, names
from ..model.quantities import ParameterError, Quantity

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


@cache  # asked for each run of thousands
def study_parameters() -> Mapping[str, Quantity]:
    """Everything a study may vary, by the name it goes by: fields of runs, and constants."""
    known = names()
    return MappingProxyType({known.short(full): entry for full, entry in known.items()})


@cache
def other_names() -> Mapping[str, str]:
    """The names that stand for another one: full names, and short ones beside an alias."""
    known = names()
    others = {other: known.short(full) for full in known for other in known.others(full)}
    return MappingProxyType(others)


def by_study_name(values: dict[str, Any]) -> dict[str, Any]:
    """Values by the names that their parameters go by, in the declared type.

    So 1 and 1.0 give one and the same simulation.

    Raises
    ------
    ParameterError
        If a name stands for no parameter, or one is given twice.
    """
    known, declared = names(), study_parameters()
    found: dict[str, Any] = {}
    for given, value in values.items():
        name = known.short(known.full(given))
        if name in found:
            raise ParameterError(f"{given} = {value!r} is not allowed: {name} is given already")
        found[name] = in_type(declared[name], value)
    return found


def in_type(entry: Quantity, value: Any) -> Any:
    """An allowed value in its declared type; a tuple of what a list or a range means."""
    if entry.many:
        return tuple(map(float, expand(value)))
    return float(value) if entry.kind == "float" and value is not None else value


def identifier(study: str, parameters: Parameters, varied: dict[str, Any]) -> str:
    """Readable, file-name-safe name of a run, such as ``paper-aging-H0.005-phi1-n_x800``.

    What is varied comes in the order of the groups of parameters, whatever that of the
    configuration; within a group words before numbers, then by name. Constants come last.
    """
    groups, declared, known = list(GROUPS), study_parameters(), names()

    def key(name: str) -> tuple[int, bool, str]:
        group, _, field = known.full(name).rpartition(".")
        if not group:
            return len(groups), True, name
        return groups.index(group), not declared[name].choices, field

    height, age = parameters.geometry.height, parameters.loading.initial_state
    others = sorted(varied.keys() - {"evolution", "height", "phi0"}, key=key)
    return "-".join(
        [study, parameters.friction.evolution, f"H{_text(height)}", f"phi{_text(age)}"]
        + [f"{name}{_text(varied[name])}" for name in others]
    )


def _text(value: Any) -> str:
    """A number in its shortest form without a plus sign, ``4e9`` for 4.0e+9."""
    if value is None:
        return "same"  # as the first body's
    if isinstance(value, str):
        return value
    mantissa, _, exponent = f"{value:.12g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if exponent else mantissa
