"""What keys a configuration may have, and a JSON schema of them for text editors.

Both follow from the declarations of the parameters. ``python -m nucleation.configuration.schema``
prints the schema.
"""

import dataclasses
import json
from collections.abc import Mapping
from functools import cache
from typing import Any

from ..analysis.definitions import ExtractionSettings
from ..model import parameters
from ..model.friction.registry import law_declarations
from ..model.linearised import InterfaceState
from ..model.quantities import Quantity, declarations
from ..theory.settings import Curves
from ..verification.crosscheck.plan import CrosscheckSettings
from .settings import FigureSettings, Limits
from .studies import StudySettings
from .study_names import RANGE, other_names, study_parameters

Node = dict[str, Any]


GROUPS: dict[str, type] = {
    **{name: cls for name, cls in parameters.GROUPS.items() if name not in ("geometry", "mesh")},
    "main_text_interface": InterfaceState,
    "curves": Curves,
    "extraction": ExtractionSettings,
    "figures": FigureSettings,
    "limits": Limits,
    "crosscheck": CrosscheckSettings,
}
"""The sections of the configuration that are one dataclass each."""

FROM_LOADING = ("velocity", "normal_stress")
"""Fields of ``main_text_interface`` that come from the section ``loading``."""

STUDY_NAME = "[A-Za-z][A-Za-z0-9_]{0,59}"
"""Pattern of the names of studies."""

RESULTS = Quantity("directory of all results", kind="str")


def group_entries(group: str) -> dict[str, Quantity]:
    """The keys of a section and their declarations."""
    if group == "friction":
        return law_declarations()
    entries = declarations(GROUPS[group])
    taken = FROM_LOADING if group == "main_text_interface" else ()
    return {name: entry for name, entry in entries.items() if name not in taken}


def entry_at(path: tuple[Any, ...]) -> Quantity | None:
    """The declaration that one value of the configuration has to meet, by its place there."""
    if path == ("results",):
        return RESULTS
    names = [part for part in path if isinstance(part, str)]
    if names and names[-1] in RANGE:
        return RANGE[names[-1]]
    if names[:1] == ["studies"]:
        known = _study_entries()
        names = names[2:]
    else:
        known = group_entries(names[0]) if names and names[0] in GROUPS else {}
    found = next((known[name] for name in names if name in known), None)
    return found and (dataclasses.replace(found, kind="float") if found.many else found)


@cache  # asked for each text of a configuration
def _study_entries() -> Mapping[str, Quantity]:
    """Declarations of all that a study may give, by all of its names."""
    known = study_parameters()
    others = {other: known[name] for other, name in other_names().items()}
    return {**known, **others, **declarations(StudySettings)}


def build() -> Node:
    """The schema of the whole configuration (JSON Schema, draft 2020-12)."""
    sections = {"results": _leaf(RESULTS)}
    for group, cls in GROUPS.items():
        entries = {
            key: _values(_leaf(entry), entry) if entry.many else _leaf(entry)
            for key, entry in group_entries(group).items()
        }
        sections[group] = _mapping(str(cls.__doc__).splitlines()[0], entries)
    sections["studies"] = {
        "description": "named sets of simulations; their roles say what they are for",
        "type": "object",
        "minProperties": 1,
        "propertyNames": {"type": "string", "pattern": f"^{STUDY_NAME}$"},
        "additionalProperties": {"$ref": "#/$defs/study"},
    }
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "Configuration of the workflow; SI units",
        **_mapping("all settings; a key left out has the paper's value", sections),
        "$defs": {"study": _study(), **{k: _leaf(entry) for k, entry in RANGE.items()}},
    }


def _study() -> Node:
    """The schema of one study."""
    settings = {k: _leaf(entry) for k, entry in declarations(StudySettings).items()}
    declared, others = study_parameters(), other_names().items()
    place = "#/$defs/study/properties/defaults/properties/"
    single = {name: _leaf(entry) for name, entry in declared.items()}
    single |= {other: {"$ref": place + name} for other, name in others}
    varied = {name: _values({"$ref": place + name}, entry) for name, entry in declared.items()}
    place = "#/$defs/study/properties/runs/items/properties/"
    varied |= {other: {"$ref": place + name} for other, name in others}
    own = "values for all simulations of the entry, without a part in their names"
    varied["defaults"] = {"description": own, "$ref": "#/$defs/study/properties/defaults"}
    runs = {
        "description": "each entry stands for all combinations of its values",
        "type": "array",
        "minItems": 1,
        "items": _mapping("a value, a list of values or a range for any parameter", varied),
    }
    runs["items"]["minProperties"] = 1  # type: ignore[index]
    defaults = _mapping("values for all runs of the study that do not give their own", single)
    return _mapping("a study", {**settings, "defaults": defaults, "runs": runs}, ["runs"])


def _mapping(description: str, properties: Node, required: list[str] | None = None) -> Node:
    node = {
        "description": description,
        "type": "object",
        "properties": properties,
        "additionalProperties": False,
    }
    return node | ({"required": required} if required else {})


def _leaf(entry: Quantity) -> Node:
    """The schema of one value."""
    node: Node = {"description": entry.description, "unit": entry.unit}
    if entry.symbol:
        node["symbol"] = entry.symbol
    if entry.choices:
        return node | {"enum": [*entry.choices, *([None] if entry.optional else [])]}
    if entry.kind == "str":
        return node | {"type": "string", "minLength": 1}
    low = "minimum" if entry.closed in ("low", "both") else "exclusiveMinimum"
    high = "maximum" if entry.closed in ("high", "both") else "exclusiveMaximum"
    kind = "integer" if entry.kind == "int" else "number"
    types = [kind, "null"] if entry.optional else kind
    return node | {"type": types, low: entry.low, high: entry.high}


def has_range(entry: Quantity) -> bool:
    """Whether a range may stand for several values of a parameter."""
    return not entry.choices and entry.kind != "int"


def _values(leaf: Node, entry: Quantity) -> Node:
    """The schema of a value, a list of values or (of numbers) a range."""
    values = {"type": "array", "minItems": 1, "uniqueItems": True, "items": leaf}
    forms = [leaf, values]
    if has_range(entry):
        keys = {"start": leaf, "stop": leaf}
        keys |= {key: {"$ref": f"#/$defs/{key}"} for key in RANGE}
        forms.append(_mapping("evenly spaced values", keys, ["start", "stop", "num"]))
    return {"description": f"{entry.description}: a value, a list or a range", "anyOf": forms}


if __name__ == "__main__":
    print(json.dumps(build(), indent=1, ensure_ascii=False))
