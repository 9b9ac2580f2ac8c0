"""Options of the command line whose values are parameters, with units as people write them."""

import dataclasses
import difflib
import math
from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from typing import Any

import click

from ..answers.draws import Range, parse_range
from ..configuration.installed import require
from ..configuration.load import configure, load
from ..configuration.runs import Run
from ..configuration.strict_yaml import read_yaml
from ..configuration.study_names import study_parameters
from ..model.friction.constants import CONSTANTS, with_constants
from ..model.friction.law import Friction
from ..model.friction.registry import LAWS
from ..model.own_fault import follows_from
from ..model.parameters import Parameters, names
from ..model.quantities import ParameterError, Quantity, check
from ..model.units import bounds, parse
from ..theory.fault import QUANTITIES
from .text import with_unit

Decorator = Callable[[Callable[..., Any]], Callable[..., Any]]


def option(
    *names: str, key: str, entry: Quantity, note: str = "", read: Callable[..., Any] = parse,
    **settings: Any,
) -> Decorator:  # fmt: skip
    """A click option whose help, unit and range come from the declaration of a parameter."""

    def value_of(text: str) -> Any:
        try:
            return read(key, text, entry)
        except ParameterError as error:
            raise click.BadParameter(str(error) + _of_half_space(key, text, entry)) from None

    help, metavar = entry.description, f"[{'|'.join(entry.choices)}]"
    if not entry.choices:
        metavar = "NUMBER" if entry.unit == "1" else f"VALUE[{entry.unit}]"
        help += f"; {'an integer in' if entry.kind == 'int' else 'in'} {bounds(entry)}"
    return click.option(
        *names, key, type=value_of, metavar=metavar, help=f"{help}; {note}" if note else help,
        shell_complete=lambda ctx, param, begun: [c for c in entry.choices if c.startswith(begun)],
        **settings,
    )  # fmt: skip


HALF_SPACE = (
    "; a simulation and its drop are those of a block: one of 4 L_c in height and 30 L_c in length "
    "has an L_s within 2 % of that of a half-space"
)


def _of_half_space(key: str, text: str, entry: Quantity) -> str:
    """A block in place of a half-space, where a height must be finite."""
    is_height = key in ("height", "second_height") and math.isfinite(entry.high)
    return HALF_SPACE if is_height and "inf" in text.lower() else ""


def together(*options: Decorator) -> Decorator:
    """Several options as one decorator, in the order of the help."""

    def with_options(function: Callable[..., Any]) -> Callable[..., Any]:
        for add in reversed(options):
            function = add(function)
        return function

    return with_options


def words(name: str) -> list[str]:
    """The options for a parameter: its full name, its other names, and the one it goes by."""
    known = names()
    full = known.full(name)
    called = dict.fromkeys([*known.others(full), known.short(full)])
    ambiguous = ("f", "kind", "law")  # which would be read as something else
    return [f"--{word.replace('_', '-')}" for word in called if word not in ambiguous]


second_body_option = click.option(
    "--second-body", metavar="BODY",
    help="same: like the first; rigid; or MODULUS,POISSON[,HEIGHT], such as 60GPa,0.3; "
    "default same",
)  # fmt: skip

source_options = together(
    click.option(
        "--parameters", "file", type=click.Path(exists=True, dir_okay=False, path_type=Path),
        help="YAML or JSON file of parameters by the names of options, with units if you like; "
        "or the dataset of an earlier simulation",
    ),
    click.option("--run", "run_id", metavar="ID", help="a run of the configuration, by its id"),
    click.option(
        "--config", type=click.Path(dir_okay=False),
        help="the configuration that --run is in; default: that of the checkout",
    ),
    click.option(
        "--paper", is_flag=True,
        help="take what is not given from the paper: PMMA on a rigid base, with its friction law",
    ),
)  # fmt: skip
"""Where other parameters are from."""


def flat(parameters: Parameters) -> dict[str, Any]:
    """Parameters by their names in studies, but for those that are left out."""
    known, given = names(), parameters.named().items()
    return {known.short(full): value for full, value in given if value is not None}


