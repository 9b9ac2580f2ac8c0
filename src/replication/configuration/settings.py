"""Settings beside the simulations' parameters: of studies, of figures, and limits."""

import dataclasses
from collections.abc import Collection, Mapping
from typing import Any, Self

from nucleation.extraction.definitions import ExtractionSettings
from nucleation.model.checked import Checked
from nucleation.model.linearised import InterfaceState
from nucleation.model.parameters import Parameters
from nucleation.model.quantities import quantity
from nucleation.theory.settings import Curves

from .roles import OWN, ROLES


@dataclasses.dataclass(frozen=True)
class StudySettings(Checked):
    """Settings of a study that hold for all of its runs."""

    description: str = quantity(
        "purpose of the study",
        default="a set of simulations",
    )
    role: str = quantity(
        "use in figures, tables and verdicts",
        choices=tuple(ROLES),
        default=OWN,
    )
    length_over_critical: float = quantity(
        "block length over the theory's critical length, unless a run gives its length",
        "(1.0, 1000.0)",
        symbol="L/L_c",
        default=6.0,
    )
    interface: str = quantity(
        "linearised friction of the theory: the rounded values of the group main_text_interface, "
        "which must be those of the run's friction law, or that law expanded at the run's velocity",
        choices=("main_text", "friction_law"),
        default="friction_law",
    )
    table: str = quantity(
        "table of its lengths: lengths.csv, with the other studies, so that the targets "
        "lengths and simulations include it; or its own table alone",
        choices=("lengths", "own"),
        default="lengths",
    )
    runs_per_job: int = quantity(
        "simulations that one job makes, one after another; more than one where runs take seconds",
        "[1, 10000]",
        default=1,
    )
    measure: str = quantity(
        "measurement of each run: lengths at the drop, or also the length at which the patch turns "
        "unstable; the latter if runs_per_job is more than one",
        choices=("lengths", "stability"),
        default="lengths",
    )

    @classmethod
    def of(cls, section: Mapping[str, Any]) -> Self:
        """The settings in a study's section of the configuration."""
        others = ("defaults", "runs")
        return cls(**{key: value for key, value in section.items() if key not in others})


@dataclasses.dataclass(frozen=True)
class FigureSettings(Checked):
    """Which simulations with the role ``paper`` the figures show."""

    inset_height: float = quantity(
        "height of the simulation in the inset of Figure 3, or the nearest",
        "(0.0, 1e6) m",
        symbol="H",
        default=0.1,
    )
    space_time_height: float = quantity(
        "height of the simulation in Figure S2, or the nearest",
        "(0.0, 1e6) m",
        symbol="H",
        default=0.005,
    )


@dataclasses.dataclass(frozen=True)
class Limits(Checked):
    """Limits of one simulation; larger ones are refused before they start."""

    memory: float = quantity("memory of one simulation", "(100.0, 1e7) MB", default=2000.0)
    runtime: float = quantity(
        "time after which a cluster may end a simulation", "[1.0, 1e5] min", default=60.0
    )


@dataclasses.dataclass(frozen=True)
class Settings:
    """All settings of the workflow, and the sections of its studies."""

    results: str
    base: Parameters
    main_text_interface: InterfaceState
    curves: Curves
    extraction: ExtractionSettings
    figures: FigureSettings
    limits: Limits
    studies: dict[str, StudySettings]
    sections: Mapping[str, dict[str, Any]] = dataclasses.field(repr=False)
    """The section of each study in the configuration."""

    stepping: Collection[str] = ()
    """The keys in the section ``stepping``."""


def estimated_megabytes(parameters: Parameters) -> float:
    """Memory (MB) that a simulation needs, rounded up from measured runs.

    The memory consists of the libraries, some hundred vectors of the bodies (mostly the stored
    factors for step sizes in use) and some dense matrices of the interface.
    """
    mesh = parameters.mesh
    below = parameters.below
    rows = mesh.n_y + (below.mesh.n_y if below else 0)
    vector = 8e-6 * 2 * mesh.n_x * rows
    matrix = 8e-6 * mesh.n_x**2
    return 250.0 + 400.0 * vector + 8.0 * matrix
