"""The configuration of the workflow: read, checked as a whole, turned into settings and runs.

All problems of a configuration are reported together, each with key, value, unit and range.
"""

import dataclasses
import difflib
import numbers
import os
import sys
from collections.abc import Iterable, Iterator
from typing import Any

import jsonschema
from jsonschema.exceptions import ValidationError

from ..analysis.definitions import ExtractionSettings
from ..configuration import schema
from ..model.friction.registry import EVOLUTIONS
from ..model.linearised import InterfaceState, loaded
from ..model.parameters import Parameters
from ..model.quantities import ParameterError, Quantity, refusal
from ..model.units import parse
from ..theory.settings import Curves
from ..verification.crosscheck.plan import CrosscheckSettings
from .contradictions import results_directory, results_problems, run_problems, setting_problems
from .roles import role_problems, shown
from .runs import Run
from .settings import FigureSettings, Limits
from .strict_yaml import read_yaml
from .studies import StudySettings, study_runs, study_settings
from .study_names import LARGEST_GRID, grid_size, in_type, range_problem


@dataclasses.dataclass(frozen=True)
class Configuration:
    """Everything the workflow does, checked."""

    results: str
    base: Parameters
    main_text_interface: InterfaceState
    curves: Curves
    extraction: ExtractionSettings
    figures: FigureSettings
    limits: Limits
    crosscheck: CrosscheckSettings
    studies: dict[str, StudySettings]
    runs: tuple[Run, ...]

    def runs_of(self, study: str) -> list[Run]:
        """The runs of one study, none if there is no such study."""
        return [run for run in self.runs if run.study == study]

    def studies_for(self, *roles: str) -> list[str]:
        """The names of the studies with some roles, in the configuration's order."""
        return [name for name, study in self.studies.items() if study.role in roles]

    def runs_for(self, *roles: str) -> list[Run]:
        """The runs of the studies with some roles."""
        return [run for run in self.runs if run.role in roles]

    def shown(self, height: float) -> Run:
        """The run with the role ``paper`` of a height (m) that figures show.

        Raises
        ------
        ParameterError
            If there is none.
        """
        run = shown(self.runs_for("paper"), height, self.base)
        if run is None:
            raise ParameterError(f"no study with role: paper has a run with height {height:g} m")
        return run


def load(path: str | os.PathLike[str]) -> Configuration:
    """The configuration in a YAML file; raises ParameterError with all its problems."""
    return configure(read_yaml(path))


def configure(values: Any) -> Configuration:
    """The configuration in plain dictionaries, as read from YAML.

    Raises
    ------
    ParameterError
        With one line for each problem found.
    """
    values = _with_numbers(values)
    _stop_on(_schema_problems(values))
    _stop_on([*_range_problems(values), *results_problems(results_directory(values))])
    try:
        groups = {name: _group(name, values.get(name, {})) for name in schema.GROUPS}
    except ParameterError as error:  # what the chosen friction law does not have
        _stop_on([str(error)])
    own = [f.name for f in dataclasses.fields(Parameters) if f.name in groups]
    base = Parameters(**{name: groups.pop(name) for name in own})
    drop = max(base.stepping.event_drop, groups["extraction"].drop)  # is to be recorded
    base = dataclasses.replace(base, stepping=dataclasses.replace(base.stepping, event_drop=drop))
    interface = loaded(groups.pop("main_text_interface"), base.loading)
    found: list[tuple[str, Run | str]] = []
    for name, study in values["studies"].items():
        found.extend(study_runs(name, study, base, interface, values.get("stepping", {})))
    settings = {k: v for k, v in groups.items() if k != "figures"}
    of_runs = _run_problems(found, groups["limits"], groups["extraction"])
    _stop_on([*of_runs, *setting_problems(base, interface, **settings)])
    runs = tuple(run for _, run in found if isinstance(run, Run))
    studies = {name: study_settings(study) for name, study in values["studies"].items()}
    _stop_on(role_problems(studies, runs, groups["figures"], base))
    results = results_directory(values)
    return Configuration(results, base, interface, studies=studies, runs=runs, **groups)


def _stop_on(problems: Iterable[str]) -> None:
    """Raise one ParameterError that lists all problems, if there are any."""
    lines = list(dict.fromkeys(problems))
    if lines:
        count = "one problem" if len(lines) == 1 else f"{len(lines)} problems"
        listing = "".join(f"\n  - {line}" for line in lines)
        raise ParameterError(f"the configuration has {count}:{listing}")


def _group(name: str, values: dict[str, Any]) -> Any:
    """The dataclass of a section, numbers in their declared type."""
    entries = schema.group_entries(name)
    return schema.GROUPS[name](**{key: in_type(entries[key], own) for key, own in values.items()})


def _is_finite(_: Any, value: Any) -> bool:
    if not isinstance(value, numbers.Real) or isinstance(value, bool):
        return False
    return abs(value) <= sys.float_info.max  # type: ignore[operator]  # also of integers beyond the largest float; not NaN


