"""The parts of a run beside its fault: start, block, steps, perturbation and record, as data."""

import dataclasses
import math

from .perturbations import KINDS
from .quantities import quantity
from .units import Checked

EVENT_DROP = 0.02
"""Default drop of the driving force that defines an event, as a fraction of the force."""

FIRST_STEP = 2.0e-6
"""First time step over the memory time D/V."""

STUCK_BELOW = 1e-4
"""With ``record: lengths``, nodes with slip rates below this fraction of V count as stuck.

Their fields are zero in the record, except beside slipping nodes. Configurations must locate the
edges of the patch at larger slip rates.
"""

NEAR_END = 0.6
"""Length of the patch over the block's up to which a thin block's far end has no effect."""

THICK = 0.5
"""Height over the patch's length above which a block is thick."""

THICK_REACH = 0.2
"""(L + H) over the block's length up to which a thick block's far end has no effect."""

ELEMENTS_PER_CORRELATION = 4
"""Fewest elements per correlation length for which a mesh represents the declared roughness."""

STEPS_PER_CORRELATION = 10
"""Fewest time steps per correlation time; the error is then below the law's tolerance."""


@dataclasses.dataclass(frozen=True)
class Start(Checked):
    """The stress at the start, and the rate of a remote load."""

    initial_stress: str = quantity(
        "initial static field: of an interface without slip, or of one that has slipped to the "
        "uniform shear stress initial_shear_stress",
        choices=("no_slip", "uniform_shear"),
        default="no_slip",
    )
    initial_shear_stress: float = quantity(
        "initial shear stress at the interface, if initial_stress is uniform_shear",
        "[0.0, 1e10) Pa",
        symbol="tau0",
        default=0.0,
    )
    stress_rate: float = quantity(
        "rate at which the far shear stress rises, with loading remote",
        "[0.0, 1e15) Pa/s",
        symbol="dtau/dt",
        default=0.0,
    )


@dataclasses.dataclass(frozen=True)
class Block(Checked):
    """Length of the bodies and numbers of bilinear elements; the fault has their heights."""

    length: float = quantity(
        "block length", "(0.0, 1e7) m", symbol="L", name="block_length", default=1.0
    )
    n_x: int = quantity("number of elements along x", "[8, 100000]", symbol="N_x", default=400)
    n_y: int = quantity("number of elements along y", "[2, 10000]", symbol="N_y", default=150)
    grading: float = quantity(
        "height of the top row of elements over that of the bottom row",
        "[1.0, 1000.0]",
        default=1.0,
    )
    second_n_y: int | None = quantity(
        "number of elements along y of the second block; the first one's if left out",
        "[2, 10000]",
        default=None,
    )
    second_grading: float | None = quantity(
        "height of the bottom row of elements of the second block over that of the row at the "
        "interface; the first one's grading if left out",
        "[1.0, 1000.0]",
        default=None,
    )


@dataclasses.dataclass(frozen=True)
class Stepping(Checked):
    """Control of the time integration, and the data that are recorded."""

    end_time: float = quantity("simulated time", "(0.0, 1e12) s", symbol="t", default=16.0)
    time_after_event: float = quantity(
        "time simulated after the event's onset before the run may end",
        "[0.0, 1e12) s",
        default=1e12 / 2,
    )
    event_drop: float = quantity(
        "fall of the driving force with which the event has begun, as a fraction; in the workflow "
        "extraction.drop if that is larger",
        "(0.0, 1.0)",
        default=EVENT_DROP,
    )
    tolerance: float = quantity(
        "tolerance of the local error of log slip rate and log state per step",
        "(0.0, 1.0)",
        default=1.0e-2,
    )
    longest_step: float = quantity(
        "longest time step over the memory time D/V", "(0.0, 1.0]", default=0.1
    )
    shortest_step: float = quantity(
        "shortest time step, below which the run ends as failed", "(0.0, 1.0) s", default=1.0e-12
    )
    record: str = quantity(
        "recorded data of a simulation: all fields of the interface; or only the data for lengths "
        "and the stability of the patch, in single precision",
        choices=("interface", "lengths"),
        default="interface",
    )


@dataclasses.dataclass(frozen=True)
class Perturbation(Checked):
    """The declared deviation of loads, strength or state from uniformity; by default none.

    The length at the drop depends on the logarithm of the perturbation (docs/drop.md). Its kind is
    one of :mod:`.perturbations`, with the relative strength eps, and a Gaussian process xi of zero
    mean and unit variance::

        drive_velocity   V(t) = V [1 + eps xi(t)]                  velocity of the left edge
        normal_load      sigma0(t) = sigma0 [1 + eps xi(t)]        stress on the top
        strength         f(v, phi, x) = f(v, phi) [1 + eps xi(x)]  friction coefficient along x
        state            d log(phi)/dt = g + eps (V/D) xi(x, t)    evolution of the state variable

    The correlation time is a multiple of D/V, because friction averages over faster changes. The
    correlation length is in metres, a property of the surfaces; the mesh must resolve it.

    Examples
    --------
    >>> Perturbation(kind="normal_load", strength=1e-4).strength
    0.0001
    """

    kind: str = quantity(
        "perturbed quantity", choices=("none", *KINDS), name="perturbation", default="none"
    )
    strength: float = quantity(
        "relative strength of the perturbation, its standard deviation",
        "[0.0, 0.1]",
        symbol="eps",
        default=0.0,
    )
    correlation_time: float = quantity(
        "correlation time of the perturbation over the memory time D/V", "(0.0, 1e6)", default=1.0
    )
    correlation_length: float = quantity(
        "correlation length of the perturbation along x", "(0.0, 1e6) m", default=0.02
    )
    seed: int = quantity(
        "seed of the perturbation's realisation", "[0, 9223372036854775807]", default=0
    )

    @property
    def acts(self) -> bool:
        """Whether the run is perturbed."""
        return self.kind != "none" and self.strength > 0.0

    @property
    def in_time(self) -> bool:
        """Whether its kind changes in time: the steps must resolve it."""
        return self.kind != "none" and KINDS[self.kind].in_time

    @property
    def along_x(self) -> bool:
        """Whether its kind varies along x: the mesh must resolve it."""
        return self.kind != "none" and KINDS[self.kind].along_x

    def longest_step(self, memory_time: float) -> float:
        """The longest time step (s) that resolves the perturbation; infinite if every step does."""
        if not self.acts or not self.in_time:
            return math.inf
        return self.correlation_time * memory_time / STEPS_PER_CORRELATION
