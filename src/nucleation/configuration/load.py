"""The configuration of the workflow: read, checked as a whole, turned into settings and runs.

All problems of a configuration are reported together, each with key, value, unit and range.
"""

import dataclasses
import os
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from ..model.linearised import InterfaceState, linearised, loaded, not_rounded_from
from ..model.parameters import Parameters
from ..model.quantities import ParameterError
from ..model.units import parse
from . import schema
from .configuration import Configuration
from .contradictions import results_directory, results_problems, rounding_problems, setting_problems
from .refusals import range_problems, stop_on, value_problems
from .roles import problems_of_studies
from .strict_yaml import read_yaml
from .studies import study_settings
from .study_names import in_type

CHECKOUT = Path(__file__).parents[3]
DEFAULTS = (CHECKOUT / "config" / "config.yaml", CHECKOUT / "config" / "beyond.yaml")
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

    Raises
    ------
    ParameterError
        With one line for each problem found.
    """
    return configure(_merged(map(read_yaml, paths)) if paths else {}, lazy=lazy)


def _merged(layers: Iterable[Any]) -> Any:
    """Configurations as one, as Snakemake merges its files: later values replace earlier ones."""
    first, *others = layers
    for other in others:
        if not isinstance(first, dict) or not isinstance(other, dict):
            first = other
            continue
        both = first.keys() & other.keys()
        first = {**first, **other, **{key: _merged((first[key], other[key])) for key in both}}
    return first


def completed(values: Any) -> Any:
    """A configuration that has studies: those of the default one if it gives none itself."""
    if not isinstance(values, dict) or "studies" in values:
        return values
    if not all(path.is_file() for path in DEFAULTS):
        raise ParameterError(
            "the configuration lacks the key studies: only a checkout of the project has the "
            "paper's, in config/config.yaml"
        )
    default = _merged(map(read_yaml, DEFAULTS))
    if {"friction", "loading"} & values.keys():
        del default["main_text_interface"]  # which rounds the paper's own friction law
    return _merged((default, values))


def configure(values: Any, *, lazy: bool = False) -> Configuration:
    """The configuration in plain dictionaries, as read from YAML.

    Parameters
    ----------
    values : dict
        The configuration. A key that it leaves out has the value of the default configuration,
        ``studies`` too.
    lazy : bool
        Whether the runs of a study are checked only once they are asked for.

    Raises
    ------
    ParameterError
        With one line for each problem found.
    """
    values = _with_numbers(completed(values))
    stop_on(value_problems(values))
    stop_on([*range_problems(values), *results_problems(results_directory(values))])
    try:
        groups = {name: _group(name, values.get(name, {})) for name in schema.GROUPS}
    except ParameterError as error:  # what the chosen friction law does not have
        stop_on([str(error)])
    own = [f.name for f in dataclasses.fields(Parameters) if f.name in groups]
    base = Parameters(**{name: groups.pop(name) for name in own})
    drop = max(base.stepping.event_drop, groups["extraction"].drop)  # is to be recorded
    base = dataclasses.replace(base, stepping=dataclasses.replace(base.stepping, event_drop=drop))
    sections = values["studies"]
    settings = Configuration(
        results=results_directory(values),
        base=base,
        main_text_interface=_main_text(values.get("main_text_interface"), groups, base),
        studies={name: study_settings(section) for name, section in sections.items()},
        sections=sections,
        stepping=tuple(values.get("stepping", {})),
        **groups,
    )
    stop_on([*rounding_problems(settings)])
    expanded = [] if lazy else settings.studies
    problems = [problem for study in expanded for problem in settings.problems_of(study)]
    problems += problems_of_studies(settings.studies)
    problems += setting_problems(settings)
    stop_on(problems)
    return settings


def _main_text(given: Any, groups: dict[str, Any], base: Parameters) -> InterfaceState:
    """The friction on which the theory's curves stand.

    Without a section of its own the paper's rounded values, if they are roundings of the friction
    law; of any other law its own values.
    """
    rounded = loaded(groups.pop("main_text_interface"), base.loading)
    exact = linearised(base.friction, base.loading)
    if not given and not_rounded_from(rounded, exact):
        return exact
    return rounded


def _group(name: str, values: dict[str, Any]) -> Any:
    """The dataclass of a section, numbers in their declared type."""
    entries = schema.group_entries(name)
    return schema.GROUPS[name](**{key: in_type(entries[key], own) for key, own in values.items()})


def _with_numbers(value: Any, path: tuple[Any, ...] = ()) -> Any:
    """A configuration as read from YAML, copied, with numbers in place of texts that are such.

    Such are ``30 GPa``, ``1/3`` and ``1e-8``, which YAML takes for text. What is no allowed number
    stays, to be refused.
    """
    if isinstance(value, dict):
        return {key: _with_numbers(own, (*path, key)) for key, own in value.items()}
    if isinstance(value, list):
        return [_with_numbers(own, (*path, number)) for number, own in enumerate(value)]
    entry = schema.entry_at(path) if isinstance(value, str) else None
    try:
        return parse("", value, entry) if entry else value
    except ParameterError:
        return value
