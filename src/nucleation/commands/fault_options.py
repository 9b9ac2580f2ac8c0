"""The parameters of a fault of the linear theory as options, and the system that they make."""

import contextlib
import math
import warnings
from collections.abc import Collection, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple

import click

from ..answers.draws import Range, parse_range
from ..answers.in_use import HALF_SPACES, RIGID_BASE, THIS_FAULT, TWO_MATERIALS
from ..model.friction.constants import CONSTANTS
from ..model.friction.law import Friction
from ..model.friction.registry import LAWS, law_declarations
from ..model.material import ANTIPLANE
from ..model.parameters import Parameters, names
from ..model.plausible import ImplausibleWarning
from ..model.quantities import ParameterError
from ..theory.fault import QUANTITIES, Fault
from ..theory.transfer import RigidBody, bodies_of
from .options import (
    given_of,
    merged_parameters,
    option,
    parameter_options,
    second_body_option,
    source_options,
    sourced,
    together,
    words,
)


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
    return f"System: {bodies}; {BEGINS[loading]}; {plane_in_words(fault.plane)}."


def _body(modulus: Any, ratio: Any, height: Any, far_side: Any) -> str:
    value = "looked for" if math.isnan(float(modulus)) else f"= {float(modulus):.4g} Pa"
    own = f"(mu {value}, nu = {float(ratio):.4g})"
    if math.isinf(float(height)):
        return f"a half-space {own}"
    side = {"traction": "free", "velocity": "moved"}.get(str(far_side), far_side)
    return f"a layer {float(height):.4g} m high with its far side {side} {own}"


def plane_in_words(plane: str) -> str:
    """How bodies deform: plane strain, plane stress, antiplane shear."""
    return "antiplane shear" if plane == ANTIPLANE else f"plane {plane}"


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
    if base is not None:
        return lines
    lines += _papers_told(law, given)
    if assumed := _assumed_of_bodies(given.keys(), parameters.second_body.deformable):
        lines.append(f"Assumed: {', '.join(assumed)}.")
    return lines


def _papers_told(law: Friction, given: Mapping[str, Any]) -> list[str]:
    """The constants of a fault that are not given and so the paper's, in a line."""
    asked = PAPERS
    if any(name in given for name in law.set_by_expansion):
        constants = {"friction", "a", "b"}
        asked = {name: by for name, by in PAPERS.items() if name not in constants}
        asked |= {name: {name} for name in law.set_by_expansion}
    papers = [name for name, by in asked.items() if not by & given.keys()]
    return [f"Not given, so the paper's: {', '.join(papers)}."] if papers else []


def _assumed_of_bodies(given: Collection[str], deformable: bool) -> list[str]:
    """What was assumed of the second body, in words."""
    if not deformable:
        return []
    if "second_shear_modulus" not in given:
        return ["the second body is like the first"]
    return [] if "second_height" in given else ["the second body is as high as the first"]


NOTES = {
    "b": "this, --zeta or --zeta-over-a", "zeta": "zeta = b - a",
    "friction": "needed where the bodies differ", "velocity": "for frequencies alone",
    "height": "inf, a half-space, if left out", "far_side": "traction if left out",
    "second_far_side": "of the second body; the first one's if left out",
    "plane": "strain if left out",
}  # fmt: skip
"""What options say beside the declaration of their parameter."""

REQUIRED = ("shear_modulus", "poisson_ratio", "normal_stress", "a", "slip_distance")

FRICTION = {
    "velocity",
    "evolution",
    *CONSTANTS,
    *(names().short(f"friction.{k}") for k in law_declarations()),
}
"""The names in studies of what a friction law and its constants at V are given by."""

IN_STUDIES = {k: names().short(names().full(k)) for k in QUANTITIES if k != "far_side"}
"""The names in studies of a fault's parameters; of a far side a simulation has one kind alone."""


SCALES = (
    "regularisation_slip_rate",
    "reference_slip_rate",
    "slip_rate_scale",
    "state_scale",
)
"""The names in studies of what makes a and b of a friction law change with the slip rate."""


class GivenFault(NamedTuple):
    """A fault as options and files give it."""

    values: dict[str, Any]
    """The parameters of :class:`~nucleation.theory.fault.Fault`."""
    law: Friction | None
    """The friction law of `simulate` and `drop`; None without f or V, or where no law fits."""
    told: list[str]
    """What is not given and so the paper's, in a line."""


