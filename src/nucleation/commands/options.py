"""Parameters as options of a command line, and the run that they stand for."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterable, Mapping
from typing import Any

from ..configuration.load import configure
from ..configuration.runs import Run
from ..configuration.study_names import study_parameters
from ..model.friction.constants import CONSTANTS, with_constants
from ..model.friction.law import Friction
from ..model.friction.registry import LAWS
from ..model.parameters import Parameters, names
from ..model.quantities import ParameterError, Quantity
from . import units
from .text import with_unit

STUDY = "command"  # name of the study of one run that a command line amounts to


IN_COMMANDS = {
    "the configuration has one problem:\n  - ": "",
    "the configuration has": "the parameters have",
    "limits.memory": "--memory",
    "results = ": "OUTPUT's directory = ",
}
"""What the configuration calls things that are options here."""


def flat(parameters: Parameters) -> dict[str, Any]:
    """Parameters by their names in studies, but for those that are left out."""
    known, given = names(), parameters.named().items()
    return {known.short(full): value for full, value in given if value is not None}


def _defaults() -> dict[str, Any]:
    """The usual values by their names in studies, those of other friction laws among them."""
    laws = [flat(Parameters(friction=Friction(law=law))) for law in LAWS]
    return {k: v for law in laws for k, v in law.items()} | flat(Parameters())


def parameter_options(
    chosen: Iterable[str], changed: Mapping[str, Any] = {}
) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """One option for each of some parameters, from its declaration; also by its full name.

    Parameters
    ----------
    chosen : names of parameters in studies.
    changed : defaults by name that are not those of simulations.
    """
    wanted = set(chosen)
    entries = [(name, entry) for name, entry in study_parameters().items() if name in wanted]
    defaults = _defaults() | dict(changed)

    def with_options(function: Callable[..., Any]) -> Callable[..., Any]:
        for name, entry in reversed(entries):
            function = _option(name, entry, defaults)(function)
        return function

    return with_options


def _option(name: str, entry: Quantity, defaults: Mapping[str, Any]) -> Callable[..., Any]:
    known = names()
    note = f"default {with_unit(defaults[name], entry)}" if name in defaults else ""
    note = "6 critical lengths if left out" if name == "length" else note
    full = known.full(name)
    called = [full, *known.others(full), name]
    called = [word for word in dict.fromkeys(called) if word not in ("f", "kind", "law")]
    words = [f"--{word.replace('_', '-')}" for word in called]
    return units.option(*words, key=name, entry=entry, note=note)


def merged(base: Parameters | None, given: dict[str, Any]) -> dict[str, Any]:
    """All values, from a base or the defaults, and those given; constants of friction set its law.

    Without a base, the block's length is left out unless it is given: it follows from the theory.
    """
    plain = {name: value for name, value in given.items() if name not in CONSTANTS}
    parameters = (base or Parameters()).replaced(plain)
    friction = with_constants(parameters.friction, parameters.loading.velocity, given)
    values = flat(dataclasses.replace(parameters, friction=friction))
    if base is None and "length" not in given:
        del values["length"]
    return values


def planned(
    values: dict[str, Any], study: dict[str, Any], limits: dict[str, Any], results: str
) -> Run:
    """The run that values by their names in studies stand for, checked as a configuration.

    Raises
    ------
    ParameterError
        With all that is wrong with it.
    """
    defaults = dict(values)
    runs = [{"height": defaults.pop("height")}]
    study = study | {"defaults": defaults, "runs": runs}
    try:
        settings = configure({"studies": {STUDY: study}, "limits": limits, "results": results})
    except ParameterError as error:
        text = str(error)
        for place in (f"studies.{STUDY}.runs[0]", f"studies.{STUDY}.defaults"):
            text = text.replace(f"{place}: ", "").replace(f"{place}.", "")
        for words, own in IN_COMMANDS.items():
            text = text.replace(words, own)
        raise ParameterError(text) from None
    return settings.runs[0]


def given_of(values: dict[str, Any]) -> dict[str, Any]:
    """The options that were given."""
    return {name: value for name, value in values.items() if value is not None}
