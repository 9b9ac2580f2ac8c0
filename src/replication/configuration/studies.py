"""Studies: named sets of simulations over lists or ranges of parameters, one run for each."""

import itertools
import math
import random
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from nucleation.fault import Fault
from nucleation.fault.parameters import parameters
from nucleation.model.quantities import ParameterError
from nucleation.run.run import Run
from nucleation.run.sizing import late_end, latest_length, rounded
from nucleation.theory.critical import stability_reason
from nucleation.theory.evaluation import OF_SYSTEMS, single_system

from ..tables.curves import main_text
from .runs import StudyRun, identifier, varied
from .settings import Settings

OF_A_FAULT = {"shear_modulus", "poisson_ratio", "normal_stress", "slip_distance"}
"""What a fault of its own has: who gives all of it says what it slides on, and with which law."""

_CURVE_POINTS = 81
"""Values of the varied number in the theory's curve."""

_BETWEEN = 10
"""At every tenth of them L_s and L are computed, which takes seconds."""


def study_runs(name: str, settings: Settings) -> list[tuple[str, StudyRun | str]]:
    """The runs of a study with their places in the configuration; of a bad run its error message.

    A place is ``studies.paper.runs[0]``, say. If neither the section ``stepping`` nor the study has
    an end time, it follows from the theory's estimate of the event's time.
    """
    section = settings.sections[name]
    given: list[tuple[str, dict[str, Any], dict[str, Any]]] = []
    for number, entry in enumerate(section["runs"]):
        defaults = {**section.get("defaults", {}), **entry.get("defaults", {})}
        lists = {key: values for key, values in entry.items() if key != "defaults"}
        for chosen in itertools.product(*lists.values()):
            own = dict(zip(lists, chosen, strict=True))
            given.append((f"studies.{name}.runs[{number}]", own, {**defaults, **own}))
    made: dict[int, tuple[Run, Fault]] = {}
    found: list[StudyRun | str] = [""] * len(given)
    for i, (_, _, values) in enumerate(given):
        try:
            made[i] = fault_of(name, values, settings)
        except ParameterError as error:
            found[i] = str(error)
    lengths = critical_lengths([theory for _, theory in made.values()])
    batches = _batches(name, len(given), settings.studies[name].runs_per_job)
    for (i, (run, theory)), critical in zip(made.items(), lengths, strict=True):
        _, own, values = given[i]
        try:
            run = _completed(name, run, theory, critical, values, settings)
        except ParameterError as error:
            found[i] = str(error)
            continue
        found[i] = StudyRun(
            id=identifier(name, run, own),
            study=name,
            run=run,
            critical_length=critical,
            theory=theory,
            given=values,
            batch=batches[i],
            role=settings.studies[name].role,
        )
    return [(place, one) for (place, _, _), one in zip(given, found, strict=True)]


def critical_lengths(faults: Sequence[Fault]) -> list[float]:
    """L_c (m) of single faults in few vectorised calls; NaN where sliding is stable."""
    groups: dict[tuple[Any, ...], list[Fault]] = {}
    for fault in dict.fromkeys(faults):
        kind = fault.plane, fault.far_side, fault.second_far_side
        groups.setdefault(kind, []).append(fault)
    lengths: dict[Fault, float] = {}
    for (plane, far_side, second_far_side), group in groups.items():
        arrays: dict[str, Any] = {
            name: np.array([getattr(fault, name) for fault in group]) for name in OF_SYSTEMS
        }
        words = {"plane": plane, "far_side": far_side, "second_far_side": second_far_side}
        found = Fault(**arrays, **words).critical_length()
        lengths |= zip(group, found.tolist(), strict=True)
    return [lengths[fault] for fault in faults]


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
    batches = [""] * runs
    for rank, run in enumerate(sorted(range(runs), key=draws.__getitem__)):
        batches[run] = f"{study}-{rank % number:0{digits}d}"
    return batches


def fault_of(study: str, values: Mapping[str, Any], settings: Settings) -> tuple[Run, Fault]:
    """The run with values of a study, whose block length is the base's, and the theory's fault."""
    start = settings.sections[study].get("fault")
    named = {*settings.given, *values}
    missing = [name for name in ("second_body", "friction_law") if name not in named]
    if start is None and named >= OF_A_FAULT and missing:
        raise ParameterError(
            f"{', '.join(sorted(OF_A_FAULT))} are given, but not {' and '.join(missing)}: write "
            "`fault: paper` in the study if they are the paper's, a rigid second body and the law "
            "product; or give all as `fault: {...}`, with a second body like the first and the "
            "friction law dieterich_ruina where nothing else is given"
        )
    values = {**(start or {}), **values}
    if "height" not in values:
        raise ParameterError("the run has no height: give it here or in the study's defaults")
    run = settings.base.replaced(**values)
    _ = run.law.evolution_law  # raises the error of a file that can't be loaded
    if settings.studies[study].interface == "main_text":
        return run, main_text(run.fault)
    return run, run.fault


def _completed(
    study: str,
    run: Run,
    theory: Fault,
    critical: float,
    values: Mapping[str, Any],
    settings: Settings,
) -> Run:
    """A run with its length, a multiple of the critical one (m), and its end, unless given."""
    follows: dict[str, Any] = {}
    if "block_length" not in values:
        if math.isnan(critical):
            raise ParameterError(
                f"{stability_reason(single_system(theory))}; a control run, in which nothing is to "
                "nucleate, needs its block_length (m)"
            )
        over_critical = settings.studies[study].length_over_critical
        follows["block_length"] = rounded(over_critical * critical)
    given = {*settings.given, *values}
    if "end_time" not in given and not math.isnan(critical):
        longest = latest_length(run.fault, run.law, run.start, run.perturbation, critical)
        times = late_end(run.fault, run.start, longest)
        follows |= {name: time for name, time in times.items() if name not in given}
    return run.replaced(**follows) if follows else run


def theory_curves(runs: list[StudyRun], settings: Settings) -> list[dict[str, Any]]:
    """The theory of a study over the number that has most values, closely spaced.

    A curve for each set of the other values, realisations aside: the `members` among the runs, the
    number `x`, L_c (m) as `length`, NaN where sliding is stable, to eight digits, and for every
    tenth of them the parameters of a run, `between`. Empty if no real number varies.
    """
    found = varied(runs)
    numbers = [name for name in found if not parameters()[name].choices and name != "seed"]
    numbers.sort(key=lambda name: -len(set(found[name])))
    if not numbers or parameters()[numbers[0]].kind != "float":
        return []
    name = numbers[0]
    others = [other for other in found if other not in (name, "seed")]
    members: dict[tuple[Any, ...], list[int]] = {}
    for i in range(len(runs)):
        members.setdefault(tuple(found[other][i] for other in others), []).append(i)
    curves = []
    for rows in members.values():
        values = [found[name][i] for i in rows]
        given = [runs[i] for i in rows if name in runs[i].given]
        low, high = min(values), max(values)
        if not given or low == high:
            continue
        spaced = np.geomspace if low > 0.0 else np.linspace
        x = [float(f"{n:.8g}") for n in spaced(low, high, _CURVE_POINTS)]
        made = [fault_of(given[0].study, {**given[0].given, name: value}, settings) for value in x]
        lengths = [float(f"{n:.8g}") for n in critical_lengths([theory for _, theory in made])]
        between = [run.to_dict() for run, _ in made[::_BETWEEN]]
        curves.append({"members": rows, "x": x, "length": lengths, "between": between})
    return curves
