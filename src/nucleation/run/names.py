"""The parameters of a run by name: declarations, sections, reading of values."""

import dataclasses
from collections.abc import Mapping
from functools import cache
from types import MappingProxyType
from typing import Any

from ..fault.flat import SECOND_BODY
from ..model.friction import Friction, law_declarations
from ..model.friction.constants import CONSTANTS, ZETA_OVER_A
from ..model.heterogeneity import Heterogeneity
from ..model.hints import hint
from ..model.quantities import ParameterError, Quantity, declarations
from ..model.settings import Block, Perturbation, Start, Stepping
from ..model.units import in_si
from ..theory.values import QUANTITIES

GROUPS: dict[str, Any] = {
    "start": Start,
    "block": Block,
    "stepping": Stepping,
    "perturbation": Perturbation,
    "heterogeneity": Heterogeneity,
}
"""The parts of a run beside its fault and its friction law."""

OF_GROUPS = {
    group: {cls.called.get(name, name): entry for name, entry in declarations(cls).items()}
    for group, cls in GROUPS.items()
}
"""Declarations of the parts of a run, by the names of their parameters."""

OF_PARTS = {name for entries in OF_GROUPS.values() for name in entries}
"""Names of all these parameters."""

_OF_SECOND = ("far_side", "shear_modulus", "poisson_ratio", "density", "height", "n_y", "grading")


OF_LAWS = {Friction.called.get(name, name): entry for name, entry in law_declarations().items()}
"""Declarations of the parameters of all friction laws by their names in a run."""


@cache
def sections() -> Mapping[str, tuple[str, ...]]:
    """The names of all parameters of a run, by section of a configuration."""
    block = [name for name in OF_GROUPS["block"] if not name.startswith("second_")]
    loading = ("normal_stress", "velocity", "initial_state", "loading")
    found = {
        "material": ("shear_modulus", "poisson_ratio", "density", "plane"),
        "friction": tuple(OF_LAWS),
        "loading": (*loading, *OF_GROUPS["start"]),
        "block": ("height", *block),
        "stepping": tuple(name for name in OF_GROUPS["stepping"] if name != "record"),
        "perturbation": tuple(OF_GROUPS["perturbation"]),
        "heterogeneity": tuple(OF_GROUPS["heterogeneity"]),
        "second_body": ("second_body", *(f"second_{name}" for name in _OF_SECOND)),
        "recording": ("record",),
    }
    return MappingProxyType(found)


@cache
def parameters() -> Mapping[str, Quantity]:
    """The declarations of all parameters of a run and of the constants of friction, by name."""
    known = {**QUANTITIES, **OF_LAWS, "second_body": SECOND_BODY, "zeta_over_a": ZETA_OVER_A}
    for entries in OF_GROUPS.values():
        known |= entries
    found = {}
    for names in sections().values():
        for name in names:
            left_out = name.startswith("second_") and name != "second_body"
            optional = left_out or known[name].optional
            found[name] = dataclasses.replace(known[name], optional=optional)
    return MappingProxyType(found | {name: known[name] for name in CONSTANTS})


def read(values: Mapping[str, Any]) -> dict[str, Any]:
    """Values in SI units and their declared types, from numbers and texts such as "5 mm"."""
    found = {}
    known = parameters()
    for name, value in values.items():
        if name not in known:
            suggestion = hint(name, known) or f"known: {', '.join(known)}"
            raise ParameterError(f"there is no parameter {name}; {suggestion}")
        entry = known[name]
        found[name] = in_type(entry, in_si(name, value, entry))
    return found


def in_type(entry: Quantity, value: Any) -> Any:
    """A value as the declared type: 1 and 1.0 make the same simulation."""
    is_number = entry.kind == "float" and not entry.worded
    return float(value) if is_number and value is not None else value
