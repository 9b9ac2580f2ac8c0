"""A fault as a flat mapping of names and values: files, options, studies."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from ..model.friction import Friction, law_class
from ..model.friction.constants import LAW, own_law
from ..model.hints import hint
from ..model.quantities import ParameterError, Quantity
from ..model.units import in_si
from ..theory.values import QUANTITIES, FaultLike
from .parameters import fault_parameters, names_of

LAW_NAMES = tuple(name for name in names_of("law") if name not in (*QUANTITIES, "friction_law"))
"""Parameters of friction laws beside those that every fault has."""


def keywords(values: Mapping[str, Any]) -> dict[str, Any]:
    """Keywords of :class:`~nucleation.fault.Fault` from flat values in SI units.

    Beside them there may be ``second_body`` (rigid or deformable), ``zeta_over_a``, and
    ``friction_law`` by its name with parameters of the law.
    """
    found = dict(values)
    body = found.pop("second_body", None)
    if body == "rigid":
        found["second_shear_modulus"] = math.inf
    elif body:
        found = dict.fromkeys(("second_shear_modulus", "second_poisson_ratio")) | found
    ratio = found.pop("zeta_over_a", None)
    if ratio is not None:
        if "zeta" in found or "b" in found:
            raise ParameterError("zeta_over_a is not allowed together with zeta or b")
        if "a" not in found:
            raise ParameterError("a is missing: zeta_over_a needs it")
        found["zeta"] = ratio * found["a"]
    own = {name: found.pop(name) for name in LAW_NAMES if name in found}
    law = found.get("friction_law")
    if isinstance(law, Friction):
        return found | {"friction_law": law.changed(own)}
    if not own and not law:
        return found
    name = law or LAW
    set_by_constants = law_class(name).set_by_expansion
    needed = {"velocity", "slip_distance"}
    given = [key for key in set_by_constants if key in own]
    if given:
        clash = [constant for constant in ("friction", "a", "zeta", "b") if constant in found]
        if clash:
            text = f"{', '.join(given)} is not allowed together with {', '.join(clash)}"
            raise ParameterError(f"{text}, which sets it")
        needed |= {*set_by_constants}
    else:
        needed |= {"friction", "a"}
    missing = sorted(needed - found.keys() - own.keys())
    if missing:
        raise ParameterError(f"{', '.join(missing)} is missing: the friction law {name} needs it")
    velocity, distance = (float(np.median(found[key])) for key in ("velocity", "slip_distance"))
    law = own_law(velocity, distance, found.get("evolution", "aging"), name)
    return found | {"friction_law": law.changed(own)}


def flat(fault: FaultLike) -> dict[str, Any]:
    """The parameters of a single fault as plain values, the inverse of :func:`keywords`."""
    names = list(fault.keys())
    found: dict[str, Any] = {}
    law = fault.friction_law
    if law is not None:
        names.remove("friction_law")
        own = dict(vars(law))
        found["friction_law"] = own.pop("law")
        left_out: list[str] = []
        if {"friction", "a", "zeta"} & set(names):  # others than the law's
            left_out += law.set_by_expansion
            names += [n for n in ("friction", "a", "zeta") if n not in names]
        found |= {name: value for name, value in own.items() if name not in left_out}
    for name in names:
        value = getattr(fault, name)
        found[name] = value if isinstance(value, str) else fault.single(name)
    return found


def read_parameters(
    path: Path | str, ignored: Collection[str] = (), further: Mapping[str, Quantity] = {}
) -> dict[str, Any]:
    """The flat values in a YAML or JSON file, in SI units; texts may have units and ranges.

    Keys that are `ignored` are those of other questions about the fault. Beside its parameters
    there may be `further` ones, by name.
    """
    from .files import read_yaml

    content = read_yaml(Path(path))
    if not isinstance(content, dict):
        raise ParameterError(f"{path} must hold a mapping (lines of key: value)")
    try:
        return read_values({k: x for k, x in content.items() if k not in ignored}, further)
    except ParameterError as error:
        raise ParameterError(f"{path}: {error}") from None


def read_values(values: Mapping[str, Any], further: Mapping[str, Quantity] = {}) -> dict[str, Any]:
    """Flat values in SI units, from numbers and texts with units and ranges.

    Beside the parameters of a fault there may be `further` ones, by name.
    """
    from ..lengths.ranges import SAMPLED, parse_range

    known = {**fault_parameters(), **further}
    found = {}
    for key, value in values.items():
        if key not in known:
            suggestion = hint(str(key), known) or f"known: {', '.join(known)}"
            raise ParameterError(f"{key} = {value!r} is not allowed: unknown key; {suggestion}")
        entry = known[key]
        read = parse_range if isinstance(value, str) and key in SAMPLED else in_si
        found[key] = read(key, value, entry)
    return found
