"""The one table of parameters: of a fault, its friction law, and the parts of a run.

A parameter has one name in files, options, studies and records. The table says which part of a run
has it and under which field, with its unit, range, meaning and default. `nucleation length`,
`nucleation simulate`, studies and records read and write parameters by this table alone.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from functools import cache
from types import MappingProxyType
from typing import Any, Self

from ..model.friction import law_declarations
from ..model.friction.constants import CONSTANTS, ZETA_OVER_A
from ..model.heterogeneity import Heterogeneity
from ..model.hints import hint
from ..model.quantities import ParameterError, Quantity, declarations
from ..model.settings import Block, Perturbation, Start, Stepping
from ..model.units import in_si
from ..theory.values import QUANTITIES

PARTS: dict[str, Any] = {
    "start": Start,
    "block": Block,
    "stepping": Stepping,
    "perturbation": Perturbation,
    "heterogeneity": Heterogeneity,
}
"""The parts of a run beside its fault and its law, and their classes."""

SECTIONS = {
    "material": ("shear_modulus", "poisson_ratio", "density", "plane"),
    "friction": ("friction_law", "evolution", "slip_distance"),
    "loading": ("normal_stress", "velocity", "initial_state", "loading"),
    "block": ("height",),
    "second_body": (
        "second_body",
        "second_far_side",
        "second_shear_modulus",
        "second_poisson_ratio",
        "second_density",
        "second_height",
        "second_n_y",
        "second_grading",
    ),
    "recording": ("record",),
}
"""Where a configuration has parameters that are not in the section of their part."""

_SECTION_OF_PART = {"law": "friction", "start": "loading", "fault": ""}
"""The section of a part's other parameters, if it has not the part's name; of a fault none."""

_ORDER = (
    "material",
    "friction",
    "loading",
    "block",
    "stepping",
    "perturbation",
    "heterogeneity",
    "second_body",
    "recording",
)

_SECOND_BODY = Quantity(
    "body below the interface: a rigid base, or a second deformable block, in all that is left "
    "out like the first",
    choices=("rigid", "deformable"),
    kind="str",
)


@dataclasses.dataclass(frozen=True)
class Parameter(Quantity):
    """A parameter of a run: its quantity, the part that has it, and its place in a configuration.

    The part is ``fault``, ``law``, one of :data:`PARTS`, or empty for `second_body` and
    `zeta_over_a`, which are said in other words. A run has a, b, zeta and friction by its law.
    """

    part: str = ""
    field: str = ""
    section: str = ""  # of a configuration; empty for what no section has
    default: Any = None

    @classmethod
    def of(cls, entry: Quantity, name: str, part: str, field: str, default: Any = None) -> Self:
        """The parameter with a declaration, in the section of its part unless it has another."""
        section = _SECTION_OF_PART.get(part, part)
        for other, names in SECTIONS.items():
            if name in names:
                section = other
        own = {f.name: getattr(entry, f.name) for f in dataclasses.fields(Quantity)}
        own["name"] = name
        if name.startswith("second_") and part:
            own["optional"] = True
        return cls(**own, part=part, field=field, section=section, default=default)


@cache
def table() -> Mapping[str, Parameter]:
    """All parameters by name, those of runs in the order of a configuration's sections."""
    found = [Parameter.of(entry, name, "fault", name) for name, entry in QUANTITIES.items()]
    for field, entry in law_declarations().items():
        found.append(Parameter.of(entry, entry.name, "law", field))
    for part, cls in PARTS.items():
        defaults = {field.name: field.default for field in dataclasses.fields(cls)}
        for field, entry in declarations(cls).items():
            found.append(Parameter.of(entry, entry.name, part, field, defaults[field]))
    found.append(Parameter.of(_SECOND_BODY, "second_body", "", ""))
    found.append(Parameter.of(ZETA_OVER_A, "zeta_over_a", "", ""))
    by_name = {one.name: one for one in found}  # D and the evolution are the law's, too
    sections = (*_ORDER, "")
    first = [name for names in SECTIONS.values() for name in names]
    ordered = sorted(
        by_name.values(),
        key=lambda one: (
            sections.index(one.section),
            first.index(one.name) if one.name in first else len(first),
        ),
    )
    return MappingProxyType({one.name: one for one in ordered})


@cache
def parameters() -> Mapping[str, Parameter]:
    """Those of a run: of the sections of a configuration, and the constants of friction."""
    in_sections = {name: one for name, one in table().items() if one.section}
    return MappingProxyType(in_sections | {name: table()[name] for name in CONSTANTS})


@cache
def fault_parameters() -> Mapping[str, Parameter]:
    """Those of a fault as a flat mapping: its own, its law's, `second_body` and `zeta_over_a`."""
    names = (*QUANTITIES, "second_body", "zeta_over_a", *names_of("law"))
    return MappingProxyType({name: table()[name] for name in names})


@cache
def sections() -> Mapping[str, tuple[str, ...]]:
    """The names of the parameters in each section of a configuration."""
    found: dict[str, tuple[str, ...]] = {}
    for name, one in table().items():
        if one.section:
            found[one.section] = (*found.get(one.section, ()), name)
    return MappingProxyType(found)


@cache  # each of thousands of runs asks
def names_of(*parts: str) -> tuple[str, ...]:
    """The names of the parameters that some parts of a run have."""
    return tuple(name for name, one in table().items() if one.part in parts)


def by_part(values: Mapping[str, Any]) -> dict[str, dict[str, Any]]:
    """The fields of each part from values by name; under "" those that no part has."""
    found: dict[str, dict[str, Any]] = {part: {} for part in ("fault", "law", *PARTS, "")}
    for name, value in values.items():
        one = table()[name]
        found[one.part][one.field or name] = value
    return found


@cache
def _fields_of(part: str) -> tuple[tuple[str, str], ...]:
    """Name and field of the parameters of runs that a part has."""
    own = (one for one in table().values() if one.part == part and one.section)
    return tuple((one.name, one.field) for one in own)


def values_of(part: str, owner: Any) -> dict[str, Any]:
    """The values by name that a part of a run has, None left out."""
    found = ((name, getattr(owner, field, None)) for name, field in _fields_of(part))
    return {name: value for name, value in found if value is not None}


def read(values: Mapping[str, Any]) -> dict[str, Any]:
    """Values of a run in SI units and their declared types, from numbers and texts such as "5 mm".

    Raises a ParameterError for a name that no run has, and for values that are not allowed.
    """
    entries = parameters()
    found = {}
    for name, value in values.items():
        if name not in entries:
            suggestion = hint(name, entries) or f"known: {', '.join(entries)}"
            raise ParameterError(f"there is no parameter {name}; {suggestion}")
        found[name] = in_type(entries[name], in_si(name, value, entries[name]))
    return found


def in_type(entry: Quantity, value: Any) -> Any:
    """A value as the declared type: 1 and 1.0 make the same simulation."""
    is_number = entry.kind == "float" and not entry.worded
    return float(value) if is_number and value is not None else value
