"""What studies are for: the roles that figures, tables and verdicts ask for, and what each needs.

A study says its role in its section of the configuration; names are the user's, and say nothing.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

from ..model.parameters import Parameters
from .settings import FigureSettings

Run = Any
"""Of :mod:`.runs`, which knows this module."""

OWN = "own"
JUDGED, PAPERS = "converged", "paper"
"""The role that verdicts on lengths stand on, and that of the runs on the paper's own mesh."""
LITERATURE = "literature"
"""The role of runs whose zones are read while they accelerate, not at the drop."""
LONGER = "long_blocks"
"""Runs in longer blocks than those with the role :data:`JUDGED`; in tables of lengths also of the
runs that they are compared with."""


class Need(NamedTuple):
    """What a role asks of a key of the study, or of a parameter of each of its runs."""

    name: str
    allowed: Callable[[Any], bool]
    words: str  # what it must be


LENGTHS = Need("table", "lengths".__eq__, "lengths")
STABILITY = Need("measure", "stability".__eq__, "stability")
BATCHES = Need("runs_per_job", (1).__lt__, "more than 1")
INTERFACE = Need("record", lambda level: level != "lengths", "interface or everything")
QUIET = Need("perturbation", "none".__eq__, "none")
PAIR = Need("second_body", "deformable".__eq__, "deformable")
REMOTE = Need("loading", "remote".__eq__, "remote")
ZETA_VARIES = Need("varies", "zeta".__eq__, "zeta")


class Role(NamedTuple):
    """What studies with a role are for, and what they need for it."""

    purpose: str
    several: bool = False  # whether studies may share it
    one_by_one: bool = True  # whether other results are made of its simulations one by one
    study: tuple[Need, ...] = ()
    runs: tuple[Need, ...] = ()
    heights: tuple[str, ...] = ()  # keys of the section figures: of each height a run is shown


ROLES = {
    OWN: Role("a study of your own: lengths, a figure, its part of the report", True, False),
    PAPERS: Role(
        "the paper's runs on its mesh, for Figures 3 and S2 and the verdicts", study=(LENGTHS,),
        runs=(INTERFACE,), heights=("inset_height", "space_time_height"),
    ),
    JUDGED: Role(
        "the runs on which verdicts about lengths stand", study=(LENGTHS,), runs=(INTERFACE,),
    ),
    LONGER: Role(
        "those in longer blocks, for the claim that the length plays no role", several=True,
        runs=(INTERFACE,),
    ),
    "noisy": Role("a stronger perturbation, for the band of `figure_3_extended`", False, False),
    "patch_convergence": Role("refined runs whose patches are followed", several=True),
    "drop": Role("declared perturbations, for `figure_drop`", True, False),
    "weakening": Role("weak to strong weakening, for `figure_weakening`", True, False),
    "weakening_patches": Role(
        "patches that weaken in a fault that strengthens, for `figure_weakening_patches`",
        runs=(REMOTE, ZETA_VARIES),
    ),
    "map": Role("heights and weakenings, for `figure_map`", False, False, (STABILITY, BATCHES)),
    "patch_theory": Role(
        "faults to hold the theory of the patch against, for `figure_patch_theory`", True, False,
        (STABILITY, BATCHES),
    ),
    "convergence": Role("mesh and steps refined, for `figure_convergence`", True, False),
    "convergence_quiet": Role(
        "the same without a perturbation, for the noise of meshes", True, False, runs=(QUIET,)
    ),
    "sensitivity": Role("one parameter changed at a time; the first run of a height is the base"),
    "pairs": Role("two deformable bodies, for the table of pairs", several=True, runs=(PAIR,)),
    "pairs_identical": Role(
        "the same, identical blocks, for `figure_pairs`", several=True, runs=(PAIR,)
    ),
    "figure_2_simulated": Role(
        "the same, half-spaces in contrast, for `figure_2_simulated`", several=True, runs=(PAIR,)
    ),
    LITERATURE: Role(
        "the literature's lengths in their own settings, for `figure_literature`", runs=(REMOTE,)
    ),
}  # fmt: skip
"""All roles, by name."""

PAIRS = ("pairs", "pairs_identical", "figure_2_simulated")
"""Roles of studies in the table of pairs."""

REFINEMENTS = ("convergence", "convergence_quiet")
"""Roles of studies in the table of refinement."""


def shown(runs: Sequence[Run], height: float, base: Parameters) -> Run | None:
    """The run of a height (m) with the configuration's own evolution law and initial state."""
    usual = {
        "height": height,
        "evolution": base.friction.evolution,
        "phi0": base.loading.initial_state,
    }
    return next((run for run in runs if usual.items() <= run.labels.items()), None)


def problems_of_studies(studies: Mapping[str, Any]) -> Iterator[str]:
    """What studies declare that does not go with their roles, a line for each, without their runs.

    Parameters
    ----------
    studies : dict
        The settings of each study, by its name.
    """
    having: dict[str, str] = {}
    for name, settings in studies.items():
        role = settings.role
        first = having.setdefault(role, name)
        if first != name and not ROLES[role].several:
            yield (
                f"studies.{name}.role = {role} is not allowed: studies.{first} has it, "
                "and it must be one study's alone"
            )
        for need in ROLES[role].study:
            value = getattr(settings, need.name)
            if not need.allowed(value):
                yield _refusal(f"studies.{name}.{need.name}", value, role, need)


def problems_of_runs(
    name: str, settings: Any, runs: Sequence[Run], figures: FigureSettings, base: Parameters
) -> Iterator[str]:
    """What the runs of a study lack for its role, a line for each, with key and value.

    Parameters
    ----------
    name, settings : the study's.
    runs : all runs of the study.
    figures : which heights (m) figures show.
    base : values of what no study sets.
    """
    role = settings.role
    for need in ROLES[role].runs:
        bad = next((run for run in runs if not need.allowed(run.value(need.name))), None)
        if bad is not None:
            key = f"studies.{name}: {bad.id}: {need.name}"
            yield _refusal(key, bad.value(need.name), role, need)
    for key in ROLES[role].heights:
        height = getattr(figures, key)
        if shown(runs, height, base) is None:
            law, age = base.friction.evolution, base.loading.initial_state
            yield (
                f"studies.{name}.role = {role} needs a run with height = {height:g} m"
                f", evolution = {law}, phi0 = {age:g} s: figures.{key} names it"
            )


def _refusal(key: str, value: Any, role: str, need: Need) -> str:
    return f"{key} = {value} is not allowed with role = {role}: it must be {need.words}"
