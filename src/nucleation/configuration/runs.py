"""A simulation of a study, with what the study and the theory say of it."""

import dataclasses
from collections.abc import Iterable
from typing import Any

from ..model.friction.constants import CONSTANTS, constants
from ..model.identity import ensemble
from ..model.linearised import InterfaceState
from ..model.parameters import Parameters, names
from ..model.quantities import plain
from .roles import OWN
from .study_names import study_parameters


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
    batch: str = dataclasses.field(default="", compare=False)  # of runs made by one job
    role: str = OWN  # of its study

    def to_dict(self) -> dict[str, Any]:
        """The run as plain nested dictionaries: what it is, not who asks for it."""
        return {
            "id": self.id,
            "study": self.study,
            "role": self.role,
            "parameters": self.parameters.to_dict(),
            "theory_length": self.theory_length,
            "interface": plain(self.interface),
        }

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
            "evolution": self.parameters.friction.evolution,
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


def first_realisations(runs: Iterable[Run]) -> list[Run]:
    """The runs of each study without those that differ from an earlier one in the seed alone."""
    first: dict[tuple[str, str], Run] = {}
    for run in runs:
        first.setdefault((run.study, ensemble(run.parameters)), run)
    return list(first.values())
