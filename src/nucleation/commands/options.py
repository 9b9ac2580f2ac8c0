"""Parameters as options of a command line, and the run that they stand for."""

import dataclasses
from collections.abc import Callable, Iterable, Mapping
from pathlib import Path
from typing import Any

import click

from ..configuration.load import configure
from ..configuration.runs import Run
from ..configuration.study_names import study_parameters
from ..model.friction.constants import CONSTANTS, with_constants
from ..model.friction.law import Friction
from ..model.friction.registry import LAWS
from ..model.parameters import Parameters, names
from ..model.quantities import ParameterError, Quantity
from ..model.units import bounds, parse
from ..theory.fault import QUANTITIES, Fault
from ..theory.uncertainty import Range
from . import units
from .given import of_dataset, of_file, of_run
from .system import of_parameters, system_line
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
    if name == "second_body":
        return second_body_option
    note = f"default {with_unit(defaults[name], entry)}" if name in defaults else ""
    note = "6 critical lengths if left out" if name == "length" else note
    return units.option(*words(name), key=name, entry=entry, note=note)


def words(name: str) -> list[str]:
    """The options for a parameter: its full name, its other names, and the one it goes by."""
    known = names()
    full = known.full(name)
    called = [*known.others(full), known.short(full)]
    return [
        f"--{word.replace('_', '-')}"
        for word in dict.fromkeys(called)
        if word not in ("f", "kind", "law")  # which would be read as something else
    ]


second_body_option = click.option(
    "--second-body", metavar="BODY",
    help="same: like the first; rigid; or MODULUS,POISSON[,HEIGHT], such as 60GPa,0.3; "
    "default same",
)  # fmt: skip


def second_body(text: str) -> dict[str, Any]:
    """What ``--second-body`` stands for, by names of parameters in studies.

    Raises
    ------
    ParameterError
        If it is none of same (deformable), rigid, and two or three values with commas between.
    """
    if text in ("same", "deformable", "rigid"):
        return {"second_body": "rigid" if text == "rigid" else "deformable"}
    keys = ("second_shear_modulus", "second_poisson_ratio", "second_height")
    entries, parts = QUANTITIES, text.split(",")  # of the theory: a height may be infinite
    if not 2 <= len(parts) <= 3:
        raise ParameterError(
            f"second_body = {text!r} is not allowed: it must be same, rigid, or a shear modulus "
            f"in {bounds(entries[keys[0]])}, Poisson's ratio in {bounds(entries[keys[1]])} and "
            "perhaps a height, with commas between"
        )
    own = {k: parse(k, part, entries[k]) for k, part in zip(keys, parts, strict=False)}
    return {"second_body": "deformable", **own}


def source_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """``--parameters``, ``--run`` and ``--config``: where other parameters are from."""
    for option in (
        click.option(
            "--config", type=click.Path(dir_okay=False), default="config/config.yaml",
            show_default=True, help="the configuration that --run is in",
        ),
        click.option("--run", "run_id", metavar="ID", help="a run of the configuration, by its id"),
        click.option(
            "--parameters", "file", type=click.Path(exists=True, dir_okay=False, path_type=Path),
            help="YAML or JSON file of parameters by the names of options, with units if you like; "
            "or the dataset of an earlier simulation",
        ),
    ):  # fmt: skip
        function = option(function)
    return function


def sourced(
    file: Path | None, run_id: str | None, config: str, options: Mapping[str, Any],
    ranges: bool = False,
) -> tuple[Parameters | None, dict[str, Any]]:  # fmt: skip
    """The parameters of a run or a dataset, if one is named, and those that are given."""
    if file and run_id:
        raise ParameterError("--parameters and --run can't be combined")
    base, given = None, {}
    if run_id:
        base = of_run(config, run_id)
    elif file and file.suffix == ".nc":
        base = of_dataset(file)
    elif file:
        given = of_file(file)
    own = given_of(options)
    for values in (given, own):
        if "second_body" in values:
            values |= second_body(values.pop("second_body"))
    usual = {} if base else {"second_body": "deformable"}
    found = usual | given | own
    uncertain = [name for name, value in found.items() if isinstance(value, Range)]
    if uncertain and not ranges:
        raise ParameterError(f"{uncertain[0]}: only `nucleation length` takes a range")
    return base, found


BODIES_AND_LOAD = {
    **{name: {name} for name in ("shear_modulus", "poisson_ratio", "height", "normal_stress")},
    "velocity": {"velocity"}, "slip_distance": {"characteristic_slip_distance"},
}  # fmt: skip
FRICTION = {
    "friction": {"friction_coefficient"}, "a": {"direct_effect"},
    "b": {"zeta_over_a", "velocity_weakening", "evolution_effect"},
}  # fmt: skip
"""The parameters of a fault that the paper has values for, and by which names each is given."""


def scales(law: Friction, velocity: float) -> str:
    """The slip rates of a law and V, in words."""
    scale = getattr(law, "slip_rate_scale", getattr(law, "reference_slip_rate", None))
    rates = {"v*": scale, "v0": law.regularisation_slip_rate, "V": velocity}
    return ", ".join(f"{name} = {x:.3g}" for name, x in rates.items() if x is not None) + " m/s"


def told(parameters: Parameters, base: Parameters | None, given: Mapping[str, Any]) -> list[str]:
    """The system of a run, its friction, and what was assumed, a line each."""
    law, v = parameters.friction, parameters.loading.velocity
    f, a, zeta = law.expansion(v)
    lines = [
        system_line(Fault(**of_parameters(parameters)), parameters.loading.kind),
        f"Friction: {law.law} law, {law.evolution}; at V: f = {f:.4g}, a = {a:.4g}, "
        f"b = {a + zeta:.4g}; D = {law.characteristic_slip_distance:.4g} m; {scales(law, v)}.",
    ]
    own = {name: {name} for name in law.set_by_expansion}
    asked = BODIES_AND_LOAD | (own if own.keys() & given.keys() else FRICTION)
    papers = [name for name, by in asked.items() if not by & given.keys()]
    if base is None and papers:
        lines.append(f"Not given, so the paper's: {', '.join(papers)}.")
    return lines


def merged(base: Parameters | None, given: dict[str, Any]) -> dict[str, Any]:
    """All values, from a base or the defaults, and those given; constants of friction set its law.

    Without a base, the block's length and the end time are left out unless they are given: they
    follow from the theory.
    """
    values = flat(merged_parameters(base, given))
    if base is None:  # these follow from the theory
        for name in {"length", "end_time", "time_after_event"} - given.keys():
            del values[name]
    return values


def merged_parameters(base: Parameters | None, given: dict[str, Any]) -> Parameters:
    """The parameters of a base, or the defaults, with those given."""
    plain = {name: value for name, value in given.items() if name not in CONSTANTS}
    parameters = (base or Parameters()).replaced(plain)
    friction = with_constants(parameters.friction, parameters.loading.velocity, given)
    return dataclasses.replace(parameters, friction=friction)


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
