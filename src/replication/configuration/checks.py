"""From the YAML of a configuration to values in their declared types, and all of its problems."""

import math
import os
import re
import sys
from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np

from nucleation.fault import Fault
from nucleation.fault.flat import read_parameters, read_values
from nucleation.fault.parameters import in_type, parameters
from nucleation.model.friction import EVOLUTIONS
from nucleation.model.hints import hint
from nucleation.model.quantities import ParameterError, Quantity, declarations
from nucleation.model.settings import STUCK_BELOW
from nucleation.model.units import in_si
from nucleation.run.checks import contradictions, memory_problem
from nucleation.run.sizing import starting_values

from .roles import LITERATURE, OWN, WEAKENING_PATCHES
from .runs import StudyRun
from .settings import GROUPS, RANGE, SECTIONS, Settings, StudySettings, entries_of

_Read = Callable[[str, Any], Any]
"""A function that reads a value at a place of the configuration."""

PAPERS_FAULT = "paper"
"""The fault of the paper, from which a study starts if it names none."""

_RESULTS = Quantity("directory of all results", kind="str")

_STUDY_NAME = "[A-Za-z][A-Za-z0-9_]{0,59}"
"""Pattern of the names of studies."""

_LARGEST_GRID = 10000
"""Most simulations of one entry of a study."""

_LONGEST_QUOTE = 80
"""Characters of a value in a message; longer values are cut."""

_LONGEST_ID = 200
"""Most characters of an identifier; a file's name adds suffixes, and has at most 255 bytes."""

_CODE = ("src", "workflow", "profiles", "config", "docs", "tests")
"""Directories of the checkout that can't be the directory of results."""


def stop_on(problems: Iterable[str]) -> None:
    """Raise one ParameterError that lists all problems, if there are any."""
    lines = list(dict.fromkeys(problems))
    if lines:
        count = "one problem" if len(lines) == 1 else f"{len(lines)} problems"
        listing = "".join(f"\n  - {line}" for line in lines)
        raise ParameterError(f"the configuration has {count}:{listing}")


