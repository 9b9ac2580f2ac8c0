"""The given parameters of a fault, read, checked and completed: numbers in SI units and words."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..model.material import ANTIPLANE
from ..model.quantities import ParameterError, refusal
from ..model.units import is_quantity
from .evaluation import require_broadcast
from .stiffness import FAR_SIDES, require_far_side
from .values import QUANTITIES, WORDS, ZONE, checked, labelled


def completed(given: Mapping[str, Any]) -> dict[str, Any]:
    """All parameters of a fault from those that are given (None: not given), and the registry.

    Raises a ParameterError if one is missing, given twice or out of its range.
    """
    found = dict(given)
    _expand(found)
    missing = [name for name in required(found["plane"]) if found[name] is None]
    if missing:
        raise ParameterError(f"{', '.join(missing)} is missing: every fault needs it")
    if (found["zeta"] is None) == (found["b"] is None):
        raise ParameterError("zeta or b = a + zeta is needed, one of them and not both")
    _require_whole_zone(found)
    found["registry"] = None
    for name, value in found.items():
        if name in QUANTITIES and name not in WORDS and value is not None:
            if is_quantity(value):
                found["registry"] = value._REGISTRY
            array = checked(name, value, QUANTITIES[name])
            found[name] = array if np.ndim(array) or labelled(array) else float(array)
    numbers = _numbers(found)
    _require_one_kind(numbers)
    require_broadcast(numbers)
    _read_words(found)
    _complete(found)
    coupled = found["plane"] != ANTIPLANE and np.any(bodies_differ(found))
    if found["friction"] is None and coupled:
        raise ParameterError(
            "friction is missing: where the bodies differ, slip changes the normal stress, and "
            "the friction coefficient matters"
        )
    return found


def required(plane: str) -> list[str]:
    """Names of the parameters without a default; Poisson's ratio has none but in antiplane."""
    names = ["shear_modulus", "poisson_ratio", "normal_stress", "a", "slip_distance"]
    if plane == ANTIPLANE:
        names.remove("poisson_ratio")
    return names


def bodies_differ(fault: Mapping[str, Any]) -> Any:
    """Whether the second body is no mirror image of the first one (bool or array)."""
    differ = FAR_SIDES[fault["far_side"]] is not FAR_SIDES[fault["second_far_side"]]
    for name in ("shear_modulus", "poisson_ratio", "height"):
        differ = differ | (fault[f"second_{name}"] != fault[name])
    return differ


def _numbers(found: Mapping[str, Any]) -> dict[str, Any]:
    """The numbers and arrays among the parameters."""
    names = [name for name in QUANTITIES if name not in WORDS]
    return {name: found[name] for name in names if found.get(name) is not None}


def _expand(found: dict[str, Any]) -> None:
    """Take constants that are not given from the friction law, expanded about V."""
    law = found["friction_law"]
    if law is None:
        return
    if found["velocity"] is None:
        raise ParameterError("velocity is missing: a friction law is expanded about it")
    if found["evolution"] is None:
        found["evolution"] = law.evolution
    known = {"slip_distance": law.slip_distance}
    if found["a"] is None or found["friction"] is None:
        speed = checked("velocity", found["velocity"], QUANTITIES["velocity"])
        if speed.ndim:
            raise ParameterError(
                "a, zeta, friction and slip_distance are missing: a friction law is expanded about "
                "one velocity, not an array of them"
            )
        expansion = law.expansion(float(speed))
        known |= {"friction": expansion.f0, "a": expansion.a}
        if found["zeta"] is None and found["b"] is None:
            found["zeta"] = expansion.zeta
    for name, value in known.items():
        if found[name] is None:
            found[name] = value


def _require_whole_zone(found: Mapping[str, Any]) -> None:
    """Refuse a zone without its thickness or its shear modulus."""
    given = [name for name in ZONE if found[name] is not None]
    for name in ("zone_thickness", "zone_shear_modulus"):
        if given and name not in given:
            raise ParameterError(
                f"{name} is missing: a zone has a thickness (m) and a shear modulus (Pa), and "
                f"{given[0]} is given"
            )


def _require_one_kind(numbers: Mapping[str, Any]) -> None:
    """Refuse arrays without named dimensions beside DataArrays."""
    with_names = any(map(labelled, numbers.values()))
    without_names = any(np.ndim(x) and not labelled(x) for x in numbers.values())
    if with_names and without_names:
        raise ParameterError("arrays with and without named dimensions can't be combined")


def _read_words(found: dict[str, Any]) -> None:
    """Check the words; a second far side that is not given is the first one."""
    found["evolution"] = found["evolution"] or "aging"
    if found["second_far_side"] is None:
        found["second_far_side"] = found["far_side"]
    for name in WORDS:
        value, entry = found[name], QUANTITIES[name]
        if not (isinstance(value, str) and value in entry.choices):
            raise ParameterError(refusal(name, value, entry))
    for name in ("far_side", "second_far_side"):
        require_far_side(name, found[name], found["plane"])


def _complete(found: dict[str, Any]) -> None:
    """Set the parameters that follow from others."""
    if found["zeta"] is None:
        found["zeta"] = found["b"] - found["a"]
    else:
        found["b"] = found["a"] + found["zeta"]
    if found["poisson_ratio"] is None:
        found["poisson_ratio"] = 0.0  # of antiplane shear, without effect
    if found["zone_thickness"] is not None and found["zone_poisson_ratio"] is None:
        found["zone_poisson_ratio"] = found["poisson_ratio"]
    for name in ("shear_modulus", "poisson_ratio", "height", "density"):
        if found[f"second_{name}"] is None:
            found[f"second_{name}"] = found[name]
