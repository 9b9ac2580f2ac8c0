"""The parameters of a command: from options, a file, a dataset, a configuration or the paper."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click

from replication.configuration.load import load
from replication.configuration.parameter_files import read_parameters, with_second_body
from replication.configuration.study_names import other_names, study_parameters

from ..installed import require
from ..lengths.draws import Range
from ..model.own_fault import follows_from
from ..model.parameters import Parameters
from ..model.quantities import ParameterError
from ..theory.values import QUANTITIES

_SOURCES = ("file", "run_id", "config", "paper")
"""The arguments of :data:`~nucleation.commands.options.source_options`."""


def given_of(values: Mapping[str, Any]) -> dict[str, Any]:
    """The values that are given, that is, not None."""
    return {name: value for name, value in values.items() if value is not None}


def sourced(
    options: Mapping[str, Any],
    ranges: bool = False,
) -> tuple[Parameters | None, dict[str, Any]]:
    """The base and the given parameters of a command.

    Parameters
    ----------
    options : mapping
        Values of :data:`~nucleation.commands.options.source_options` and of the options for
        parameters, these by their names in studies, in SI units; None if not given.
    ranges : bool
        Whether ranges are allowed.

    Returns
    -------
    base : Parameters or None
        The parameters of the run or the dataset, if one is given.
    given : dict
        The given values by their names in studies, in SI units. Without a base and ``--paper`` they
        include the values that follow from the given ones.

    Raises
    ------
    ParameterError
        If sources contradict each other, or a parameter in a file is wrong.
    """
    file, paper = options.get("file"), options.get("paper")
    own = {name: value for name, value in options.items() if name not in _SOURCES}
    base = base_of(options)
    found: dict[str, Any] = {}
    if base is None:
        found["second_body"] = "rigid" if paper else "deformable"
        if file:
            found |= read_parameters(file, keys_of_command())
    found |= with_second_body(given_of(own))

    uncertain = [name for name, value in found.items() if isinstance(value, Range)]
    if uncertain and not ranges:
        raise ParameterError(
            f"{uncertain[0]}: a range is not allowed here, a simulation has one value of each "
            "parameter; `nucleation length` and `specimen` take ranges"
        )
    if base is None and not paper and not uncertain:
        found |= follows_from(found)
    return base, found


def base_of(options: Mapping[str, Any]) -> Parameters | None:
    """The parameters of the run or the dataset in the options, if one is given."""
    file, run_id, config, paper = (options.get(name) for name in _SOURCES)
    is_dataset = file is not None and file.suffix == ".nc"
    if file and run_id:
        raise ParameterError("--parameters and --run can't be combined")
    if paper and (run_id or is_dataset):
        raise ParameterError("--paper is not allowed with a run or a dataset, which has all values")
    if run_id:
        return _of_run(config, run_id)
    return _of_dataset(file) if file and is_dataset else None


def _of_run(config: str | None, run_id: str) -> Parameters:
    settings = load(config, lazy=True) if config else load(lazy=True)
    try:
        return settings.run(run_id).parameters
    except ParameterError as error:
        raise ParameterError(f"--run = {run_id!r}: {error}") from None


def _of_dataset(path: Path) -> Parameters:
    require("solver")
    # imported here, since the libraries take a second
    from ..datasets import netcdf
    from ..extraction.record import parameters_of

    dataset = netcdf.read(path, requires=["slip_rate", "driving_force"])
    return parameters_of(dataset)


def keys_of_command() -> list[str]:
    """The parameters among the options of the current command; all parameters without one."""
    context = click.get_current_context(silent=True)
    if context is None:
        return list(study_parameters())
    known = {*study_parameters(), *other_names(), *QUANTITIES}
    return [str(option.name) for option in context.command.params if option.name in known]
