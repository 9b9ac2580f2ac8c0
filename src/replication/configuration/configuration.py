"""The checked configuration; a study is expanded into runs when one of them is first used."""

import dataclasses
import difflib
from collections.abc import Hashable, Iterable, Iterator, Mapping
from typing import NamedTuple, TypeVar

import numpy as np

from nucleation.model.quantities import ParameterError
from nucleation.theory.settings import Curves

from .contradictions import run_problems
from .refusals import stop_on
from .role_problems import problems_of_runs
from .roles import PAPERS
from .runs import Run, shown
from .settings import Settings
from .studies import study_runs

_Named = TypeVar("_Named")


class _Expanded(NamedTuple):
    """The runs of a study."""

    runs: dict[str, Run]  # by their ids
    batches: dict[str, list[Run]]  # by their names
    problems: list[str]


@dataclasses.dataclass(frozen=True)
class Configuration(Settings):
    """Everything the workflow does.

    A study is expanded into its runs when one of them is first used, and the runs are kept.
    Methods that return runs raise a ParameterError with all problems of the study if it has any.
    """

    _kept: dict[str, _Expanded] = dataclasses.field(
        default_factory=dict,
        init=False,
        repr=False,
        compare=False,
    )

    @property
    def runs(self) -> tuple[Run, ...]:
        """The runs of all studies, in the configuration's order."""
        return tuple(self._runs_of_all(self.studies))

    def runs_of(self, study: str) -> list[Run]:
        """The runs of one study, none if there is no such study."""
        if study not in self.studies:
            return []
        expanded = self._checked(study)
        return list(expanded.runs.values())

    def studies_for(self, *roles: str) -> list[str]:
        """The names of the studies with some roles, in the configuration's order."""
        return [name for name, study in self.studies.items() if study.role in roles]

    def runs_for(self, *roles: str) -> list[Run]:
        """The runs of the studies with some roles."""
        studies = self.studies_for(*roles)
        return self._runs_of_all(studies)

    def _runs_of_all(self, studies: Iterable[str]) -> list[Run]:
        runs = []
        for study in studies:
            runs += self.runs_of(study)
        return runs

    def run(self, identifier: str) -> Run:
        """The run with an identifier such as ``paper-aging-H0.005-phi1``.

        Raises
        ------
        ParameterError
            If there is none; the message names similar identifiers.
        """
        study = self._study_in(identifier, "run")
        runs = self._checked(study).runs
        return _found("run", identifier, runs, study)

    def batch(self, name: str) -> list[Run]:
        """The runs of the batch with a name such as ``paper-0``; one job makes them.

        Raises
        ------
        ParameterError
            If there is none; the message names similar names.
        """
        study = self._study_in(name, "batch")
        batches = self._checked(study).batches
        return list(_found("batch", name, batches, study))

    def shown(self, height: float) -> Run:
        """The run with the role ``paper`` nearest to a height (m), which figures show.

        Raises
        ------
        ParameterError
            If there is none.
        """
        runs = self.runs_for(PAPERS)
        run = shown(runs, height, self.base)
        if run is None:
            law = self.base.friction.evolution
            age = self.base.loading.initial_state
            raise ParameterError(
                f"no study with role: paper has a run with evolution = {law} and initial_state = "
                f"{age:g} s"
            )
        return run

    def drawn_curves(self) -> Curves:
        """The theory's curves, with heights beyond either end of the runs in Figure 3."""
        heights = list(self.curves.heights)
        simulated = [run.parameters.geometry.height for run in self.runs_for(PAPERS)]
        low, high = 0.7 * min(simulated, default=np.inf), 1.15 * max(simulated, default=0.0)
        if low < min(heights):
            heights[:0] = np.geomspace(low, min(heights), 20, endpoint=False).tolist()
        if high > max(heights):
            heights += np.geomspace(max(heights), high, 21)[1:].tolist()
        return dataclasses.replace(self.curves, heights=tuple(heights))

    def problems_of(self, study: str) -> list[str]:
        """The problems with the runs of a study, one line for each."""
        return self._expanded(study).problems

    def _checked(self, study: str) -> _Expanded:
        expanded = self._expanded(study)
        stop_on(expanded.problems)
        return expanded

    def _expanded(self, study: str) -> _Expanded:
        if study not in self._kept:
            self._kept[study] = self._expand(study)
        return self._kept[study]

    def _expand(self, study: str) -> _Expanded:
        found = list(study_runs(study, self))
        runs = [run for _, run in found if isinstance(run, Run)]
        problems = list(self._run_problems(found))
        if not problems:
            problems += problems_of_runs(study, self.studies[study], runs)
        batches: dict[str, list[Run]] = {}
        for run in runs:
            if run.batch:
                batches.setdefault(run.batch, []).append(run)
        by_id = {run.id: run for run in runs}
        return _Expanded(by_id, batches, problems)

    def _run_problems(
        self,
        found: Iterable[tuple[str, Run | str]],
    ) -> Iterator[str]:
        """Runs that are invalid, repeated or contradictory."""
        seen: dict[Hashable, str] = {}
        for key, run in found:
            if isinstance(run, str):
                yield f"{key}: {run}"
                continue
            for mark in (run.id, run.parameters):
                if mark in seen:
                    yield f"{key} gives the simulation {run.id} again, after {seen[mark]}"
                seen[mark] = key
            yield from run_problems(key, run, self.limits, self.extraction)

    def _study_in(self, name: str, kind: str) -> str:
        """The study at the start of the name of a run or of a batch."""
        study = name.partition("-")[0]
        if study in self.studies:
            return study
        close = difflib.get_close_matches(study, self.studies, n=1)
        listed = ", ".join(self.studies)
        hint = f"did you mean {close[0]}?" if close else f"studies: {listed}"
        raise ParameterError(f"there is no {kind} {name}, as there is no study {study}; {hint}")


def _found(
    kind: str,
    name: str,
    known: Mapping[str, _Named],
    study: str,
) -> _Named:
    """The run or the batch of a study with a name."""
    if name in known:
        return known[name]
    close = difflib.get_close_matches(name, known, n=3)
    if not known:
        hint = f"the study {study} has none"
    elif close:
        hint = f"did you mean {' or '.join(close)}?"
    else:
        example = next(iter(known))
        hint = f"those of the study {study} have names like {example}"
    raise ParameterError(f"there is no {kind} {name}; {hint}")
