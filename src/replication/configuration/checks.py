"""Problems with the values of a configuration, one line for each."""

import math
import re
from collections.abc import Callable, Collection, Iterable, Iterator, Mapping
from functools import cache, partial
from typing import Any, cast

from nucleation.model.friction import EVOLUTIONS
from nucleation.model.hints import hint
from nucleation.model.quantities import ParameterError, Quantity, declarations, refusal
from nucleation.model.units import parse
from nucleation.run.names import parameters

from .names import LARGEST_GRID, RANGE, SECTIONS, grid_size, range_problem
from .settings import GROUPS, StudySettings

_Place = tuple[object, ...]
"""Keys and numbers of items from the top of the configuration to a value."""

_Check = Callable[[_Place, object], Iterator[str]]
"""A function that yields the problems with a value at a place of the configuration."""

_Problems = Iterator[str]
"""Messages, one for each problem."""

_RESULTS = Quantity("directory of all results", kind="str")

_STUDY_NAME = "[A-Za-z][A-Za-z0-9_]{0,59}"
"""Pattern of the names of studies."""

_LONGEST_QUOTE = 80
"""Characters of a value in a message; longer values are cut."""


def stop_on(problems: Iterable[str]) -> None:
    """Raise one ParameterError that lists all problems, if there are any."""
    lines = list(dict.fromkeys(problems))
    if lines:
        count = "one problem" if len(lines) == 1 else f"{len(lines)} problems"
        listing = "".join(f"\n  - {line}" for line in lines)
        raise ParameterError(f"the configuration has {count}:{listing}")


def entries_of(section: str) -> dict[str, Quantity]:
    """The keys of a section of a configuration and their declarations."""
    if section in GROUPS:
        return declarations(GROUPS[section])
    return {name: parameters()[name] for name in SECTIONS[section]}


def with_numbers(values: Any) -> Any:
    """A copy of a configuration as read from YAML, with texts such as ``30 GPa`` as numbers.

    YAML reads ``30 GPa``, ``1/3`` and ``1e-8`` as text. A text that is not an allowed number is
    kept; a later check refuses it.
    """
    if not isinstance(values, dict):
        return values
    found = {}
    for section, content in values.items():
        if section in GROUPS or section in SECTIONS:
            content = _read(content, entries_of(section))
        elif section == "studies":
            content = _read(content, {**parameters(), **declarations(StudySettings)})
        found[section] = content
    return found


def _read(value: Any, entries: Mapping[str, Quantity], entry: Quantity | None = None) -> Any:
    """A value with its texts as numbers; `entry` is the declaration of its key, if it has one."""
    if isinstance(value, dict):
        found = {}
        for key, own in value.items():
            known = RANGE.get(key) if entry else None
            found[key] = _read(
                own,
                entries,
                known or entries.get(key) or entry,
            )
        return found
    if isinstance(value, list):
        return [_read(own, entries, entry) for own in value]
    if not isinstance(value, str) or entry is None:
        return value
    try:
        return parse("", value, entry.element)
    except ParameterError:
        return value


def value_problems(values: object) -> _Problems:
    """Unknown keys, missing keys and values that are not allowed, in a whole configuration."""
    checks: dict[str, _Check] = {"results": partial(_single, _RESULTS)}
    for section in (*SECTIONS, *GROUPS):
        keys: dict[str, _Check] = {}
        for key, entry in entries_of(section).items():
            check = _several if entry.many else _single
            keys[key] = partial(check, entry)
        checks[section] = partial(_mapping, keys)
    checks["studies"] = _studies
    yield from _mapping(checks, (), values)


def _studies(place: _Place, given: object) -> _Problems:
    """Problems with the section ``studies``."""
    if not isinstance(given, dict):
        yield _no_mapping(place, given)
        return
    if not given:
        yield _empty(place, given)
    for name, study in given.items():
        if isinstance(name, str) and re.fullmatch(_STUDY_NAME, name):
            check = _check_of_study()
            yield from check((*place, name), study)
        else:
            yield (
                f"{_key_text(place)}: {name!r} is not allowed as a name: it must be made of at "
                "most 60 letters, digits and _, beginning with a letter"
            )


@cache
def _check_of_study() -> _Check:
    """The check of one study."""
    single: dict[str, _Check] = {}
    varied: dict[str, _Check] = {}
    for name, entry in parameters().items():
        single[name] = partial(_single, entry)
        varied[name] = partial(_several, entry)
    defaults = partial(_mapping, single)
    varied["defaults"] = defaults
    entry_of_runs = partial(_mapping, varied, filled=True)

    keys: dict[str, _Check] = {}
    for name, entry in declarations(StudySettings).items():
        keys[name] = partial(_single, entry)
    keys["defaults"] = defaults
    keys["runs"] = partial(_list, entry_of_runs)
    return partial(_mapping, keys, needed=["runs"])


