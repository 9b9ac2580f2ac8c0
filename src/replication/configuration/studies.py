"""Studies: named sets of simulations over lists or ranges of parameters, one run for each."""

import itertools
import math
import random
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from nucleation.fault import Fault
from nucleation.model.quantities import ParameterError
from nucleation.run.complete import late_end, rounded
from nucleation.run.names import read
from nucleation.run.run import Run
from nucleation.theory.critical import unstable_modes
from nucleation.theory.evaluation import single_system
from nucleation.theory.status import NoLength

from ..tables.main_text import main_text
from .names import expand, identifier
from .runs import StudyRun
from .settings import Settings

_Place = str
"""Place of a run in the configuration, such as ``studies.paper.runs[0]``."""

_ARRAYS = (
    "shear_modulus",
    "poisson_ratio",
    "height",
    "second_shear_modulus",
    "second_poisson_ratio",
    "second_height",
    "normal_stress",
    "a",
    "zeta",
    "slip_distance",
    "friction",
    "velocity",
)
"""Parameters of a fault on which L_c depends and that differ among the runs of a study."""


class _Prepared(NamedTuple):
    """A run whose block length is not yet known."""

    run: Run
    theory: Fault
    varied: dict[str, Any]
    values: dict[str, Any]  # all values that the study gives


def study_runs(name: str, settings: Settings) -> Iterator[tuple[_Place, StudyRun | str]]:
    """The runs of a study with their places in the configuration; of a bad run its error message.

    If neither the section ``stepping`` nor the study has an end time, it follows from the theory's
    estimate of the event's time.
    """
    given = list(_given(name, settings.sections[name]))
    prepared: list[_Prepared | ParameterError] = []
    for _, own, others in given:
        try:
            values = read({**others, **own})
            run, theory = fault_of(name, values, settings)
            prepared.append(_Prepared(run, theory, read(own), values))
        except ParameterError as error:
            prepared.append(error)
    faults = [one.theory for one in prepared if isinstance(one, _Prepared)]
    lengths = iter(critical_lengths(faults))
    batches = _batches(name, len(given), settings.studies[name].runs_per_job)
    for (key, *_), one, batch in zip(
        given,
        prepared,
        batches,
        strict=True,
    ):
        if isinstance(one, ParameterError):
            yield key, str(one)
            continue
        critical = next(lengths)
        try:
            yield key, _run(name, one, critical, batch, settings)
        except ParameterError as error:
            yield key, str(error)


def critical_lengths(faults: Sequence[Fault]) -> list[float]:
    """L_c (m) of single faults in few vectorised calls; NaN where sliding is stable."""
    groups: dict[tuple[Any, ...], list[Fault]] = {}
    for fault in dict.fromkeys(faults):
        kind = fault.plane, fault.far_side, fault.second_far_side
        groups.setdefault(kind, []).append(fault)
    lengths: dict[Fault, float] = {}
    for (plane, far_side, second_far_side), group in groups.items():
        arrays: dict[str, Any] = {
            name: np.array([getattr(fault, name) for fault in group]) for name in _ARRAYS
        }
        words = {"plane": plane, "far_side": far_side, "second_far_side": second_far_side}
        found = Fault(**arrays, **words).critical_length()
        lengths |= zip(group, found.tolist(), strict=True)
    return [lengths[fault] for fault in faults]


def _given(
    name: str,
    study: Mapping[str, Any],
) -> Iterator[tuple[_Place, dict[str, Any], dict[str, Any]]]:
    """Place of each run, the values that vary, and the study's and the entry's defaults."""
    of_study = study.get("defaults", {})
    for number, entry in enumerate(study["runs"]):
        defaults = {**of_study, **entry.get("defaults", {})}
        lists = {key: expand(value) for key, value in entry.items() if key != "defaults"}
        place = f"studies.{name}.runs[{number}]"
        for chosen in itertools.product(*lists.values()):
            yield place, dict(zip(lists, chosen, strict=True)), defaults


def _batches(study: str, runs: int, per_job: int) -> list[str]:
    """The name of the batch of each run, empty if it has a job of its own.

    Runs are assigned at random, so that all batches take about the same time: neighbours in a
    study are similar, and so are runs at any fixed distance.
    """
    if per_job == 1:
        return [""] * runs
    number = math.ceil(runs / per_job)
    digits = len(str(number - 1))
    generator = random.Random(runs)
    draws = [generator.random() for _ in range(runs)]  # equal in every Python version
    shuffled = sorted(range(runs), key=draws.__getitem__)
    batches = [""] * runs
    for rank, run in enumerate(shuffled):
        batch = rank % number
        batches[run] = f"{study}-{batch:0{digits}d}"
    return batches


def fault_of(study: str, values: Mapping[str, Any], settings: Settings) -> tuple[Run, Fault]:
    """The run with values of a study, whose block length is the base's, and the theory's fault."""
    if "height" not in values:
        raise ParameterError("the run has no height: give it here or in the study's defaults")
    run = settings.base.replaced(**values)
    _ = run.law.evolution_law  # raises the error of a file that can't be loaded
    if settings.studies[study].interface == "main_text":
        return run, main_text(run.fault)
    return run, run.fault


def _run(
    study: str,
    prepared: _Prepared,
    critical: float,
    batch: str,
    settings: Settings,
) -> StudyRun:
    """One run; its length, unless given, is a multiple of the theory's critical length (m)."""
    own = settings.studies[study]
    values, run = prepared.values, prepared.run
    if math.isnan(critical) and "block_length" not in values:
        raise ParameterError(
            f"{_reason(prepared.theory)}; a control run, in which nothing is to nucleate, needs "
            "its block_length (m)"
        )
    follows: dict[str, Any] = {}
    if "block_length" not in values:
        follows["block_length"] = rounded(own.length_over_critical * critical)
    given = {*settings.stepping, *values}
    if "end_time" not in given and not math.isnan(critical):
        times = late_end(run.fault, run.start, critical)
        follows |= {name: time for name, time in times.items() if name not in given}
    if follows:
        run = run.replaced(**follows)
    return StudyRun(
        id=identifier(study, run, prepared.varied),
        study=study,
        run=run,
        critical_length=critical,
        theory=prepared.theory,
        given=values,
        batch=batch,
        role=own.role,
    )


def _reason(fault: Fault) -> str:
    """Why the theory has no critical length."""
    try:
        unstable_modes(single_system(fault))
    except NoLength as error:
        return str(error)
    return "the theory has no critical length"
