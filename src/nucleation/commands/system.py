"""The system of a command in words: bodies, loading, friction, and the assumptions."""

import contextlib
import math
import warnings
from collections.abc import Collection, Iterator
from typing import Any

from ..fault import Fault
from ..model.hints import ImplausibleWarning
from ..model.material import ANTIPLANE
from ..theory.values import QUANTITIES
from .text import in_unit, warn

BEGINS = {
    "edge": "pushed at its edge",
    "remote": "begun in the interior",
}
"""Where the creeping patch begins, by ``--loading``."""

_SOUGHT = "to find"

_FAR_SIDES = {"traction": "free", "velocity": "moved"}
"""Boundary conditions of a far side, in words."""

_PAPERS = ("shear_modulus", "poisson_ratio", "height", "normal_stress", "velocity", "slip_distance")


def plane_in_words(plane: str) -> str:
    """The deformation of the bodies: plane strain, plane stress or antiplane shear."""
    return "antiplane shear" if plane == ANTIPLANE else f"plane {plane}"


def is_of_one_material(fault: Fault) -> bool:
    """Whether both bodies have the same material."""
    second = (fault.second_shear_modulus, fault.second_poisson_ratio)
    return (fault.shear_modulus, fault.poisson_ratio) == second


def parameters_of(fault: Fault) -> dict[str, Any]:
    """All parameters of a fault that are not None, by name."""
    values = {name: getattr(fault, name) for name in QUANTITIES}
    return {name: value for name, value in values.items() if value is not None}


def _body(fault: Fault, prefix: str, sought: str = "") -> str:
    """The first body in words, or with the prefix ``second_`` the other one."""
    height = float(getattr(fault, f"{prefix}height"))
    material = _material(fault, prefix, sought)
    if math.isinf(height):
        return f"a half-space {material}"
    far_side = getattr(fault, f"{prefix}far_side")
    side = _FAR_SIDES.get(far_side, far_side)
    return f"a layer {in_unit(height, 'm')} high with its far side {side} {material}"


def _material(fault: Fault, prefix: str, sought: str = "") -> str:
    """Moduli in words; antiplane shear has no nu."""
    modulus, ratio = (getattr(fault, prefix + n) for n in ("shear_modulus", "poisson_ratio"))
    value = _SOUGHT if sought == "shear_modulus" else in_unit(modulus, "Pa")
    nu = "" if fault.plane == ANTIPLANE else f", nu = {ratio:.4g}"
    return f"(mu = {value}{nu})"


def _system_line(fault: Fault, sought: str) -> str:
    """Bodies, far sides, loading and plane."""
    first, second = _body(fault, "", sought), _body(fault, "second_")
    if math.isinf(fault.second_shear_modulus):
        bodies = f"{first} on a rigid one"
    elif _body(fault, "") == second:
        bodies = f"two identical bodies, each {first}"
    else:
        bodies = f"{first} on {second}"
    if fault.zone_thickness is not None:
        thickness = in_unit(fault.zone_thickness, "m")
        bodies += f"; a zone of {thickness} {_material(fault, 'zone_')} in each deformable body "
        bodies += "beside the fault"
    return f"System: {bodies}; {BEGINS[fault.loading]}; {plane_in_words(fault.plane)}."


def _friction_line(fault: Fault, sought: str) -> str:
    """Coefficients at V, normal stress, slip distance and the friction law with its scales."""
    known = parameters_of(fault)
    symbols = {"f": "friction", "a": "a", "b": "b"}
    shown = [f"{key} = {known[name]:.4g}" for key, name in symbols.items() if name in known]
    coefficients = ", ".join(shown)
    if fault.velocity is not None:
        coefficients += f" at V = {in_unit(fault.velocity, 'm/s')}"
    parts = [coefficients]
    for symbol, name in {"sigma0": "normal_stress", "D": "slip_distance"}.items():
        value = _SOUGHT if name == sought else in_unit(known[name], QUANTITIES[name].unit)
        parts.append(f"{symbol} = {value}")
    law = fault.friction_law
    if law is not None:
        scale = getattr(law, "slip_rate_scale", None) or getattr(law, "reference_slip_rate", None)
        v0 = in_unit(law.regularisation_slip_rate, "m/s")
        scales = f"v0 = {v0}" if scale is None else f"v* = {in_unit(scale, 'm/s')}, v0 = {v0}"
        parts.append(f"{law.law} law, {law.evolution}, {scales}")
    return f"Friction: {'; '.join(parts)}."


def _assumed(fault: Fault, given: Collection[str]) -> list[str]:
    """The assumptions about bodies, far sides and plane, in words."""
    assumed = []
    if math.isfinite(fault.second_shear_modulus):
        alike = fault.second_height == fault.height
        if is_of_one_material(fault) and alike and "second_shear_modulus" not in given:
            assumed.append("the second body is like the first")
        elif alike and "second_height" not in given:
            assumed.append("the second body is as high as the first")
    if math.isfinite(fault.height):
        if "far_side" not in given:
            assumed.append("far sides free of changes of stress")
    elif "height" not in given:
        assumed.append("half-spaces")
    if "plane" not in given:
        assumed.append("plane strain")
    if fault.plane == "stress":
        assumed.append("plates much thinner than these lengths")
    return assumed


def system_of_fault(
    fault: Fault, given: Collection[str], paper: bool, sought: str = ""
) -> list[str]:
    """The system that a command computes, its friction and the assumptions, one line each.

    `given` are the names of given parameters of one fault; with `paper` the others are the paper's.
    It has any value of the parameter that is `sought`.
    """
    lines = [_system_line(fault, sought), _friction_line(fault, sought)]
    papers = [name for name in (*_PAPERS, "friction", "a") if name not in given]
    if not {"zeta_over_a", "zeta", "b"} & {*given}:
        papers.append("b")
    if paper and papers:
        lines.append(f"Not given, so the paper's: {', '.join(papers)}.")
    assumed = _assumed(fault, given)
    return [*lines, f"Assumed: {', '.join(assumed)}."] if assumed else lines


@contextlib.contextmanager
def printed_warnings() -> Iterator[None]:
    """Print warnings of implausible magnitudes on the standard error, each once."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", ImplausibleWarning)
        yield
    for text in dict.fromkeys(str(warning.message) for warning in caught):
        warn(text)
