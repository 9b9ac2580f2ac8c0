"""Options for the parameters of a fault of the linear theory, and the fault that they define."""

import math
from typing import Any

import click

from replication.configuration.given_fault import IN_STUDIES, fault_from, sets_law
from replication.configuration.single_run import merged_parameters

from ..lengths.draws import parse_range
from ..model.parameters import names
from ..model.quantities import ParameterError
from ..theory.fault import QUANTITIES, required
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
    paper: bool,
    optional: str = "",
    **options: Any,
) -> tuple[dict[str, Any], list[str]]:
    """The fault that options and files define.

    Parameters
    ----------
    per_decade : bool
        Whether the options a, b and zeta are coefficients of log10.
    paper : bool
        Whether parameters that are not given are the paper's.
    optional : str
        A required parameter that may be missing.
    **options
        Values of the other :data:`fault_options`, in SI units; None if not given.

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
    own = given_of({**options, "paper": paper})
    if per_decade:
        for name in own.keys() & {"a", "b", "zeta"}:
            own[name] = own[name] / math.log(10.0)
    of_theory = {name: own.pop(name) for name in OF_THEORY if name in own}
    if "second_far_side" in own:  # which allows more in the theory
        of_theory["second_far_side"] = own.pop("second_far_side")
    base, given = sourced(own, ranges=True)

    of_theory |= {name: given.pop(name) for name in OF_THEORY if name in given}
    values = fault_from(given, base, paper)
    papers = []
    if not base and (paper or sets_law(given)):
        papers = papers_lines(merged_parameters(None, given).friction, given)
    values |= of_theory

    for name in required(values.get("plane", "strain")):
        if name not in values and name != optional:
            raise ParameterError(
                f"{name} is missing: give {words(name)[-1]} or --parameters FILE, or take all "
                "other parameters from the paper by --paper"
            )
    return values, papers
