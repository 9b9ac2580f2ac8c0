"""Simulations of studies, with the data that the study and the theory give for them."""

import dataclasses
from collections.abc import Iterable, Mapping
from functools import cached_property
from typing import Any

from nucleation.fault import Fault
from nucleation.fault.parameters import parameters, sections
from nucleation.model.friction.constants import CONSTANTS, constants_of
from nucleation.run.derived import ensemble
from nucleation.run.run import Run

from .roles import OWN


@dataclasses.dataclass(frozen=True)
class StudyRun:
    """One run of a study, with the length that the linear theory predicts for it (m).

    The length is NaN where homogeneous sliding is stable: a control run.
    """

    id: str
    study: str
    run: Run
    critical_length: float = dataclasses.field(compare=False)  # follows from the others; NaN != NaN
    theory: Fault
    """The fault of the theory, possibly with rounded friction."""

    given: dict[str, Any] = dataclasses.field(default_factory=dict, compare=False)
    """Values that the study gives, by name."""

    batch: str = dataclasses.field(default="", compare=False)
    """Name of the batch of runs that one job makes."""

    role: str = OWN
    """Role of the study."""

    @cached_property
    def parameters(self) -> dict[str, Any]:
        """All parameters by name, in SI units."""
        return self.run.to_dict()

    def to_dict(self) -> dict[str, Any]:
        """The run as plain nested dictionaries, without its batch."""
        constants = {name: getattr(self.theory, name) for name in ("friction", "a", "zeta")}
        return {
            "id": self.id,
            "study": self.study,
            "role": self.role,
            "parameters": self.parameters,
            "critical_length": self.critical_length,
            "theory": constants,
        }

    def value(self, name: str) -> Any:
        """The value of a parameter, given by the study or not; None if the run does not have it."""
        if name in self.given:
            return self.given[name]
        if name in CONSTANTS:
            return constants_of(self.run.law, self.run.fault.velocity)[name]
        return self.parameters.get(name)

    @property
    def labels(self) -> dict[str, Any]:
        """Study, evolution law, height (m) and initial_state (s), which label the run in tables."""
        return {
            "study": self.study,
            "evolution": self.run.law.evolution,
            "height": self.run.fault.height,
            "initial_state": self.run.fault.initial_state,
        }


def identifier(study: str, run: Run, varied: Mapping[str, Any]) -> str:
    """Readable, file-name-safe name of a run, such as ``paper-aging-H0.005-phi1-n_x800``.

    It has the study, the evolution law, the height (m), the initial state (s) and the other varied
    values. Their order does not depend on the configuration: sections are in their order, in a
    section words come before numbers, then the names are sorted; constants come last.
    """
    groups = list(sections().values())

    def position(name: str) -> tuple[int, bool, str]:
        group = next((i for i, names in enumerate(groups) if name in names), len(groups))
        return group, not parameters()[name].choices, name

    first = {"H": run.fault.height, "phi": run.fault.initial_state}
    others = varied.keys() - {"evolution", "height", "initial_state"}
    values = first | {name: varied[name] for name in sorted(others, key=position)}
    parts = [study, run.law.evolution]
    for name, value in values.items():
        if value is None:
            text = "same"  # as the first body's
        elif isinstance(value, str):
            text = value
        else:  # a number in its shortest form without a plus sign, 4e9 for 4.0e+9
            mantissa, _, exponent = f"{value:.12g}".partition("e")
            text = f"{mantissa}e{int(exponent)}" if exponent else mantissa
        parts.append(name + text)
    return "-".join(parts)


def varied(runs: Iterable[StudyRun]) -> dict[str, list[Any]]:
    """The parameters that differ among runs of a study, each with the values of the runs in order.

    Only parameters that the study gives count, not a block length that follows from the theory.
    """
    runs = list(runs)
    given = [name for name in parameters() if any(name in run.given for run in runs)]
    given.sort(key=lambda name: name != "height")  # the height comes first
    found = {name: [run.value(name) for run in runs] for name in given}
    return {name: values for name, values in found.items() if len(set(values)) > 1}


def first_realisations(runs: Iterable[StudyRun]) -> list[StudyRun]:
    """The runs of each study without those that differ from an earlier one only in the seed."""
    first: dict[tuple[str, str], StudyRun] = {}
    for run in runs:
        first.setdefault((run.study, ensemble(run.run)), run)
    return list(first.values())
