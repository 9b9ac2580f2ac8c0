"""The configuration of the workflow: read, checked as a whole, converted to settings and runs.

All problems of a configuration are reported together, each with key, value, unit and range. A
study is expanded into runs when one of them is first used.
"""

import dataclasses
import difflib
import functools
import math
import os
from collections.abc import Hashable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from nucleation.fault.files import read_yaml
from nucleation.model.quantities import ParameterError
from nucleation.run.run import PAPER_RUN

from .checks import Reader, problems_of_run, results_problem, setting_problems, stop_on
from .roles import PAPERS, ROLES, problems_of_studies
from .runs import StudyRun
from .settings import GROUPS, SECTIONS, Curves, Settings, StudySettings
from .studies import study_runs

CHECKOUT = Path(__file__).parents[3]
DEFAULTS = (CHECKOUT / "config" / "config.yaml", CHECKOUT / "config" / "beyond.yaml")
"""The default configuration: the paper's, and the studies beyond it."""


OF_RUNS = ("fault", "defaults", "runs")
"""The keys of a study that say which runs it has."""


class _Expanded(NamedTuple):
    """The runs of a study."""

    runs: dict[str, StudyRun]  # by their ids
    batches: dict[str, list[StudyRun]]  # by their names
    problems: list[str]


@dataclasses.dataclass(frozen=True)
class Configuration(Settings):
    """Everything the workflow does.

    Methods that return runs raise a ParameterError with all problems of the study if it has any.
    """

    _kept: dict[str, _Expanded] = dataclasses.field(
        default_factory=dict, init=False, repr=False, compare=False
    )

    @property
    def runs(self) -> tuple[StudyRun, ...]:
        """The runs of all studies, in the configuration's order."""
        return tuple(run for study in self.studies for run in self.runs_of(study))

    def runs_of(self, study: str) -> list[StudyRun]:
        """The runs of one study, none if there is no such study."""
        return list(self._checked(study).runs.values()) if study in self.studies else []

    def studies_for(self, *roles: str) -> list[str]:
        """The names of the studies with some roles, in the configuration's order."""
        return [name for name, study in self.studies.items() if study.role in roles]

    def runs_for(self, *roles: str) -> list[StudyRun]:
        """The runs of the studies with some roles."""
        return [run for study in self.studies_for(*roles) for run in self.runs_of(study)]

    def run(self, identifier: str) -> StudyRun:
        """The run with an identifier such as ``paper-aging-H0.005-phi1``.

        A ParameterError names similar identifiers if there is none.
        """
        run: StudyRun = self._named("run", identifier)
        return run

    def batch(self, name: str) -> list[StudyRun]:
        """The runs of the batch with a name such as ``paper-0``; one job makes them."""
        return list(self._named("batch", name))

    def _named(self, kind: str, name: str) -> Any:
        """The run or the batch with a name, which begins with the study's."""
        study = name.partition("-")[0]
        known: dict[str, Any] = {}
        if study in self.studies:
            expanded = self._checked(study)
            known = expanded.runs if kind == "run" else expanded.batches
        if name not in known:
            close = difflib.get_close_matches(name, known, n=3)
            of = f"the study {study} has {', '.join(close or list(known)[:3]) or 'none'}"
            hint = of if study in self.studies else f"studies: {', '.join(self.studies)}"
            raise ParameterError(f"there is no {kind} {name}; {hint}")
        return known[name]

    def shown(self, height: float) -> StudyRun:
        """The run that figures show: of the role ``paper``, the nearest to a height (m).

        It has the configuration's evolution law and initial state.
        """
        law, age = self.base.law.evolution, self.base.fault.initial_state
        wanted = {"evolution": law, "initial_state": age}
        usual = [run for run in self.runs_for(PAPERS) if wanted.items() <= run.labels.items()]
        if not usual:
            raise ParameterError(
                f"no study with role: paper has a run with evolution = {law} and "
                f"initial_state = {age:g} s"
            )
        return min(usual, key=lambda run: abs(math.log(run.run.fault.height / height)))

    def drawn_curves(self) -> Curves:
        """The theory's curves, with heights beyond either end of the runs in Figure 3."""
        heights = self.curves.heights
        simulated = [run.run.fault.height for run in self.runs_for(PAPERS)]
        low = min(*heights, *(0.7 * height for height in simulated))
        high = max(*heights, *(1.15 * height for height in simulated))
        if (low, high) != (min(heights), max(heights)):
            heights = tuple(np.geomspace(low, high, 120).tolist())
        return dataclasses.replace(self.curves, heights=heights)

    def problems_of(self, study: str) -> list[str]:
        """The problems with the runs of a study, one line for each."""
        if study not in self._kept:
            self._kept[study] = self._expanded(study)
        return self._kept[study].problems

    def _checked(self, study: str) -> _Expanded:
        stop_on(self.problems_of(study))
        return self._kept[study]

    def _expanded(self, study: str) -> _Expanded:
        """The runs of a study, and those that are invalid, repeated, contradictory or missing."""
        problems: list[str] = []
        runs: dict[str, StudyRun] = {}
        batches: dict[str, list[StudyRun]] = {}
        seen: dict[Hashable, str] = {}
        for key, run in study_runs(study, self):
            if isinstance(run, str):
                problems.append(f"{key}: {run}")
                continue
            for mark in (run.id, run.run):
                if mark in seen:
                    again = f"{key} gives the simulation {run.id} again, after {seen[mark]}"
                    problems.append(again)
                seen[mark] = key
            problems += problems_of_run(key, run, self)
            runs[run.id] = run
            if run.batch:
                batches.setdefault(run.batch, []).append(run)
        role = self.studies[study].role
        for need in () if problems else ROLES[role].runs:
            wrong = [run for run in runs.values() if not need.allowed(run.value(need.name))]
            for run in wrong[:1]:  # the first run shows the problem
                place = f"studies.{study}: {run.id}: {need.name}"
                problems.append(need.refusal(place, run.value(need.name), role))
        return _Expanded(runs, batches, problems)


