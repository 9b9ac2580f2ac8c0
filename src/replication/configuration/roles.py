"""Roles of studies: how figures, tables and verdicts use a study, and what each role requires.

A study has its role in its section of the configuration. The names of studies are the user's and
have no meaning.
"""

from collections.abc import Callable, Iterator, Mapping
from typing import Any, NamedTuple

OWN = "own"
"""The role of the user's own studies."""

JUDGED = "converged"
"""The role of the runs for verdicts on lengths."""

PAPERS = "paper"
"""The role of the runs on the paper's own mesh."""

WEAKENING_PATCHES = "weakening_patches"
"""The role of patches that weaken in a fault that strengthens: no length is measured."""

LITERATURE = "literature"
"""The role of runs with lengths that are measured during acceleration, not at the drop."""

LONGER = "long_blocks"
"""The role of runs in longer blocks than those with the role :data:`JUDGED`.

Tables of lengths give it also to the runs of the comparison.
"""


class _Need(NamedTuple):
    """A requirement of a role on a key of the study, or on a parameter of each of its runs."""

    name: str
    allowed: Callable[[Any], bool]
    rule: str  # the allowed values, in words

    def refusal(self, key: str, value: object, role: str) -> str:
        """The message for a value at a key that does not fulfil the requirement."""
        return f"{key} = {value} is not allowed with role = {role}: it must be {self.rule}"


_LENGTHS = _Need("table", "lengths".__eq__, "lengths")
_STABILITY = _Need("measure", "stability".__eq__, "stability")
_BATCHES = _Need("runs_per_job", (1).__lt__, "more than 1")
_INTERFACE = _Need("record", "interface".__eq__, "interface")
_UNPERTURBED = _Need("perturbation", "none".__eq__, "none")
_PAIR = _Need("second_body", "deformable".__eq__, "deformable")
_REMOTE = _Need("loading", "remote".__eq__, "remote")
_FRICTION_VARIES = _Need("heterogeneity", ("zeta", "a").__contains__, "zeta or a")


class _Role(NamedTuple):
    """What holds for studies with a role, and its requirements."""

    several: bool = False  # whether several studies may have the role
    one_by_one: bool = True  # whether other results use single simulations of the study
    study: tuple[_Need, ...] = ()
    runs: tuple[_Need, ...] = ()


ROLES = {
    # a study of your own: lengths and a figure
    OWN: _Role(several=True, one_by_one=False),
    # the paper's runs on its mesh, for Figures 3 and S2 and the verdicts
    PAPERS: _Role(study=(_LENGTHS,), runs=(_INTERFACE,)),
    # the runs for verdicts about lengths
    JUDGED: _Role(study=(_LENGTHS,), runs=(_INTERFACE,)),
    # runs in longer blocks, for the claim that the block length has no effect
    LONGER: _Role(several=True, runs=(_INTERFACE,)),
    # refined runs with patches over time
    "patch_convergence": _Role(several=True),
    # declared perturbations, for `figure_drop`
    "drop": _Role(several=True, one_by_one=False),
    # weak to strong weakening, for `figure_weakening`
    "weakening": _Role(several=True, one_by_one=False),
    # faults that the expected drop was not fitted to, for `other_faults`
    "other_faults": _Role(one_by_one=False),
    # faults whose L was predicted before it was simulated, for `blind`
    "blind": _Role(one_by_one=False),
    # weakening patches in a fault that strengthens
    WEAKENING_PATCHES: _Role(runs=(_REMOTE, _FRICTION_VARIES)),
    # heights and weakenings, for `figure_map`
    "map": _Role(one_by_one=False, study=(_STABILITY, _BATCHES)),
    # faults for the test of the patch theory, for `gather_patch_theory`
    "patch_theory": _Role(several=True, one_by_one=False, study=(_STABILITY, _BATCHES)),
    # mesh and steps refined, for `convergence`
    "convergence": _Role(several=True, one_by_one=False),
    # the same without a perturbation, for the noise of meshes
    "convergence_quiet": _Role(several=True, one_by_one=False, runs=(_UNPERTURBED,)),
    # two deformable bodies, for the table of pairs
    "pairs": _Role(several=True, runs=(_PAIR,)),
    # the same, identical blocks
    "pairs_identical": _Role(several=True, runs=(_PAIR,)),
    # the same, half-spaces in contrast
    "pairs_contrast": _Role(several=True, runs=(_PAIR,)),
    # the literature's lengths in their own settings
    LITERATURE: _Role(runs=(_REMOTE,)),
}
"""All roles, by name."""

PAIRS = ("pairs", "pairs_identical", "pairs_contrast")
"""Roles of studies in the table of pairs."""

REFINEMENTS = ("convergence", "convergence_quiet")
"""Roles of studies in the table of refinement."""


def problems_of_studies(studies: Mapping[str, Any]) -> Iterator[str]:
    """Settings of studies that contradict their roles, a line for each."""
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
                yield need.refusal(f"studies.{name}.{need.name}", value, role)
