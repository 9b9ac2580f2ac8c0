"""Parameters of options, a file, an earlier dataset or a configuration, and their run."""

import dataclasses
import difflib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ..answers.uncertainty import Range, parse_range
from ..configuration.load import configure, load
from ..configuration.runs import Run
from ..configuration.strict_yaml import read_yaml
from ..configuration.study_names import study_parameters
from ..model.friction.constants import CONSTANTS, with_constants
from ..model.parameters import Parameters, names
from ..model.quantities import ParameterError, check
from ..model.units import bounds, parse
from ..theory.fault import QUANTITIES
from .options import flat

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
    file: Path | None, run_id: str | None, config: str, options: Mapping[str, Any],
    ranges: bool = False,
) -> tuple[Parameters | None, dict[str, Any]]:  # fmt: skip
    """The parameters of a run or a dataset, if one is named, and those that are given."""
    if file and run_id:
        raise ParameterError("--parameters and --run can't be combined")
    base, found = None, {"second_body": "deformable"}
    if run_id:
        base, found = _of_run(config, run_id), {}
    elif file and file.suffix == ".nc":
        base, found = _of_dataset(file), {}
    elif file:
        found |= _with_second_body(_of_file(file))
    found |= _with_second_body(given_of(options))
    uncertain = [name for name, value in found.items() if isinstance(value, Range)]
    if uncertain and not ranges:
        raise ParameterError(f"{uncertain[0]}: only `nucleation length` takes a range")
    return base, found


def _of_run(config: str, run_id: str) -> Parameters:
    runs = {run.id: run for run in load(config).runs}
    if run_id not in runs:
        raise ParameterError(f"--run = {run_id!r} is not in {config}{_similar(run_id, runs)}")
    return runs[run_id].parameters


def _of_dataset(path: Path) -> Parameters:
    # with the libraries of arrays on disk, which takes a second
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
    if isinstance(value, str):
        return parse_range(key, value, entry)
    check(key, value, entry)
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
    own = {k: parse(k, part, entries[k]) for k, part in zip(keys, parts, strict=False)}
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
