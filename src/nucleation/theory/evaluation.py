"""Parameters of a fault, read, checked and completed; functions of :class:`.Systems` over them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..model.friction import Friction
from ..model.material import ANTIPLANE, in_plane_ratio
from ..model.quantities import ParameterError, refusal
from ..model.units import is_quantity
from ..types import Array
from .pair import LayerPair, Layers
from .spectrum import Systems
from .stiffness import OF_ANTIPLANE
from .values import ALIASES, QUANTITIES, WORDS, ZONE, FaultLike, Values, checked, labelled

_USUAL = np.errstate(divide="warn", over="warn", under="ignore", invalid="warn")
"""NumPy's own settings, whatever the caller's are."""

PMMA = 1200.0  # kg/m3, the density of the paper's blocks

RIGID = 1e20
"""Ratio of the moduli above which round-off does not tell the stiffer body from a rigid one."""

_SECOND_MODULUS = "second_shear_modulus"
_OF_BODY = ("shear_modulus", "poisson_ratio")
OF_SYSTEMS = (
    "shear_modulus",
    "poisson_ratio",
    "height",
    "second_shear_modulus",
    "second_poisson_ratio",
    "second_height",
    "friction",
    "a",
    "zeta",
    "slip_distance",
    "velocity",
    "normal_stress",
)
"""Numbers of a fault that its linear theory depends on."""


@_USUAL
def evaluate(
    fault: FaultLike,
    function: Callable[..., Any],
    *arrays: Values,
    rows: int = 1,
    dtype: type = float,
) -> Any:
    """Values of a function of Systems (n faults) and n entries of each array, at every point.

    The function returns `rows` arrays of length n; the result has the shape ``(rows,) + broadcast
    shape``, and the first dimension of a DataArray is ``row``.
    """
    names = (*OF_SYSTEMS, *ZONE) if fault.zone_thickness is not None else OF_SYSTEMS
    parameters = {name: getattr(fault, name) for name in names}
    for name in names:
        if name.endswith("poisson_ratio"):
            parameters[name] = in_plane_ratio(parameters[name], fault.plane)
    for name, neutral in (("friction", 0.0), ("velocity", 1.0)):
        if parameters[name] is None:
            parameters[name] = neutral

    def core(*inputs: Values) -> NDArray:
        shape = np.broadcast_shapes(*(np.shape(x) for x in inputs))
        flat = [np.broadcast_to(x, shape).ravel() for x in inputs]
        found: NDArray = np.empty((flat[0].size, rows), dtype=dtype)
        first, second = (flat[names.index(name)] for name in ("shear_modulus", _SECOND_MODULUS))
        rigid = second > RIGID * first
        flat[names.index(_SECOND_MODULUS)] = np.where(rigid, np.inf, second)
        for kind in (rigid, ~rigid):
            chosen = np.flatnonzero(kind)
            if chosen.size == 0:
                continue
            part = [x[chosen] for x in flat]
            own = dict(zip(names, part, strict=False))
            further = part[len(names) :]
            found[chosen] = np.transpose(function(_systems(fault, own), *further))
        return found.reshape(*shape, rows)

    values = parameters.values()
    if not any(labelled(value) for value in (*values, *arrays)):
        return np.moveaxis(core(*values, *arrays), -1, 0)
    import xarray as xr

    result = xr.apply_ufunc(core, *values, *arrays, output_core_dims=[["row"]])
    return result.transpose("row", ...)


def require_broadcast(arrays: dict[str, Any]) -> None:
    """Raise a ParameterError, with all shapes, where unnamed arrays don't broadcast."""
    shapes = {
        name: np.shape(array)
        for name, array in arrays.items()
        if np.ndim(array) and not labelled(array)
    }
    try:
        np.broadcast_shapes(*shapes.values())
    except ValueError:
        listed = ", ".join(f"{name} {shape}" for name, shape in shapes.items())
        message = f"the shapes of the parameters don't broadcast: {listed}"
        raise ParameterError(message) from None


def single_system(fault: FaultLike) -> Systems:
    """A single fault as Systems with fields of shape (1,)."""
    found: list[Systems] = []

    def note(systems: Systems) -> list[Array]:
        found.append(systems)
        return [systems.a]

    evaluate(fault, note)
    return found[0]


