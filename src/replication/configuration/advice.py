"""Warnings about studies with allowed values that are unlikely to give the intended results."""

from collections.abc import Iterable, Iterator, Sequence
from typing import NamedTuple

from nucleation.run.advice import (
    FRICTION,
    NOISE_OF_MESH,
    NOISE_OF_STEPS,
    OF_MESHES,
    ROUGHNESS,
    Advice,
    advice,
    elements_per_zone,
)

from .roles import REFINEMENTS
from .runs import StudyRun

_MOST_NAMED = 100
"""Most runs that a warning names beside the worst; maps have thousands."""


_Case = tuple[float, str, StudyRun]
"""Badness and text of a warning, and the run."""


class _Warned(NamedTuple):
    """A warning about the runs of a study."""

    topic: str
    text: str
    """Study, topic, the worst run and its numbers, the other runs."""
    runs: list[StudyRun]
    """The runs, the worst first."""

    @property
    def is_of_meshes(self) -> bool:
        """Whether it is about meshes and steps that do not resolve the front."""
        return self.topic in OF_MESHES


def warned(runs: Iterable[StudyRun]) -> list[_Warned]:
    """The warnings about some runs: one for each study and topic, with the numbers of the worst."""
    found: dict[tuple[str, str], list[_Case]] = {}
    for run in runs:
        for topic, badness, text in _about(run):
            found.setdefault((run.study, topic), []).append((badness, text, run))
    warnings = []
    for (study, topic), cases in found.items():
        cases.sort(key=lambda case: case[0], reverse=True)
        _, text, _ = cases[0]
        concerned = {run.id: run for _, _, run in cases}  # a run of two blocks may be repeated
        ids = list(concerned)
        full_text = f"studies.{study}: {topic} ({_worst(ids)}): {text}{_others(ids)}"
        warnings.append(_Warned(topic, full_text, list(concerned.values())))
    return warnings


def advise(runs: Iterable[StudyRun]) -> list[str]:
    """The texts of the warnings about some runs."""
    return [warning.text for warning in warned(runs)]


def summary_of_meshes(warnings: Sequence[_Warned], place: str) -> str:
    """One sentence for all warnings about meshes and steps, which `place` has in full."""
    runs = {run.id: run for warning in warnings for run in warning.runs}
    elements = {run.id: elements_per_zone(run.run, run.critical_length) for run in runs.values()}
    worst = min(elements, key=elements.__getitem__)
    number = f"{len(runs)} runs have" if len(runs) > 1 else "1 run has"
    return (
        f"{number} a coarse mesh or long steps, with {elements[worst]:.2g} elements per "
        f"process zone at worst ({worst}); {place} lists them"
    )


def _worst(ids: list[str]) -> str:
    if len(ids) == 1:
        return ids[0]
    return f"{len(ids)} runs, the worst {ids[0]}"


def _others(ids: list[str]) -> str:
    others = ids[1:]
    if not others:
        return ""
    named = ", ".join(others[:_MOST_NAMED])
    unnamed = len(others) - _MOST_NAMED
    rest = f" and {unnamed} more" if unnamed > 0 else ""
    return f" [also {named}{rest}]"


def _about(run: StudyRun) -> Iterator[Advice]:
    """All warnings about a run that are not the purpose of its role."""
    meant: tuple[str, ...] = ()
    if run.role == "patch_theory":  # its faults have such friction on purpose
        meant = (FRICTION,)
    if run.role in (*REFINEMENTS, "patch_theory"):  # these measure the noise
        meant += (ROUGHNESS, NOISE_OF_MESH, NOISE_OF_STEPS)
    for one in advice(run.run, run.critical_length):
        if one[0] not in meant:
            yield one
