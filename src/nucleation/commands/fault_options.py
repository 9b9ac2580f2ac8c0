"""The parameters of a fault of the linear theory as options of a command line."""

from __future__ import annotations

import contextlib
import math
import warnings
from collections.abc import Callable, Iterator
from typing import Any

import click

from ..commands import units
from ..model.plausible import ImplausibleWarning
from ..model.quantities import ParameterError
from ..model.units import bounds, parse
from ..theory.fault import QUANTITIES, Fault
from .text import plain


def fault_options(required: bool) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """One option for each parameter of a fault; what every fault needs may be `required`."""

    def option(*names: str, key: str, **settings: Any) -> Any:
        return units.option(*names, key=key, entry=QUANTITIES[key], **settings)

    always = {"required": required}
    stack = [
        option("--shear-modulus", key="shear_modulus", **always),
        option("--poisson", "--poisson-ratio", key="poisson_ratio", required=True),
        option("--normal-stress", key="normal_stress", **always),
        option("--a", "--direct-effect", key="a", required=True),
        option("--b", key="b", note="this or --zeta"),
        option("--zeta", key="zeta", note="zeta = b - a"),
        option("--slip-distance", "--characteristic-slip-distance", key="slip_distance", **always),
        option(
            "--friction", "--friction-coefficient", key="friction",
            note="needed where the bodies differ",
        ),
        option("--velocity", key="velocity", note="for frequencies alone"),
        option("--height", key="height", default="inf", show_default=True),
        option("--far-side", key="far_side", default="traction", show_default=True),
        option(
            "--second-far-side", key="second_far_side",
            note="of the second body; the same by default",
        ),
        option("--plane", key="plane", default="strain", show_default=True),
        click.option(
            "--second-body", default="same", show_default=True, metavar="BODY",
            help="same; rigid; or MODULUS,POISSON[,HEIGHT], such as 60GPa,0.3",
        ),
        click.option(
            "--per-decade", is_flag=True, help="a, b and zeta are given per decade, for log10"
        ),
    ]  # fmt: skip

    def with_options(function: Callable[..., Any]) -> Callable[..., Any]:
        for add in reversed(stack):
            function = add(function)
        return function

    return with_options


def fault_values(second_body: str, per_decade: bool, **parameters: Any) -> dict[str, Any]:
    """The parameters of :class:`~nucleation.theory.fault.Fault` that the options give."""
    given = {k: v for k, v in parameters.items() if v is not None} | _second(second_body)
    if per_decade:
        given |= {k: given[k] / math.log(10.0) for k in ("a", "b", "zeta") if k in given}
    return given


def _second(text: str) -> dict[str, float]:
    """The parameters of the second body."""
    if text == "same":
        return {}
    if text == "rigid":
        return {"second_shear_modulus": math.inf}
    keys = ("second_shear_modulus", "second_poisson_ratio", "second_height")
    parts = text.split(",")
    if not 2 <= len(parts) <= 3:
        raise ParameterError(
            f"second_body = {text!r} is not allowed: it must be same, rigid, or a shear modulus "
            f"in {bounds(QUANTITIES[keys[0]])}, Poisson's ratio in "
            f"{bounds(QUANTITIES[keys[1]])} and perhaps a height, with commas between"
        )
    return {k: parse(k, part, QUANTITIES[k]) for k, part in zip(keys, parts, strict=False)}


@contextlib.contextmanager
def doubts_told() -> Iterator[None]:
    """Magnitudes that are hardly meant are told on the standard error, each once."""
    with warnings.catch_warnings(record=True) as doubts:
        warnings.simplefilter("always", ImplausibleWarning)
        yield
    for text in dict.fromkeys(str(doubt.message) for doubt in doubts):
        click.echo(f"warning: {text}", err=True)


def given_of(fault: Fault) -> dict[str, Any]:
    """All parameters that a fault has, for JSON (SI units)."""
    names = (name for name in QUANTITIES if getattr(fault, name) is not None)
    return {name: plain(getattr(fault, name)) for name in names}