def _systems(fault: FaultLike, own: dict[str, Array]) -> Systems:
    """Faults as systems, all or none of them with a rigid second body."""
    antiplane = fault.plane == ANTIPLANE
    zone = None
    if fault.zone_thickness is not None:
        modulus, ratio, thickness = (own[f"zone_{name}"] for name in (*_OF_BODY, "thickness"))
        zone = Layers(modulus, ratio, thickness, "free", antiplane)
    bodies: list[Layers | None] = []
    for prefix in ("", "second_"):
        modulus, ratio, height = (own[f"{prefix}{name}"] for name in (*_OF_BODY, "height"))
        far_side = getattr(fault, f"{prefix}far_side")
        deformable = np.all(np.isfinite(modulus))
        body = Layers(modulus, ratio, height, far_side, antiplane, zone)
        bodies.append(body if deformable else None)
    return Systems(
        pair=LayerPair(*bodies),
        friction=own["friction"],
        a=own["a"],
        zeta=own["zeta"],
        softness=own["shear_modulus"] * own["slip_distance"] / own["normal_stress"],
        rate=own["velocity"] / own["slip_distance"],
    )


def completed(given: Mapping[str, Any]) -> dict[str, Any]:
    """All parameters of a fault from those that are given (None: not given), and the registry.

    Raises a ParameterError if one is missing, given twice or out of its range.
    """
    found = dict(given)
    for name, default in (("height", math.inf), ("density", PMMA)):
        found[name] = default if found[name] is None else found[name]
    _expand(found)
    missing = [name for name in required(found["plane"]) if found[name] is None]
    if missing:
        raise ParameterError(f"{', '.join(missing)} is missing: every fault needs it")
    if (found["zeta"] is None) == (found["b"] is None):
        raise ParameterError("zeta or b = a + zeta is needed, one of them and not both")
    given_of_zone = [name for name in ZONE if found[name] is not None]
    for name in ("zone_thickness", "zone_shear_modulus"):
        if given_of_zone and name not in given_of_zone:
            raise ParameterError(
                f"{name} is missing: a zone has a thickness (m) and a shear modulus (Pa), and "
                f"{given_of_zone[0]} is given"
            )
    _read_numbers(found)
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
    differ = fault["far_side"] != fault["second_far_side"]
    for name in ("shear_modulus", "poisson_ratio", "height"):
        differ = differ | (fault[f"second_{name}"] != fault[name])
    return differ


def _read_numbers(found: dict[str, Any]) -> None:
    """Check the numbers and arrays; the registry is that of the last pint quantity, or None."""
    found["registry"] = None
    arrays = {}
    for name, value in found.items():
        if name not in QUANTITIES or name in WORDS or value is None:
            continue
        if is_quantity(value):
            found["registry"] = value._REGISTRY
        array = checked(name, value, QUANTITIES[name])
        if np.ndim(array) or labelled(array):
            found[name] = arrays[name] = array
        else:
            found[name] = float(array)
    if len({labelled(x) for x in arrays.values()}) == 2:
        raise ParameterError("arrays with and without named dimensions can't be combined")
    require_broadcast(arrays)


def _expand(found: dict[str, Any]) -> None:
    """Take constants that are not given from the friction law, expanded about V."""
    law = found["friction_law"]
    if law is None:
        return
    if found["velocity"] is None:
        raise ParameterError("velocity is missing: a friction law is expanded about it")
    if not isinstance(law, Friction):
        raise ParameterError(
            f"friction_law = {law!r} is not allowed: it must be a law such as "
            'Friction(law="dieterich_ruina"); Fault.from_dict takes laws by name'
        )
    if found["evolution"] not in (None, law.evolution):
        raise ParameterError(
            f"evolution = {found['evolution']!r} is not allowed with a friction law whose own is "
            f"{law.evolution}: give it to the law alone"
        )
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


def _read_words(found: dict[str, Any]) -> None:
    """Check the words, and replace aliases; the second far side follows the first one."""
    found["evolution"] = found["evolution"] or "aging"
    if found["second_far_side"] is None:
        found["second_far_side"] = found["far_side"]
    for name in WORDS:
        value, entry = found[name], QUANTITIES[name]
        if not (isinstance(value, str) and value in entry.choices):
            raise ParameterError(refusal(name, value, entry))
    for name in ("far_side", "second_far_side"):
        found[name] = ALIASES.get(found[name], found[name])
        if found["plane"] == ANTIPLANE and found[name] not in OF_ANTIPLANE:
            raise ParameterError(
                f"{name} = {found[name]!r} is not allowed with plane = {ANTIPLANE}: "
                f"it must be one of {', '.join(OF_ANTIPLANE)}"
            )


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
