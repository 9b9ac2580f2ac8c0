"""The parameters of a command: from options, a file, a dataset, a configuration or the paper."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click

from ..answers.draws import Range, parse_range
from ..configuration.installed import require
from ..configuration.load import load
from ..configuration.strict_yaml import read_yaml
from ..configuration.study_names import study_parameters
from ..model.own_fault import follows_from
from ..model.parameters import Parameters, names
from ..model.quantities import ParameterError, check
from ..model.synonyms import hint
from ..model.units import bounds, parse
from ..theory.fault import QUANTITIES
from .options import means_half_space
from .unit_text import note_typed

_SECOND_BODY = ("second_shear_modulus", "second_poisson_ratio", "second_height")
"""The parameters in ``--second-body``, in their order."""


def given_of(values: Mapping[str, Any]) -> dict[str, Any]:
    """The values that are given, that is, not None."""
    return {name: value for name, value in values.items() if value is not None}


def sourced(
    file: Path | None,
    run_id: str | None,
    config: str | None,
    paper: bool,
    options: Mapping[str, Any],
    ranges: bool = False,
) -> tuple[Parameters | None, dict[str, Any]]:
    """The base and the given parameters of a command.

    Parameters
    ----------
    file : Path or None
        YAML or JSON file of parameters, or the dataset of a simulation.
    run_id, config : str or None
        A run of a configuration and the path of the configuration.
    paper : bool
        Whether parameters that are not given are the paper's.
    options : mapping
        Values of the options by their names in studies, in SI units; None if not given.
    ranges : bool
        Whether ranges are allowed.

    Returns
    -------
    base : Parameters or None
        The parameters of the run or the dataset, if one is given.
    given : dict
        The given values by their names in studies, in SI units. Without a base and `paper` they
        include the values that follow from the given ones.

    Raises
    ------
    ParameterError
        If sources contradict each other, or a parameter in a file is wrong.
    """
    is_dataset = file is not None and file.suffix == ".nc"
    if file and run_id:
        raise ParameterError("--parameters and --run can't be combined")
    if paper and (run_id or is_dataset):
        raise ParameterError("--paper is not allowed with a run or a dataset, which has all values")

    base = None
    found: dict[str, Any] = {}
    if run_id:
        base = _of_run(config, run_id)
    elif file and is_dataset:
        base = _of_dataset(file)
    else:
        found["second_body"] = "rigid" if paper else "deformable"
        if file:
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
    require("solver")
    # imported here, since the libraries take a second
    from ..analysis.record import parameters_of
    from ..datasets import netcdf

    dataset = netcdf.read(path, requires=["slip_rate", "driving_force"])
    return parameters_of(dataset)


def _of_file(path: Path) -> dict[str, Any]:
    """The values in a YAML or JSON file, flat or in groups, by their names in studies."""
    content = read_yaml(path)
    if not isinstance(content, dict):
        raise ParameterError(f"{path} must hold a mapping (lines of key: value)")
    given: dict[str, Any] = {}
    try:
        for full, field, value in _entries(content):
            name = _name_in_file(full, field, value)
            if name in given:
                raise ParameterError(f"{name} is given twice")
            given[name] = _value_in_file(name, value)
    except ParameterError as error:
        raise ParameterError(f"{path}: {error}") from None
    return given


def _entries(content: Mapping[Any, Any]) -> list[tuple[str, str, Any]]:
    """Full name, last part of the name, and value of each entry of a file."""
    entries = []
    for key, value in content.items():
        if not isinstance(value, dict):
            entries.append((str(key), str(key), value))
            continue
        for field, own in value.items():
            entries.append((f"{key}.{field}", str(field), own))
    return entries


def name_in_studies(name: str) -> str:
    """The name in studies of a parameter, from any of its names.

    Raises
    ------
    ParameterError
        If no parameter has the name.
    """
    return _name_in_file(name, name, "...")


def _name_in_file(full: str, field: str, value: Any) -> str:
    """The name in studies of a parameter, from its full name or the last part of it."""
    known = names()
    declared = study_parameters()
    name = full if full in known else field
    if name in declared:
        return name
    try:
        return known.short(known.full(name))
    except ParameterError:
        own = _keys_of_command()
        suggestion = hint(field, own) or hint(field, declared) or f"known: {', '.join(own)}"
        raise ParameterError(
            f"{field} = {value!r} is not allowed: unknown key; {suggestion}"
        ) from None


def _keys_of_command() -> list[str]:
    """The parameters among the options of the current command; all parameters without one."""
    context = click.get_current_context(silent=True)
    declared = study_parameters()
    if context is None:
        return list(declared)
    options = [str(option.name) for option in context.command.params]
    return [name for name in options if name in declared or _is_parameter(name)]


def _is_parameter(name: str) -> bool:
    try:
        names().full(name)
    except ParameterError:
        return False
    return True


def _value_in_file(key: str, value: Any) -> Any:
    """One value of a file in SI units; the second body is a text, as in its option."""
    if key == "second_body":
        return str(value)
    if means_half_space(key, value):
        return math.inf
    entry = study_parameters()[key]
    if not isinstance(value, str):
        check(key, value, entry)
        return value
    found = parse_range(key, value, entry)
    if isinstance(found, float):
        note_typed(found, value, entry.unit)
    return found


def _with_second_body(given: dict[str, Any]) -> dict[str, Any]:
    """The values with ``second_body`` replaced by the parameters of the second body."""
    if "second_body" not in given:
        return given
    text = given["second_body"]
    if text == "rigid":
        return given
    if text in ("same", "deformable"):
        return given | {"second_body": "deformable"}
    parts = text.split(",")
    if not 2 <= len(parts) <= 3:
        modulus, ratio, _ = (bounds(QUANTITIES[key]) for key in _SECOND_BODY)
        raise ParameterError(
            f"second_body = {text!r} is not allowed: it must be same, rigid, or a shear modulus "
            f"in {modulus}, Poisson's ratio in {ratio} and perhaps a height, with commas between"
        )
    own: dict[str, Any] = {"second_body": "deformable"}
    try:
        for key, part in zip(_SECOND_BODY, parts, strict=False):
            own[key] = parse(key, part, QUANTITIES[key])  # of the theory: a height may be infinite
            note_typed(own[key], part, QUANTITIES[key].unit)
    except ParameterError as error:
        raise ParameterError(
            f"second_body = {text!r} is not allowed: commas separate its values, which have a "
            f"decimal point; {error}"
        ) from None
    return given | own
