"""The declared perturbation: deviations of the loads, the strength or the state from uniformity.

No real fault is as unperturbed as a simulation in double precision. The length at the drop of the
driving force depends on the logarithm of the perturbation (docs/drop.md), so that it is
well-defined only with a declared perturbation: one of the kinds below, with a relative strength
``eps``, a correlation and a random seed. ``xi`` is a Gaussian process of zero mean and unit
variance (:mod:`nucleation.simulation.realisation`).

    drive_velocity   V(t) = V [1 + eps xi(t)]                  velocity of the left edge
    normal_load      sigma0(t) = sigma0 [1 + eps xi(t)]        stress on the top
    strength         f(v, phi, x) = f(v, phi) [1 + eps xi(x)]  friction coefficient along x
    state            d log(phi)/dt = g + eps (V/D) xi(x, t)    evolution of the state variable
"""

import dataclasses
import math
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from ..types import Array
from .checked import Checked
from .quantities import quantity

MEAN_SQUARE = 151.0 / 315.0  # int B(u)^2 du of the cubic B-spline

KINDS = ("none", "drive_velocity", "normal_load", "strength", "state")
IN_TIME = ("drive_velocity", "normal_load", "state")
"""Kinds that change in time; the time steps must resolve them."""

ALONG_X = ("strength", "state")
"""Kinds that vary along x; the mesh must resolve them."""

ELEMENTS_PER_CORRELATION = 4
"""Fewest elements per correlation length for which a mesh represents the declared roughness."""

STEPS_PER_CORRELATION = 10
"""Fewest time steps per correlation time; the error is then below the law's tolerance."""


@dataclasses.dataclass(frozen=True)
class Perturbation(Checked):
    """The declared perturbation of a run; by default the run is unperturbed.

    The correlation time is a multiple of the memory time D/V, because friction averages over
    faster changes. The correlation length is in metres: the roughness is a property of the
    surfaces, independent of block, theory and mesh. The mesh must resolve it; otherwise the run
    has another roughness. A front that moves at dL/dt crosses roughness of wavenumber ``k`` with
    the frequency ``k dL/dt``. The frequency of the patch's own mode perturbs it most; with the
    paper's parameters that is a wavelength of about 0.01 m.

    Examples
    --------
    >>> Perturbation(kind="normal_load", strength=1e-4).strength
    0.0001
    """

    called: ClassVar = {"kind": "perturbation"}

    kind: str = quantity("perturbed quantity", choices=KINDS, default="none")
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

    def longest_step(self, memory_time: float) -> float:
        """The longest time step (s) that resolves the perturbation; infinite if every step does."""
        if not self.acts or self.kind not in IN_TIME:
            return math.inf
        return self.correlation_time * memory_time / STEPS_PER_CORRELATION


def correlation(lag: ArrayLike, scale: float) -> Array:
    """Correlation ``<xi(s) xi(s + lag)>`` at a lag (s or m), by the correlation time or length."""
    spacing = MEAN_SQUARE * scale
    u = np.abs(np.asarray(lag, dtype=float)) / spacing
    septic = np.zeros_like(u)
    for k, binomial in enumerate((1.0, -8.0, 28.0, -56.0, 70.0, -56.0, 28.0, -8.0)):
        septic = septic + binomial * np.maximum(4.0 - u - k, 0.0) ** 7
    return septic / (5040.0 * MEAN_SQUARE)


def spectral_density(omega: ArrayLike, correlation: float) -> Array:
    """Spectral density S (s or m) at omega (1/s or 1/m): ``int S d omega / (2 pi) = 1``."""
    half_spacing = 0.5 * MEAN_SQUARE * correlation
    half = half_spacing * np.asarray(omega, dtype=float)
    return correlation * np.sinc(half / np.pi) ** 8
