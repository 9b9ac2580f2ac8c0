"""Studies: named sets of simulations over lists or ranges of parameters, one `Run` for each."""

import itertools
import math
import random
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from ..model.friction.constants import CONSTANTS, with_constants
from ..model.linearised import InterfaceState, linearised, loaded, not_rounded_from
from ..model.parameters import Parameters
from ..model.quantities import ParameterError
from ..theory.critical import NoInstability, run_length, theory_lengths
from ..theory.estimates import growth_time
from ..theory.transfer import bodies_of
from .runs import Run, varied
from .settings import StudySettings
from .study_names import by_study_name, expand, identifier, study_parameters

_LATEST_END = 1.5
"""Default end of a run over the estimated time until the critical length."""

_AFTER_EVENT = 10.0
"""Default time after the event over D/V."""

_CURVE_POINTS = 81
"""Values of a varied number in the theory's curve of a study's figure."""


class _Prepared(NamedTuple):
    """A run whose block length is not yet known."""

    parameters: Parameters
    interface: InterfaceState
    varied: dict[str, Any]
    values: dict[str, Any]  # all values that the study gives


def theory_curves(
    runs: list[Run],
    settings: StudySettings,
    base: Parameters,
    main_text: InterfaceState,
) -> dict[str, dict[str, list[float]]]:
    """The theory's length over the one number that a study varies, closely spaced.

    Parameters
    ----------
    runs : list of Run
        The study's runs.
    settings : StudySettings
        The study's settings.
    base, main_text
        As in :func:`study_runs`.

    Returns
    -------
    dict
        By the words that differ among the runs (``"slip"``, or ``""``): the number (``x``) and
        the lengths (``length``, m; NaN where sliding is stable), to eight digits. Empty if the
        study varies several numbers or none, or an integer.
    """
    declared = study_parameters()
    found = varied(runs)
    numbers = [name for name in found if not declared[name].choices]
    words = [name for name in found if declared[name].choices]
    if len(numbers) != 1 or declared[numbers[0]].kind != "float":
        return {}
    (name,) = numbers
    kinds = [", ".join(str(found[word][i]) for word in words) for i in range(len(runs))]
    curves = {}
    for run, kind in zip(runs, kinds, strict=True):
        ends = [x for x, other in zip(found[name], kinds, strict=True) if other == kind]
        if kind in curves or name not in run.given or len(ends) < 2:
            continue
        low = min(ends)
        high = max(ends)
        spaced = np.geomspace if low > 0.0 else np.linspace
        x = spaced(low, high, _CURVE_POINTS).tolist()
        faults = [_fault(settings, run.given | {name: value}, base, main_text) for value in x]
        curves[kind] = {
            "x": _rounded(x),
            "length": _rounded(_theory_lengths(faults)),
        }
    return curves


def _rounded(numbers: Iterable[float]) -> list[float]:
    return [float(f"{number:.8g}") for number in numbers]


def study_runs(
    name: str,
    study: Mapping[str, Any],
    base: Parameters,
    main_text: InterfaceState,
    stepping: Collection[str] = (),
) -> Iterator[tuple[str, Run | str]]:
    """The runs of a study.

    Parameters
    ----------
    name : str
        The study's name.
    study : mapping
        Its section of the configuration, with allowed values.
    base : Parameters
        Values of the parameters that the study does not set.
    main_text : InterfaceState
        The main text's rounded interface.
    stepping : collection of str
        Keys in the section ``stepping``. If neither it nor the study has an end time, it follows
        from the theory's estimate of the event's time.

    Yields
    ------
    key : str
        Place of the run in the configuration.
    run : Run or str
        The run; of a bad run the error message.
    """
    settings = StudySettings.of(study)
    given = list(_given(name, study))
    prepared: list[_Prepared | ParameterError] = []
    for _, parts in given:
        try:
            prepared.append(_prepared(settings, parts, base, main_text))
        except ParameterError as error:
            prepared.append(error)
    good = [run[:2] for run in prepared if isinstance(run, _Prepared)]
    lengths = iter(_theory_lengths(good))
    batches = _batches(name, len(given), settings.runs_per_job)
    for (key, _), batch, run in zip(given, batches, prepared, strict=True):
        if isinstance(run, ParameterError):
            yield key, str(run)
            continue
        critical = next(lengths)
        try:
            yield key, _run(name, settings, run, critical, batch, stepping)
        except ParameterError as error:
            yield key, str(error)


def _given(name: str, study: Mapping[str, Any]) -> Iterator[tuple[str, tuple[dict[str, Any], ...]]]:
    """Place of each run, with the values of the study, of the entry and of the run itself."""
    of_study = study.get("defaults", {})
    for number, entry in enumerate(study["runs"]):
        of_entry = entry.get("defaults", {})
        lists = {key: expand(value) for key, value in entry.items() if key != "defaults"}
        for chosen in itertools.product(*lists.values()):
            own = dict(zip(lists, chosen, strict=True))
            yield f"studies.{name}.runs[{number}]", (of_study, of_entry, own)


