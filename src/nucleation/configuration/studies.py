"""Studies: named sets of simulations over lists or ranges of parameters, one `Run` for each."""

from __future__ import annotations

import dataclasses
import itertools
import math
from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

import numpy as np

from ..model.friction.constants import CONSTANTS, constants, with_constants
from ..model.linearised import (
    InterfaceState,
    linearised,
    loaded,
)
from ..model.parameters import Parameters, names
from ..model.quantities import Checked, ParameterError, Quantity, quantity
from ..theory.critical import NoInstability, run_length, theory_lengths
from ..theory.transfer import bodies_of
from .study_names import by_study_name, identifier, study_parameters

RANGE: dict[str, Quantity] = {
    "num": Quantity("number of values", low=2, high=10000, closed="both", kind="int"),
    "scale": Quantity("spacing of the values", choices=("linear", "log")),
}
"""Keys of a range beside ``start`` and ``stop``, which have the parameter's own declaration."""

LARGEST_GRID = 10000
"""Simulations that one entry of a study may stand for."""


@dataclasses.dataclass(frozen=True)
class StudySettings(Checked):
    """What a study says once for all of its runs."""

    description: str = quantity("what the study is for", default="a set of simulations")
    length_over_critical: float = quantity(
        "block length over the theory's critical length, unless a run gives its length",
        low=1.0, high=1000.0, default=6.0, symbol="L/L_c",
    )  # fmt: skip
    interface: str = quantity(
        "linearised friction of the theory: the rounded values of the group main_text_interface, "
        "or each run's own friction law expanded at its velocity",
        choices=("main_text", "friction_law"), default="friction_law",
    )  # fmt: skip
    table: str = quantity(
        "where its lengths go: with the other studies into lengths.csv, and so into the targets "
        "lengths and simulations; or into its own table alone",
        choices=("lengths", "own"), default="lengths",
    )  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Run:
    """One simulation of a study, with the length the linear theory predicts for it (m).

    The length is NaN where homogeneous sliding is stable: a control run.
    """

    id: str
    study: str
    parameters: Parameters
    theory_length: float
    interface: InterfaceState = InterfaceState()  # friction of the theory
    given: dict[str, Any] = dataclasses.field(default_factory=dict, compare=False)  # by the study

    def to_dict(self) -> dict[str, Any]:
        """The run as plain nested dictionaries."""
        return {k: v for k, v in dataclasses.asdict(self).items() if k != "given"}

    def value(self, name: str) -> Any:
        """What a parameter of studies is in this run, also if its study doesn't give it."""
        if name in self.given:
            return self.given[name]
        friction, loading = self.parameters.friction, self.parameters.loading
        if name in CONSTANTS:
            return constants(friction, loading.velocity)[name]
        return self.parameters.named().get(names().full(name))  # None: its law has no such thing

    @property
    def labels(self) -> dict[str, Any]:
        """What tells runs apart: study, law, height (m) and phi0 (s)."""
        return {
            "study": self.study,
            "law": self.parameters.friction.evolution,
            "height": self.parameters.geometry.height,
            "phi0": self.parameters.loading.initial_state,
        }


def varied(runs: Iterable[Run]) -> dict[str, list[Any]]:
    """The parameters that differ among runs of a study, each with its values in their order.

    Only what the study gives is looked at: a block's length that follows from the theory is not.
    """
    runs = list(runs)
    given = [name for name in study_parameters() if any(name in run.given for run in runs)]
    given.sort(key=lambda name: name != "height")  # first
    values = {name: [run.value(name) for run in runs] for name in given}
    return {name: found for name, found in values.items() if len(set(found)) > 1}


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
    curves = {}
    for i, run in enumerate(runs):
        kind = ", ".join(str(found[word][i]) for word in words)
        ends = [x for j, x in enumerate(found[name])
                if all(found[word][j] == found[word][i] for word in words)]  # fmt: skip
        if kind in curves or name not in run.given or len(ends) < 2:
            continue
        low, high = min(ends), max(ends)
        spaced = np.geomspace if low > 0.0 else np.linspace
        x = spaced(low, high, CURVE_POINTS).tolist()
        cases = [_prepared(settings, [], run.given | {name: value}, base, main_text) for value in x]
        rounded = [float(f"{length:.8g}") for length in _theory_lengths(cases)]
        curves[kind] = {"x": [float(f"{value:.8g}") for value in x], "length": rounded}
    return curves


def first_realisations(runs: Iterable[Run]) -> list[Run]:
    """The runs without those that differ from an earlier one in the declared seed alone."""
    faults: dict[Any, Run] = {}
    for run in runs:
        faults.setdefault((run.study, run.parameters.replaced({"perturbation.seed": 0})), run)
    return list(faults.values())


def expand(value: Any) -> tuple[Any, ...]:
    """The values meant by a value, a list of values or a range, in the order given.

    Values of a range are rounded to six significant digits, which identifiers then state exactly.
    """
    if isinstance(value, list):
        return tuple(value)
    if not isinstance(value, dict):
        return (value,)
    spaced = np.geomspace if value.get("scale", "linear") == "log" else np.linspace
    return tuple(float(f"{x:.6g}") for x in spaced(value["start"], value["stop"], value["num"]))


