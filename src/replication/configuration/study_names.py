"""Parameters of studies: their names, their values in lists and ranges, identifiers of runs.

Each parameter has one standard name, the short one (:class:`nucleation.model.names.Names`).
Identifiers and tables use it, so that they do not depend on the name in a configuration.
"""

import math
from collections.abc import Mapping
from functools import cache
from types import MappingProxyType
from typing import Any

import numpy as np

from nucleation.model.parameters import GROUPS, Parameters, names
from nucleation.model.quantities import ParameterError, Quantity, declared

RANGE: dict[str, Quantity] = {
    "num": declared("number of values", "[2, 10000]", kind="int"),
    "scale": Quantity(
        "spacing of the values",
        choices=("linear", "log"),
    ),
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


@cache  # each run of thousands needs it
def study_parameters() -> Mapping[str, Quantity]:
    """The parameters that a study may vary, by standard name: those of runs, and constants."""
    known = names()
    found = {}
    for full, entry in known.items():
        name = known.short(full)
        found[name] = entry
    return MappingProxyType(found)


@cache
def other_names() -> Mapping[str, str]:
    """Standard names by the other names of the same parameter, full and short ones."""
    known = names()
    found = {}
    for full in known:
        for other in known.others(full):
            found[other] = known.short(full)
    return MappingProxyType(found)


def by_study_name(values: Mapping[str, Any]) -> dict[str, Any]:
    """Values by the standard names of their parameters, in the declared type.

    So 1 and 1.0 give the same simulation.

    Raises
    ------
    ParameterError
        If no parameter has a name, or one is given twice.
    """
    known = names()
    declared = study_parameters()
    found: dict[str, Any] = {}
    for given, value in values.items():
        name = known.short(known.full(given))
        if name in found:
            raise ParameterError(f"{given} = {value!r} is not allowed: {name} is given already")
        found[name] = in_type(declared[name], value)
    return found


def in_type(entry: Quantity, value: Any) -> Any:
    """Convert an allowed value to its declared type.

    Parameters
    ----------
    entry : Quantity
        The declaration.
    value : object
        A value; for a tuple also a list or a range.

    Returns
    -------
    float, int, str, None or tuple of float
    """
    if entry.many:
        return tuple(map(float, expand(value)))
    if entry.kind == "float" and value is not None:
        return float(value)
    return value


def identifier(
    study: str,
    parameters: Parameters,
    varied: Mapping[str, Any],
) -> str:
    """Readable, file-name-safe name of a run, such as ``paper-aging-H0.005-phi1-n_x800``.

    Parameters
    ----------
    study : str
        The study's name.
    parameters : Parameters
        The run's parameters.
    varied : mapping
        The values that the study varies, by standard name.

    Returns
    -------
    str
        Study, evolution law, height (m), initial state (s) and other varied values.

    Notes
    -----
    The order of the varied values does not depend on the configuration: groups of parameters are
    in their declared order; in a group words come before numbers, then the names are sorted.
    Constants come last.
    """
    groups = list(GROUPS)
    declared = study_parameters()
    known = names()

    def position(name: str) -> tuple[int, bool, str]:
        full = known.full(name)
        group, _, field = full.rpartition(".")
        if not group:
            return len(groups), True, name
        number = not declared[name].choices
        return groups.index(group), number, field

    height = parameters.geometry.height
    age = parameters.loading.initial_state
    parts = [
        study,
        parameters.friction.evolution,
        f"H{_text(height)}",
        f"phi{_text(age)}",
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
