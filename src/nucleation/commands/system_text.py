"""The system of a command in words: bodies, loading, friction, and the assumptions."""

import contextlib
import math
import warnings
from collections.abc import Collection, Iterator, Sequence
from typing import Any

from ..fault import Fault
from ..lengths.length import number
from ..model.friction import Friction
from ..model.hints import ImplausibleWarning
from ..model.material import ANTIPLANE
from ..theory.values import QUANTITIES
from .text import warn
from .unit_text import in_unit

BEGINS = {
    "edge": "pushed at its edge",
    "remote": "begun in the interior",
}
"""Where the creeping patch begins, by ``--loading``."""

_SOUGHT = "to find"

_FAR_SIDES = {"traction": "free", "velocity": "moved"}
"""Boundary conditions of a far side, in words."""


def plane_in_words(plane: str) -> str:
    """The deformation of the bodies: plane strain, plane stress or antiplane shear."""
    return "antiplane shear" if plane == ANTIPLANE else f"plane {plane}"


def _system_line(fault: Fault, sought: str) -> str:
    """Bodies, far sides, loading and plane."""
    first, second = _body(fault, "", sought), _body(fault, "second_", "")
    if math.isinf(number(fault, "second_shear_modulus")):
        bodies = f"{first} on a rigid one"
    elif _body(fault, "", "") == second:
        bodies = f"two identical bodies, each {first}"
    else:
        bodies = f"{first} on {second}"
    if fault.has_zone:
        bodies += f"; {_zone(fault)} beside the fault"
    return f"System: {bodies}; {BEGINS[fault.loading]}; {plane_in_words(fault.plane)}."


def _zone(fault: Fault) -> str:
    """The zone of other stiffness in words."""
    names = ("zone_thickness", "zone_shear_modulus", "zone_poisson_ratio")
    thickness, modulus, ratio = (float(number(fault, name)) for name in names)
    material = _material(modulus, ratio, fault.plane)
    return f"a zone of {in_unit(thickness, 'm')} {material} in each deformable body"


def _body(
    fault: Fault,
    prefix: str,
    sought: str,
) -> str:
    """The first body in words, or with the prefix ``second_`` the other one."""
    names = ("shear_modulus", "poisson_ratio", "height")
    modulus, ratio, height = (float(number(fault, prefix + name)) for name in names)
    if sought == "shear_modulus":
        modulus = math.nan
    material = _material(modulus, ratio, fault.plane)
    if math.isinf(height):
        return f"a half-space {material}"
    far_side = getattr(fault, f"{prefix}far_side")
    side = _FAR_SIDES.get(far_side, far_side)
    return f"a layer {in_unit(height, 'm')} high with its far side {side} {material}"


def _material(
    modulus: float,
    ratio: float,
    plane: str,
) -> str:
    """Moduli in words; a shear modulus of NaN is the one to find, and antiplane shear has no nu."""
    value = _SOUGHT if math.isnan(modulus) else in_unit(modulus, "Pa")
    return f"(mu = {value})" if plane == ANTIPLANE else f"(mu = {value}, nu = {ratio:.4g})"


def _friction_line(fault: Fault, sought: str) -> str:
    """Coefficients at V, normal stress, slip distance and the friction law."""
    constants = {"f": "friction", "a": "a", "b": "b"}
    known = parameters_of(fault) | {"b": fault.b}
    coefficients = [
        f"{symbol} = {float(known[name]):.4g}"
        for symbol, name in constants.items()
        if name in known
    ]
    if fault.velocity is not None:
        coefficients[-1] += f" at V = {in_unit(known['velocity'], 'm/s')}"
    scales = {
        "sigma0": ("normal_stress", "Pa"),
        "D": ("slip_distance", "m"),
    }
    parts = [", ".join(coefficients)]
    for symbol, (name, unit) in scales.items():
        value = _SOUGHT if name == sought else in_unit(getattr(fault, name), unit)
        parts.append(f"{symbol} = {value}")
    law = fault.friction_law
    if law is not None:
        parts.append(f"{law.law} law, {law.evolution}, {scales_text(law)}")
    return f"Friction: {'; '.join(parts)}."


def is_of_one_material(fault: Fault) -> bool:
    """Whether both bodies have the same material."""
    second = (fault.second_shear_modulus, fault.second_poisson_ratio)
    return (fault.shear_modulus, fault.poisson_ratio) == second


def parameters_of(fault: Fault) -> dict[str, Any]:
    """All parameters of a fault that are not None, by name."""
    values = {name: getattr(fault, name) for name in QUANTITIES}
    return {name: value for name, value in values.items() if value is not None}


def scales_text(law: Friction) -> str:
    """The slip rates v* and v0 of a friction law, in words."""
    reference = getattr(law, "reference_slip_rate", None)
    rates = {
        "v*": getattr(law, "slip_rate_scale", reference),
        "v0": law.regularisation_slip_rate,
    }
    return ", ".join(
        f"{name} = {in_unit(rate, 'm/s')}" for name, rate in rates.items() if rate is not None
    )


def _assumed(fault: Fault, given: Collection[str]) -> list[str]:
    """The assumptions about bodies, far sides and plane, in words."""
    assumed = []
    if math.isfinite(number(fault, "second_shear_modulus")):
        alike = fault.second_height == fault.height
        if is_of_one_material(fault) and alike and "second_shear_modulus" not in given:
            assumed.append("the second body is like the first")
        elif alike and "second_height" not in given:
            assumed.append("the second body is as high as the first")
    if math.isfinite(number(fault, "height")):
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
    fault: Fault,
    given: Collection[str],
    papers: Sequence[str] = (),
    sought: str = "",
) -> list[str]:
    """The system that a command computes, its friction and the assumptions, one line each.

    Parameters
    ----------
    fault : Fault
        One fault.
    given : collection of str
        Names of its given parameters.
    papers : sequence of str
        The line about parameters that are the paper's, if there is one.
    sought : str
        Name of the parameter to find, of which the fault has any value; empty without one.

    Returns
    -------
    list of str
    """
    lines = [
        _system_line(fault, sought),
        _friction_line(fault, sought),
        *papers,
    ]
    assumed = _assumed(fault, given)
    if assumed:
        lines.append(f"Assumed: {', '.join(assumed)}.")
    return lines


@contextlib.contextmanager
def printed_warnings() -> Iterator[None]:
    """Print warnings of implausible magnitudes on the standard error, each once."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", ImplausibleWarning)
        yield
    for text in dict.fromkeys(str(warning.message) for warning in caught):
        warn(text)


def papers_line(names: frozenset[str]) -> list[str]:
    """The main parameters that are not given and therefore the paper's, in one line or none."""
    given_by = {
        "shear_modulus": {"shear_modulus"},
        "poisson_ratio": {"poisson_ratio"},
        "height": {"height"},
        "normal_stress": {"normal_stress"},
        "velocity": {"velocity"},
        "slip_distance": {"slip_distance"},
        "friction": {"friction"},
        "a": {"a"},
        "b": {"zeta_over_a", "zeta", "b"},
    }
    papers = [name for name, by in given_by.items() if not names & by]
    return [f"Not given, so the paper's: {', '.join(papers)}."] if papers else []