def grid_size(entry: dict[str, Any]) -> int:
    """The number of simulations that an entry of a study stands for."""
    return math.prod(
        value["num"] if isinstance(value, dict) else len(value) if isinstance(value, list) else 1
        for key, value in entry.items()
        if key != "defaults"
    )


def range_problem(value: Any) -> str | None:
    """Why a range can't be expanded, or None."""
    if not isinstance(value, dict):
        return None
    if not value["start"] < value["stop"]:
        return f"start {value['start']!r} must be less than stop {value['stop']!r}"
    if value.get("scale") == "log" and not value["start"] > 0.0:
        return f"start {value['start']!r} must be positive on a log scale"
    if len(set(expand(value))) < value["num"]:
        return f"its {value['num']} values from {value['start']!r} on are not all different"
    return None


def study_settings(study: dict[str, Any]) -> StudySettings:
    """The settings in a study's section of the configuration."""
    return StudySettings(**{k: v for k, v in study.items() if k not in ("defaults", "runs")})


def study_runs(
    name: str, study: dict[str, Any], base: Parameters, main_text: InterfaceState
) -> Iterator[tuple[str, Run | str]]:
    """The runs of a study, each with the key it comes from; a string in place of a bad run.

    Parameters
    ----------
    name : str
        The study's name.
    study : dict
        Its section of the configuration, valid against the schema.
    base : Parameters
        Values of all that the study does not set.
    main_text : InterfaceState
        The main text's rounded interface.
    """
    settings = study_settings(study)
    defaults = study.get("defaults", {})
    prepared: list[tuple[str, _Prepared | str]] = []
    for number, entry in enumerate(study["runs"]):
        key = f"studies.{name}.runs[{number}]"
        given = {name: value for name, value in entry.items() if name != "defaults"}
        usual = [defaults, entry.get("defaults", {})]
        for values in itertools.product(*map(expand, given.values())):
            varied = dict(zip(given, values, strict=True))
            try:
                prepared.append((key, _prepared(settings, usual, varied, base, main_text)))
            except ParameterError as error:
                prepared.append((key, str(error)))
    lengths = _theory_lengths(run for _, run in prepared if isinstance(run, _Prepared))
    for key, run in prepared:
        try:
            yield key, run if isinstance(run, str) else _run(name, settings, run, next(lengths))
        except ParameterError as error:
            yield key, str(error)


class _Prepared(NamedTuple):
    """A run whose block has no length yet."""

    varied: dict[str, Any]
    values: dict[str, Any]  # all that the study gives
    parameters: Parameters
    interface: InterfaceState


def _prepared(
    settings: StudySettings,
    defaults: Iterable[dict[str, Any]],
    varied: dict[str, Any],
    base: Parameters,
    main_text: InterfaceState,
) -> _Prepared:
    varied = by_study_name(varied)
    values: dict[str, Any] = {}
    for given in (*defaults, varied):
        values |= by_study_name(given)
    if "height" not in values:
        raise ParameterError("the run has no height: give it here or in the study's defaults")
    parameters = base.replaced({k: v for k, v in values.items() if k not in CONSTANTS})
    loading = parameters.loading
    friction = with_constants(parameters.friction, loading.velocity, values)
    parameters = dataclasses.replace(parameters, friction=friction)
    if settings.interface == "main_text":
        interface = loaded(main_text, loading)
    else:
        interface = linearised(parameters.friction, loading)
    return _Prepared(varied, values, parameters, interface)


def _theory_lengths(runs: Iterable[_Prepared]) -> Iterator[float]:
    """The theory's lengths (m) of all runs of a study in one call, NaN where sliding is stable."""
    cases = [(*bodies_of(run.parameters), run.interface) for run in runs]
    return iter(theory_lengths(cases).tolist() if cases else [])


def _reason(parameters: Parameters, interface: InterfaceState) -> str:
    """Why the theory knows no critical length."""
    try:
        run_length(parameters, interface)
    except NoInstability as error:
        return str(error)
    return "the theory has no critical length"


def _run(study: str, settings: StudySettings, prepared: _Prepared, critical: float) -> Run:
    """One run; its length, unless given, is a multiple of the theory's critical length."""
    varied, values, parameters, interface = prepared
    if math.isnan(critical) and "length" not in values:
        raise ParameterError(
            f"{_reason(parameters, interface)}; a control run, in which nothing is to nucleate, "
            "needs its length (m)"
        )
    length = values.get("length", float(f"{settings.length_over_critical * critical:.4g}"))
    if length <= critical:
        raise ParameterError(
            f"length = {length:g} m is not allowed: the block must be longer than the critical "
            f"nucleation length of the theory, {critical:.3g} m, better 6 times as long"
        )
    geometry = dataclasses.replace(parameters.geometry, length=float(length))
    parameters = dataclasses.replace(parameters, geometry=geometry)
    run = Run("", study, parameters, critical, interface, values)
    return dataclasses.replace(run, id=identifier(study, run.labels, varied))
