"""A fault as a flat mapping of names and values: files, options, studies."""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping
from pathlib import Path
from typing import Any, cast

import numpy as np

from ..model.friction import LAWS, Friction, law_class, law_declarations
from ..model.friction.constants import LAW, ZETA_OVER_A, own_law
from ..model.hints import hint
from ..model.quantities import ParameterError, Quantity, check
from ..model.units import parse
from ..theory.values import QUANTITIES, FaultLike

_OF_FAULT = ("law", "evolution", "slip_distance")
LAW_NAMES = tuple(name for name in law_declarations() if name not in _OF_FAULT)
"""Parameters of friction laws beside those that every fault has."""

SECOND_BODY = "second_body"
_SECOND = ("second_shear_modulus", "second_poisson_ratio", "second_height")


def declarations_of_flat() -> dict[str, Quantity]:
    """The declarations of all names, but for ``second_body``."""
    laws = law_declarations()
    own = {name: laws[name] for name in LAW_NAMES}
    named = {"zeta_over_a": ZETA_OVER_A, "friction_law": laws["law"]}
    return {**QUANTITIES, **named, **own}


def keywords(values: Mapping[str, Any]) -> dict[str, Any]:
    """Keywords of :class:`~nucleation.fault.Fault` from flat values in SI units.

    Beside them there may be ``second_body`` (same, rigid or MODULUS,POISSON[,HEIGHT]),
    ``zeta_over_a``, and ``friction_law`` by its name with parameters of the law.
    """
    found = dict(values)
    if SECOND_BODY in found:
        found |= second_body(found.pop(SECOND_BODY))
    ratio = found.pop("zeta_over_a", None)
    if ratio is not None:
        if "zeta" in found or "b" in found:
            raise ParameterError("zeta_over_a is not allowed together with zeta or b")
        if "a" not in found:
            raise ParameterError("a is missing: zeta_over_a needs it")
        found["zeta"] = ratio * found["a"]
    own = {name: found.pop(name) for name in LAW_NAMES if name in found}
    law = found.get("friction_law")
    if own or isinstance(law, str):
        found["friction_law"] = _law(law, own, found)
    return found


def second_body(text: str) -> dict[str, Any]:
    """The parameters of the second body from its text."""
    if text in ("same", "deformable"):
        return dict.fromkeys(_SECOND[:2])
    if text == "rigid":
        return {"second_shear_modulus": math.inf}
    parts = text.split(",")
    if not 2 <= len(parts) <= 3:
        modulus, ratio, _ = (QUANTITIES[key].bounds for key in _SECOND)
        raise ParameterError(
            f"second_body = {text!r} is not allowed: it must be same, rigid, or a shear modulus "
            f"in {modulus}, Poisson's ratio in {ratio} and perhaps a height, with commas between"
        )
    try:
        pairs = zip(_SECOND, parts, strict=False)
        return {
            key: parse(
                key,
                part,
                QUANTITIES[key],
            )
            for key, part in pairs
        }
    except ParameterError as error:
        raise ParameterError(
            f"second_body = {text!r} is not allowed: commas separate its values, which have a "
            f"decimal point; {error}"
        ) from None


def _law(given: Any, own: dict[str, Any], fault: Mapping[str, Any]) -> Friction:
    """The friction law of a name or an object and further parameters."""
    if isinstance(given, Friction):
        return given.changed(own)
    name = given or _law_with(own)
    needed = ["velocity", "slip_distance"]
    set_by_constants = cast(type[Friction], law_class(name)).set_by_expansion
    whole = own.keys() & set(set_by_constants)
    if whole:
        clash = [constant for constant in ("friction", "a", "zeta", "b") if constant in fault]
        if clash:
            text = f"{', '.join(sorted(whole))} is not allowed together with {', '.join(clash)}"
            raise ParameterError(f"{text}, which sets it")
        missing = [key for key in set_by_constants if key not in own]
    else:
        missing = []
        needed += ["friction", "a"]
    missing += [key for key in needed if key not in fault]
    if missing:
        raise ParameterError(f"{', '.join(missing)} is missing: the friction law {name} needs it")
    velocity, distance = (float(np.median(fault[key])) for key in ("velocity", "slip_distance"))
    return own_law(
        velocity,
        distance,
        fault.get("evolution", "aging"),
        name,
    ).changed(own)


def _law_with(own: Collection[str]) -> str:
    """The usual law, or the first other one that has the parameters."""
    for name in (LAW, *LAWS):
        if all(hasattr(law_class(name), key) for key in own):
            return name
    raise ParameterError(f"no friction law has {', '.join(own)} together")


def flat(fault: FaultLike) -> dict[str, Any]:
    """The parameters of a single fault as plain values, the inverse of :func:`keywords`."""
    names = list(fault.keys())
    found: dict[str, Any] = {}
    law = fault.friction_law
    if law is not None:
        names.remove("friction_law")
        own = dict(vars(law))
        found["friction_law"] = own.pop("law")
        left_out = ["evolution"]
        if {"friction", "a", "zeta"} & set(names):  # others than the law's
            left_out += law.set_by_expansion
            names += [n for n in ("friction", "a", "zeta") if n not in names]
        found |= {name: value for name, value in own.items() if name not in left_out}
    for name in names:
        value = getattr(fault, name)
        found[name] = value if isinstance(value, str) else fault.single(name)
    return found


def read_parameters(
    path: Path | str,
    ignored: Collection[str] = (),
    further: Mapping[str, Quantity] = {},
) -> dict[str, Any]:
    """The flat values in a YAML or JSON file, in SI units; texts may have units and ranges.

    Keys that are `ignored` are those of other questions about the fault. Beside its parameters
    there may be `further` ones, by name.
    """
    from .strict_yaml import read_yaml

    content = read_yaml(Path(path))
    if not isinstance(content, dict):
        raise ParameterError(f"{path} must hold a mapping (lines of key: value)")
    known = {**declarations_of_flat(), **further}
    try:
        own = {str(key): value for key, value in content.items() if key not in ignored}
        return {
            key: _value(
                key,
                value,
                known,
            )
            for key, value in own.items()
        }
    except ParameterError as error:
        raise ParameterError(f"{path}: {error}") from None


def _value(key: str, value: Any, known: Mapping[str, Quantity]) -> Any:
    if key == SECOND_BODY:
        return str(value)
    if key not in known:
        suggestion = hint(key, (*known, SECOND_BODY)) or f"known: {', '.join(known)}"
        raise ParameterError(f"{key} = {value!r} is not allowed: unknown key; {suggestion}")
    entry = known[key]
    if isinstance(value, str) and not entry.worded:
        from ..lengths.draws import SAMPLED, parse_range

        return (
            parse_range(
                key,
                value,
                entry,
            )
            if key in SAMPLED
            else parse(
                key,
                value,
                entry,
            )
        )
    check(key, value, entry)
    return value
