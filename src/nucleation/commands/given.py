"""Parameters of a simulation from a file, an earlier dataset, or a run of a configuration."""

import difflib
from pathlib import Path
from typing import Any

from ..configuration.load import load
from ..configuration.strict_yaml import read_yaml
from ..configuration.study_names import study_parameters
from ..model.parameters import Parameters, names
from ..model.quantities import ParameterError, check
from ..theory.uncertainty import parse_range

KNOWN = 30  # names listed in a message


def of_run(config: str, run_id: str) -> Parameters:
    """The parameters of a configuration's run."""
    runs = {run.id: run for run in load(config).runs}
    if run_id not in runs:
        raise ParameterError(f"--run = {run_id!r} is not in {config}{_similar(run_id, runs)}")
    return runs[run_id].parameters


def of_dataset(path: Path) -> Parameters:
    """The parameters of an earlier simulation."""
    # with the libraries of arrays on disk, which takes a second
    from ..analysis.record import parameters_of
    from ..datasets import netcdf

    return parameters_of(netcdf.read(path, requires=["slip_rate", "driving_force"]))


def of_file(path: Path) -> dict[str, Any]:
    """What a YAML or JSON file gives, by names in studies."""
    content = read_yaml(path)
    if not isinstance(content, dict):
        raise ParameterError(f"{path} must hold a mapping (lines of key: value)")
    given: dict[str, Any] = {}
    for key, value in content.items():
        grouped = isinstance(value, dict)  # as the configuration, or flat
        for field, one in value.items() if grouped else [(key, value)]:
            name = _name_in_file(path, f"{key}." if grouped else "", str(field), one)
            if name in given:
                raise ParameterError(f"{path}: {name} is given twice")
            given[name] = _file_value(path, name, one)
    return given


def _name_in_file(path: Path, group: str, field: str, value: Any) -> str:
    """The name in studies of a parameter that stands in a group of a file, or in none."""
    known, declared = names(), study_parameters()
    name = group + field if group + field in known else field
    try:
        return name if name in declared else known.short(known.full(name))
    except ParameterError as error:
        hint = _similar(field, declared)
        text = str(error) if not hint else "unknown key"
        raise ParameterError(f"{path}: {field} = {value!r} is not allowed: {text}{hint}") from None


def _file_value(path: Path, key: str, value: Any) -> Any:
    """One value of a file, in SI units."""
    if key == "second_body":
        return str(value)  # as the option
    entry = study_parameters()[key]
    try:
        if isinstance(value, str):
            return parse_range(key, value, entry)
        check(key, value, entry)
    except ParameterError as error:
        raise ParameterError(f"{path}: {error}") from None
    return value


def _similar(name: str, known: Any) -> str:
    close = difflib.get_close_matches(name, list(known), n=1)
    listing = ", ".join([*list(known)[:KNOWN], *(["..."] if len(known) > KNOWN else [])])
    return f"; did you mean {close[0]}?" if close else f"; known: {listing}"
