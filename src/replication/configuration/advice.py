"""Warnings about studies with allowed values that are unlikely to give the intended results."""

from collections.abc import Iterable

from nucleation.fault.setting import friction, second_body
from nucleation.run.advice import (
    BEFORE_DROP,
    NOISE_OF_MESH,
    OF_MESHES,
    ROUGHNESS,
    advice,
    elements_per_zone,
)

from .roles import REFINEMENTS
from .runs import StudyRun


def warned(runs: Iterable[StudyRun]) -> list[tuple[str, list[StudyRun]]]:
    """The warnings about some runs: one for each study and topic, with the numbers of the worst.

    One about meshes that do not resolve the front comes with its runs. The purpose of a
    role is no warning.
    """
    found: dict[tuple[str, str], list[tuple[float, str, StudyRun]]] = {}
    for run in runs:
        meant: tuple[str, ...] = ()
        if run.role in (*REFINEMENTS, "patch_theory"):  # these measure the noise
            meant = (ROUGHNESS, NOISE_OF_MESH)
        if run.role in ("patch_theory", "patch_convergence"):  # these are about L_s
            meant = (*meant, BEFORE_DROP)
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
            text += f" [also {', '.join(others)}]"
        warnings.append((text, [*concerned.values()] if topic in OF_MESHES else []))
    return warnings


def faults_of(runs: Iterable[StudyRun]) -> list[str]:
    """What the bodies of some runs slide on, and with which friction law: each setting once."""
    faults = (run.run.fault for run in runs)
    return list(dict.fromkeys(f"{second_body(fault)} {friction(fault)}" for fault in faults))


def summary_of_meshes(runs: Iterable[StudyRun], place: str) -> str:
    """One sentence for all warnings about meshes, which `place` has in full."""
    elements = {run.id: elements_per_zone(run.run, run.critical_length) for run in runs}
    worst = min(elements, key=elements.__getitem__)
    number = f"{len(elements)} runs have" if len(elements) > 1 else "1 run has"
    return (
        f"{number} a coarse mesh, with {elements[worst]:.2g} elements per "
        f"process zone at worst ({worst}); {place} lists them"
    )