def parameter_options(
    chosen: Collection[str], changed: Mapping[str, Any] = {}, ranges: bool = False
) -> Decorator:
    """Options for parameters by their names in studies, some with `changed` defaults.

    Their values may be ranges if `ranges` says so.
    """
    usual: dict[str, Any] = {}
    for law in (*LAWS, Friction().law):
        usual |= flat(Parameters(friction=Friction(law=law)))
    known = names()
    notes = {
        k: f"default {with_unit(v, known[known.full(k)])}" for k, v in (usual | changed).items()
    }
    notes["length"] = "6 critical lengths if left out"
    entries = {name: entry for name, entry in study_parameters().items() if name in chosen}
    return together(*(
        second_body_option if name == "second_body"
        else option(
            *words(name),
            key=name,
            entry=entry,
            note=notes.get(name, ""),
            read=parse_range if ranges and not entry.worded else parse,
        )
        for name, entry in entries.items()
    ))  # fmt: skip


STUDY = "command"  # name of the study of one run that a command line amounts to

IN_COMMANDS = {
    "the configuration has one problem:\n  - ": "",
    "the configuration has": "the parameters have",
    **{f"studies.{STUDY}.{place}{end}": ""
       for place in ("runs[0]", "defaults") for end in (": ", ".")},
    "limits.memory": "--memory",
    "results = ": "OUTPUT's directory = ",
}  # fmt: skip
"""What the configuration calls things that are options here."""

KNOWN = 30  # names listed in a message


def given_of(values: Mapping[str, Any]) -> dict[str, Any]:
    """The options that were given."""
    return {name: value for name, value in values.items() if value is not None}


def sourced(
    file: Path | None,
    run_id: str | None,
    config: str | None,
    paper: bool,
    options: Mapping[str, Any],
    ranges: bool = False,
) -> tuple[Parameters | None, dict[str, Any]]:
    """The parameters of a run or a dataset, if one is named, and those that are given.

    With those that are given come the ones that follow from them, unless they are the paper's or
    those of the run or the dataset.
    """
    if file and run_id:
        raise ParameterError("--parameters and --run can't be combined")
    if paper and (run_id or (file and file.suffix == ".nc")):
        raise ParameterError("--paper is not allowed with a run or a dataset, which has all values")
    base, found = None, {"second_body": "rigid" if paper else "deformable"}
    if run_id:
        base, found = _of_run(config, run_id), {}
    elif file and file.suffix == ".nc":
        base, found = _of_dataset(file), {}
    elif file:
        found |= _with_second_body(_of_file(file))
    found |= _with_second_body(given_of(options))
    uncertain = [name for name, value in found.items() if isinstance(value, Range)]
    if uncertain and not ranges:
        raise ParameterError(
            f"{uncertain[0]}: a range is not allowed here, a simulation has one value of each "
            "parameter; `nucleation drop`, `length` and `specimen` take ranges"
        )
    if base is None and not paper and not uncertain:
        found |= follows_from(found)
    return base, found


def _of_run(config: str | None, run_id: str) -> Parameters:
    settings = load(config, lazy=True) if config else load(lazy=True)
    try:
        return settings.run(run_id).parameters
    except ParameterError as error:
        raise ParameterError(f"--run = {run_id!r}: {error}") from None


def _of_dataset(path: Path) -> Parameters:
    # with the libraries of arrays on disk, which takes a second
    require("solver")
    from ..analysis.record import parameters_of
    from ..datasets import netcdf

    return parameters_of(netcdf.read(path, requires=["slip_rate", "driving_force"]))


def _of_file(path: Path) -> dict[str, Any]:
    """What a YAML or JSON file gives, by names in studies: flat, or in groups."""
    content = read_yaml(path)
    if not isinstance(content, dict):
        raise ParameterError(f"{path} must hold a mapping (lines of key: value)")
    given: dict[str, Any] = {}
    try:
        for key, value in content.items():
            fields = value.items() if isinstance(value, dict) else [(key, value)]
            for field, one in fields:
                name = _name_in_file(f"{key}.{field}", str(field), one)
                if name in given:
                    raise ParameterError(f"{name} is given twice")
                given[name] = _value_in_file(name, one)
    except ParameterError as error:
        raise ParameterError(f"{path}: {error}") from None
    return given


