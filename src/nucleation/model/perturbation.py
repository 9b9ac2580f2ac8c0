"""The declared perturbation: how far the loads, the strength or the state of a fault are from even.

No fault is as quiet as double precision. The length at the drop of the driving force depends on
the logarithm of what shakes the patch (docs/drop.md), so it is a number only where that is
declared: one of the kinds below, with a relative strength ``eps``, a correlation and a seed. ``xi``
is a Gaussian process of zero mean and unit variance (:mod:`nucleation.simulation.realisation`).

    drive_velocity   V(t) = V [1 + eps xi(t)]                  velocity of the left edge
    normal_load      sigma0(t) = sigma0 [1 + eps xi(t)]        stress on the top
    strength         f(v, phi, x) = f(v, phi) [1 + eps xi(x)]  friction coefficient along x
    state            d log(phi)/dt = g + eps (V/D) xi(x, t)    evolution of the state variable
"""

import dataclasses
import math

from .checked import Checked
from .quantities import quantity

KINDS = ("none", "drive_velocity", "normal_load", "strength", "state")
IN_TIME = ("drive_velocity", "normal_load", "state")
"""Kinds that change in time, which the steps have to resolve."""

ALONG_X = ("strength", "state")
"""Kinds that vary along x, which the mesh has to resolve."""

ELEMENTS_PER_CORRELATION = 4
"""Elements within a correlation length from which on a mesh has the roughness that is declared."""

STEPS_PER_CORRELATION = 10
"""Steps within a correlation time, at least: then they err by less than the law's tolerance."""


@dataclasses.dataclass(frozen=True)
class Perturbation(Checked):
    """The declared perturbation of a run; the run is quiet by default.

    The correlation time is counted in memory times D/V: friction averages over what is faster. The
    correlation length is in metres: roughness belongs to the surfaces, which know neither block nor
    theory nor mesh. It has to be resolved by the mesh, which else samples some other roughness. The
    front, at dL/dt, meets roughness with the frequencies ``k dL/dt``; what shakes the patch most is
    that at the frequency of its mode, of a wavelength of some 0.01 m with the paper's parameters.
    """

    kind: str = quantity("what is perturbed", choices=KINDS, default="none")
    strength: float = quantity(
        "relative strength of the perturbation, its standard deviation",
        low=0.0, high=0.1, closed="both", symbol="eps", default=0.0,
    )  # fmt: skip
    correlation_time: float = quantity(
        "correlation time of the perturbation over the memory time D/V",
        low=0.0, high=1e6, default=1.0,
    )  # fmt: skip
    correlation_length: float = quantity(
        "correlation length of the perturbation along x", unit="m", low=0.0, high=1e6, default=0.02
    )
    seed: int = quantity(
        "seed of the perturbation's realisation", low=0, high=2**63 - 1, closed="both", default=0
    )

    @property
    def acts(self) -> bool:
        """Whether anything is perturbed at all."""
        return self.kind != "none" and self.strength > 0.0

    def longest_step(self, memory_time: float) -> float:
        """The longest time step (s) that resolves the perturbation, infinite if every step does."""
        if not self.acts or self.kind not in IN_TIME:
            return math.inf
        return self.correlation_time * memory_time / STEPS_PER_CORRELATION
