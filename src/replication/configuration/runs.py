"""Simulations of studies, with the data that the study and the theory give for them."""

import dataclasses
import math
from collections.abc import Iterable, Sequence
from typing import Any

from nucleation.model.friction.constants import CONSTANTS, constants
from nucleation.model.identity import ensemble
from nucleation.model.linearised import InterfaceState
from nucleation.model.parameters import Parameters, names
from nucleation.model.quantities import plain

from .roles import OWN
from .study_names import study_parameters


@dataclasses.dataclass(frozen=True)
class Run:
    """One simulation of a study, with the length that the linear theory predicts for it (m).

    The length is NaN where homogeneous sliding is stable: a control run.
    """

    id: str
    study: str
    parameters: Parameters
    critical_length: float = dataclasses.field(compare=False)  # follows from the others; NaN != NaN
    interface: InterfaceState = InterfaceState()
    """Friction of the theory."""

    given: dict[str, Any] = dataclasses.field(default_factory=dict, compare=False)
    """Values that the study gives, by name."""

    batch: str = dataclasses.field(default="", compare=False)
    """Name of the batch of runs that one job makes."""

    role: str = OWN
    """Role of the study."""

    def to_dict(self) -> dict[str, Any]:
        """The run as plain nested dictionaries, without its batch."""
        return {
            "id": self.id,
            "study": self.study,
            "role": self.role,
            "parameters": self.parameters.to_dict(),
            "critical_length": self.critical_length,
            "interface": plain(self.interface),
        }

    def value(self, name: str) -> Any:
        """The value of a parameter of studies, given by the study or not.

        None if the run's friction law does not have the parameter.
        """
        if name in self.given:
            return self.given[name]
        if name in CONSTANTS:
            velocity = self.parameters.loading.velocity
            return constants(self.parameters.friction, velocity)[name]
        full = names().full(name)
        return self.parameters.named().get(full)

    @property
    def labels(self) -> dict[str, Any]:
        """Study, evolution law, height (m) and initial_state (s), which label the run in tables."""
        return {
            "study": self.study,
            "evolution": self.parameters.friction.evolution,
            "height": self.parameters.geometry.height,
            "initial_state": self.parameters.loading.initial_state,
        }


def varied(runs: Iterable[Run]) -> dict[str, list[Any]]:
    """The parameters that differ among runs of a study, each with the values of the runs in order.

    Only parameters that the study gives count, not a block length that follows from the theory.
    """
    runs = list(runs)
    given = [name for name in study_parameters() if any(name in run.given for run in runs)]
    given.sort(key=lambda name: name != "height")  # the height comes first
    found = {}
    for name in given:
        values = [run.value(name) for run in runs]
        if len(set(values)) > 1:
            found[name] = values
    return found


def first_realisations(runs: Iterable[Run]) -> list[Run]:
    """The runs of each study without those that differ from an earlier one only in the seed."""
    first: dict[tuple[str, str], Run] = {}
    for run in runs:
        key = run.study, ensemble(run.parameters)
        first.setdefault(key, run)
    return list(first.values())


def shown(runs: Sequence[Run], height: float, base: Parameters) -> Run | None:
    """The run that figures show: nearest to a height (m), with the configuration's law and state.

    None if there is no run with its evolution law and initial state.
    """
    wanted = {
        "evolution": base.friction.evolution,
        "initial_state": base.loading.initial_state,
    }
    usual = [run for run in runs if wanted.items() <= run.labels.items()]
    distance = {run.id: abs(math.log(run.labels["height"] / height)) for run in usual}
    return min(usual, key=lambda run: distance[run.id], default=None)