class Reader:
    """Reads a configuration, and collects its problems, each with key, value, unit and range.

    YAML reads ``30 GPa``, ``1/3`` and ``1e-8`` as text; they are read as numbers here.
    """

    def __init__(self) -> None:
        self.problems: list[str] = []

    def configuration(self, values: Any) -> dict[str, Any]:
        """A whole configuration; its values count only if there is no problem."""
        keys: dict[str, _Read] = {"results": partial(self.single, _RESULTS)}
        for section in (*SECTIONS, *GROUPS):
            keys[section] = partial(self.mapping, self.declared(entries_of(section)))
        keys["studies"] = self.studies
        return self.mapping(keys, "", values)

    def studies(self, place: str, given: Any) -> dict[str, Any]:
        """The section ``studies``."""
        several: dict[str, _Read] = {}
        for name, entry in parameters().items():
            several[name] = partial(self.several, entry)
        several["defaults"] = partial(self.mapping, self.declared(parameters()))
        keys = self.declared(declarations(StudySettings))
        keys["defaults"] = several["defaults"]
        keys["fault"] = self.fault
        keys["runs"] = partial(self.listed, partial(self.entry, several))
        names = list(given) if isinstance(given, dict) else []
        for name in names:
            if not (isinstance(name, str) and re.fullmatch(_STUDY_NAME, name)):
                self.problems.append(
                    f"{place}: {name!r} is not allowed as a name: it must be made of at "
                    "most 60 letters, digits and _, beginning with a letter"
                )
        read = partial(self.mapping, keys, needed=["runs"])
        return self.mapping(dict.fromkeys(names, read), place, given, filled=True)

    def fault(self, place: str, given: Any) -> dict[str, Any]:
        """The parameters of runs that start from a fault: the paper's, of a file, or a mapping.

        What a file or a mapping leaves out has the meaning of ``Fault.from_file``.
        """
        if given == PAPERS_FAULT:
            return {}
        try:
            if isinstance(given, str):
                values = read_parameters(given)
            elif isinstance(given, dict):
                values = read_values(given)
            else:
                raise ParameterError(
                    f"it must be {PAPERS_FAULT}, a file or a mapping of a fault's parameters"
                )
            return starting_values(Fault.from_dict(values))
        except ParameterError as error:
            self.problems.append(f"{place}: {error}")
            return {}

    def declared(self, entries: Mapping[str, Quantity]) -> dict[str, _Read]:
        """Functions that read declared values: one value of each name, or a tuple."""
        return {
            name: partial(self.several if entry.many else self.single, entry)
            for name, entry in entries.items()
        }

    def entry(self, keys: Mapping[str, _Read], place: str, given: Any) -> dict[str, Any]:
        """An entry of a study's runs, with all values of each parameter."""
        found = self.mapping(keys, place, given, filled=True)
        size = math.prod(len(own) for key, own in found.items() if key != "defaults")
        if size > _LARGEST_GRID:
            self.problems.append(f"{place} has {size} simulations, more than {_LARGEST_GRID}")
        return found

    def mapping(
        self,
        keys: Mapping[str, _Read],
        place: str,
        given: Any,
        *,
        needed: Iterable[str] = (),
        filled: bool = False,
    ) -> dict[str, Any]:
        """A mapping; `keys` read the values of its keys."""
        if not isinstance(given, dict):
            of = place or "the configuration"
            rule = "must be a mapping (lines of key: value)"
            self.problems.append(f"{of} = {_quoted(given)} {rule}")
            return {}
        missing = [key for key in needed if key not in given]
        if missing:
            self.problems.append(f"{place} lacks the key {', '.join(missing)}")
        if filled and not given:
            self.problems.append(f"{place} = {given!r} is empty: it needs at least one entry")
        found = {}
        for key, value in given.items():
            below = f"[{key}]" if isinstance(key, int) else f".{key}"
            inner = (place + below).lstrip(".")
            if key in keys:
                found[key] = keys[key](inner, value)
                continue
            suggestion = hint(str(key), keys) or f"known keys: {', '.join(keys)}"
            refused = f"{inner} = {_quoted(value)} is not allowed: unknown key"
            self.problems.append(f"{refused}; {suggestion}")
        return found

    def listed(self, read: _Read, place: str, given: Any) -> list[Any]:
        """A list; `read` reads its items."""
        if not isinstance(given, list):
            self.problems.append(f"{place} = {_quoted(given)} must be a list")
            return []
        if not given:
            self.problems.append(f"{place} = {given!r} is empty: it needs at least one entry")
        return [read(f"{place}[{number}]", value) for number, value in enumerate(given)]

    def single(self, entry: Quantity, place: str, value: Any) -> Any:
        """One value in its declared type; no number may be infinite."""
        try:
            value = in_si(place, value, entry)
            if not (value is None or entry.worded or abs(value) <= sys.float_info.max):
                raise ParameterError(
                    f"{place} = {value!r}{entry.unit_suffix} is not allowed: a simulation needs a "
                    "finite number; blocks 4 L_c high are as half-spaces"
                )
        except ParameterError as error:
            is_evolution = place.endswith("friction_law") and value in list(EVOLUTIONS)
            advice = "; the evolution of the state is called evolution" if is_evolution else ""
            self.problems.append(f"{error}{advice}")
            return value
        return in_type(entry, value)

    def several(self, entry: Quantity, place: str, value: Any) -> tuple[Any, ...]:
        """The values of a value, of a list of different values or of a range, in their order.

        Values of a range are rounded to six significant digits, so that identifiers have them
        exactly.
        """
        read = partial(self.single, entry.element)
        before = len(self.problems)
        if isinstance(value, list):
            values = self.listed(read, place, value)
            if len(self.problems) == before and len(set(values)) < len(values):
                self.problems.append(f"{place} = {_quoted(value)} has a value twice")
            return tuple(values)
        if not isinstance(value, dict) or entry.choices or entry.kind == "int":
            return (read(place, value),)
        keys: dict[str, _Read] = dict.fromkeys(("start", "stop"), read)
        keys |= self.declared(RANGE)
        given = self.mapping(keys, place, value, needed=("start", "stop", "num"))
        if len(self.problems) > before:
            return ()
        start, stop, number = given["start"], given["stop"], given["num"]
        logarithmic = given.get("scale") == "log"
        if not start < stop:
            problem = f"start {start!r} must be less than stop {stop!r}"
        elif logarithmic and not start > 0.0:
            problem = f"start {start!r} must be positive on a log scale"
        else:
            spaced = (np.geomspace if logarithmic else np.linspace)(start, stop, number)
            values = [float(f"{x:.6g}") for x in spaced]
            if len(set(values)) == number:
                return tuple(values)
            problem = f"its {number} values from {start!r} on are not all different"
        self.problems.append(f"{place}: {problem}")
        return ()