_Validator = jsonschema.validators.extend(
    jsonschema.Draft202012Validator,
    type_checker=jsonschema.Draft202012Validator.TYPE_CHECKER.redefine_many(
        {
            "integer": lambda _, v: isinstance(v, numbers.Integral) and not isinstance(v, bool),
            "number": _is_finite,
        }
    ),
)


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


def _schema_problems(values: Any) -> Iterator[str]:
    """What is wrong with the configuration against the schema."""
    for error in _Validator(schema.build()).iter_errors(values):
        for cause in _causes(error):
            yield from _messages(cause)


def _causes(error: ValidationError) -> list[ValidationError]:
    """The errors behind one of several forms: those of the form that the value has."""
    if error.validator != "anyOf":
        return [error]
    forms = {list: "array", dict: "object"}
    wanted = forms.get(type(error.instance))  # type: ignore[call-overload]
    kinds = [branch.get("type") for branch in error.validator_value]
    chosen = kinds.index(wanted) if wanted in kinds else 0
    return [cause for cause in error.context if cause.relative_schema_path[0] == chosen]


def _messages(error: ValidationError) -> Iterator[str]:
    """One schema error in words."""
    path = tuple(error.absolute_path)
    key = key_text(path)
    entry = schema.entry_at(path)
    leaf = "unit" in error.schema
    if error.validator == "additionalProperties":
        yield from _unknown_keys(path, error.instance, list(error.schema["properties"]))
    elif error.validator == "required":
        missing = [k for k in error.validator_value if k not in error.instance]
        yield f"{key} lacks the key {', '.join(missing)}"
    elif error.validator in ("minItems", "minProperties"):
        yield f"{key} = {error.instance!r} is empty: it needs at least one entry"
    elif error.validator == "uniqueItems":
        yield f"{key} = {_short(error.instance)} has a value twice"
    elif "propertyNames" in error.absolute_schema_path:
        yield (
            f"{key}: {error.instance!r} is not allowed as a name: it must be made of at most 60 "
            "letters, digits and _, beginning with a letter"
        )
    elif leaf and entry is not None:
        meant = path[:1] == ("studies",) and "law" in path and error.instance in EVOLUTIONS
        hint = "; the evolution of the state is called evolution" if meant else ""
        yield f"{_refusal(key, error.instance, entry)}{hint}"
    else:
        form = {"object": "a mapping (lines of key: value)", "array": "a list"}
        yield f"{key} = {_short(error.instance)} must be {form[error.validator_value]}"


def _refusal(key: str, value: Any, entry: Quantity) -> str:
    """Why a value is not allowed, be it of its unit."""
    try:
        if isinstance(value, str):
            parse(key, value, entry)
    except ParameterError as error:
        return str(error)
    return refusal(key, value, entry)


def _unknown_keys(path: tuple[Any, ...], given: dict[Any, Any], known: list[str]) -> Iterator[str]:
    in_study = path[:1] == ("studies",)
    for name in given:
        if name in known:
            continue
        value = _short(given[name])
        place = f"{key_text((*path, name))} = {value} is not allowed"
        close = difflib.get_close_matches(str(name), known, n=1)
        listed = [key for key in known if "." not in key] if in_study else known
        hint = f"did you mean {close[0]}?" if close else f"known keys: {', '.join(listed)}"
        yield f"{place}: unknown key; {hint}"


def key_text(path: tuple[Any, ...]) -> str:
    """A place in the configuration as text, ``studies.paper.runs[0].height``."""
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path)
    return text.lstrip(".") or "the configuration"


def _short(value: Any) -> str:
    text = repr(value)
    return text if len(text) <= 80 else f"{text[:76]} ..."


def _range_problems(values: dict[str, Any]) -> Iterator[str]:
    """Ranges that can't be expanded, wherever they stand, and grids that are far too large."""
    places = [((g, k), v) for g in schema.GROUPS for k, v in values.get(g, {}).items()]
    for name, study in values["studies"].items():
        for number, entry in enumerate(study["runs"]):
            path = ("studies", name, "runs", number)
            varied = [(k, v) for k, v in entry.items() if k != "defaults"]
            places += [((*path, k), v) for k, v in varied]  # type: ignore[misc]
            size = grid_size(entry)
            if size > LARGEST_GRID:
                yield f"{key_text(path)} stands for {size} simulations, more than {LARGEST_GRID}"
    for path, value in places:  # type: ignore[assignment]
        problem = range_problem(value)
        if problem:
            yield f"{key_text(path)}: {problem}"


def _run_problems(
    found: list[tuple[str, Run | str]], limits: Limits, extraction: ExtractionSettings
) -> Iterator[str]:
    """Runs that can't be made, stand twice or contradict themselves."""
    seen: dict[Any, str] = {}
    for key, run in found:
        if isinstance(run, str):
            yield f"{key}: {run}"
            continue
        for mark in (run.id, (run.study, run.parameters)):
            if mark in seen:
                yield f"{key} gives the simulation {run.id} again, after {seen[mark]}"
            seen[mark] = key
        yield from run_problems(key, run, limits, extraction)


if __name__ == "__main__":  # python -m nucleation.configuration.load > config/schema.yaml
    print(schema.text(), end="")
