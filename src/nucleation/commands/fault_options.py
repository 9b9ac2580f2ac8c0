"""The parameters of a fault of the linear theory as options of a command line."""

import contextlib
import math
import warnings
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import click

from ..answers.uncertainty import parse_range
from ..model.friction.law import Friction
from ..model.friction.registry import LAWS
from ..model.parameters import names
from ..model.plausible import ImplausibleWarning
from ..model.quantities import ParameterError
from ..theory.fault import QUANTITIES, Fault
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
from .system import of_parameters, system_line

NOTES = {
    "b": "this, --zeta or --zeta-over-a", "zeta": "zeta = b - a",
    "friction": "needed where the bodies differ", "velocity": "for frequencies alone",
    "height": "inf, a half-space, if left out", "far_side": "traction if left out",
    "second_far_side": "of the second body; the first one's if left out",
    "plane": "strain if left out",
}  # fmt: skip
"""What options say beside the declaration of their parameter."""

REQUIRED = ("shear_modulus", "poisson_ratio", "normal_stress", "a", "slip_distance")

IN_STUDIES = {k: names().short(names().full(k)) for k in QUANTITIES if k != "far_side"}
"""The names in studies of a fault's parameters; of a far side a simulation has one kind alone."""

fault_options = together(
    *(
        option(
            *(["--far-side"] if key == "far_side" else words(key)),
            key=key, entry=entry, note=NOTES.get(key, ""), read=parse_range,
        )
        for key, entry in QUANTITIES.items()
    ),
    option("--zeta-over-a", key="zeta_over_a", entry=names()["zeta_over_a"]),
    parameter_options(("evolution", "friction_law")),
    second_body_option,
    click.option(
        "--per-decade", is_flag=True, help="a, b and zeta are given per decade, for log10"
    ),
    source_options,
)  # fmt: skip
"""One option for each parameter of a fault, and those for where they are from."""


def fault_values(
    per_decade: bool, file: Path | None, run_id: str | None, config: str, optional: str = "",
    ranges: bool = False, **options: Any,
) -> dict[str, Any]:  # fmt: skip
    """The parameters of :class:`~nucleation.theory.fault.Fault` that options and files give.

    Raises ParameterError if one is wrong or missing, but for an `optional` one, or a file has a
    range, but for `ranges`.
    """
    own = given_of(options)
    if per_decade:
        own |= {k: own[k] / math.log(10.0) for k in ("a", "b", "zeta") if k in own}
    by_study = {IN_STUDIES.get(k, k): v for k, v in own.items() if k != "far_side"}
    base, given = sourced(file, run_id, config, by_study, ranges)
    if base or any(given.keys() & Friction(law=law).set_by_expansion for law in LAWS):
        found = of_parameters(merged_parameters(base, given))
    else:
        found = _of_study(given)
    found |= {k: v for k, v in own.items() if k in ("far_side", "second_far_side")}
    for name in REQUIRED:
        if name not in found and name != optional:
            raise ParameterError(f"{name} is missing: give {words(name)[-1]}, or --parameters FILE")
    return found


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
    assumed = []
    if "second_shear_modulus" not in given:
        assumed.append("the second body is like the first")
    elif "second_height" not in given and math.isfinite(given["second_shear_modulus"]):
        assumed.append("the second body is as high as the first")
    if "height" not in given:
        assumed.append("half-spaces")
    elif "far_side" not in given:
        assumed.append("far sides free of changes of stress")
    if "plane" not in given:
        assumed.append("plane strain")
    line = f"Assumed: {', '.join(assumed)}."
    return [system_line(fault, loading, known), *([line] if assumed else [])]
