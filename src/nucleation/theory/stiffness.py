"""Stiffness of an elastic layer against tractions on its face, for each far-side condition.

With ``u_y = i W`` and ``sigma_yy = i N`` every relation is real. For a layer ``0 < y < H`` and
k > 0 the tractions on ``y = 0`` are ``(T, N) = -mu k A (U, W)`` with the dimensionless stiffness

    A = [[A_xx, -A_xy], [-A_xy, A_yy]],    A_xx, A_yy, det A > 0 .

On the far side ``y = H`` two perturbations vanish, those of the imposed stress or velocity:

- ``traction``, also called ``free``: sigma_xy and sigma_yy (Eq. 10);
- ``velocity``: u_x and sigma_yy (Eq. S-general_M);
- ``clamped``: u_x and u_y, a layer glued to a rigid base;
- ``roller``: u_y and sigma_xy, a layer on rollers, or half of one that is loaded from both faces.

With ``kappa = 3 - 4 nu`` and ``Delta = 2 q^2 + kappa cosh 2q - 4 nu (3 - 2 nu) + 5`` A is

    traction: A_xx = 4 (1-nu) (sinh 2q + 2q) / Delta,    A_yy = 4 (1-nu) (sinh 2q - 2q) / Delta,
              A_xy = 4 [(1-2nu) sinh^2 q + q^2] / Delta
    velocity: A_xx = 8 (1-nu) cosh^2 q / d,    A_yy = 8 (1-nu) sinh^2 q / d,
              A_xy = 2 [(1-2nu) sinh 2q + 2q] / d    with d = kappa sinh 2q + 2q
    roller:   A_xx = 8 (1-nu) sinh^2 q / d,    A_yy = 8 (1-nu) cosh^2 q / d,
              A_xy = 2 [(1-2nu) sinh 2q - 2q] / d    with d = kappa sinh 2q - 2q
    clamped:  A_xx = 2 (1-nu) (kappa sinh 2q - 2q) / d,
              A_yy = 2 (1-nu) (kappa sinh 2q + 2q) / d,
              A_xy = 2 [(1-2nu) kappa sinh^2 q - q^2] / d    with d = kappa^2 sinh^2 q - q^2

In antiplane shear slip and displacement are along z, and one number replaces A: ``tanh q`` if the
far side is free of traction, ``coth q`` if it is held. The normal stress does not change.

Every entry is a quotient of sums of terms that increase with ``q = |k| H``. So it is accurate for
``q -> 0``, for incompressible layers and where ``cosh(2q)`` overflows (a factor ``exp(-2q)`` is
taken out). Only ``A_xy`` of clamped and roller layers is a difference, and changes sign: in a thin
layer that cannot expand sideways, compression by slip exceeds the half-space's uplift. A body with
a layer of another material beside the interface is in :mod:`.zone`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..model.material import ANTIPLANE
from ..model.quantities import ParameterError
from .waves import Array, Waves

SATURATION = 25.0
"""A layer with ``q = |k| H`` above this is a half-space: ``q^2 exp(-2q) < 2e-19``."""


class StiffnessTerms(NamedTuple):
    """Numerators of ``A_xx, A_xy, A_yy, det A`` and their denominator, all times ``exp(-2q)``.

    Each but ``A_xy`` is a sum of :class:`~.waves.Waves` with positive coefficients.
    """

    denominator: Array
    xx: Array
    xy: Array
    yy: Array
    det: Array


class Stiffness(NamedTuple):
    """Dimensionless entries of A (:mod:`nucleation.theory.stiffness`), shape of the wavenumber."""

    xx: Array
    xy: Array
    yy: Array
    det: Array


def _velocity_terms(
    w: Waves,
    nu: Array,
) -> StiffnessTerms:
    """``u_x = sigma_yy = 0``: the inverse of the paper's M (Eq. S-general_M)."""
    return StiffnessTerms(
        denominator=(3.0 - 4.0 * nu) * w.sinh_2q + w.linear,
        xx=8.0 * (1.0 - nu) * w.cosh_squared,
        xy=2.0 * (w.linear + (1.0 - 2.0 * nu) * w.sinh_2q),
        yy=8.0 * (1.0 - nu) * w.sinh_squared,
        det=4.0 * w.excess,
    )


def _roller_terms(
    w: Waves,
    nu: Array,
) -> StiffnessTerms:
    """``u_y = sigma_xy = 0``: symmetric fields where those of `velocity` are antisymmetric.

    ``A_xy D = 2 [(1 - 2 nu) sinh 2q - 2q]`` with ``D = (3 - 4 nu) sinh 2q - 2q``.
    """
    return StiffnessTerms(
        denominator=2.0 * (1.0 - 2.0 * nu) * w.sinh_2q + w.excess,
        xx=8.0 * (1.0 - nu) * w.sinh_squared,
        xy=2.0 * (w.excess - 2.0 * nu * w.sinh_2q),
        yy=8.0 * (1.0 - nu) * w.cosh_squared,
        det=4.0 * (w.sinh_2q + w.linear),
    )


def _traction_terms(
    w: Waves,
    nu: Array,
) -> StiffnessTerms:
    """``sigma_xy = sigma_yy = 0``: the first column is Eq. (10)."""
    compression = 4.0 * (1.0 - nu)
    constant = compression**2 / 2.0 * w.decay
    return StiffnessTerms(
        denominator=constant + 2.0 * w.square + 2.0 * (3.0 - 4.0 * nu) * w.sinh_squared,
        xx=compression * (w.sinh_2q + w.linear),
        xy=4.0 * (w.square + (1.0 - 2.0 * nu) * w.sinh_squared),
        yy=compression * w.excess,
        det=8.0 * w.square_excess,
    )


