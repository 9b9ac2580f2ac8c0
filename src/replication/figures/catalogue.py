"""The figures of the report: title, category, required roles of studies, and data."""

from collections.abc import Collection, Iterable
from typing import NamedTuple

PAPER = "The paper's figures"
BEYOND = "Beyond the paper"
CHECKS = "Why to believe it"
OWN = "Studies of your own"


class Data(NamedTuple):
    """A table for download: some variables of a dataset, or all of them."""

    dataset: str  # file name in the directory of results, without its suffix
    variables: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """Name of the downloaded file."""
        return f"{'-'.join((self.dataset, *self.variables[:1]))}.csv"


class Entry(NamedTuple):
    """One figure; a configuration can make it if it has studies with these roles."""

    title: str
    category: str
    roles: tuple[str, ...] = ()
    data: tuple[Data, ...] = ()


_LENGTHS = Data("lengths")
_PATCHES = Data("patch_stability")
_PAIRS = Data("pairs")

FIGURES: dict[str, Entry] = {
    "figure_1": Entry("Figure 1: the two set-ups", PAPER),
    "figure_2": Entry(
        "Figure 2: bimaterial interfaces",
        PAPER,
        data=(Data("theory", ("bimaterial_length_ratio",)),),
    ),
    "figure_3": Entry(
        "Figure 3: critical length against height",
        PAPER,
        roles=("paper",),
        data=(Data("theory", ("critical_length", "thin_limit_length")), _LENGTHS),
    ),
    "figure_s1": Entry(
        "Figure S1: steady-state friction",
        PAPER,
        data=(Data("theory", ("steady_friction", "steady_friction_logarithmic")),),
    ),
    "figure_s2": Entry(
        "Figure S2: stress in space and time",
        PAPER,
        roles=("paper",),
    ),
    "figure_3_extended": Entry(
        "Lengths of the drop and of the patch's stability",
        BEYOND,
        roles=("paper",),
        data=(_LENGTHS, _PATCHES),
    ),
    "figure_drop": Entry(
        "Where the force drops under a declared perturbation",
        BEYOND,
        roles=("drop",),
        data=(Data("drop"),),
    ),
    "figure_weakening": Entry(
        "Where slow slip ends: lengths over the weakening",
        BEYOND,
        roles=("weakening",),
        data=(Data("weakening"),),
    ),
    "figure_weakening_patches": Entry(
        "Weakening patches among strengthening surroundings",
        BEYOND,
        roles=("weakening_patches",),
        data=(Data("weakening_patches"),),
    ),
    "figure_map": Entry(
        "Lengths over height and weakening: a map", BEYOND, roles=("map",), data=(Data("map"),)
    ),
    "figure_patch_stability": Entry(
        "Stability of the creeping patch", BEYOND, roles=("paper",), data=(_PATCHES,)
    ),
    "figure_patch_theory": Entry(
        "Stability of the creeping patch by theory",
        BEYOND,
        roles=("converged",),
        data=(Data("patch_theory"),),
    ),
    "figure_sensitivity": Entry(
        "Sensitivity to parameters and definitions",
        BEYOND,
        roles=("sensitivity",),
        data=(Data("sensitivity"),),
    ),
    "figure_pairs": Entry(
        "Two deformable bodies", BEYOND, roles=("pairs_identical",), data=(_PAIRS,)
    ),
    "figure_2_simulated": Entry(
        "Figure 2 with simulations, in both senses of the contrast",
        BEYOND,
        roles=("pairs_identical", "figure_2_simulated"),
        data=(_PAIRS,),
    ),
    "figure_literature": Entry(
        "Lengths of the literature, simulated in their own settings",
        BEYOND,
        roles=("literature",),
        data=(Data("literature"),),
    ),
    "figure_convergence": Entry(
        "Length at the drop against mesh and steps",
        CHECKS,
        roles=("convergence", "convergence_quiet"),
        data=(Data("convergence"),),
    ),
}


def of_studies(descriptions: dict[str, str]) -> dict[str, Entry]:
    """The figures of studies by name, from the studies' descriptions."""
    found = {}
    for study, text in descriptions.items():
        found[f"study_{study}"] = Entry(
            f"Study {study}: {text}",
            OWN,
            data=(_LENGTHS,),
        )
    return found


def drawable(roles: Collection[str], papers: bool = True) -> list[str]:
    """The figures that a configuration can make, in the order of the catalogue.

    Parameters
    ----------
    roles : collection of str
        Roles of the configuration's studies.
    papers : bool
        Whether the configuration is the paper's; if not, the paper's figures are left out.

    Returns
    -------
    list of str
        Names of the figures.
    """
    found = []
    for name, entry in FIGURES.items():
        if not papers and entry.category == PAPER:
            continue
        if set(entry.roles) <= set(roles):
            found.append(name)
    return found


def datasets_of(entries: Iterable[Entry]) -> list[str]:
    """Names of the datasets for the tables of some figures."""
    return list(dict.fromkeys(data.dataset for entry in entries for data in entry.data))
