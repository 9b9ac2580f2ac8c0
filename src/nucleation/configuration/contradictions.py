"""What is wrong with values that are each allowed alone: settings and runs that can't be meant."""

import os
from collections.abc import Iterator, Mapping
from pathlib import Path, PurePosixPath
from typing import Any

from ..analysis.definitions import ExtractionSettings
from ..model.linearised import linearised, not_rounded_from
from ..model.parameters import FIRST_STEP, Parameters
from ..model.perturbation import ALONG_X, ELEMENTS_PER_CORRELATION, KINDS
from ..model.quantities import ParameterError
from ..model.recording import STUCK_BELOW
from ..theory.critical import NoInstability, theory_length
from ..verification.crosscheck.plan import runs as crosscheck_runs
from .roles import LITERATURE, OWN
from .runs import Run
from .settings import Limits, estimated_megabytes

LONGEST_ID = 200
"""Characters of an identifier: with its suffixes it is a file's name, of 255 bytes at most."""

CODE = ("src", "workflow", "profiles", "config", "docs", "tests")
"""Directories of the checkout in which results have no place."""


def setting_problems(settings: Any) -> Iterator[str]:
    """Contradictions among the settings of a configuration that no study changes."""
    base, interface = settings.base, settings.main_text_interface
    extraction, curves = settings.extraction, settings.curves
    low, edge, high = (
        extraction.edge_threshold_low, extraction.edge_threshold, extraction.edge_threshold_high,
    )  # fmt: skip
    if not low <= edge <= high:
        yield (
            f"extraction: edge_threshold_low = {low:g}, edge_threshold = {edge:g}, "
            f"edge_threshold_high = {high:g} is not allowed: they must ascend, each in (0, 1]"
        )
    if all(study.role == OWN for study in settings.studies.values()):
        return  # no figure of the paper is asked for
    try:
        for height in (min(curves.heights), max(curves.heights)):
            theory_length(height, base.material, interface)
    except NoInstability as error:
        yield (
            f"main_text_interface: zeta = {interface.zeta:g} with a = {interface.a:g} is not "
            f"allowed: the theory's curve needs an instability at H = {height:g} m; {error}"
        )
        return
    try:
        parameters = crosscheck_runs(base, settings.crosscheck, interface)
    except (ParameterError, NoInstability) as error:
        yield f"crosscheck: {error}"
        return
    for run in parameters.values():
        yield from memory_problems("crosscheck", run, settings.limits)


def rounding_problems(settings: Any) -> Iterator[str]:
    """Values of the main text that do not round those of the friction law."""
    base = settings.base
    exact = linearised(base.friction, base.loading)
    foreign = not_rounded_from(settings.main_text_interface, exact)
    if foreign:
        yield (
            f"{foreign.replace(' is no', ' is not allowed: it is no')}; leave the section "
            "main_text_interface out, and the theory follows from the friction law"
        )


