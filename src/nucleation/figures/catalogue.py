"""The figures of the report: title, category, roles of the studies they stand on, data."""

from collections.abc import Collection, Iterable
from typing import NamedTuple

PAPER = "The paper's figures"
BEYOND = "Beyond the paper"
CHECKS = "Why to believe it"
OWN = "Studies of your own"


class Data(NamedTuple):
    """A table that can be downloaded: some variables of a dataset, or all of them."""

    dataset: str  # file name in the directory of results, without its suffix
    variables: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """Name of the downloaded file."""
        return f"{'-'.join((self.dataset, *self.variables[:1]))}.csv"


class Entry(NamedTuple):
    """One figure; it can be made if the configuration has studies with these roles."""

    title: str
    category: str
    roles: tuple[str, ...] = ()
    data: tuple[Data, ...] = ()


LENGTHS = Data("lengths")
PATCHES = Data("patch_stability")

FIGURES: dict[str, Entry] = {
    "figure_1": Entry("Figure 1: the two set-ups", PAPER),
    "figure_2": Entry(
        "Figure 2: bimaterial interfaces", PAPER, (),
        (Data("theory", ("bimaterial_length_ratio",)),),
    ),
    "figure_3": Entry(
        "Figure 3: critical length against height", PAPER, ("paper",),
        (Data("theory", ("critical_length", "thin_limit_length")), LENGTHS),
    ),
    "figure_s1": Entry(
        "Figure S1: steady-state friction", PAPER, (),
        (Data("theory", ("steady_friction", "steady_friction_logarithmic")),),
    ),
    "figure_s2": Entry("Figure S2: stress in space and time", PAPER, ("paper",)),
    "animation": Entry("Creep, nucleation and rupture", BEYOND, ("paper",)),
    "figure_3_extended": Entry(
        "Lengths of the drop and of the patch's stability", BEYOND, ("paper",), (LENGTHS, PATCHES)
    ),
    "figure_drop": Entry(
        "Where the force drops under a declared perturbation", BEYOND, ("drop",),
        (Data("drop"),),
    ),
    "figure_weakening": Entry(
        "Where slow slip ends: lengths over the weakening", BEYOND, ("weakening",),
        (Data("weakening"),),
    ),
    "figure_map": Entry(
        "Lengths over height and weakening: a map", BEYOND, ("map",),
        (Data("map"),),
    ),
    "figure_patch_stability": Entry(
        "Stability of the creeping patch", BEYOND, ("paper",), (PATCHES,),
    ),
    "figure_patch_theory": Entry(
        "Stability of the creeping patch by theory", BEYOND, ("converged",),
        (Data("patch_theory"),),
    ),
    "figure_sensitivity": Entry(
        "Sensitivity to parameters and definitions", BEYOND, ("sensitivity",),
        (Data("sensitivity"),),
    ),
    "figure_pairs": Entry(
        "Two deformable bodies", BEYOND, ("pairs_identical",), (Data("pairs"),)
    ),
    "figure_2_simulated": Entry(
        "Figure 2 with simulations, in both senses of the contrast", BEYOND,
        ("pairs_identical", "figure_2_simulated"), (Data("pairs"),),
    ),
    "figure_literature": Entry(
        "Lengths of the literature, simulated in their own settings", BEYOND, ("literature",),
        (Data("literature"),),
    ),
    "figure_convergence": Entry(
        "Critical length against mesh and steps", CHECKS,
        ("convergence", "convergence_quiet"), (Data("convergence"),)
    ),
    "figure_dispersion": Entry(
        "Growth of single modes: simulation and theory", CHECKS, (),
        (
            Data("dispersion", ("mode_wavenumber", "measured_growth", "measured_frequency",
                                "theory_growth", "theory_frequency")),
            Data("dispersion", ("curve_wavenumber", "curve_growth", "curve_frequency")),
        ),
    ),
    "figure_verification": Entry(
        "Orders of convergence on manufactured solutions", CHECKS, (), (Data("verification"),)
    ),
}  # fmt: skip


def of_studies(descriptions: dict[str, str]) -> dict[str, Entry]:
    """The generic figures of studies, by name, from what the studies are for."""
    return {
        f"study_{study}": Entry(f"Study {study}: {text}", OWN, (), (LENGTHS,))
        for study, text in descriptions.items()
    }


def drawable(roles: Collection[str], papers: bool = True) -> list[str]:
    """The figures that a configuration can make whose studies have these roles, in their order.

    Those of the paper's category are left out unless the configuration is the paper's.
    """
    return [
        name
        for name, entry in FIGURES.items()
        if set(entry.roles) <= set(roles) and (papers or entry.category != PAPER)
    ]


def datasets_of(entries: Iterable[Entry]) -> list[str]:
    """Names of the datasets whose tables come with some figures."""
    return list(dict.fromkeys(data.dataset for entry in entries for data in entry.data))