def load(*paths: str | os.PathLike[str], lazy: bool = False) -> Configuration:
    """The configuration in YAML files, or the default one of the checkout without a file.

    Values of a file replace those of the files before it; `lazy` is that of :func:`configure`.
    """
    layers = map(read_yaml, paths)
    values = functools.reduce(_merged, layers) if paths else {}
    return configure(values, lazy=lazy)


def _merged(first: Any, later: Any) -> Any:
    """Two configurations as one, as Snakemake merges its files: later values replace earlier."""
    if not isinstance(first, dict) or not isinstance(later, dict):
        return later
    merged = {**first, **later}
    for key in first.keys() & later.keys():
        merged[key] = _merged(first[key], later[key])
    return merged


def completed(values: Any) -> Any:
    """A configuration with studies: those of the default one if it has none itself.

    A study that has a name of the paper's and no role is that study with changes.
    """
    if not isinstance(values, dict):
        return values
    if "studies" not in values:
        return _merged(functools.reduce(_merged, map(read_yaml, DEFAULTS)), values)
    studies = values["studies"]
    if not isinstance(studies, dict):
        return values
    changed = {
        name: section
        for name, section in studies.items()
        if isinstance(section, dict) and "role" not in section
    }
    papers = read_yaml(DEFAULTS[0])["studies"] if changed else {}
    named = {name: papers[name] | changed[name] for name in changed if name in papers}
    return {**values, "studies": studies | named}


def configure(values: Any, *, lazy: bool = False) -> Configuration:
    """Check a configuration in plain dictionaries and convert it to settings and runs.

    A missing key has the paper's value; without ``studies`` the configuration is the default one
    with other values. With `lazy` the runs of a study are checked when they are first used. A
    ParameterError has one line for each problem.
    """
    reader = Reader()
    values = reader.configuration(completed(values))
    stop_on(reader.problems)
    results = os.path.normpath(values.get("results", "results"))
    stop_on(filter(None, [results_problem(results)]))
    groups = {name: cls(**values.get(name, {})) for name, cls in GROUPS.items()}
    given: dict[str, Any] = {}
    for section in SECTIONS:
        given |= values.get(section, {})
    try:
        base = PAPER_RUN.replaced(**given)
    except ParameterError as error:  # a parameter that the chosen friction law does not have
        stop_on([str(error)])
    drop = max(base.stepping.event_drop, groups["extraction"].drop)
    base = base.replaced(event_drop=drop)  # runs do not end before the force has dropped so far
    studies = {}
    for name, section in values["studies"].items():
        own = {key: value for key, value in section.items() if key not in OF_RUNS}
        studies[name] = StudySettings(**own)
    settings = Configuration(
        results=results,
        base=base,
        studies=studies,
        sections=values["studies"],
        given=tuple(given),
        **groups,
    )
    problems = []
    for study in () if lazy else studies:
        problems += settings.problems_of(study)
    stop_on([*problems, *problems_of_studies(studies), *setting_problems(settings)])
    return settings
