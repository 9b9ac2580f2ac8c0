"""Studies and runs that do not fulfil the requirements of their roles."""

from collections.abc import Iterator, Mapping, Sequence

from .roles import ROLES
from .runs import Run
from .settings import StudySettings

_Problems = Iterator[str]


def problems_of_studies(studies: Mapping[str, StudySettings]) -> _Problems:
    """Settings of studies that contradict their roles, a line for each.

    Parameters
    ----------
    studies : mapping
        The settings of each study, by its name.
    """
    first_with: dict[str, str] = {}
    for name, settings in studies.items():
        role = settings.role
        first = first_with.setdefault(role, name)
        if first != name and not ROLES[role].several:
            yield (
                f"studies.{name}.role = {role} is not allowed: studies.{first} has it, "
                "and it must be one study's alone"
            )
        for need in ROLES[role].study:
            value = getattr(settings, need.name)
            if not need.allowed(value):
                key = f"studies.{name}.{need.name}"
                yield need.refusal(key, value, role)


def problems_of_runs(
    name: str,
    settings: StudySettings,
    runs: Sequence[Run],
) -> _Problems:
    """Runs of a study that contradict its role, and missing ones, a line for each.

    Parameters
    ----------
    name : str
        The study's name.
    settings : StudySettings
        Its settings.
    runs : sequence of Run
        All runs of the study.
    """
    role = settings.role
    for need in ROLES[role].runs:
        for run in runs:
            value = run.value(need.name)
            if not need.allowed(value):
                key = f"studies.{name}: {run.id}: {need.name}"
                yield need.refusal(key, value, role)
                break  # the first run shows the problem