fault_options = together(
    *(
        option(
            *(["--far-side"] if key == "far_side" else words(key)),
            key=key, entry=entry, note=NOTES.get(key, ""), read=parse_range,
        )
        for key, entry in QUANTITIES.items()
    ),
    option("--zeta-over-a", key="zeta_over_a", entry=names()["zeta_over_a"]),
    parameter_options(("evolution", "friction_law", *SCALES)),
    second_body_option,
    click.option(
        "--per-decade", is_flag=True, help="a, b and zeta are given per decade, for log10"
    ),
    source_options,
)  # fmt: skip
"""One option for each parameter of a fault, and those for where they are from."""


def fault_values(
    per_decade: bool,
    file: Path | None,
    run_id: str | None,
    config: str | None,
    paper: bool,
    optional: str = "",
    ranges: bool = False,
    **options: Any,
) -> GivenFault:
    """The fault that options and files give.

    Raises ParameterError if a parameter is wrong or missing, but for an `optional` one, or a file
    has a range, but for `ranges`.
    """
    own = given_of(options)
    if per_decade:
        own |= {k: own[k] / math.log(10.0) for k in ("a", "b", "zeta") if k in own}
    by_study = {IN_STUDIES.get(k, k): v for k, v in own.items() if k != "far_side"}
    base, given = sourced(file, run_id, config, paper, by_study, ranges)
    if base or paper or any(given.keys() & Friction(law=law).set_by_expansion for law in LAWS):
        parameters = merged_parameters(base, given)
        found = of_parameters(parameters)
        law: Friction | None = parameters.friction
        told = [] if base else _papers_told(parameters.friction, given)
    else:
        found, told = _of_study(given), []
        law = _law_of(found, given)
    found |= {k: v for k, v in own.items() if k in ("far_side", "second_far_side")}
    for name in REQUIRED:
        if name not in found and name != optional:
            raise ParameterError(
                f"{name} is missing: give {words(name)[-1]} or --parameters FILE, or take what is "
                "not given from the paper by --paper"
            )
    return GivenFault(found, law, told)


def _law_of(found: Mapping[str, Any], given: Mapping[str, Any]) -> Friction | None:
    """The law of a fault of its own, if it can be known."""
    needed = ("velocity", "friction", "a", "slip_distance")
    if any(
        not isinstance(found.get(name), float) or isinstance(found[name], Range) for name in needed
    ):
        return None
    of_friction = {k: v for k, v in given.items() if k in FRICTION}
    with contextlib.suppress(ParameterError):
        return merged_parameters(None, of_friction).friction
    return None


def _of_study(given: Mapping[str, Any]) -> dict[str, Any]:
    """The same of values by their names in studies; what a fault does not have is left out."""
    found = {key: given[name] for key, name in IN_STUDIES.items() if name in given}
    if "zeta_over_a" in given and "a" in found:
        if {"zeta", "b"} & found.keys():
            raise ParameterError("zeta_over_a is not allowed together with zeta or b")
        found["zeta"] = given["zeta_over_a"] * found["a"]
    if given["second_body"] == "rigid":
        found["second_shear_modulus"] = math.inf
    return found


@contextlib.contextmanager
def doubts_told() -> Iterator[None]:
    """Magnitudes that are hardly meant are told on the standard error, each once."""
    with warnings.catch_warnings(record=True) as doubts:
        warnings.simplefilter("always", ImplausibleWarning)
        yield
    for text in dict.fromkeys(str(doubt.message) for doubt in doubts):
        click.echo(f"warning: {text}", err=True)


def parameters_of(fault: Fault) -> dict[str, Any]:
    """All parameters that a fault has."""
    return given_of({name: getattr(fault, name) for name in QUANTITIES})


def said_of(
    fault: Fault, given: Mapping[str, Any], loading: str = "edge", known: bool = True
) -> list[str]:
    """The system of a fault of which some parameters are `given`, and what was assumed."""
    deformable = math.isfinite(given.get("second_shear_modulus", 1.0))
    assumed = _assumed_of_bodies(given.keys(), deformable)
    if "height" not in given:
        assumed.append("half-spaces")
    elif "far_side" not in given:
        assumed.append("far sides free of changes of stress")
    if "plane" not in given:
        assumed.append("plane strain")
    line = f"Assumed: {', '.join(assumed)}."
    return [system_line(fault, loading, known), *([line] if assumed else [])]
