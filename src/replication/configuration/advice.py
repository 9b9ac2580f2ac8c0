"""Warnings about studies with allowed values that are unlikely to give the intended results."""

from collections.abc import Iterable, Sequence
from typing import NamedTuple

from nucleation.run.advice import (
    FRICTION,
    NOISE_OF_MESH,
    OF_MESHES,
    ROUGHNESS,
    advice,
    elements_per_zone,
)

from .roles import REFINEMENTS
from .runs import StudyRun

_MOST_NAMED = 100
"""Most runs that a warning names beside the worst; maps have thousands."""


class Warned(NamedTuple):
    """A warning about the runs of a study."""

    topic: str
    text: str  # study, topic, the worst run and its numbers, the other runs
    runs: list[StudyRun]  # the worst first
    is_of_meshes: bool  # whether it is about meshes that do not resolve the front


def warned(runs: Iterable[StudyRun]) -> list[Warned]:
    """The warnings about some runs: one for each study and topic, with the numbers of the worst.

    What is the purpose of a role is no warning.
    """
    found: dict[tuple[str, str], list[tuple[float, str, StudyRun]]] = {}
    for run in runs:
        meant: tuple[str, ...] = ()
        if run.role == "patch_theory":  # its faults have such friction on purpose
            meant = (FRICTION,)
        if run.role in (*REFINEMENTS, "patch_theory"):  # these measure the noise
            meant += (ROUGHNESS, NOISE_OF_MESH)
        for topic, badness, text in advice(run.run, run.critical_length):
            if topic not in meant:
                found.setdefault((run.study, topic), []).append((badness, text, run))
    warnings = []
    for (study, topic), cases in found.items():
        cases.sort(key=lambda case: case[0], reverse=True)
        concerned = {run.id: run for _, _, run in cases}  # a run of two blocks may be repeated
        worst, *others = concerned
        which = f"{len(concerned)} runs, the worst {worst}" if others else worst
        text = f"studies.{study}: {topic} ({which}): {cases[0][1]}"
        if others:
            unnamed = len(others) - _MOST_NAMED
            rest = f" and {unnamed} more" if unnamed > 0 else ""
            text += f" [also {', '.join(others[:_MOST_NAMED])}{rest}]"
        warnings.append(Warned(topic, text, list(concerned.values()), topic in OF_MESHES))
    return warnings


def summary_of_meshes(warnings: Sequence[Warned], place: str) -> str:
    """One sentence for all warnings about meshes, which `place` has in full."""
    runs = {run.id: run for warning in warnings for run in warning.runs}
    elements = {run.id: elements_per_zone(run.run, run.critical_length) for run in runs.values()}
    worst = min(elements, key=elements.__getitem__)
    number = f"{len(runs)} runs have" if len(runs) > 1 else "1 run has"
    return (
        f"{number} a coarse mesh, with {elements[worst]:.2g} elements per "
        f"process zone at worst ({worst}); {place} lists them"
    )