def name_in_studies(name: str) -> str:
    """The name in studies of a parameter by any of its names."""
    return _name_in_file(name, name, "...")


def _name_in_file(full: str, field: str, value: Any) -> str:
    """The name in studies of a parameter by its full name or its field's."""
    known, declared = names(), study_parameters()
    name = full if full in known else field
    try:
        return name if name in declared else known.short(known.full(name))
    except ParameterError as error:
        hint = _similar(field, declared)
        text = f"unknown key{hint}" if hint else str(error)
        raise ParameterError(f"{field} = {value!r} is not allowed: {text}") from None


def _value_in_file(key: str, value: Any) -> Any:
    """One value of a file, in SI units; of the second body as the option has it."""
    entry = study_parameters()[key]
    if key == "second_body":
        return str(value)
    try:
        if isinstance(value, str):
            return parse_range(key, value, entry)
        check(key, value, entry)
    except ParameterError as error:
        raise ParameterError(str(error) + _of_half_space(key, str(value), entry)) from None
    return value


def _similar(name: str, known: Any) -> str:
    close = difflib.get_close_matches(name, list(known), n=1)
    listing = ", ".join([*list(known)[:KNOWN], *(["..."] if len(known) > KNOWN else [])])
    return f"; did you mean {close[0]}?" if close else f"; known: {listing}"


def _with_second_body(given: dict[str, Any]) -> dict[str, Any]:
    """The same with what ``--second-body`` stands for, by names of parameters in studies."""
    if "second_body" not in given:
        return given
    text = given["second_body"]
    if text in ("same", "deformable", "rigid"):
        return given | {"second_body": "rigid" if text == "rigid" else "deformable"}
    keys = ("second_shear_modulus", "second_poisson_ratio", "second_height")
    entries, parts = QUANTITIES, text.split(",")  # of the theory: a height may be infinite
    if not 2 <= len(parts) <= 3:
        raise ParameterError(
            f"second_body = {text!r} is not allowed: it must be same, rigid, or a shear modulus "
            f"in {bounds(entries[keys[0]])}, Poisson's ratio in {bounds(entries[keys[1]])} and "
            "perhaps a height, with commas between"
        )
    try:
        own = {k: parse(k, part, entries[k]) for k, part in zip(keys, parts, strict=False)}
    except ParameterError as error:
        raise ParameterError(
            f"second_body = {text!r} is not allowed: commas separate its values, which have a "
            f"decimal point; {error}"
        ) from None
    return given | {"second_body": "deformable", **own}


def merged(base: Parameters | None, given: dict[str, Any]) -> dict[str, Any]:
    """All values, from a base or the defaults, and those given; constants of friction set its law.

    Without a base, the block's length and the end time are left out unless they are given: they
    follow from the theory.
    """
    values = flat(merged_parameters(base, given))
    if base is None:
        for name in {"length", "end_time", "time_after_event"} - given.keys():
            del values[name]
    return values


def merged_parameters(base: Parameters | None, given: dict[str, Any]) -> Parameters:
    """The parameters of a base, or the defaults, with those given."""
    plain = {name: value for name, value in given.items() if name not in CONSTANTS}
    parameters = (base or Parameters()).replaced(plain)
    friction = with_constants(parameters.friction, parameters.loading.velocity, given)
    return dataclasses.replace(parameters, friction=friction)


def planned(values: dict[str, Any], study: dict[str, Any], **config: Any) -> Run:
    """The run that values by their names in studies stand for, checked as a configuration.

    Raises ParameterError with all that is wrong with it.
    """
    defaults = dict(values)
    runs = [{"height": defaults.pop("height")}]
    study = study | {"defaults": defaults, "runs": runs}
    try:
        settings = configure({"studies": {STUDY: study}, **config})
    except ParameterError as error:
        text = str(error)
        for words, own in IN_COMMANDS.items():
            text = text.replace(words, own)
        raise ParameterError(text) from None
    return settings.runs[0]
