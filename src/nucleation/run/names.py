"""The parameters of a run by name: declarations, sections, reading of values."""

import dataclasses
import difflib
from collections.abc import Mapping
from functools import cache
from types import MappingProxyType
from typing import Any

from ..model.friction import law_declarations
from ..model.friction.constants import CONSTANTS, ZETA_OVER_A
from ..model.heterogeneity import Heterogeneity
from ..model.hints import hint
from ..model.quantities import ParameterError, Quantity, check, declarations
from ..model.settings import Block, Perturbation, Recording, Start, Stepping
from ..model.units import parse
from ..theory.values import QUANTITIES

GROUPS: dict[str, Any] = {
    "start": Start,
    "block": Block,
    "stepping": Stepping,
    "perturbation": Perturbation,
    "heterogeneity": Heterogeneity,
    "recording": Recording,
}
"""The parts of a run beside its fault and its friction law."""

SECOND_BODY = Quantity(
    "body below the interface: a rigid base, or a second deformable block, in all that is left "
    "out like the first",
    choices=("rigid", "deformable"),
    kind="str",
)

_OF_FAULT = {
    "material": ("shear_modulus", "poisson_ratio", "density", "plane"),
    "loading": ("normal_stress", "velocity", "initial_state", "loading"),
    "block": ("height",),
    "second_body": (
        "second_far_side",
        "second_shear_modulus",
        "second_poisson_ratio",
        "second_density",
        "second_height",
    ),
}
"""Parameters of the fault that a run has too, by section."""


def _of_group(cls: Any) -> dict[str, Quantity]:
    """Declarations of a part of a run, by the names of its parameters."""
    return {cls.called.get(name, name): entry for name, entry in declarations(cls).items()}


@cache
def sections() -> Mapping[str, tuple[str, ...]]:
    """The names of all parameters of a run, by section of a configuration."""
    law = ["friction_law" if name == "law" else name for name in law_declarations()]
    block = [name for name in _of_group(Block) if not name.startswith("second_")]
    found = {
        "material": _OF_FAULT["material"],
        "friction": tuple(law),
        "loading": (*_OF_FAULT["loading"], *_of_group(Start)),
        "block": (*_OF_FAULT["block"], *block),
        "stepping": tuple(_of_group(Stepping)),
        "perturbation": tuple(_of_group(Perturbation)),
        "heterogeneity": tuple(_of_group(Heterogeneity)),
        "second_body": (
            "second_body",
            *_OF_FAULT["second_body"],
            "second_n_y",
            "second_grading",
        ),
        "recording": tuple(_of_group(Recording)),
    }
    return MappingProxyType(found)


@cache
def parameters() -> Mapping[str, Quantity]:
    """The declarations of all parameters of a run and of the constants of friction, by name."""
    known = dict(QUANTITIES)
    for name, entry in law_declarations().items():
        known["friction_law" if name == "law" else name] = entry
    known["second_body"] = SECOND_BODY
    for cls in GROUPS.values():
        known |= _of_group(cls)
    found = {}
    for names in sections().values():
        for name in names:
            left_out = name.startswith("second_") and name != "second_body"
            found[name] = dataclasses.replace(
                known[name], optional=left_out or known[name].optional
            )
    known["zeta_over_a"] = ZETA_OVER_A
    return MappingProxyType(found | {name: known[name] for name in CONSTANTS})


def require_known(name: str) -> None:
    """Raise a ParameterError with a suggestion if no parameter of a run has a name."""
    known = parameters()
    if name not in known:
        close = difflib.get_close_matches(name, known, n=3)
        suggestion = hint(name, known) or f"similar: {', '.join(close or known)}"
        raise ParameterError(f"there is no parameter {name}; {suggestion}")


def read(values: Mapping[str, Any]) -> dict[str, Any]:
    """Values in SI units and their declared types, from numbers and texts such as "5 mm"."""
    found = {}
    for name, value in values.items():
        require_known(name)
        entry = parameters()[name]
        if isinstance(value, str) and not entry.worded:
            value = parse(name, value, entry)
        check(name, value, entry)
        found[name] = in_type(entry, value)
    return found


def in_type(entry: Quantity, value: Any) -> Any:
    """A value as the declared type: 1 and 1.0 make the same simulation."""
    is_number = entry.kind == "float" and not entry.worded
    return float(value) if is_number and value is not None else value
