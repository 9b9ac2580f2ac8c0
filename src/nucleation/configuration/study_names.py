"""Names of parameters in studies: which there are, what they stand for, identifiers made of them.

A parameter goes by one name there, the short one (:class:`nucleation.model.names.Names`), however
a configuration calls it: identifiers and tables do not depend on that.
"""

from collections.abc import Iterable
from typing import Any

from ..model.friction.constants import CONSTANTS
from ..model.parameters import GROUPS, names
from ..model.quantities import ParameterError, Quantity


def study_parameters() -> dict[str, Quantity]:
    """Everything a study may vary, by the name it goes by: fields of runs, and constants."""
    known = names()
    return {known.short(full): entry for full, entry in known.items()}


def other_names() -> dict[str, str]:
    """The names that stand for another one: full names, and short ones beside an alias."""
    known = names()
    return {other: known.short(full) for full in known for other in known.others(full)}


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
        number = declared[name].kind == "float" and value is not None
        found[name] = float(value) if number else value
    return found


def in_identifiers(chosen: Iterable[str]) -> list[str]:
    """Names in the order of identifiers, whatever that of the configuration.

    By the groups of the parameters; within a group words before numbers, then by name. Constants
    come last.
    """
    groups, declared, known = list(GROUPS), study_parameters(), names()

    def key(name: str) -> tuple[int, bool, str]:
        if name in CONSTANTS:
            return len(groups), True, name
        group, _, field = known.full(name).partition(".")
        return groups.index(group), not declared[name].choices, field

    return sorted(chosen, key=key)


def identifier(study: str, labels: dict[str, Any], varied: dict[str, Any]) -> str:
    """Readable, file-name-safe name of a run, such as ``paper-aging-H0.005-phi1-n_x800``."""
    parts = [
        study,
        labels["evolution"],
        f"H{_text(labels['height'])}",
        f"phi{_text(labels['phi0'])}",
    ]
    others = in_identifiers(name for name in varied if name not in labels)
    parts += [f"{name}{_text(varied[name])}" for name in others]
    return "-".join(parts)


def _text(value: Any) -> str:
    """A number in its shortest form without a plus sign, ``4e9`` for 4.0e+9."""
    if value is None:
        return "same"  # as the first body's
    if isinstance(value, str):
        return value
    mantissa, _, exponent = f"{value:.12g}".partition("e")
    return f"{mantissa}e{int(exponent)}" if exponent else mantissa
