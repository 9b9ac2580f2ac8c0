"""The configuration of the workflow: read, checked as a whole, converted to settings and runs.

All problems of a configuration are reported together, each with key, value, unit and range.
"""

import dataclasses
import functools
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from nucleation.model.linearised import InterfaceState, linearised, loaded, not_rounded_from
from nucleation.model.parameters import Parameters
from nucleation.model.quantities import ParameterError
from nucleation.model.units import parse
from nucleation.strict_yaml import read_yaml

from . import schema
from .configuration import Configuration
from .contradictions import results_directory, results_problems
from .refusals import range_problems, stop_on, value_problems
from .role_problems import problems_of_studies
from .setting_problems import rounding_problems, setting_problems
from .settings import StudySettings
from .study_names import in_type

CHECKOUT = Path(__file__).parents[3]
DEFAULTS = (
    CHECKOUT / "config" / "config.yaml",
    CHECKOUT / "config" / "beyond.yaml",
)
"""The default configuration: the paper's, and the studies beyond it."""


def load(
    *paths: str | os.PathLike[str],
    lazy: bool = False,
) -> Configuration:
    """The configuration in YAML files, or the default one.

    Parameters
    ----------
    *paths : path
        Values of a file replace those of the files before it. Without a file it is the default
        configuration of the checkout.
    lazy : bool
        See :func:`configure`.

    Returns
    -------
    Configuration

    Raises
    ------
    ParameterError
        With one line for each problem found.
    """
    layers = map(read_yaml, paths)
    values = functools.reduce(_merged, layers) if paths else {}
    return configure(values, lazy=lazy)


def _merged(first: Any, later: Any) -> Any:
    """Two configurations as one, as Snakemake merges its files: later values replace earlier."""
    if not isinstance(first, dict) or not isinstance(later, dict):
        return later
    merged = {**first, **later}
    for key in first.keys() & later.keys():
        merged[key] = _merged(first[key], later[key])
    return merged


def completed(values: Any) -> Any:
    """A configuration with studies: those of the default one if it has none itself.

    Raises
    ------
    ParameterError
        If there is no default configuration, because the library is not in a checkout.
    """
    if not isinstance(values, dict):
        return values
    if "studies" in values:
        return {**values, "studies": _with_paper(values["studies"])}
    in_checkout = all(path.is_file() for path in DEFAULTS)
    if not in_checkout:
        raise ParameterError(
            "the configuration lacks the key studies: only a checkout of the project has the "
            "paper's, in config/config.yaml"
        )
    default = functools.reduce(_merged, map(read_yaml, DEFAULTS))
    if "friction" in values or "loading" in values:
        del default["main_text_interface"]  # the rounded values of the paper's own friction law
    return _merged(default, values)


def _with_paper(studies: Any) -> Any:
    """Studies, where one that has a name of the paper's and no role is that study with changes."""
    if not isinstance(studies, dict):
        return studies
    unnamed = []
    for name, section in studies.items():
        if isinstance(section, dict) and "role" not in section:
            unnamed.append(name)
    if not unnamed or not DEFAULTS[0].is_file():
        return studies
    papers = read_yaml(DEFAULTS[0])["studies"]
    return studies | {name: papers[name] | studies[name] for name in unnamed if name in papers}


def configure(
    values: Any,
    *,
    lazy: bool = False,
) -> Configuration:
    """Check a configuration and convert it to settings and runs.

    Parameters
    ----------
    values : dict
        The configuration in plain dictionaries, as read from YAML. A missing key, also
        ``studies``, has the value of the default configuration.
    lazy : bool
        Whether the runs of a study are checked only when they are first used.

    Returns
    -------
    Configuration

    Raises
    ------
    ParameterError
        With one line for each problem found.
    """
    values = completed(values)
    values = _with_numbers(values)
    stop_on(value_problems(values))
    problems = list(range_problems(values))
    problems += results_problems(results_directory(values))
    stop_on(problems)
    settings = _settings(values)
    stop_on(rounding_problems(settings))
    problems = []
    if not lazy:
        for study in settings.studies:
            problems += settings.problems_of(study)
    problems += problems_of_studies(settings.studies)
    problems += setting_problems(settings)
    stop_on(problems)
    return settings


def _settings(values: Mapping[str, Any]) -> Configuration:
    """The settings in a configuration with allowed values."""
    groups = {}
    for name in schema.GROUPS:
        section = values.get(name, {})
        try:
            groups[name] = _group(name, section)
        except ParameterError as error:  # a parameter that the chosen friction law does not have
            stop_on([str(error)])
    own = {}
    for field in dataclasses.fields(Parameters):
        if field.name in groups:
            own[field.name] = groups.pop(field.name)
    drop = groups["extraction"].drop
    base = _recording_the_drop(Parameters(**own), drop)
    main_text = groups.pop("main_text_interface")
    main_text = loaded(main_text, base.loading)
    if not values.get("main_text_interface"):
        main_text = _own_unless_rounded(main_text, base)
    studies = {}
    for name, section in values["studies"].items():
        studies[name] = StudySettings.of(section)
    return Configuration(
        results=results_directory(values),
        base=base,
        main_text_interface=main_text,
        studies=studies,
        sections=values["studies"],
        stepping=tuple(values.get("stepping", ())),
        **groups,
    )


def _recording_the_drop(base: Parameters, drop: float) -> Parameters:
    """Parameters of runs that do not end before the force has dropped by a fraction."""
    event_drop = max(base.stepping.event_drop, drop)
    stepping = dataclasses.replace(base.stepping, event_drop=event_drop)
    return dataclasses.replace(base, stepping=stepping)


def _own_unless_rounded(rounded: InterfaceState, base: Parameters) -> InterfaceState:
    """The default friction of the theory's curves.

    The paper's rounded values if they are roundings of the friction law; for any other law its own
    values.
    """
    exact = linearised(base.friction, base.loading)
    return exact if not_rounded_from(rounded, exact) else rounded


def _group(name: str, values: Mapping[str, Any]) -> Any:
    """The dataclass of a section, with numbers in their declared type."""
    cls = schema.GROUPS[name]
    entries = schema.group_entries(name)
    typed = {}
    for key, value in values.items():
        typed[key] = in_type(entries[key], value)
    return cls(**typed)


def _with_numbers(value: Any, path: tuple[object, ...] = ()) -> Any:
    """A copy of a configuration as read from YAML, with texts such as ``30 GPa`` as numbers.

    YAML reads ``30 GPa``, ``1/3`` and ``1e-8`` as text. A text that is not an allowed number is
    kept; a later check refuses it.
    """
    if isinstance(value, dict):
        return {key: _with_numbers(own, (*path, key)) for key, own in value.items()}
    if isinstance(value, list):
        return [_with_numbers(own, (*path, number)) for number, own in enumerate(value)]
    if not isinstance(value, str):
        return value
    entry = schema.entry_at(path)
    if entry is None:
        return value
    try:
        return parse("", value, entry)
    except ParameterError:
        return value
