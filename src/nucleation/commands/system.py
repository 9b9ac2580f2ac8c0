"""The system that a command computes, in words: bodies, far sides, loading, plane."""

import math
from typing import Any

from ..model.parameters import Parameters
from ..theory.fault import Fault
from ..theory.literature_table import LENGTHS, TWO_MATERIALS
from ..theory.transfer import RigidBody, bodies_of


def system_line(fault: Fault, loading: str = "edge", known: bool = True) -> str:
    """What was computed, in a line: bodies, far sides, loading, plane.

    `known` is whether the first body's shear modulus is, or it is looked for.
    """
    first = (fault.shear_modulus, fault.poisson_ratio, fault.height, fault.far_side)
    second = (
        fault.second_shear_modulus, fault.second_poisson_ratio, fault.second_height,
        fault.second_far_side,
    )  # fmt: skip
    alike = first == second
    if not known:
        first = (math.nan, *first[1:])
    if math.isinf(float(fault.second_shear_modulus)):
        bodies = f"{_body(*first)} on a rigid one"
    elif alike:
        bodies = f"two identical bodies, each {_body(*first)}"
    else:
        bodies = f"{_body(*first)} on {_body(*second)}"
    return f"System: {bodies}; {BEGINS[loading]}; plane {fault.plane}."


def _body(modulus: Any, ratio: Any, height: Any, far_side: Any) -> str:
    value = "looked for" if math.isnan(float(modulus)) else f"= {float(modulus):.4g} Pa"
    own = f"(mu {value}, nu = {float(ratio):.4g})"
    if math.isinf(float(height)):
        return f"a half-space {own}"
    side = {"traction": "free", "velocity": "moved"}.get(str(far_side), far_side)
    return f"a layer {float(height):.4g} m high with its far side {side} {own}"


def systems_of_lengths(differ: bool) -> list[str]:
    """Of which the lengths in use are, as they are listed: the fault's own, of the pair if its
    materials `differ`, of its first body."""
    systems = list(dict.fromkeys(length.system for length in LENGTHS))
    systems.remove(TWO_MATERIALS)
    return [*systems[:1], *[TWO_MATERIALS] * differ, *systems[1:]]


BEGINS = {
    "edge": "pushed at its edge", "top": "begun at a free side", "remote": "begun in the interior",
}  # fmt: skip
"""Where the creeping patch begins, by ``--loading``."""


def of_parameters(parameters: Parameters) -> dict[str, Any]:
    """The fault of a simulation, its friction law expanded at V."""
    material, loading = parameters.material, parameters.loading
    friction, a, zeta = parameters.friction.expansion(loading.velocity)
    upper, lower = bodies_of(parameters)
    found = {
        "shear_modulus": material.shear_modulus, "poisson_ratio": material.poisson_ratio,
        "plane": material.plane, "height": upper.height, "far_side": upper.far_side,
        "normal_stress": loading.normal_stress, "velocity": loading.velocity,
        "slip_distance": parameters.friction.characteristic_slip_distance,
        "friction": friction, "a": a, "zeta": zeta,
    }  # fmt: skip
    if isinstance(lower, RigidBody):
        return found | {"second_shear_modulus": math.inf}
    return found | {
        "second_shear_modulus": lower.material.shear_modulus,
        "second_poisson_ratio": lower.material.poisson_ratio,
        "second_height": lower.height, "second_far_side": lower.far_side,
    }  # fmt: skip