def run_problems(
    key: str, run: Run, limits: Limits, extraction: ExtractionSettings
) -> Iterator[str]:
    """Contradictions among the parameters of one run, which stands at a key."""
    stepping, loading = run.parameters.stepping, run.parameters.loading
    longest, memory = run.parameters.longest_step, run.parameters.memory_time
    first = FIRST_STEP * memory
    if stepping.shortest_step >= min(longest, first):
        yield (
            f"{key}: shortest_step = {stepping.shortest_step:g} s is not allowed: it must be less "
            f"than the first step, {first:.3g} s, and the longest one, {longest / memory:.3g} D/V "
            f"= {longest:.3g} s"
        )
    if loading.initial_shear_stress and loading.initial_stress == "no_slip":
        yield (
            f"{key}: initial_shear_stress = {loading.initial_shear_stress:g} Pa is not allowed "
            "with initial_stress = no_slip: it must be 0 Pa, or initial_stress uniform_shear"
        )
    if stepping.event_drop < extraction.drop and run.role != LITERATURE:  # which has no drop
        yield (
            f"{key}: event_drop = {stepping.event_drop:g} is not allowed with extraction.drop = "
            f"{extraction.drop:g}: the run may end before the force has fallen so far; it must lie "
            f"in [{extraction.drop:g}, 1), or be left out"
        )
    recording, low = run.parameters.recording, extraction.edge_threshold_low
    if not recording.covers("interface") and low < STUCK_BELOW:
        yield (
            f"{key}: record = {recording.record} is not allowed with extraction.edge_threshold_low "
            f"= {low:g}, as it leaves out slip rates below {STUCK_BELOW:g} V: it must be interface "
            f"or everything, or the threshold in [{STUCK_BELOW:g}, 1]"
        )
    declared = run.parameters.perturbation
    element = run.parameters.geometry.length / run.parameters.mesh.n_x
    if declared.kind == "none" and declared.strength > 0.0:
        yield (
            f"{key}: strength = {declared.strength:g} is not allowed with perturbation = none, "
            f"which perturbs nothing: it must be 0, or perturbation one of {', '.join(KINDS[1:])}"
        )
    if declared.acts and declared.kind in ALONG_X and declared.correlation_length < element:
        yield (
            f"{key}: correlation_length = {declared.correlation_length:g} m is not allowed: it "
            f"must be at least an element, {element:.3g} m, better {ELEMENTS_PER_CORRELATION:g}"
        )
    if len(run.id) > LONGEST_ID:
        yield (
            f"{key}: {run.id[:60]}... is not allowed as a name of files: it has {len(run.id)} "
            f"characters, more than {LONGEST_ID}; put what does not vary into the study's defaults"
        )
    yield from memory_problems(key, run.parameters, limits)


def memory_problems(key: str, parameters: Parameters, limits: Limits) -> Iterator[str]:
    """Meshes whose simulation would need more memory than allowed."""
    need, mesh, below = estimated_megabytes(parameters), parameters.mesh, parameters.below
    if need > limits.memory:
        second = f", second_n_y = {below.mesh.n_y}" if below else ""
        yield (
            f"{key}: n_x = {mesh.n_x}, n_y = {mesh.n_y}{second} is not allowed: the simulation "
            f"would need about {need:.0f} MB, more than limits.memory = {limits.memory:g} MB"
        )


def results_directory(values: Mapping[str, Any]) -> str:
    """The directory of all results in a configuration, in its shortest form: b for a/../b."""
    return os.path.normpath(values.get("results", "results"))


def results_problems(results: str) -> Iterator[str]:
    """Why a text (of :func:`results_directory`) can't name the directory of results."""
    if results != results.strip() or not results.isprintable() or set(results) & set("{}<>*?"):
        yield (
            f"results = {results!r} is not allowed: a directory must be named without braces, "
            "< and >, wildcards, control characters, and spaces at its ends"
        )
    if set(PurePosixPath(results).parts) <= {"/", "//", ".."}:
        yield f"results = {results!r} is not allowed: it must be a directory of its own"
    first = PurePosixPath(results).parts[:1]
    if first and (first[0] in CODE or (first[0].startswith(".") and first[0] != "..")):
        yield (
            f"results = {results!r} is not allowed: hidden directories and {', '.join(CODE)} hold "
            "what makes results"
        )
    if results.startswith("~"):
        yield f"results = {results!r} is not allowed: write the home directory out in place of ~"


def directory_problem(results: str | os.PathLike[str]) -> str | None:
    """Why results can't be written to a directory, which need not exist yet; or None."""
    for place in (results, Path(results, "store"), Path(results, "logs")):
        problem = _not_writable(results, place)
        if problem:
            return problem
    return None


def _not_writable(results: str | os.PathLike[str], place: str | os.PathLike[str]) -> str | None:
    path = Path(place).absolute()
    while not os.path.lexists(path):
        path = path.parent
    if not path.is_dir():
        return f"results = {str(results)!r} is not allowed: {path} is no directory"
    if not os.access(path, os.W_OK | os.X_OK):
        return f"results = {str(results)!r} is not allowed: {path} is not writable"
    return None
