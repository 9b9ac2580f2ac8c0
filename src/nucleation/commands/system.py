"""The system that a command computes, in words: bodies, far sides, loading, friction."""

import math
from collections.abc import Collection, Mapping
from typing import Any

from ..answers.in_use import HALF_SPACES, RIGID_BASE, THIS_FAULT, TWO_MATERIALS
from ..model.friction.law import Friction
from ..model.parameters import Parameters
from ..theory.fault import Fault
from ..theory.transfer import RigidBody, bodies_of


def system_line(fault: Fault, loading: str = "edge", known: bool = True) -> str:
    """What was computed, in a line: bodies, far sides, loading, plane.

    `known` is whether the first body's shear modulus is, or it is looked for.
    """
    names = ("shear_modulus", "poisson_ratio", "height", "far_side")
    first = [getattr(fault, name) for name in names]
    second = [getattr(fault, f"second_{name}") for name in names]
    alike = first == second
    if not known:
        first[0] = math.nan
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


def one_material(fault: Fault) -> bool:
    """Whether both bodies are of the same."""
    second = (fault.second_shear_modulus, fault.second_poisson_ratio)
    return (fault.shear_modulus, fault.poisson_ratio) == second


def systems_of_lengths(fault: Fault, uncertain: Collection[str] = ()) -> list[str]:
    """What the lengths in use are of, as they are listed: the pair's own where materials differ."""
    differ = not one_material(fault) or any(name.startswith("second_") for name in uncertain)
    pair = [TWO_MATERIALS] if differ and math.isfinite(fault.second_shear_modulus) else []
    return [THIS_FAULT, *pair, HALF_SPACES, RIGID_BASE]


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


def scales(law: Friction, velocity: float) -> str:
    """The slip rates of a law and V, in words."""
    scale = getattr(law, "slip_rate_scale", getattr(law, "reference_slip_rate", None))
    rates = {"v*": scale, "v0": law.regularisation_slip_rate, "V": velocity}
    return ", ".join(f"{name} = {x:.3g}" for name, x in rates.items() if x is not None) + " m/s"


PAPERS = {
    **{name: {name} for name in ("shear_modulus", "poisson_ratio", "height", "normal_stress")},
    "velocity": {"velocity"}, "slip_distance": {"characteristic_slip_distance"},
    "friction": {"friction_coefficient"}, "a": {"direct_effect"},
    "b": {"zeta_over_a", "velocity_weakening", "evolution_effect"},
}  # fmt: skip
"""The parameters of a fault that the paper has values for, and by which names each is given."""


def told(parameters: Parameters, base: Parameters | None, given: Mapping[str, Any]) -> list[str]:
    """The system of a run, its friction, and what was assumed, a line each."""
    law, v = parameters.friction, parameters.loading.velocity
    f, a, zeta = law.expansion(v)
    lines = [
        system_line(Fault(**of_parameters(parameters)), parameters.loading.kind),
        f"Friction: {law.law} law, {law.evolution}; at V: f = {f:.4g}, a = {a:.4g}, "
        f"b = {a + zeta:.4g}; D = {law.characteristic_slip_distance:.4g} m; {scales(law, v)}.",
    ]
    asked = PAPERS
    if any(name in given for name in law.set_by_expansion):
        constants = {"friction", "a", "b"}
        asked = {name: by for name, by in PAPERS.items() if name not in constants}
        asked |= {name: {name} for name in law.set_by_expansion}
    papers = [name for name, by in asked.items() if not by & given.keys()]
    if base is None and papers:
        lines.append(f"Not given, so the paper's: {', '.join(papers)}.")
    return lines
