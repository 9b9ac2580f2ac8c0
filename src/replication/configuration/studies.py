"""Studies: named sets of simulations over lists or ranges of parameters, one `Run` for each."""

import itertools
import math
import random
from collections.abc import Collection, Iterator, Mapping
from dataclasses import replace
from typing import Any, NamedTuple

from nucleation.model.friction.constants import CONSTANTS, with_constants
from nucleation.model.linearised import InterfaceState, linearised, loaded, not_rounded_from
from nucleation.model.parameters import Parameters
from nucleation.model.quantities import ParameterError
from nucleation.theory.critical import critical_lengths, run_length
from nucleation.theory.estimates import growth_time
from nucleation.theory.status import NoLength

from .runs import Run
from .settings import Settings
from .study_names import by_study_name, expand, identifier

_LATEST_END = 1.5
"""Default end of a run over the estimated time until the critical length."""

_AFTER_EVENT = 10.0
"""Default time after the event over D/V."""


_Place = str
"""Place of a run in the configuration, such as ``studies.paper.runs[0]``."""

_Parts = tuple[dict[str, Any], ...]
"""Values of the study, of the entry and of the run itself."""


class _Prepared(NamedTuple):
    """A run whose block length is not yet known."""

    parameters: Parameters
    interface: InterfaceState
    varied: dict[str, Any]
    values: dict[str, Any]  # all values that the study gives


def study_runs(name: str, configuration: Settings) -> Iterator[tuple[_Place, Run | str]]:
    """The runs of a study.

    Parameters
    ----------
    name : str
        The study's name.
    configuration : Settings
        With the study's section. If neither the section ``stepping`` nor the study has an end time,
        it follows from the theory's estimate of the event's time.

    Yields
    ------
    key : str
        Place of the run in the configuration.
    run : Run or str
        The run; of a bad run the error message.
    """
    given = list(_given(name, configuration.sections[name]))
    prepared: list[_Prepared | ParameterError] = []
    faults = []
    for _, parts in given:
        try:
            run = _prepared(name, parts, configuration)
        except ParameterError as error:
            prepared.append(error)
            continue
        prepared.append(run)
        faults.append((run.parameters, run.interface))
    lengths = iter(critical_lengths(faults).tolist())
    batches = _batches(name, len(given), configuration.studies[name].runs_per_job)
    for (key, _), one, batch in zip(given, prepared, batches, strict=True):
        if isinstance(one, ParameterError):
            yield key, str(one)
            continue
        critical = next(lengths)
        try:
            yield key, _run(name, one, critical, batch, configuration)
        except ParameterError as error:
            yield key, str(error)


def _given(
    name: str,
    study: Mapping[str, Any],
) -> Iterator[tuple[_Place, _Parts]]:
    """Place of each run, with its values."""
    of_study = study.get("defaults", {})
    for number, entry in enumerate(study["runs"]):
        of_entry = entry.get("defaults", {})
        lists = {}
        for key, value in entry.items():
            if key != "defaults":
                lists[key] = expand(value)
        place = f"studies.{name}.runs[{number}]"
        for chosen in itertools.product(*lists.values()):
            own = dict(zip(lists, chosen, strict=True))
            yield place, (of_study, of_entry, own)


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


def _prepared(name: str, parts: _Parts, configuration: Settings) -> _Prepared:
    """A run from its values."""
    of_study, of_entry, own = map(by_study_name, parts)
    values = of_study | of_entry | own
    parameters, interface = fault_of(name, values, configuration)
    return _Prepared(parameters, interface, own, values)


def fault_of(
    study: str,
    values: dict[str, Any],
    configuration: Settings,
) -> tuple[Parameters, InterfaceState]:
    """The fault with values of a study.

    Parameters
    ----------
    study : str
        The study's name.
    values : dict
        Values by the standard names of parameters.
    configuration : Settings
        With values of the parameters that the study does not set.

    Returns
    -------
    parameters : Parameters
        The run's parameters, with the block length of the configuration unless it is given.
    interface : InterfaceState
        The linearised friction for the theory.

    Raises
    ------
    ParameterError
        If the height is missing or the values contradict each other.
    """
    if "height" not in values:
        raise ParameterError("the run has no height: give it here or in the study's defaults")
    others = [name for name in values if name not in CONSTANTS]
    parameters = configuration.base.replaced({name: values[name] for name in others})
    loading = parameters.loading
    friction = with_constants(parameters.friction, loading.velocity, values)
    parameters = replace(parameters, friction=friction)
    _ = friction.evolution_law  # raises the error of a file that can't be loaded
    own = linearised(friction, loading)
    if configuration.studies[study].interface != "main_text":
        return parameters, own
    main_text = configuration.main_text_interface
    foreign = not_rounded_from(main_text, own)
    if foreign:
        raise ParameterError(
            f"interface = main_text is not allowed: {foreign}; it must be friction_law, so that "
            "the theory follows from the run's own friction law"
        )
    return parameters, loaded(main_text, loading)


def _run(
    study: str,
    prepared: _Prepared,
    critical: float,
    batch: str,
    configuration: Settings,
) -> Run:
    """One run; its length, unless given, is a multiple of the theory's critical length (m)."""
    settings = configuration.studies[study]
    values = prepared.values
    if math.isnan(critical) and "block_length" not in values:
        reason = _reason_of_stability(prepared)
        raise ParameterError(
            f"{reason}; a control run, in which nothing is to nucleate, needs its block_length (m)"
        )
    usual = float(f"{settings.length_over_critical * critical:.4g}")
    length = values.get("block_length", usual)
    if length <= critical:
        raise ParameterError(
            f"block_length = {length:g} m is not allowed: the block must be longer than the "
            f"critical nucleation length of the theory, {critical:.3g} m, better 6 times as long; "
            f"`nucleation specimen --length {length:g}m` computes the stress at which it would "
            "nucleate"
        )
    geometry = replace(prepared.parameters.geometry, length=float(length))
    parameters = replace(prepared.parameters, geometry=geometry)
    parameters.require_consistent()
    given = {*configuration.stepping, *values}
    if "end_time" not in given and not math.isnan(critical):
        parameters = _with_late_end(parameters, critical, given)
    return Run(
        id=identifier(study, parameters, prepared.varied),
        study=study,
        parameters=parameters,
        critical_length=critical,
        interface=prepared.interface,
        given=values,
        batch=batch,
        role=settings.role,
    )


def _reason_of_stability(prepared: _Prepared) -> str:
    """Why the theory has no critical length."""
    try:
        run_length(prepared.parameters, prepared.interface)
    except NoLength as error:
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
    stepping = parameters.stepping
    if "end_time" not in given:
        stepping = replace(stepping, end_time=end)
    if "time_after_event" not in given:
        stepping = replace(stepping, time_after_event=after)
    return replace(parameters, stepping=stepping)
