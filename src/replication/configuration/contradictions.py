"""Contradictions among the settings of a configuration, and directories that can't hold results."""

import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path, PurePosixPath
from typing import Any

import numpy as np

from nucleation.extraction.definitions import ExtractionSettings
from nucleation.model.settings import STUCK_BELOW
from nucleation.run.checks import contradictions, memory_problem

from .roles import LITERATURE, OWN, ROLES, WEAKENING_PATCHES
from .runs import StudyRun
from .settings import Limits, Settings

_LONGEST_ID = 200
"""Most characters of an identifier; a file's name adds suffixes, and has at most 255 bytes."""

_CODE = ("src", "workflow", "profiles", "config", "docs", "tests")
"""Directories of the checkout that can't be the directory of results."""


def run_problems(
    key: str,
    run: StudyRun,
    limits: Limits,
    extraction: ExtractionSettings,
) -> Iterator[str]:
    """Parameters of a run, at a place `key`, that are each allowed but contradict each other."""
    problems = [
        *contradictions(run.run),
        *_measurement_problems(run, extraction),
        *_name_problems(run.id),
        *memory_problem(run.run, "limits.memory", limits.memory),
    ]
    for problem in problems:
        yield f"{key}: {problem}"


def _measurement_problems(run: StudyRun, extraction: ExtractionSettings) -> Iterator[str]:
    event_drop = run.run.stepping.event_drop
    measures_drop = run.role not in (LITERATURE, WEAKENING_PATCHES)
    if measures_drop and event_drop < extraction.drop:
        yield (
            f"event_drop = {event_drop:g} is not allowed with extraction.drop = "
            f"{extraction.drop:g}: the run may end before the force has fallen so far; it must lie "
            f"in [{extraction.drop:g}, 1), or be left out"
        )
    recording = run.run.recording
    low = extraction.edge_threshold_low
    if recording.record == "lengths" and low < STUCK_BELOW:
        yield (
            f"record = {recording.record} is not allowed with extraction.edge_threshold_low "
            f"= {low:g}, as it leaves out slip rates below {STUCK_BELOW:g} V: it must "
            f"be interface, or the threshold in [{STUCK_BELOW:g}, 1]"
        )


def _name_problems(identifier: str) -> Iterator[str]:
    if len(identifier) > _LONGEST_ID:
        yield (
            f"{identifier[:60]}... is not allowed as a name of files: it has {len(identifier)} "
            f"characters, more than {_LONGEST_ID}; move values that do not vary into the study's "
            "defaults"
        )


def role_problems(name: str, settings: Settings, runs: Sequence[StudyRun]) -> Iterator[str]:
    """Runs of a study that contradict its role, and missing ones, a line for each."""
    role = settings.studies[name].role
    for need in ROLES[role].runs:
        for run in runs:
            value = run.value(need.name)
            if not need.allowed(value):
                yield need.refusal(f"studies.{name}: {run.id}: {need.name}", value, role)
                break  # the first run shows the problem


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
    roles = {study.role for study in settings.studies.values()}
    if roles == {OWN}:
        return  # no figure of the paper needs the theory's curve
    fault = settings.main_text
    for height in (min(settings.curves.heights), max(settings.curves.heights)):
        if np.isnan(fault.replace(height=height).critical_length()):
            yield (
                f"zeta = {fault.zeta:g} with a = {fault.a:g} is not allowed: the theory's curve in "
                f"Figure 3 needs an instability at H = {height:g} m, and there is none"
            )
            return


def results_directory(values: Mapping[str, Any]) -> str:
    """The directory of all results in a configuration, in its shortest form: b for a/../b."""
    return os.path.normpath(values.get("results", "results"))


def results_problems(results: str) -> Iterator[str]:
    """Reasons why a path (of :func:`results_directory`) can't be the directory of results."""
    refused = f"results = {results!r} is not allowed"
    special = set(results) & set("{}<>*?")
    if results != results.strip() or not results.isprintable() or special:
        yield (
            f"{refused}: a directory must be named without braces, "
            "< and >, wildcards, control characters, and spaces at its ends"
        )
    parts = PurePosixPath(results).parts
    if set(parts) <= {"/", "//", ".."}:
        yield f"{refused}: it must be a directory of its own"
    first = parts[0] if parts else ".."
    hidden = first.startswith(".") and first != ".."
    if hidden or first in _CODE:
        yield (
            f"{refused}: hidden directories and {', '.join(_CODE)} contain the code that makes "
            "results"
        )
    if results.startswith("~"):
        yield f"{refused}: write the home directory out in place of ~"


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
