"""Options for the parameters of a fault of the linear theory, and the fault that they define."""

import contextlib
import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click

from ..answers.draws import Range, parse_range
from ..configuration.single_run import merged_parameters
from ..model.friction.constants import CONSTANTS
from ..model.friction.law import Friction
from ..model.friction.registry import LAWS, law_declarations
from ..model.parameters import names
from ..model.quantities import ParameterError
from ..theory.fault import QUANTITIES, required
from ..theory.of_runs import fault_of_run
from ..theory.values import OF_THEORY
from .options import (
    Decorator,
    option,
    parameter_options,
    second_body_option,
    source_options,
    together,
    words,
)
from .sources import given_of, sourced
from .system_text import papers_lines

_NOTES = {
    "b": "this, --zeta or --zeta-over-a",
    "zeta": "zeta = b - a",
    "friction": "needed where the bodies differ",
    "velocity": "only for frequencies",
    "height": "inf, a half-space, if left out",
    "far_side": "traction if left out",
    "second_far_side": "of the second body; the first one's if left out",
    "plane": "strain if left out",
}
"""Additions to the help of options."""

_LAW_IN_STUDIES = {names().short(f"friction.{name}") for name in law_declarations()}
_FRICTION = {"velocity", "evolution", *CONSTANTS, *_LAW_IN_STUDIES}
"""Names in studies of the parameters of friction laws, and of their constants at V."""

IN_STUDIES = tuple(name for name in QUANTITIES if name not in OF_THEORY)
"""The parameters of a fault that simulations have too, under the same names."""

_SCALES = (
    "regularisation_slip_rate",
    "reference_slip_rate",
    "slip_rate_scale",
    "state_scale",
)
"""Names in studies of the scales of friction laws, by which a and b depend on the slip rate."""


def _options_of_quantities() -> list[Decorator]:
    """One option for each parameter of a fault."""
    options: list[Decorator] = []
    for key, entry in QUANTITIES.items():
        called = words(key) if key in IN_STUDIES else [f"--{key.replace('_', '-')}"]
        note = _NOTES.get(key, "")
        options.append(option(*called, key=key, entry=entry, note=note, read=parse_range))
    return options


fault_options = together(
    *_options_of_quantities(),
    option("--zeta-over-a", key="zeta_over_a", entry=names()["zeta_over_a"]),
    parameter_options(("friction_law", *_SCALES)),
    second_body_option,
    click.option(
        "--per-decade",
        is_flag=True,
        help="a, b and zeta are given per decade, for log10",
    ),
    source_options,
)
"""One option for each parameter of a fault, and options for the source of other parameters."""


def fault_values(
    per_decade: bool,
    file: Path | None,
    run_id: str | None,
    config: str | None,
    paper: bool,
    optional: str = "",
    ranges: bool = False,
    **options: Any,
) -> tuple[dict[str, Any], list[str]]:
    """The fault that options and files define.

    Parameters
    ----------
    per_decade : bool
        Whether the options a, b and zeta are coefficients of log10.
    file, run_id, config, paper
        The source of other parameters, as for :func:`~nucleation.commands.sources.sourced`.
    optional : str
        A required parameter that may be missing.
    ranges : bool
        Whether values in files may be ranges.
    **options
        Values of :data:`fault_options`, in SI units; None if not given.

    Returns
    -------
    values : dict
        The parameters of :class:`~nucleation.api.fault.Fault`, with the friction law
        of `simulate` and `drop`.
    papers : list of str
        The parameters that are not given and therefore the paper's, in a line.

    Raises
    ------
    ParameterError
        If a parameter is wrong or missing.
    """
    own = given_of(options)
    if per_decade:
        for name in own.keys() & {"a", "b", "zeta"}:
            own[name] = own[name] / math.log(10.0)
    of_theory = {name: own.pop(name) for name in OF_THEORY if name in own}
    if "second_far_side" in own:  # which allows more in the theory
        of_theory["second_far_side"] = own.pop("second_far_side")
    base, given = sourced(file, run_id, config, paper, own, ranges)

    if base or paper or _sets_law(given):
        parameters = merged_parameters(base, given)
        values = fault_of_run(parameters)
        papers = [] if base else papers_lines(parameters.friction, given)
    else:
        values = _of_study(given)
        law = _law_of(values, given)
        if law is not None and values.get("loading", "edge") == "edge":
            values["friction_law"] = law
        papers = []
    values |= of_theory

    for name in required(values.get("plane", "strain")):
        if name not in values and name != optional:
            raise ParameterError(
                f"{name} is missing: give {words(name)[-1]} or --parameters FILE, or take all "
                "other parameters from the paper by --paper"
            )
    return values, papers


def _sets_law(given: Mapping[str, Any]) -> bool:
    """Whether parameters of a friction law are given that a, b and f would determine."""
    return any(given.keys() & Friction(law=law).set_by_expansion for law in LAWS)


def _law_of(values: Mapping[str, Any], given: Mapping[str, Any]) -> Friction | None:
    """The friction law of the user's own fault, if its constants are known."""
    for name in ("velocity", "friction", "a", "slip_distance"):
        value = values.get(name)
        if not isinstance(value, float) or isinstance(value, Range):
            return None
    of_friction = {name: value for name, value in given.items() if name in _FRICTION}
    with contextlib.suppress(ParameterError):
        return merged_parameters(None, of_friction).friction
    return None


def _of_study(given: Mapping[str, Any]) -> dict[str, Any]:
    """The parameters of a fault, from values by their names in studies."""
    found = {name: given[name] for name in IN_STUDIES if name in given}
    if "zeta_over_a" in given and "a" in found:
        if {"zeta", "b"} & found.keys():
            raise ParameterError("zeta_over_a is not allowed together with zeta or b")
        found["zeta"] = given["zeta_over_a"] * found["a"]
    if given["second_body"] == "rigid":
        found["second_shear_modulus"] = math.inf
    return found
