"""Two layers of one period on one another: homogeneous sliding of a pair and its modes.

Each layer has the modes of :mod:`.periodic`; they are put in series mode by mode (:mod:`.series`).
If no far side is held, the mean displacement of both layers together is free: in motion inertia
determines it; in statics, where the tractions on both far sides are in balance, it is zero.
"""

from __future__ import annotations

import numpy as np

from .grid import Field
from .periodic import Circulant, PeriodicBlock
from .series import SeriesOperator, TwoBodies


class PeriodicPair(TwoBodies[PeriodicBlock]):
    """A period of two layers, driven by shear tractions on their far sides."""

    def operator(self, s: float) -> _PeriodicPairOperator:
        """Factorise the dynamic stiffness ``K + s M`` (`s` in 1/s^2)."""
        return _PeriodicPairOperator(self, s)

    def top_load(self, normal_stress: float, shear_stress: float = 0.0) -> Field:
        """Return the nodal forces of stresses on the far sides.

        A component has no effect where the lower far side is held along its direction.

        Parameters
        ----------
        normal_stress : float
            Compressive stress (Pa).
        shear_stress : float
            Traction along x on the upper layer, opposite on the lower one (Pa).

        Returns
        -------
        Field
            The load (N/m).
        """
        above = self.upper.top_load(normal_stress, shear_stress)
        below = self.lower.top_load(normal_stress, -shear_stress)
        return self.joined(above, below)


class _PeriodicPairOperator(SeriesOperator, Circulant):
    """``K + s M`` of a :class:`PeriodicPair`; D and N are circulant."""

    def __init__(self, body: PeriodicPair, s: float) -> None:
        with np.errstate(invalid="ignore", divide="ignore"):
            super().__init__(body, s, body.upper.operator(s), body.lower.operator(s))
        mass = body.upper.material.density + body.lower.material.density
        if body.lower.far_side == "free" and s * mass == 0.0:
            # the mean: both layers transmit the forces in balance, and do not move
            self.modal[:, 0] = 0.0
            self.compliance[:, 0] = 0.0
            self.forces[:, 0] = np.tile(0.5 * np.eye(2).ravel(), 2)
            self.by_slip[:, 0] = 0.5, 0.0
