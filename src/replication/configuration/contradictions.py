"""Contradictions among the parameters of one run, and directories that can't hold results."""

import os
from collections.abc import Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import Any

from nucleation.extraction.definitions import ExtractionSettings
from nucleation.model.parameters import Parameters
from nucleation.model.perturbation import ALONG_X, ELEMENTS_PER_CORRELATION, KINDS
from nucleation.model.recording import STUCK_BELOW
from nucleation.model.stepping import FIRST_STEP

from .roles import LITERATURE
from .runs import Run
from .settings import Limits, estimated_megabytes

_LONGEST_ID = 200
"""Most characters of an identifier; a file's name adds suffixes, and has at most 255 bytes."""

_CODE = ("src", "workflow", "profiles", "config", "docs", "tests")
"""Directories of the checkout that can't be the directory of results."""


def run_problems(
    key: str,
    run: Run,
    limits: Limits,
    extraction: ExtractionSettings,
) -> Iterator[str]:
    """Parameters of a run that are each allowed but contradict each other.

    Parameters
    ----------
    key : str
        Place of the run in the configuration, for messages.
    run : Run
        The run.
    limits : Limits
        Limits of one simulation.
    extraction : ExtractionSettings
        Settings of the measurement.

    Yields
    ------
    str
        One line for each problem.
    """
    parameters = run.parameters
    problems = [
        *_step_problems(parameters),
        *_start_problems(parameters),
        *_measurement_problems(run, extraction),
        *_perturbation_problems(parameters),
        *_name_problems(run.id),
    ]
    for problem in problems:
        yield f"{key}: {problem}"
    yield from memory_problems(key, parameters, limits)


def _step_problems(parameters: Parameters) -> Iterator[str]:
    shortest = parameters.stepping.shortest_step
    longest = parameters.longest_step
    memory = parameters.memory_time
    first = FIRST_STEP * memory
    if shortest >= min(longest, first):
        yield (
            f"shortest_step = {shortest:g} s is not allowed: it must be less "
            f"than the first step, {first:.3g} s, and the longest one, {longest / memory:.3g} D/V "
            f"= {longest:.3g} s"
        )


def _start_problems(parameters: Parameters) -> Iterator[str]:
    loading = parameters.loading
    if loading.initial_shear_stress and loading.initial_stress == "no_slip":
        yield (
            f"initial_shear_stress = {loading.initial_shear_stress:g} Pa is not allowed "
            "with initial_stress = no_slip: it must be 0 Pa, or initial_stress uniform_shear"
        )


def _measurement_problems(run: Run, extraction: ExtractionSettings) -> Iterator[str]:
    event_drop = run.parameters.stepping.event_drop
    measures_drop = run.role != LITERATURE
    if measures_drop and event_drop < extraction.drop:
        yield (
            f"event_drop = {event_drop:g} is not allowed with extraction.drop = "
            f"{extraction.drop:g}: the run may end before the force has fallen so far; it must lie "
            f"in [{extraction.drop:g}, 1), or be left out"
        )
    recording = run.parameters.recording
    low = extraction.edge_threshold_low
    if recording.record == "lengths" and low < STUCK_BELOW:
        yield (
            f"record = {recording.record} is not allowed with extraction.edge_threshold_low "
            f"= {low:g}, as it leaves out slip rates below {STUCK_BELOW:g} V: it must "
            f"be interface, or the threshold in [{STUCK_BELOW:g}, 1]"
        )


def _perturbation_problems(parameters: Parameters) -> Iterator[str]:
    declared = parameters.perturbation
    if declared.kind == "none" and declared.strength > 0.0:
        yield (
            f"strength = {declared.strength:g} is not allowed with perturbation = none, "
            f"which perturbs nothing: it must be 0, or perturbation one of {', '.join(KINDS[1:])}"
        )
    length = declared.correlation_length
    element = parameters.geometry.length / parameters.mesh.n_x
    if declared.acts and declared.kind in ALONG_X and length < element:
        yield (
            f"correlation_length = {length:g} m is not allowed: it "
            f"must be at least an element, {element:.3g} m, better {ELEMENTS_PER_CORRELATION:g}"
        )


def _name_problems(identifier: str) -> Iterator[str]:
    if len(identifier) > _LONGEST_ID:
        yield (
            f"{identifier[:60]}... is not allowed as a name of files: it has {len(identifier)} "
            f"characters, more than {_LONGEST_ID}; move values that do not vary into the study's "
            "defaults"
        )


def memory_problems(key: str, parameters: Parameters, limits: Limits) -> Iterator[str]:
    """A mesh whose simulation would need more memory than allowed.

    Parameters
    ----------
    key : str
        Place of the simulation in the configuration, for the message.
    parameters : Parameters
        All parameters of the simulation.
    limits : Limits
        Limits of one simulation.

    Yields
    ------
    str
        The problem, if there is one.
    """
    need = estimated_megabytes(parameters)
    if need <= limits.memory:
        return
    mesh = parameters.mesh
    below = parameters.below
    second = f", second_n_y = {below.mesh.n_y}" if below else ""
    yield (
        f"{key}: n_x = {mesh.n_x}, n_y = {mesh.n_y}{second} is not allowed: the simulation "
        f"would need about {need:.0f} MB, more than limits.memory = {limits.memory:g} MB"
    )


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
