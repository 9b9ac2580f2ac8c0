"""What is wrong with the values of a configuration, in words: a line for each problem."""

import difflib
import numbers
import sys
from collections.abc import Iterable, Iterator
from typing import Any

import jsonschema
from jsonschema.exceptions import ValidationError

from ..model.friction.registry import EVOLUTIONS
from ..model.quantities import ParameterError, Quantity, refusal
from ..model.units import parse
from . import schema
from .study_names import LARGEST_GRID, grid_size, range_problem


def stop_on(problems: Iterable[str]) -> None:
    """Raise one ParameterError that lists all problems, if there are any."""
    lines = list(dict.fromkeys(problems))
    if lines:
        count = "one problem" if len(lines) == 1 else f"{len(lines)} problems"
        listing = "".join(f"\n  - {line}" for line in lines)
        raise ParameterError(f"the configuration has {count}:{listing}")


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


def schema_problems(values: Any) -> Iterator[str]:
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


def range_problems(values: dict[str, Any]) -> Iterator[str]:
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
