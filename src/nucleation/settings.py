"""Settings beside the simulations' parameters: what is measured, drawn and allowed."""

from __future__ import annotations

import dataclasses

import numpy as np

from .drop import DROP
from .quantities import Checked, quantity


def _spaced(low: float, high: float, number: int) -> tuple[float, ...]:
    return tuple(float(f"{x:.6g}") for x in np.geomspace(low, high, number))


@dataclasses.dataclass(frozen=True)
class Curves(Checked):
    """Where the theory's curves are computed."""

    heights: tuple[float, ...] = quantity(
        "block heights of the theory's curve in Figure 3", unit="m", low=0.0, high=1e6,
        symbol="H", default=_spaced(0.003, 0.15, 80),
    )  # fmt: skip
    f_beta: tuple[float, ...] = quantity(
        "friction coefficient times bimaterial contrast in Figure 2", low=-10.0, high=10.0,
        symbol="f beta", default=tuple(float(f"{x:.6g}") for x in np.linspace(0.0, 0.5, 101)),
    )  # fmt: skip
    zeta_over_a: tuple[float, ...] = quantity(
        "velocity weakening over direct effect in Figure 2", low=0.0, high=1e6,
        symbol="zeta/a", default=(0.1, 0.3, 1.0, 3.0, 10.0),
    )  # fmt: skip
    slip_rates: tuple[float, ...] = quantity(
        "slip rates of steady sliding in Figure S1", unit="m/s", low=0.0, high=1e4,
        symbol="v", default=_spaced(1e-11, 1e1, 241),
    )  # fmt: skip


@dataclasses.dataclass(frozen=True)
class ExtractionSettings(Checked):
    """How the critical nucleation length is read from a simulation."""

    edge_threshold: float = quantity(
        "slip rate at the edge of the creep patch over the imposed velocity", low=0.0, high=1.0,
        closed="high", default=0.01,
    )  # fmt: skip
    edge_threshold_high: float = quantity(
        "largest edge threshold of the error bar", low=0.0, high=1.0, closed="high", default=0.5
    )
    edge_threshold_low: float = quantity(
        "smallest edge threshold of the error bar", low=0.0, high=1.0, closed="high", default=1e-3
    )
    drop: float = quantity(
        "abrupt drop of the driving force that makes an event, as a fraction", low=0.0, high=1.0,
        default=DROP,
    )  # fmt: skip


@dataclasses.dataclass(frozen=True)
class FigureSettings(Checked):
    """Which simulations of the study ``paper`` the figures show."""

    inset_height: float = quantity(
        "height of the simulation in the inset of Figure 3", unit="m", low=0.0, high=1e6,
        symbol="H", default=0.1,
    )  # fmt: skip
    space_time_height: float = quantity(
        "height of the simulation in Figure S2", unit="m", low=0.0, high=1e6, symbol="H",
        default=0.005,
    )  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Limits(Checked):
    """What one simulation may use; larger ones are refused before they start."""

    memory: float = quantity(
        "memory of one simulation", unit="MB", low=100.0, high=1e7, default=2000.0
    )
    runtime: float = quantity(
        "time after which a cluster may end a simulation", unit="min", low=1.0, high=1e5,
        closed="both", default=60.0,
    )  # fmt: skip


@dataclasses.dataclass(frozen=True)
class CrosscheckSettings(Checked):
    """The runs made with the independent solver as well, and its time steps."""

    heights: tuple[float, ...] = quantity(
        "block heights of the runs made with both solvers", unit="m", low=0.0, high=1e6,
        symbol="H", default=(0.005, 0.05),
    )  # fmt: skip
    length_over_critical: float = quantity(
        "block length over the theory's critical length", low=1.0, high=1000.0, symbol="L/L_c",
        default=6.0,
    )  # fmt: skip
    n_x: int = quantity("number of elements along x of both solvers", low=8, high=100000,
                        closed="both", symbol="N_x", default=400)  # fmt: skip
    n_y: int = quantity("number of elements along y of both solvers", low=2, high=10000,
                        closed="both", symbol="N_y", default=8)  # fmt: skip
    longest_step: float = quantity(
        "longest time step of the independent solver over the memory time D/V", low=0.0, high=1.0,
        closed="high", default=0.04,
    )  # fmt: skip
    slip_per_step: float = quantity(
        "largest slip within a step of the independent solver over D", low=0.0, high=1.0,
        closed="high", default=0.2,
    )  # fmt: skip
    time_after_event: float = quantity(
        "time simulated by both solvers after the onset of the event", unit="s", low=0.0,
        high=1e12, closed="low", default=0.05,
    )  # fmt: skip
    timing_n_x: int = quantity("number of elements along x of the mesh on which steps are timed",
                               low=8, high=100000, closed="both", default=400)  # fmt: skip
    timing_n_y: int = quantity("number of elements along y of the mesh on which steps are timed",
                               low=2, high=10000, closed="both", default=150)  # fmt: skip
    timing_end: float = quantity(
        "simulated time of the run that times steps", unit="s", low=0.0, high=1e12, default=0.1
    )