def _clamped_terms(
    w: Waves,
    nu: Array,
) -> StiffnessTerms:
    """``u_x = u_y = 0``, with ``kappa = 3 - 4 nu > 1``.

    ``A_xx, A_yy = 2 (1 - nu) (kappa sinh 2q -+ 2q) / D``,
    ``A_xy = 2 [(1 - 2 nu) kappa sinh^2 q - q^2] / D``,
    ``det A = 4 [kappa sinh^2 q + q^2 + 4 (1 - nu)^2] / D``, ``D = kappa^2 sinh^2 q - q^2``.
    """
    kappa = 3.0 - 4.0 * nu
    kappa_less = 2.0 * (1.0 - 2.0 * nu)  # kappa - 1
    coupling = 2.0 * (1.0 - nu) * (1.0 - 4.0 * nu)  # (1 - 2 nu) kappa - 1
    constant = 4.0 * (1.0 - nu) ** 2 * w.decay
    return StiffnessTerms(
        denominator=4.0 * (1.0 - nu) * kappa_less * w.sinh_squared + w.square_excess,
        xx=2.0 * (1.0 - nu) * (kappa_less * w.sinh_2q + w.excess),
        xy=2.0 * (coupling * w.sinh_squared + w.square_excess),
        yy=2.0 * (1.0 - nu) * (kappa * w.sinh_2q + w.linear),
        det=4.0 * (kappa * w.sinh_squared + w.square + constant),
    )


_Terms: TypeAlias = Callable[[Waves, Array], StiffnessTerms]

FAR_SIDES: dict[str, _Terms] = {
    "velocity": _velocity_terms,
    "traction": _traction_terms,
    "free": _traction_terms,
    "clamped": _clamped_terms,
    "roller": _roller_terms,
}
"""Boundary conditions on the far side, by name; ``free`` is an alias of ``traction``."""


def _antiplane_free_terms(
    w: Waves,
    nu: Array,
) -> StiffnessTerms:
    """``sigma_yz = 0``: ``tanh q = sinh 2q/(2 cosh^2 q)``; the other entry of A is 1."""
    return antiplane_terms(w.sinh_2q, 2.0 * w.cosh_squared)


def _antiplane_held_terms(
    w: Waves,
    nu: Array,
) -> StiffnessTerms:
    """``u_z = 0``: ``coth q = sinh 2q/(2 sinh^2 q)``."""
    return antiplane_terms(w.sinh_2q, 2.0 * w.sinh_squared)


def antiplane_terms(
    numerator: Array,
    denominator: Array,
) -> StiffnessTerms:
    """A quotient for ``A_xx`` and ``det A``; ``A_yy = 1`` and ``A_xy = 0``."""
    return StiffnessTerms(
        denominator=denominator,
        xx=numerator,
        xy=0.0 * denominator,
        yy=denominator,
        det=numerator,
    )


OF_ANTIPLANE: dict[str, _Terms] = {
    "velocity": _antiplane_held_terms,
    "traction": _antiplane_free_terms,
    "free": _antiplane_free_terms,
    "clamped": _antiplane_held_terms,
}
"""The same in antiplane shear, without rollers: they let a layer slide along x alone."""


def require_far_side(
    name: str,
    far_side: str,
    plane: str,
) -> None:
    """Raise a ParameterError if a plane of deformation does not have the boundary condition."""
    if plane == ANTIPLANE and far_side not in OF_ANTIPLANE:
        allowed = ", ".join(OF_ANTIPLANE)
        raise ParameterError(
            f"{name} = {far_side!r} is not allowed with plane = {plane}: "
            f"it must be one of {allowed}"
        )


class Layers(NamedTuple):
    """One elastic layer or many with the same boundary condition; fields broadcast with k."""

    shear_modulus: Array  # mu (Pa)
    poisson_ratio: Array
    height: Array  # H (m), inf for a half-space
    far_side: str  # one of FAR_SIDES
    antiplane: bool = False  # slip is along z, and Poisson's ratio does not matter

    def at(self, index: NDArray) -> Layers:
        """The layers of an index or a mask."""
        return self._replace(
            shear_modulus=self.shear_modulus[index],
            poisson_ratio=self.poisson_ratio[index],
            height=self.height[index],
        )

    @property
    def thicknesses(self) -> list[Array]:
        """The height (m) alone, as there is no zone beside the interface."""
        return [self.height]

    def with_zone_at_least(self, thickness: float) -> Layers:
        """The same layers: they have no zone."""
        return self

    @property
    def contrast(self) -> float:
        """1, as there is no other material."""
        return 1.0

    def with_heights(self, heights: Callable[[Array], Array]) -> Layers:
        """The layers with other heights (m), a function of the present ones."""
        return self._replace(height=heights(self.height))

    def layer_number(self, wavenumber: ArrayLike) -> Array:
        """``q = |k| H``, cut at :data:`SATURATION`, above which no function of q changes."""
        k = np.abs(np.asarray(wavenumber, dtype=float))
        return np.minimum(k * self.height, SATURATION)

    def stiffness(self, wavenumber: ArrayLike) -> Stiffness:
        """Dimensionless stiffness A at a wavenumber (1/m)."""
        known = OF_ANTIPLANE if self.antiplane else FAR_SIDES
        waves = Waves(self.layer_number(wavenumber))
        below, *above = known[self.far_side](waves, self.poisson_ratio)
        return Stiffness(*(numerator / below for numerator in above))
