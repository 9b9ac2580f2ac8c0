"""The configuration of the workflow: read, checked as a whole, converted to settings and runs.

All problems of a configuration are reported together, each with key, value, unit and range.
"""

import dataclasses
import os
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

from ..model.linearised import InterfaceState, linearised, loaded, not_rounded_from
from ..model.parameters import Parameters
from ..model.quantities import ParameterError
from ..model.units import parse
from . import schema
from .configuration import Configuration
from .contradictions import results_directory, results_problems
from .refusals import range_problems, stop_on, value_problems
from .role_problems import problems_of_studies
from .setting_problems import rounding_problems, setting_problems
from .settings import StudySettings
from .strict_yaml import read_yaml
from .study_names import in_type

CHECKOUT = Path(__file__).parents[3]
DEFAULTS = (
    CHECKOUT / "config" / "config.yaml",
    CHECKOUT / "config" / "beyond.yaml",
)
"""The default configuration: the paper's, and the studies beyond it."""


def load(*paths: str | os.PathLike[str], lazy: bool = False) -> Configuration:
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
    values = _merged(map(read_yaml, paths)) if paths else {}
    return configure(values, lazy=lazy)


def _merged(layers: Iterable[Any]) -> Any:
    """Configurations as one, merged as Snakemake merges its files: later values replace earlier."""
    first, *others = layers
    for other in others:
        if not isinstance(first, dict) or not isinstance(other, dict):
            first = other
            continue
        both = {}
        for key in first.keys() & other.keys():
            both[key] = _merged((first[key], other[key]))
        first = {**first, **other, **both}
    return first


def completed(values: Any) -> Any:
    """A configuration with studies: those of the default one if it has none itself.

    Raises
    ------
    ParameterError
        If there is no default configuration, because the library is not in a checkout.
    """
    if not isinstance(values, dict) or "studies" in values:
        return values
    if not all(path.is_file() for path in DEFAULTS):
        raise ParameterError(
            "the configuration lacks the key studies: only a checkout of the project has the "
            "paper's, in config/config.yaml"
        )
    default = _merged(map(read_yaml, DEFAULTS))
    if "friction" in values or "loading" in values:
        del default["main_text_interface"]  # the rounded values of the paper's own friction law
    return _merged((default, values))


def configure(values: Any, *, lazy: bool = False) -> Configuration:
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
    values = _with_numbers(completed(values))
    stop_on(value_problems(values))
    results = results_directory(values)
    stop_on([*range_problems(values), *results_problems(results)])
    try:
        groups = {name: _group(name, values.get(name, {})) for name in schema.GROUPS}
    except ParameterError as error:  # a parameter that the chosen friction law does not have
        stop_on([str(error)])
    names = [field.name for field in dataclasses.fields(Parameters)]
    own = {name: groups.pop(name) for name in names if name in groups}
    base = _recording_the_drop(Parameters(**own), groups["extraction"].drop)
    main_text = loaded(groups.pop("main_text_interface"), base.loading)
    if not values.get("main_text_interface"):
        main_text = _own_unless_rounded(main_text, base)
    sections = values["studies"]
    settings = Configuration(
        results=results,
        base=base,
        main_text_interface=main_text,
        studies={name: StudySettings.of(section) for name, section in sections.items()},
        sections=sections,
        stepping=tuple(values.get("stepping", {})),
        **groups,
    )
    stop_on(rounding_problems(settings))
    problems: list[str] = []
    if not lazy:
        for study in settings.studies:
            problems += settings.problems_of(study)
    problems += problems_of_studies(settings.studies)
    problems += setting_problems(settings)
    stop_on(problems)
    return settings


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
    entries = schema.group_entries(name)
    typed = {key: in_type(entries[key], value) for key, value in values.items()}
    return schema.GROUPS[name](**typed)


def _with_numbers(value: Any, path: tuple[Any, ...] = ()) -> Any:
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
