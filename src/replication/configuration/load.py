"""The configuration of the workflow: read, checked as a whole, converted to settings and runs.

All problems of a configuration are reported together, each with key, value, unit and range. A
study is expanded into runs when one of them is first used.
"""

import dataclasses
import difflib
import functools
import os
from collections.abc import Hashable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numpy as np

from nucleation.fault.strict_yaml import read_yaml
from nucleation.model.quantities import ParameterError
from nucleation.run.names import read
from nucleation.run.run import PAPER_RUN

from .checks import entries_of, range_problems, stop_on, value_problems, with_numbers
from .contradictions import (
    results_directory,
    results_problems,
    role_problems,
    run_problems,
    setting_problems,
)
from .names import SECTIONS, typed
from .roles import PAPERS, problems_of_studies
from .runs import StudyRun, shown
from .settings import GROUPS, Curves, Settings, StudySettings
from .studies import study_runs

CHECKOUT = Path(__file__).parents[3]
DEFAULTS = (
    CHECKOUT / "config" / "config.yaml",
    CHECKOUT / "config" / "beyond.yaml",
)
"""The default configuration: the paper's, and the studies beyond it."""

_Named = TypeVar("_Named")


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
        default_factory=dict,
        init=False,
        repr=False,
        compare=False,
    )

    @property
    def runs(self) -> tuple[StudyRun, ...]:
        """The runs of all studies, in the configuration's order."""
        return tuple(self._runs_of_all(self.studies))

    def runs_of(self, study: str) -> list[StudyRun]:
        """The runs of one study, none if there is no such study."""
        if study not in self.studies:
            return []
        return list(self._checked(study).runs.values())

    def studies_for(self, *roles: str) -> list[str]:
        """The names of the studies with some roles, in the configuration's order."""
        return [name for name, study in self.studies.items() if study.role in roles]

    def runs_for(self, *roles: str) -> list[StudyRun]:
        """The runs of the studies with some roles."""
        return self._runs_of_all(self.studies_for(*roles))

    def _runs_of_all(self, studies: Iterable[str]) -> list[StudyRun]:
        return [run for study in studies for run in self.runs_of(study)]

    def run(self, identifier: str) -> StudyRun:
        """The run with an identifier such as ``paper-aging-H0.005-phi1``.

        A ParameterError names similar identifiers if there is none.
        """
        study = self._study_in(identifier, "run")
        return _found("run", identifier, self._checked(study).runs, study)

    def batch(self, name: str) -> list[StudyRun]:
        """The runs of the batch with a name such as ``paper-0``; one job makes them."""
        study = self._study_in(name, "batch")
        return list(_found("batch", name, self._checked(study).batches, study))

    def shown(self, height: float) -> StudyRun:
        """The run with the role ``paper`` nearest to a height (m), which figures show."""
        run = shown(self.runs_for(PAPERS), height, self.base)
        if run is None:
            age = self.base.fault.initial_state
            raise ParameterError(
                "no study with role: paper has a run with evolution = "
                f"{self.base.law.evolution} and initial_state = {age:g} s"
            )
        return run

    def drawn_curves(self) -> Curves:
        """The theory's curves, with heights beyond either end of the runs in Figure 3."""
        heights = list(self.curves.heights)
        simulated = [run.run.fault.height for run in self.runs_for(PAPERS)]
        low, high = 0.7 * min(simulated, default=np.inf), 1.15 * max(simulated, default=0.0)
        if low < min(heights):
            heights[:0] = np.geomspace(
                low,
                min(heights),
                20,
                endpoint=False,
            ).tolist()
        if high > max(heights):
            heights += np.geomspace(
                max(heights),
                high,
                21,
            )[1:].tolist()
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
        runs = [run for _, run in found if isinstance(run, StudyRun)]
        problems = list(self._run_problems(found))
        if not problems:
            problems += role_problems(study, self, runs)
        batches: dict[str, list[StudyRun]] = {}
        for run in runs:
            if run.batch:
                batches.setdefault(run.batch, []).append(run)
        by_id = {run.id: run for run in runs}
        return _Expanded(by_id, batches, problems)

    def _run_problems(self, found: Iterable[tuple[str, StudyRun | str]]) -> Iterator[str]:
        """Runs that are invalid, repeated or contradictory."""
        seen: dict[Hashable, str] = {}
        for key, run in found:
            if isinstance(run, str):
                yield f"{key}: {run}"
                continue
            for mark in (run.id, run.run):
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

    A ParameterError if there is no default one, because the library is not in a checkout.
    """
    if not isinstance(values, dict):
        return values
    if "studies" in values:
        return {**values, "studies": _with_paper(values["studies"])}
    in_checkout = all(path.is_file() for path in DEFAULTS)
    if not in_checkout:
        raise ParameterError(
            "the configuration lacks the key studies: only a checkout of the project has the "
            "paper's, in config/config.yaml"
        )
    return _merged(functools.reduce(_merged, map(read_yaml, DEFAULTS)), values)


def _with_paper(studies: Any) -> Any:
    """Studies, where one that has a name of the paper's and no role is that study with changes."""
    if not isinstance(studies, dict):
        return studies
    unnamed = []
    for name, section in studies.items():
        if isinstance(section, dict) and "role" not in section:
            unnamed.append(name)
    if not unnamed or not DEFAULTS[0].is_file():
        return studies
    papers = read_yaml(DEFAULTS[0])["studies"]
    return studies | {name: papers[name] | studies[name] for name in unnamed if name in papers}


def configure(values: Any, *, lazy: bool = False) -> Configuration:
    """Check a configuration in plain dictionaries and convert it to settings and runs.

    A missing key has the paper's value; without ``studies`` the configuration is the default one
    with other values. With `lazy` the runs of a study are checked when they are first used. A
    ParameterError has one line for each problem.
    """
    values = completed(values)
    values = with_numbers(values)
    stop_on(value_problems(values))
    problems = list(range_problems(values))
    problems += results_problems(results_directory(values))
    stop_on(problems)
    settings = _settings(values)
    problems = []
    if not lazy:
        for study in settings.studies:
            problems += settings.problems_of(study)
    problems += problems_of_studies(settings.studies)
    problems += setting_problems(settings)
    stop_on(problems)
    return settings


def _settings(values: Mapping[str, Any]) -> Configuration:
    """The settings in a configuration with allowed values."""
    groups = {}
    for name, cls in GROUPS.items():
        entries = entries_of(name)
        section = values.get(name, {})
        groups[name] = cls(**{key: typed(entries[key], own) for key, own in section.items()})
    given: dict[str, Any] = {}
    for section in SECTIONS:
        given |= values.get(section, {})
    try:
        base = PAPER_RUN.replaced(**read(given))
    except ParameterError as error:  # a parameter that the chosen friction law does not have
        stop_on([str(error)])
    drop = max(base.stepping.event_drop, groups["extraction"].drop)
    base = base.replaced(event_drop=drop)  # runs do not end before the force has dropped so far
    studies = {name: StudySettings.of(section) for name, section in values["studies"].items()}
    return Configuration(
        results=results_directory(values),
        base=base,
        studies=studies,
        sections=values["studies"],
        stepping=tuple(values.get("stepping", ())),
        **groups,
    )
