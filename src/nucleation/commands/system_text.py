"""The system of a command in words: bodies, loading, friction, and the assumptions."""

import contextlib
import math
import warnings
from collections.abc import Collection, Iterator, Mapping
from typing import Any

import click

from ..answers.length import HALF_SPACES, RIGID_BASE, THIS_FAULT, TWO_MATERIALS
from ..model.friction.law import Friction
from ..model.material import ANTIPLANE
from ..model.parameters import Parameters
from ..model.plausible import ImplausibleWarning
from ..theory.fault import QUANTITIES, Fault
from ..theory.transfer import RigidBody, bodies_of

BEGINS = {
    "edge": "pushed at its edge",
    "top": "begun at a free side",
    "remote": "begun in the interior",
}
"""Where the creeping patch begins, by ``--loading``."""

_FAR_SIDES = {"traction": "free", "velocity": "moved"}
"""Boundary conditions of a far side, in words."""

_GIVEN_BY = {
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
"""The parameters of a fault with a value in the paper, and names by which each may be given."""


def plane_in_words(plane: str) -> str:
    """The deformation of the bodies: plane strain, plane stress or antiplane shear."""
    return "antiplane shear" if plane == ANTIPLANE else f"plane {plane}"


def _system_line(fault: Fault, loading: str, known: bool) -> str:
    """Bodies, far sides, loading and plane; `known` is whether the shear modulus is given."""
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
    return f"System: {bodies}; {BEGINS[loading]}; {plane_in_words(fault.plane)}."


def _body(
    modulus: float,
    ratio: float,
    height: float,
    far_side: str,
) -> str:
    """One body in words; a shear modulus of NaN is the one to find."""
    value = "looked for" if math.isnan(float(modulus)) else f"= {float(modulus):.4g} Pa"
    material = f"(mu {value}, nu = {float(ratio):.4g})"
    if math.isinf(float(height)):
        return f"a half-space {material}"
    side = _FAR_SIDES.get(far_side, far_side)
    return f"a layer {float(height):.4g} m high with its far side {side} {material}"


def is_of_one_material(fault: Fault) -> bool:
    """Whether both bodies have the same material."""
    second = (fault.second_shear_modulus, fault.second_poisson_ratio)
    return (fault.shear_modulus, fault.poisson_ratio) == second


def systems_of_lengths(fault: Fault, uncertain: Collection[str] = ()) -> list[str]:
    """The systems of the lengths in use, in the order of their listing.

    Parameters
    ----------
    fault : Fault
        One fault.
    uncertain : collection of str
        Names of its uncertain parameters.

    Returns
    -------
    list of str
        With the system of two materials only if the materials differ.
    """
    differ = not is_of_one_material(fault)
    differ = differ or any(name.startswith("second_") for name in uncertain)
    systems = [THIS_FAULT]
    if differ and math.isfinite(fault.second_shear_modulus):
        systems.append(TWO_MATERIALS)
    return [*systems, HALF_SPACES, RIGID_BASE]


def parameters_of(fault: Fault) -> dict[str, Any]:
    """All parameters of a fault that are not None, by name."""
    values = {name: getattr(fault, name) for name in QUANTITIES}
    return {name: value for name, value in values.items() if value is not None}


def fault_in(parameters: Parameters) -> dict[str, Any]:
    """The fault of a simulation, with its friction law expanded at V, as keywords of Fault."""
    material = parameters.material
    loading = parameters.loading
    friction, a, zeta = parameters.friction.expansion(loading.velocity)
    upper, lower = bodies_of(parameters)
    found: dict[str, Any] = {
        "shear_modulus": material.shear_modulus,
        "poisson_ratio": material.poisson_ratio,
        "plane": material.plane,
        "height": upper.height,
        "far_side": upper.far_side,
        "normal_stress": loading.normal_stress,
        "velocity": loading.velocity,
        "slip_distance": parameters.friction.slip_distance,
        "friction": friction,
        "a": a,
        "zeta": zeta,
    }
    if isinstance(lower, RigidBody):
        return found | {"second_shear_modulus": math.inf}
    return found | {
        "second_shear_modulus": lower.material.shear_modulus,
        "second_poisson_ratio": lower.material.poisson_ratio,
        "second_height": lower.height,
        "second_far_side": lower.far_side,
    }


def scales_line(law: Friction, velocity: float) -> str:
    """The slip rates (m/s) of a friction law and V, in words.

    Parameters
    ----------
    law : Friction
        The friction law.
    velocity : float
        V (m/s).

    Returns
    -------
    str
    """
    reference = getattr(law, "reference_slip_rate", None)
    rates = {
        "v*": getattr(law, "slip_rate_scale", reference),
        "v0": law.regularisation_slip_rate,
        "V": velocity,
    }
    texts = [f"{name} = {rate:.3g}" for name, rate in rates.items() if rate is not None]
    return f"{', '.join(texts)} m/s"


def system_of_run(
    parameters: Parameters,
    base: Parameters | None,
    given: Mapping[str, Any],
) -> list[str]:
    """The system of a run, its friction and the assumptions, one line each.

    Parameters
    ----------
    parameters : Parameters
        The run.
    base : Parameters or None
        The run or the dataset from which parameters are taken, if any.
    given : mapping
        The given values by their names in studies.

    Returns
    -------
    list of str
    """
    law = parameters.friction
    velocity = parameters.loading.velocity
    friction, a, zeta = law.expansion(velocity)
    fault = Fault(**fault_in(parameters))
    lines = [
        _system_line(fault, parameters.loading.kind, known=True),
        f"Friction: {law.law} law, {law.evolution}; at V: f = {friction:.4g}, a = {a:.4g}, "
        f"b = {a + zeta:.4g}; D = {law.slip_distance:.4g} m; "
        f"{scales_line(law, velocity)}.",
    ]
    if base is not None:
        return lines
    lines += papers_lines(law, given)
    assumed = _assumed_of_bodies(given.keys(), parameters.second_body.deformable)
    if assumed:
        lines.append(f"Assumed: {', '.join(assumed)}.")
    return lines


def papers_lines(law: Friction, given: Mapping[str, Any]) -> list[str]:
    """The parameters that are not given and therefore the paper's, in one line or none.

    Parameters
    ----------
    law : Friction
        The friction law of the fault.
    given : mapping
        The given values by their names in studies.

    Returns
    -------
    list of str
    """
    given_by = dict(_GIVEN_BY)
    if any(name in given for name in law.set_by_expansion):
        for name in ("friction", "a", "b"):
            del given_by[name]
        for name in law.set_by_expansion:
            given_by[name] = {name}
    papers = [name for name, names in given_by.items() if not names & given.keys()]
    return [f"Not given, so the paper's: {', '.join(papers)}."] if papers else []


def _assumed_of_bodies(given: Collection[str], deformable: bool) -> list[str]:
    """The assumptions on the second body, in words."""
    if not deformable:
        return []
    if "second_shear_modulus" not in given:
        return ["the second body is like the first"]
    if "second_height" not in given:
        return ["the second body is as high as the first"]
    return []


def system_of_fault(
    fault: Fault,
    given: Mapping[str, Any],
    loading: str = "edge",
    known: bool = True,
) -> list[str]:
    """The system of a fault of the theory and the assumptions, one line each.

    Parameters
    ----------
    fault : Fault
        One fault.
    given : mapping
        Its given parameters, by name.
    loading : {"edge", "top", "remote"}
        Where the creeping patch begins.
    known : bool
        Whether the shear modulus of the first body is known, rather than the parameter to find.

    Returns
    -------
    list of str
    """
    deformable = math.isfinite(given.get("second_shear_modulus", 1.0))
    assumed = _assumed_of_bodies(given.keys(), deformable)
    if "height" not in given:
        assumed.append("half-spaces")
    elif "far_side" not in given:
        assumed.append("far sides free of changes of stress")
    if "plane" not in given:
        assumed.append("plane strain")
    lines = [_system_line(fault, loading, known)]
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
        click.echo(f"warning: {text}", err=True)