def _mapping(
    checks: Mapping[str, _Check],
    place: _Place,
    given: object,
    *,
    needed: Iterable[str] = (),
    filled: bool = False,
) -> _Problems:
    """Problems with a mapping; `checks` are those of its keys."""
    if not isinstance(given, dict):
        yield _no_mapping(place, given)
        return
    missing = [key for key in needed if key not in given]
    if missing:
        yield f"{_key_text(place)} lacks the key {', '.join(missing)}"
    if filled and not given:
        yield _empty(place, given)
    for key in given:
        if key not in checks:
            yield _unknown_key((*place, key), given[key], checks)
    for key, value in given.items():
        if key in checks:
            check = checks[key]
            yield from check((*place, key), value)


def _list(
    check: _Check,
    place: _Place,
    given: object,
) -> _Problems:
    """Problems with a list; `check` is that of its items."""
    if not isinstance(given, list):
        yield f"{_key_text(place)} = {_quoted(given)} must be a list"
        return
    if not given:
        yield _empty(place, given)
    for number, value in enumerate(given):
        yield from check((*place, number), value)


def _single(
    entry: Quantity,
    place: _Place,
    value: object,
) -> _Problems:
    """Problems with one value."""
    if _allowed(value, entry):
        return
    text = _refusal(_key_text(place), value, entry)
    if place[-1] == "friction_law" and value in list(EVOLUTIONS):
        text += "; the evolution of the state is called evolution"
    yield text


def _several(
    entry: Quantity,
    place: _Place,
    value: object,
) -> _Problems:
    """Problems with a value, a list of different values or a range."""
    check = partial(_single, entry.element)
    if isinstance(value, list):
        yield from _list(check, place, value)
        if _has_repeats(value):
            yield f"{_key_text(place)} = {_quoted(value)} has a value twice"
    elif isinstance(value, dict) and not entry.choices and entry.kind != "int":
        ends = ("start", "stop")
        keys: dict[str, _Check] = dict.fromkeys(ends, check)
        for name, declared in RANGE.items():
            keys[name] = partial(_single, declared)
        yield from _mapping(keys, place, value, needed=[*ends, "num"])
    else:
        yield from check(place, value)


def _has_repeats(values: list[object]) -> bool:
    """Whether a list, possibly of lists and mappings, has a value twice."""
    seen: list[object] = []
    for value in values:
        if value in seen:
            return True
        seen.append(value)
    return False


def _allowed(value: object, entry: Quantity) -> bool:
    """Whether a configuration may have a value; no value may be infinite."""
    if not entry.allows(value):
        return False
    if value is None:
        return True
    if entry.worded:
        return isinstance(value, str)
    try:
        return math.isfinite(cast(float, value))
    except OverflowError:  # an integer beyond the largest float
        return False


def _refusal(key: str, value: object, entry: Quantity) -> str:
    """The reason why a value or its unit is not allowed."""
    try:
        if isinstance(value, str):
            parse(key, value, entry)
    except ParameterError as error:
        return str(error)
    return refusal(key, value, entry)


def _no_mapping(place: _Place, value: object) -> str:
    return f"{_key_text(place)} = {_quoted(value)} must be a mapping (lines of key: value)"


def _empty(place: _Place, value: object) -> str:
    return f"{_key_text(place)} = {value!r} is empty: it needs at least one entry"


def _unknown_key(
    place: _Place,
    value: object,
    known: Collection[str],
) -> str:
    key = str(place[-1])
    suggestion = hint(key, known)
    if not suggestion:
        suggestion = f"known keys: {', '.join(known)}"
    return f"{_key_text(place)} = {_quoted(value)} is not allowed: unknown key; {suggestion}"


def _key_text(place: _Place) -> str:
    """A place in the configuration as text, ``studies.paper.runs[0].height``."""
    text = ""
    for part in place:
        text += f"[{part}]" if isinstance(part, int) else f".{part}"
    return text.lstrip(".") or "the configuration"


def _quoted(value: object) -> str:
    text = repr(value)
    if len(text) <= _LONGEST_QUOTE:
        return text
    return f"{text[: _LONGEST_QUOTE - 4]} ..."


def range_problems(values: Mapping[str, Any]) -> _Problems:
    """Ranges that can't be expanded, and entries of studies with too many simulations."""
    for group in GROUPS:
        yield from _ranges_in((group,), values.get(group, {}))
    for name, study in values["studies"].items():
        for number, entry in enumerate(study["runs"]):
            place = ("studies", name, "runs", number)
            size = grid_size(entry)
            if size > LARGEST_GRID:
                yield f"{_key_text(place)} has {size} simulations, more than {LARGEST_GRID}"
            yield from _ranges_in(place, entry)


def _ranges_in(
    place: _Place,
    section: Mapping[str, Any],
) -> _Problems:
    for key, value in section.items():
        if key == "defaults":  # single values, no ranges
            continue
        problem = range_problem(value)
        if problem:
            yield f"{_key_text((*place, key))}: {problem}"
