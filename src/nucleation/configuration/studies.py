"""Studies: named sets of simulations over lists or ranges of parameters, one `Run` for each."""

import dataclasses
import itertools
import math
import random
from collections.abc import Collection, Iterable, Iterator
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from ..model.checked import Checked
from ..model.friction.constants import CONSTANTS, with_constants
from ..model.linearised import InterfaceState, linearised, loaded, not_rounded_from
from ..model.parameters import Parameters
from ..model.quantities import ParameterError, quantity
from ..theory.critical import NoInstability, run_length, theory_lengths
from ..theory.estimates import growth_time
from ..theory.transfer import bodies_of
from .roles import OWN, ROLES
from .runs import Run, varied
from .study_names import by_study_name, expand, identifier, study_parameters

LATE = 1.5
"""Latest end of a run that is given none, over the estimated time until the critical length."""

AFTER = 10.0
"""Time that such a run goes on after its event, over D/V."""


@dataclasses.dataclass(frozen=True)
class StudySettings(Checked):
    """What a study says once for all of its runs."""

    description: str = quantity("what the study is for", default="a set of simulations")
    role: str = quantity(
        "what figures, tables and verdicts use it for (docs/studies.md); own: it has its own",
        choices=tuple(ROLES), default=OWN,
    )  # fmt: skip
    length_over_critical: float = quantity(
        "block length over the theory's critical length, unless a run gives its length",
        low=1.0, high=1000.0, default=6.0, symbol="L/L_c",
    )  # fmt: skip
    interface: str = quantity(
        "linearised friction of the theory: the rounded values of the group main_text_interface, "
        "which must be those of the run's friction law, or that law expanded at the run's velocity",
        choices=("main_text", "friction_law"), default="friction_law",
    )  # fmt: skip
    table: str = quantity(
        "where its lengths go: with the other studies into lengths.csv, and so into the targets "
        "lengths and simulations; or into its own table alone",
        choices=("lengths", "own"), default="lengths",
    )  # fmt: skip
    runs_per_job: int = quantity(
        "simulations that one job makes, one after another; more than one where runs take seconds",
        low=1, high=10000, closed="both", default=1,
    )  # fmt: skip
    measure: str = quantity(
        "what is measured of each run: lengths at the drop, or the length at which the patch turns "
        "unstable too; the latter if runs_per_job is more than one",
        choices=("lengths", "stability"), default="lengths",
    )  # fmt: skip


CURVE_POINTS = 81
"""Values of a varied number at which a study's figure has the theory."""


def theory_curves(
    runs: list[Run], settings: StudySettings, base: Parameters, main_text: InterfaceState
) -> dict[str, dict[str, list[float]]]:
    """The theory's length over the one number that a study varies, closely spaced.

    Parameters
    ----------
    runs, settings : the study's.
    base, main_text : of the configuration, see :func:`study_runs`.

    Returns
    -------
    dict
        By the words that runs differ in (``"slip"``, or ``""``): the number (``x``) and the lengths
        there (``length``, m; NaN where sliding is stable), to eight digits. Empty if the study
        varies several numbers or none, or one that counts things.
    """
    declared, found = study_parameters(), varied(runs)
    numbers = [name for name in found if not declared[name].choices]
    if len(numbers) != 1 or declared[numbers[0]].kind != "float":
        return {}
    (name,), words = numbers, [word for word in found if word not in numbers]
    kinds = [", ".join(str(found[word][i]) for word in words) for i in range(len(runs))]
    curves = {}
    for run, kind in zip(runs, kinds, strict=True):
        ends = [x for x, other in zip(found[name], kinds, strict=True) if other == kind]
        if kind in curves or name not in run.given or len(ends) < 2:
            continue
        low, high = min(ends), max(ends)
        spaced = np.geomspace if low > 0.0 else np.linspace
        x = spaced(low, high, CURVE_POINTS).tolist()
        faults = (_fault(settings, run.given | {name: value}, base, main_text) for value in x)
        rounded = [float(f"{length:.8g}") for length in _theory_lengths(faults)]
        curves[kind] = {"x": [float(f"{value:.8g}") for value in x], "length": rounded}
    return curves


def study_settings(study: dict[str, Any]) -> StudySettings:
    """The settings in a study's section of the configuration."""
    return StudySettings(**{k: v for k, v in study.items() if k not in ("defaults", "runs")})


def study_runs(
    name: str,
    study: dict[str, Any],
    base: Parameters,
    main_text: InterfaceState,
    stepping: Collection[str] = (),
) -> Iterator[tuple[str, Run | str]]:
    """The runs of a study, each with the key it comes from; a string in place of a bad run.

    Parameters
    ----------
    name : str
        The study's name.
    study : dict
        Its section of the configuration, whose values are allowed.
    base : Parameters
        Values of all that the study does not set.
    main_text : InterfaceState
        The main text's rounded interface.
    stepping : collection of str
        What the section of that name gives. If neither it nor the study has an end time, the
        theory says when an event is overdue.
    """
    settings, asked = study_settings(study), list(_given(name, study))
    prepared: list[_Prepared | ParameterError] = []
    for _, parts in asked:
        try:
            of_study, of_entry, varied = map(by_study_name, parts)
            values = of_study | of_entry | varied
            fault = _fault(settings, values, base, main_text)
            prepared.append(_Prepared(*fault, varied, values))
        except ParameterError as error:
            prepared.append(error)
    lengths = _theory_lengths(run[:2] for run in prepared if isinstance(run, _Prepared))
    batches = _batches(name, len(asked), settings.runs_per_job)
    for (key, _), batch, run in zip(asked, batches, prepared, strict=True):
        try:
            if isinstance(run, ParameterError):
                raise run
            yield key, _run(name, settings, run, next(lengths), batch, stepping)
        except ParameterError as error:
            yield key, str(error)


