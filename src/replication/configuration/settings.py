"""Settings beside the parameters of simulations: of studies, curves, and limits."""

import dataclasses
from collections.abc import Collection, Mapping
from typing import Any

import numpy as np

from nucleation.extraction.definitions import ExtractionSettings
from nucleation.fault import Fault
from nucleation.fault.parameters import parameters, sections
from nucleation.model.quantities import Quantity, declarations, declared, quantity
from nucleation.model.units import Checked
from nucleation.run.run import Run

from ..tables.curves import main_text
from .roles import OWN, ROLES


@dataclasses.dataclass(frozen=True)
class StudySettings(Checked):
    """Settings of a study that hold for all of its runs."""

    description: str = quantity("purpose of the study", default="a set of simulations")
    role: str = quantity("use in figures, tables and verdicts", choices=tuple(ROLES), default=OWN)
    length_over_critical: float = quantity(
        "block length over the theory's critical length, unless a run gives its length",
        "(1.0, 1000.0)",
        symbol="L/L_c",
        default=6.0,
    )
    interface: str = quantity(
        "f, a and zeta of the theory: main_text rounds those of the run's friction law at V to two "
        "digits, as the paper's main text does; friction_law does not round them",
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


def _spaced(values: np.ndarray) -> tuple[float, ...]:
    return tuple(float(f"{x:.6g}") for x in values)


@dataclasses.dataclass(frozen=True)
class Curves(Checked):
    """Where the theory's curves are computed."""

    heights: tuple[float, ...] = quantity(
        "block heights of the theory's curve in Figure 3",
        "(0.0, 1e6) m",
        symbol="H",
        default=_spaced(np.geomspace(0.003, 0.15, 80)),
    )
    f_beta: tuple[float, ...] = quantity(
        "friction coefficient times bimaterial contrast in Figure 2",
        "(-10.0, 10.0)",
        symbol="f beta",
        default=_spaced(np.linspace(0.0, 0.5, 101)),
    )
    zeta_over_a: tuple[float, ...] = quantity(
        "velocity weakening over direct effect in Figure 2",
        "(0.0, 1e6)",
        symbol="zeta/a",
        default=(0.1, 0.3, 1.0, 3.0, 10.0),
    )
    slip_rates: tuple[float, ...] = quantity(
        "slip rates of steady sliding in Figure S1",
        "(0.0, 1e4) m/s",
        symbol="v",
        default=_spaced(np.geomspace(1e-11, 1e1, 241)),
    )


@dataclasses.dataclass(frozen=True)
class Limits(Checked):
    """Limits of one simulation; larger ones are refused before they start."""

    memory: float = quantity("memory of one simulation", "(100.0, 1e7) MB", default=2000.0)
    runtime: float = quantity(
        "time after which a cluster may end a simulation", "[1.0, 1e5] min", default=60.0
    )


GROUPS: dict[str, type] = {"curves": Curves, "extraction": ExtractionSettings, "limits": Limits}
"""The sections of a configuration beside those of the parameters of runs and the studies."""

SECTIONS = {name: keys for name, keys in sections().items() if name != "block"}
"""The sections with parameters that all runs have unless a study sets them, and their keys."""

RANGE: dict[str, Quantity] = {
    "num": declared("number of values", "[2, 10000]", kind="int"),
    "scale": Quantity("spacing of the values", choices=("linear", "log")),
}
"""Keys of a range beside ``start`` and ``stop``, which have the parameter's own declaration."""


def entries_of(section: str) -> dict[str, Quantity]:
    """The keys of a section of a configuration and their declarations."""
    if section in GROUPS:
        return declarations(GROUPS[section])
    return {name: parameters()[name] for name in SECTIONS[section]}


@dataclasses.dataclass(frozen=True)
class Settings:
    """All settings of the workflow, and the sections of its studies."""

    results: str
    base: Run
    """Values of the parameters that no study sets."""
    curves: Curves
    extraction: ExtractionSettings
    limits: Limits
    studies: dict[str, StudySettings]
    sections: Mapping[str, dict[str, Any]] = dataclasses.field(repr=False)
    """The section of each study in the configuration."""

    given: Collection[str] = ()
    """The parameters that the sections beside the studies give."""

    @property
    def main_text(self) -> Fault:
        """The fault of the theory's curves in the paper's figures, with rounded friction."""
        return main_text(self.base.fault)
