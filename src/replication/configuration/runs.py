"""Simulations of studies, with the data that the study and the theory give for them."""

import dataclasses
import math
from collections.abc import Iterable, Sequence
from typing import Any

from nucleation.fault import Fault
from nucleation.model.friction.constants import CONSTANTS, constants
from nucleation.run.identity import ensemble
from nucleation.run.names import parameters
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

    def to_dict(self) -> dict[str, Any]:
        """The run as plain nested dictionaries, without its batch."""
        constants = {name: getattr(self.theory, name) for name in ("friction", "a", "zeta")}
        return {
            "id": self.id,
            "study": self.study,
            "role": self.role,
            "parameters": self.run.to_dict(),
            "critical_length": self.critical_length,
            "theory": constants,
        }

    def value(self, name: str) -> Any:
        """The value of a parameter, given by the study or not; None if the run does not have it."""
        if name in self.given:
            return self.given[name]
        if name in CONSTANTS:
            return constants(self.run.law, self.run.fault.velocity)[name]
        return self.run.to_dict().get(name)

    @property
    def labels(self) -> dict[str, Any]:
        """Study, evolution law, height (m) and initial_state (s), which label the run in tables."""
        return {
            "study": self.study,
            "evolution": self.run.law.evolution,
            "height": self.run.fault.height,
            "initial_state": self.run.fault.initial_state,
        }


def varied(runs: Iterable[StudyRun]) -> dict[str, list[Any]]:
    """The parameters that differ among runs of a study, each with the values of the runs in order.

    Only parameters that the study gives count, not a block length that follows from the theory.
    """
    runs = list(runs)
    given = [name for name in parameters() if any(name in run.given for run in runs)]
    given.sort(key=lambda name: name != "height")  # the height comes first
    found = {}
    for name in given:
        values = [run.value(name) for run in runs]
        if len(set(values)) > 1:
            found[name] = values
    return found


def first_realisations(runs: Iterable[StudyRun]) -> list[StudyRun]:
    """The runs of each study without those that differ from an earlier one only in the seed."""
    first: dict[tuple[str, str], StudyRun] = {}
    for run in runs:
        first.setdefault((run.study, ensemble(run.run)), run)
    return list(first.values())


def shown(runs: Sequence[StudyRun], height: float, base: Run) -> StudyRun | None:
    """The run that figures show: nearest to a height (m), with the configuration's law and state.

    None if there is no run with its evolution law and initial state.
    """
    wanted = {"evolution": base.law.evolution, "initial_state": base.fault.initial_state}
    usual = [run for run in runs if wanted.items() <= run.labels.items()]
    distance = {run.id: abs(math.log(run.labels["height"] / height)) for run in usual}
    return min(usual, key=lambda run: distance[run.id], default=None)
