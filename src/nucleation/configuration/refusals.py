"""What is wrong with the values of a configuration, in words: a line for each problem."""

import dataclasses
import difflib
import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import cache
from typing import Any

from ..model.friction.registry import EVOLUTIONS
from ..model.quantities import ParameterError, Quantity, declarations, refusal
from ..model.units import parse
from .schema import GROUPS, RESULTS, STUDY_NAME, group_entries, has_range
from .studies import StudySettings
from .study_names import (
    LARGEST_GRID,
    RANGE,
    grid_size,
    other_names,
    range_problem,
    study_parameters,
)

Place = tuple[Any, ...]
Check = Callable[[Place, Any], Iterator[str]]
"""What is wrong with a value at a place of the configuration."""


def stop_on(problems: Iterable[str]) -> None:
    """Raise one ParameterError that lists all problems, if there are any."""
    lines = list(dict.fromkeys(problems))
    if lines:
        count = "one problem" if len(lines) == 1 else f"{len(lines)} problems"
        listing = "".join(f"\n  - {line}" for line in lines)
        raise ParameterError(f"the configuration has {count}:{listing}")


def value_problems(values: Any) -> Iterator[str]:
    """Unknown keys, missing keys and values that are not allowed, in a whole configuration."""
    checks = {"results": _single(RESULTS)}
    for group in GROUPS:
        entries = group_entries(group)
        keys = {k: _several(e) if e.many else _single(e) for k, e in entries.items()}
        checks[group] = _mapping(keys)
    checks["studies"] = _studies
    yield from _mapping(checks)((), values)


def _studies(place: Place, given: Any) -> Iterator[str]:
    """What is wrong with the section ``studies``."""
    if not isinstance(given, dict):
        yield _no_mapping(place, given)
        return
    if not given:
        yield _empty(place, given)
    for name, study in given.items():
        if isinstance(name, str) and re.fullmatch(STUDY_NAME, name):
            yield from _study()((*place, name), study)
        else:
            yield (
                f"{key_text(place)}: {name!r} is not allowed as a name: it must be made of at most "
                "60 letters, digits and _, beginning with a letter"
            )


@cache
def _study() -> Check:
    """The check of one study."""
    declared, others = study_parameters(), other_names()
    single = {name: _single(entry) for name, entry in declared.items()}
    varied = {name: _several(entry) for name, entry in declared.items()}
    for checks in (single, varied):
        checks |= {other: checks[name] for other, name in others.items()}
    defaults = _mapping(single)
    entry = _mapping({**varied, "defaults": defaults}, filled=True)
    settings = {name: _single(entry) for name, entry in declarations(StudySettings).items()}
    return _mapping({**settings, "defaults": defaults, "runs": _list(entry)}, needed=["runs"])


def _mapping(
    checks: Mapping[str, Check], needed: Iterable[str] = (), filled: bool = False
) -> Check:
    """The check of a mapping whose keys have these checks."""

    def check(place: Place, given: Any) -> Iterator[str]:
        if not isinstance(given, dict):
            yield _no_mapping(place, given)
            return
        missing = [key for key in needed if key not in given]
        if missing:
            yield f"{key_text(place)} lacks the key {', '.join(missing)}"
        if filled and not given:
            yield _empty(place, given)
        yield from _unknown_keys(place, given, list(checks))
        for key, value in given.items():
            if key in checks:
                yield from checks[key]((*place, key), value)

    return check


def _list(item: Check) -> Check:
    """The check of a list whose items have this check."""

    def check(place: Place, given: Any) -> Iterator[str]:
        if not isinstance(given, list):
            yield f"{key_text(place)} = {_short(given)} must be a list"
            return
        if not given:
            yield _empty(place, given)
        for number, value in enumerate(given):
            yield from item((*place, number), value)

    return check


def _single(entry: Quantity) -> Check:
    """The check of one value."""

    def check(place: Place, value: Any) -> Iterator[str]:
        if not _allowed(value, entry):
            meant = place[0] == "studies" and "law" in place and value in list(EVOLUTIONS)
            hint = "; the evolution of the state is called evolution" if meant else ""
            yield f"{_refusal(key_text(place), value, entry)}{hint}"

    return check


def _several(entry: Quantity) -> Check:
    """The check of a value, a list of different values or a range."""
    single = _single(dataclasses.replace(entry, kind="float") if entry.many else entry)
    several = _list(single)
    ends = {"start": single, "stop": single}
    keys = ends | {name: _single(declared) for name, declared in RANGE.items()}
    spaced = _mapping(keys, needed=["start", "stop", "num"])

    def check(place: Place, value: Any) -> Iterator[str]:
        if isinstance(value, list):
            yield from several(place, value)
            if any(value[i] in value[:i] for i in range(len(value))):
                yield f"{key_text(place)} = {_short(value)} has a value twice"
        elif isinstance(value, dict) and has_range(entry):
            yield from spaced(place, value)
        else:
            yield from single(place, value)

    return check


def _allowed(value: Any, entry: Quantity) -> bool:
    """Whether a configuration may have a value, of which none is infinite."""
    if entry.worded:
        return (value is None or isinstance(value, str)) and entry.allows(value)
    return entry.allows(value) and (value is None or _is_finite(value))


def _is_finite(number: Any) -> bool:
    try:
        return math.isfinite(number)
    except OverflowError:  # of an integer beyond the largest float
        return False


def _no_mapping(place: Place, value: Any) -> str:
    return f"{key_text(place)} = {_short(value)} must be a mapping (lines of key: value)"


def _empty(place: Place, value: Any) -> str:
    return f"{key_text(place)} = {value!r} is empty: it needs at least one entry"


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
    places = [((g, k), v) for g in GROUPS for k, v in values.get(g, {}).items()]
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