def _quoted(value: object) -> str:
    text = repr(value)
    return text if len(text) <= _LONGEST_QUOTE else f"{text[: _LONGEST_QUOTE - 4]} ..."


def problems_of_run(key: str, run: StudyRun, settings: Settings) -> Iterator[str]:
    """Parameters of a run, at a place `key`, that are each allowed but contradict each other."""
    problems = [
        *contradictions(run.run),
        *memory_problem(run.run, "limits.memory", settings.limits.memory),
    ]
    extraction = settings.extraction
    event_drop = run.run.stepping.event_drop
    measures_drop = run.role not in (LITERATURE, WEAKENING_PATCHES)
    if measures_drop and event_drop < extraction.drop:
        problems.append(
            f"event_drop = {event_drop:g} is not allowed with extraction.drop = "
            f"{extraction.drop:g}: the run may end before the force has fallen so far; it must lie "
            f"in [{extraction.drop:g}, 1), or be left out"
        )
    low = extraction.edge_threshold_low
    if run.run.stepping.record == "lengths" and low < STUCK_BELOW:
        problems.append(
            "record = lengths is not allowed with extraction.edge_threshold_low "
            f"= {low:g}, as it leaves out slip rates below {STUCK_BELOW:g} V: it must "
            f"be interface, or the threshold in [{STUCK_BELOW:g}, 1]"
        )
    if len(run.id) > _LONGEST_ID:
        problems.append(
            f"{run.id[:60]}... is not allowed as a name of files: it has {len(run.id)} "
            f"characters, more than {_LONGEST_ID}; move values that do not vary into the study's "
            "defaults"
        )
    for problem in problems:
        yield f"{key}: {problem}"


def setting_problems(settings: Settings) -> Iterator[str]:
    """Settings that no study changes and that contradict each other, a line for each."""
    low = settings.extraction.edge_threshold_low
    edge = settings.extraction.edge_threshold
    high = settings.extraction.edge_threshold_high
    if not low <= edge <= high:
        yield (
            f"extraction: edge_threshold_low = {low:g}, edge_threshold = {edge:g}, "
            f"edge_threshold_high = {high:g} is not allowed: they must ascend, each in (0, 1]"
        )
    if {study.role for study in settings.studies.values()} == {OWN}:
        return  # no figure of the paper needs the theory's curve
    fault = settings.main_text
    for height in (min(settings.curves.heights), max(settings.curves.heights)):
        if np.isnan(fault.replace(height=height).critical_length()):
            yield (
                f"zeta = {fault.zeta:g} with a = {fault.a:g} is not allowed: the theory's curve in "
                f"Figure 3 needs an instability at H = {height:g} m, and there is none"
            )
            return


def results_problem(results: str) -> str | None:
    """The reason why a path, in its shortest form, can't be the directory of results; or None."""
    parts = PurePosixPath(results).parts
    first = parts[0] if parts else ".."
    refused = first in _CODE or set(parts) <= {"/", "//", ".."}
    refused |= first.startswith(".") and first != ".."
    refused |= results != results.strip() or not results.isprintable()
    if not refused and set(results).isdisjoint("{}<>*?~"):
        return None
    return (
        f"results = {results!r} is not allowed: it must be a directory of its own, neither hidden "
        f"nor {', '.join(_CODE)}, which contain the code that makes results, named without "
        "braces, < and >, wildcards, ~, control characters, and spaces at its ends"
    )


def directory_problem(results: str | os.PathLike[str]) -> str | None:
    """The reason why results can't be written to a directory, which need not exist yet; or None."""
    for place in (Path(results), Path(results, "store"), Path(results, "logs")):
        path = place.absolute()
        while not os.path.lexists(path):
            path = path.parent
        if not path.is_dir():
            return f"results = {str(results)!r} is not allowed: {path} is no directory"
        if not os.access(path, os.W_OK | os.X_OK):
            return f"results = {str(results)!r} is not allowed: {path} is not writable"
    return None