def _batches(study: str, runs: int, per_job: int) -> list[str]:
    """The name of the batch of each run, empty if it has a job of its own.

    Runs are drawn, so that all batches take about the same time: neighbours in a study are alike,
    and so are runs at any fixed distance.
    """
    if per_job == 1:
        return [""] * runs
    batches = -(-runs // per_job)
    draw = random.Random(runs).random  # the same numbers in every Python
    drawn = sorted((draw(), number) for number in range(runs))
    place = {number: rank % batches for rank, (_, number) in enumerate(drawn)}
    return [f"{study}-{place[number]:0{len(str(batches - 1))}d}" for number in range(runs)]


def _given(name: str, study: dict[str, Any]) -> Iterator[tuple[str, tuple[dict[str, Any], ...]]]:
    """Place of each run, with what the study, the entry and the run itself give for it."""
    for number, entry in enumerate(study["runs"]):
        usual = study.get("defaults", {}), entry.get("defaults", {})
        values = {name: expand(value) for name, value in entry.items() if name != "defaults"}
        for chosen in itertools.product(*values.values()):
            own = dict(zip(values, chosen, strict=True))
            yield f"studies.{name}.runs[{number}]", (*usual, own)


class _Prepared(NamedTuple):
    """A run whose block has no length yet."""

    parameters: Parameters
    interface: InterfaceState
    varied: dict[str, Any]
    values: dict[str, Any]  # all that the study gives


def _fault(
    settings: StudySettings, values: dict[str, Any], base: Parameters, main_text: InterfaceState
) -> tuple[Parameters, InterfaceState]:
    """Parameters with values of a study, by their names there, and the theory's interface."""
    if "height" not in values:
        raise ParameterError("the run has no height: give it here or in the study's defaults")
    parameters = base.replaced({k: v for k, v in values.items() if k not in CONSTANTS})
    loading = parameters.loading
    friction = with_constants(parameters.friction, loading.velocity, values)
    parameters = replace(parameters, friction=friction)
    _ = friction.evolution_law  # a file that can't be loaded is told of before any work
    own = linearised(parameters.friction, loading)
    if settings.interface != "main_text":
        return parameters, own
    foreign = not_rounded_from(main_text, own)
    if foreign:
        raise ParameterError(
            f"interface = main_text is not allowed: {foreign}; it must be friction_law, so that "
            "the theory follows from the run's own friction law"
        )
    return parameters, loaded(main_text, loading)


def _theory_lengths(faults: Iterable[tuple[Any, ...]]) -> Iterator[float]:
    """The theory's lengths (m) of all runs of a study in one call, NaN where sliding is stable."""
    cases = [(*bodies_of(parameters), interface) for parameters, interface in faults]
    return iter(theory_lengths(cases).tolist() if cases else [])


def _run(
    study: str, settings: StudySettings, prepared: _Prepared, critical: float, batch: str,
    stepping: Collection[str],
) -> Run:  # fmt: skip
    """One run; its length, unless given, is a multiple of the theory's critical length."""
    parameters, interface, varied, values = prepared
    if math.isnan(critical) and "length" not in values:
        reason = "the theory has no critical length"
        try:
            run_length(parameters, interface)
        except NoInstability as error:
            reason = str(error)
        raise ParameterError(
            f"{reason}; a control run, in which nothing is to nucleate, needs its length (m)"
        )
    length = values.get("length", float(f"{settings.length_over_critical * critical:.4g}"))
    if length <= critical:
        raise ParameterError(
            f"length = {length:g} m is not allowed: the block must be longer than the critical "
            f"nucleation length of the theory, {critical:.3g} m, better 6 times as long; "
            f"`nucleation specimen --length {length:g}m` says at which stress it would nucleate"
        )
    geometry = replace(parameters.geometry, length=float(length))
    parameters = replace(parameters, geometry=geometry)
    parameters.require_consistent()
    if "end_time" not in {*stepping, *values} and not math.isnan(critical):
        parameters = _until_overdue(parameters, critical, {*stepping, *values})
    name = identifier(study, parameters, varied)
    return Run(name, study, parameters, critical, interface, values, batch, settings.role)


def _until_overdue(parameters: Parameters, critical: float, given: Collection[str]) -> Parameters:
    """With an end that is late enough for an event, and soon after it, whenever that comes.

    An estimate of the time for a patch of the theory's critical length is an upper one
    (:func:`nucleation.theory.estimates.growth_time`).
    """
    end = float(f"{LATE * growth_time(parameters, critical):.2g}")
    found = {"end_time": end, "time_after_event": min(AFTER * parameters.memory_time, end)}
    own = {name: value for name, value in found.items() if name not in given}
    return replace(parameters, stepping=replace(parameters.stepping, **own))