def _batches(study: str, runs: int, per_job: int) -> list[str]:
    """The name of the batch of each run, empty if it has a job of its own.

    Runs are assigned at random, so that all batches take about the same time: neighbours in a
    study are similar, and so are runs at any fixed distance.
    """
    if per_job == 1:
        return [""] * runs
    number = math.ceil(runs / per_job)
    digits = len(str(number - 1))
    draw = random.Random(runs).random  # the same numbers in every Python version
    drawn = sorted((draw(), run) for run in range(runs))
    batches = [""] * runs
    for rank, (_, run) in enumerate(drawn):
        batches[run] = f"{study}-{rank % number:0{digits}d}"
    return batches


def _prepared(
    settings: StudySettings,
    parts: Iterable[dict[str, Any]],
    base: Parameters,
    main_text: InterfaceState,
) -> _Prepared:
    """A run from the values of the study, of the entry and of the run itself."""
    of_study, of_entry, own = map(by_study_name, parts)
    values = of_study | of_entry | own
    parameters, interface = _fault(settings, values, base, main_text)
    return _Prepared(parameters, interface, own, values)


def _fault(
    settings: StudySettings,
    values: dict[str, Any],
    base: Parameters,
    main_text: InterfaceState,
) -> tuple[Parameters, InterfaceState]:
    """Parameters with values of a study, by standard name, and the theory's interface."""
    if "height" not in values:
        raise ParameterError("the run has no height: give it here or in the study's defaults")
    without_constants = {name: value for name, value in values.items() if name not in CONSTANTS}
    parameters = base.replaced(without_constants)
    loading = parameters.loading
    friction = with_constants(parameters.friction, loading.velocity, values)
    parameters = replace(parameters, friction=friction)
    _ = friction.evolution_law  # raises the error of a file that can't be loaded
    own = linearised(friction, loading)
    if settings.interface != "main_text":
        return parameters, own
    foreign = not_rounded_from(main_text, own)
    if foreign:
        raise ParameterError(
            f"interface = main_text is not allowed: {foreign}; it must be friction_law, so that "
            "the theory follows from the run's own friction law"
        )
    return parameters, loaded(main_text, loading)


def _theory_lengths(faults: Iterable[tuple[Any, ...]]) -> list[float]:
    """The theory's lengths (m) of all faults in one call, NaN where sliding is stable."""
    cases = [(*bodies_of(parameters), interface) for parameters, interface in faults]
    return theory_lengths(cases).tolist() if cases else []


def _run(
    study: str,
    settings: StudySettings,
    prepared: _Prepared,
    critical: float,
    batch: str,
    stepping: Collection[str],
) -> Run:
    """One run; its length, unless given, is a multiple of the theory's critical length (m)."""
    values = prepared.values
    if math.isnan(critical) and "length" not in values:
        reason = _reason_of_stability(prepared)
        raise ParameterError(
            f"{reason}; a control run, in which nothing is to nucleate, needs its length (m)"
        )
    usual = float(f"{settings.length_over_critical * critical:.4g}")
    length = values.get("length", usual)
    if length <= critical:
        raise ParameterError(
            f"length = {length:g} m is not allowed: the block must be longer than the critical "
            f"nucleation length of the theory, {critical:.3g} m, better 6 times as long; "
            f"`nucleation specimen --length {length:g}m` computes the stress at which it would "
            "nucleate"
        )
    geometry = replace(prepared.parameters.geometry, length=float(length))
    parameters = replace(prepared.parameters, geometry=geometry)
    parameters.require_consistent()
    given = {*stepping, *values}
    if "end_time" not in given and not math.isnan(critical):
        parameters = _with_late_end(parameters, critical, given)
    return Run(
        id=identifier(study, parameters, prepared.varied),
        study=study,
        parameters=parameters,
        theory_length=critical,
        interface=prepared.interface,
        given=values,
        batch=batch,
        role=settings.role,
    )


def _reason_of_stability(prepared: _Prepared) -> str:
    """Why the theory has no critical length."""
    try:
        run_length(prepared.parameters, prepared.interface)
    except NoInstability as error:
        return str(error)
    return "the theory has no critical length"


def _with_late_end(
    parameters: Parameters,
    critical: float,
    given: Collection[str],
) -> Parameters:
    """Parameters with an end time after the latest event, and an early end after the event.

    The estimated time until the theory's critical length (m) is an upper bound of the event's time
    (:func:`nucleation.theory.estimates.growth_time`).
    """
    end = float(f"{_LATEST_END * growth_time(parameters, critical):.2g}")
    after = min(_AFTER_EVENT * parameters.memory_time, end)
    found = {"end_time": end, "time_after_event": after}
    own = {name: value for name, value in found.items() if name not in given}
    return replace(parameters, stepping=replace(parameters.stepping, **own))
