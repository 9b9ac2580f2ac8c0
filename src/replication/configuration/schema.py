"""The allowed keys of a configuration, and a JSON schema of them for text editors.

Both follow from the declarations of the parameters. ``python -m replication.configuration.schema``
prints the schema.
"""

import json
from collections.abc import Mapping
from functools import cache
from typing import Any

from nucleation.extraction.definitions import ExtractionSettings
from nucleation.model import parameters
from nucleation.model.friction.registry import law_declarations
from nucleation.model.linearised import InterfaceState
from nucleation.model.quantities import Quantity, declarations
from nucleation.theory.settings import Curves

from .roles import ROLES
from .settings import FigureSettings, Limits, StudySettings
from .study_names import RANGE, other_names, study_parameters

_Node = dict[str, Any]
"""A part of the JSON schema."""

_OF_PARAMETERS = {
    name: cls for name, cls in parameters.GROUPS.items() if name not in ("geometry", "mesh")
}

GROUPS: dict[str, type] = {
    **_OF_PARAMETERS,
    "main_text_interface": InterfaceState,
    "curves": Curves,
    "extraction": ExtractionSettings,
    "figures": FigureSettings,
    "limits": Limits,
}
"""The sections of the configuration that are one dataclass each."""

_FROM_LOADING = ("velocity", "normal_stress")
"""Fields of ``main_text_interface`` that come from the section ``loading``."""

STUDY_NAME = "[A-Za-z][A-Za-z0-9_]{0,59}"
"""Pattern of the names of studies."""

RESULTS = Quantity("directory of all results", kind="str")


def group_entries(group: str) -> dict[str, Quantity]:
    """The keys of a section and their declarations."""
    if group == "friction":
        return law_declarations()
    entries = declarations(GROUPS[group])
    if group == "main_text_interface":
        for name in _FROM_LOADING:
            del entries[name]
    return entries


def entry_at(path: tuple[object, ...]) -> Quantity | None:
    """The declaration of one value of the configuration, by its place there; None if unknown."""
    if path == ("results",):
        return RESULTS
    names = [part for part in path if isinstance(part, str)]
    if not names:
        return None
    section, last = names[0], names[-1]
    if last in RANGE:
        return RANGE[last]
    known: Mapping[str, Quantity] = {}
    if section == "studies":
        known = _study_entries()
        names = names[2:]  # without the study's name
    elif section in GROUPS:
        known = group_entries(section)
    for name in names:
        if name in known:
            return known[name].element
    return None


@cache  # each text of a configuration needs it
def _study_entries() -> Mapping[str, Quantity]:
    """Declarations of all keys in a study, by all of their names."""
    known = study_parameters()
    others = {other: known[name] for other, name in other_names().items()}
    return {**known, **others, **declarations(StudySettings)}


def build() -> _Node:
    """The schema of the whole configuration (JSON Schema, draft 2020-12)."""
    sections = {"results": _value(RESULTS)}
    for group in GROUPS:
        sections[group] = _group(group)
    sections["studies"] = {
        "description": "named sets of simulations, each with a role in figures and tables",
        "type": "object",
        "minProperties": 1,
        "propertyNames": {"type": "string", "pattern": f"^{STUDY_NAME}$"},
        "additionalProperties": {"$ref": "#/$defs/study"},
    }
    of_ranges = {key: _value(entry) for key, entry in RANGE.items()}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Configuration of the workflow; SI units",
        **_mapping("all settings; a key left out has the paper's value", sections),
        "$defs": {"study": _study(), **of_ranges},
    }


def _group(group: str) -> _Node:
    """The schema of a section that is one dataclass."""
    keys = {}
    for key, entry in group_entries(group).items():
        keys[key] = _value(entry)
        if entry.many:
            keys[key] = _values(keys[key], entry)
    summary = str(GROUPS[group].__doc__).splitlines()[0]
    return _mapping(summary, keys)


def _study() -> _Node:
    """The schema of one study."""
    declared = study_parameters()
    defaults = "#/$defs/study/properties/defaults"
    items = "#/$defs/study/properties/runs/items"

    single = {}
    varied = {}
    for name, entry in declared.items():
        single[name] = _value(entry)
        varied[name] = _values({"$ref": f"{defaults}/properties/{name}"}, entry)
    for other, name in other_names().items():
        single[other] = {"$ref": f"{defaults}/properties/{name}"}
        varied[other] = {"$ref": f"{items}/properties/{name}"}
    varied["defaults"] = {
        "description": "values for all simulations of the entry, without a part in their names",
        "$ref": defaults,
    }
    entry_of_runs = _mapping("a value, a list of values or a range for any parameter", varied)

    keys = {key: _value(entry) for key, entry in declarations(StudySettings).items()}
    purposes = [f"{name}: {role.purpose}" for name, role in ROLES.items()]
    keys["role"]["description"] += f". {'; '.join(purposes)}"
    keys["defaults"] = _mapping(
        "values for all runs of the study that do not give their own",
        single,
    )
    keys["runs"] = {
        "description": "each entry gives all combinations of its values",
        "type": "array",
        "minItems": 1,
        "items": {**entry_of_runs, "minProperties": 1},
    }
    return {**_mapping("a study", keys), "required": ["runs"]}


def _mapping(description: str, properties: _Node) -> _Node:
    return {
        "description": description,
        "type": "object",
        "properties": properties,
        "additionalProperties": False,
    }


def _value(entry: Quantity) -> _Node:
    """The schema of one value."""
    node: _Node = {"description": entry.description, "unit": entry.unit}
    if entry.symbol:
        node["symbol"] = entry.symbol
    if entry.choices:
        allowed: list[str | None] = list(entry.choices)
        if entry.optional:
            allowed.append(None)
        return {**node, "enum": allowed}
    if entry.kind == "str":
        return {**node, "type": "string", "minLength": 1}
    low = "minimum" if entry.includes_low else "exclusiveMinimum"
    high = "maximum" if entry.includes_high else "exclusiveMaximum"
    number = "integer" if entry.kind == "int" else "number"
    return {
        **node,
        "type": [number, "null"] if entry.optional else number,
        low: entry.low,
        high: entry.high,
    }


def has_range(entry: Quantity) -> bool:
    """Whether a configuration may give several values of a parameter as a range."""
    return not entry.choices and entry.kind != "int"


def _values(value: _Node, entry: Quantity) -> _Node:
    """The schema of a value, a list of values or (of numbers) a range."""
    listed = {
        "type": "array",
        "minItems": 1,
        "uniqueItems": True,
        "items": value,
    }
    forms = [value, listed]
    if has_range(entry):
        keys = {"start": value, "stop": value}
        for key in RANGE:
            keys[key] = {"$ref": f"#/$defs/{key}"}
        spaced = _mapping("evenly spaced values", keys)
        forms.append({**spaced, "required": ["start", "stop", "num"]})
    return {
        "description": f"{entry.description}: a value, a list or a range",
        "anyOf": forms,
    }


if __name__ == "__main__":
    print(json.dumps(build(), indent=1, ensure_ascii=False))
