"""Stiffness of an elastic layer against tractions on its face, by the condition on its far side.

With ``u_y = i W`` and ``sigma_yy = i N`` every relation is real. For a layer ``0 < y < H`` and
k > 0 the tractions on ``y = 0`` are ``(T, N) = -mu k A (U, W)`` with the dimensionless stiffness

    A = [[A_xx, -A_xy], [-A_xy, A_yy]],    A_xx, A_yy, det A > 0 .

What vanishes on the far side ``y = H`` (as a perturbation: the stress or the velocity is given):

- ``traction``, also called ``free``: sigma_xy and sigma_yy (Eq. 10);
- ``velocity``: u_x and sigma_yy (Eq. S-general_M);
- ``clamped``: u_x and u_y, a layer glued to a rigid base;
- ``roller``: u_y and sigma_xy, a layer on rollers, or half of one that is loaded from both faces.

In antiplane shear slip and displacement are along z, and one number takes the place of A:
``tanh q`` if the far side is free of traction, ``coth q`` if it is held. Normal stress does not
change.

Every entry is a quotient of sums of terms that increase with ``q = |k| H``: nothing is lost for
``q -> 0``, for incompressible layers or when ``cosh(2q)`` overflows (a factor ``exp(-2q)`` is taken
out). Only ``A_xy`` of clamped and roller layers is a difference, and changes sign: under a thin
layer that can't yield to the side, compression by slip wins over the half-space's uplift.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..model.material import ANTIPLANE
from ..model.quantities import ParameterError
from .waves import Array, Waves

SATURATION = 25.0
"""A layer with ``q = |k| H`` above this is a half-space: ``q^2 exp(-2q) < 2e-19``."""


class StiffnessTerms(NamedTuple):
    """Numerators of ``A_xx, A_xy, A_yy, det A`` and their denominator, all times ``exp(-2q)``.

    Each is a sum of :class:`~.waves.Waves` with positive coefficients; the numerator of ``A_xy`` is
    ``xy - xy_less``.
    """

    denominator: Array
    xx: Array
    xy: Array
    xy_less: Array | float
    yy: Array | None
    det: Array | None


class Stiffness(NamedTuple):
    """Dimensionless entries of A (see the module's text), shape of the wavenumber."""

    xx: Array
    xy: Array
    yy: Array
    det: Array


def _velocity_terms(w: Waves, nu: ArrayLike, whole: bool) -> StiffnessTerms:
    """``u_x = sigma_yy = 0``: the inverse of the paper's M (Eq. S-general_M)."""
    return StiffnessTerms(
        denominator=(3.0 - 4.0 * nu) * w.sinh_2q + w.linear,
        xx=8.0 * (1.0 - nu) * w.cosh_squared,
        xy=2.0 * (w.linear + (1.0 - 2.0 * nu) * w.sinh_2q),
        xy_less=0.0,
        yy=8.0 * (1.0 - nu) * w.sinh_squared if whole else None,
        det=4.0 * w.excess if whole else None,
    )


def _roller_terms(w: Waves, nu: ArrayLike, whole: bool) -> StiffnessTerms:
    """``u_y = sigma_xy = 0``: symmetric fields where those of `velocity` are antisymmetric.

    ``A_xy D = 2 [(1 - 2 nu) sinh 2q - 2q]`` with ``D = (3 - 4 nu) sinh 2q - 2q``.
    """
    return StiffnessTerms(
        denominator=2.0 * (1.0 - 2.0 * nu) * w.sinh_2q + w.excess,
        xx=8.0 * (1.0 - nu) * w.sinh_squared,
        xy=2.0 * (w.excess + 2.0 * np.maximum(-nu, 0.0) * w.sinh_2q),
        xy_less=4.0 * np.maximum(nu, 0.0) * w.sinh_2q,
        yy=8.0 * (1.0 - nu) * w.cosh_squared if whole else None,
        det=4.0 * (w.sinh_2q + w.linear) if whole else None,
    )


def _traction_terms(w: Waves, nu: ArrayLike, whole: bool) -> StiffnessTerms:
    """``sigma_xy = sigma_yy = 0``: the first column is Eq. (10)."""
    compression = 4.0 * (1.0 - nu)
    return StiffnessTerms(
        denominator=compression**2 / 2.0 * w.decay
        + 2.0 * w.square
        + 2.0 * (3.0 - 4.0 * nu) * w.sinh_squared,
        xx=compression * (w.sinh_2q + w.linear),
        xy=4.0 * (w.square + (1.0 - 2.0 * nu) * w.sinh_squared),
        xy_less=0.0,
        yy=compression * w.excess if whole else None,
        det=8.0 * w.square_excess if whole else None,
    )


def _clamped_terms(w: Waves, nu: ArrayLike, whole: bool) -> StiffnessTerms:
    """``u_x = u_y = 0``, with ``kappa = 3 - 4 nu > 1``.

    ``A_xx, A_yy = 2 (1 - nu) (kappa sinh 2q -+ 2q) / D``,
    ``A_xy = 2 [(1 - 2 nu) kappa sinh^2 q - q^2] / D``,
    ``det A = 4 [kappa sinh^2 q + q^2 + 4 (1 - nu)^2] / D``, ``D = kappa^2 sinh^2 q - q^2``.
    """
    kappa, kappa_less = 3.0 - 4.0 * nu, 2.0 * (1.0 - 2.0 * nu)  # kappa - 1
    coupling = 2.0 * (1.0 - nu) * (1.0 - 4.0 * nu)  # (1 - 2 nu) kappa - 1
    yy = det = None
    if whole:
        yy = 2.0 * (1.0 - nu) * (kappa * w.sinh_2q + w.linear)
        det = 4.0 * (kappa * w.sinh_squared + w.square + 4.0 * (1.0 - nu) ** 2 * w.decay)
    return StiffnessTerms(
        denominator=4.0 * (1.0 - nu) * kappa_less * w.sinh_squared + w.square_excess,
        xx=2.0 * (1.0 - nu) * (kappa_less * w.sinh_2q + w.excess),
        xy=2.0 * (np.maximum(coupling, 0.0) * w.sinh_squared + w.square_excess),
        xy_less=2.0 * np.maximum(-coupling, 0.0) * w.sinh_squared,
        yy=yy,
        det=det,
    )


FAR_SIDES: dict[str, Callable[[Waves, ArrayLike, bool], StiffnessTerms]] = {
    "velocity": _velocity_terms,
    "traction": _traction_terms,
    "free": _traction_terms,
    "clamped": _clamped_terms,
    "roller": _roller_terms,
}
"""The conditions on the far side, by name; ``free`` is another word for ``traction``."""


def _antiplane_free_terms(w: Waves, nu: ArrayLike, whole: bool) -> StiffnessTerms:
    """``sigma_yz = 0``: ``tanh q = sinh 2q/(2 cosh^2 q)``; the other entry of A is 1."""
    below = 2.0 * w.cosh_squared
    return StiffnessTerms(below, w.sinh_2q, 0.0 * below, 0.0, below, w.sinh_2q)


def _antiplane_held_terms(w: Waves, nu: ArrayLike, whole: bool) -> StiffnessTerms:
    """``u_z = 0``: ``coth q = sinh 2q/(2 sinh^2 q)``."""
    below = 2.0 * w.sinh_squared
    return StiffnessTerms(below, w.sinh_2q, 0.0 * below, 0.0, below, w.sinh_2q)


OF_ANTIPLANE: dict[str, Callable[[Waves, ArrayLike, bool], StiffnessTerms]] = {
    "velocity": _antiplane_held_terms,
    "traction": _antiplane_free_terms,
    "free": _antiplane_free_terms,
    "clamped": _antiplane_held_terms,
}
"""The same in antiplane shear. Rollers, which let a layer slide along x alone, are not known."""


def require_far_side(name: str, far_side: str, plane: str) -> None:
    """Raise ParameterError if a far side is not one of a plane of deformation."""
    if plane == ANTIPLANE and far_side not in OF_ANTIPLANE:
        raise ParameterError(
            f"{name} = {far_side!r} is not allowed with plane = {plane}: it must be one of "
            f"{', '.join(OF_ANTIPLANE)}"
        )


class Layers(NamedTuple):
    """Elastic layers: one, or as many as the arrays have entries; they broadcast with k."""

    shear_modulus: Array  # mu (Pa)
    poisson_ratio: Array
    height: Array  # H (m), inf for a half-space
    far_side: str  # one of FAR_SIDES, of all of them
    antiplane: bool = False  # slip is along z; Poisson's ratio does not matter

    def at(self, index: NDArray) -> Layers:
        """The layers of an index; the fields have to be arrays."""
        return self._replace(
            shear_modulus=self.shear_modulus[index],
            poisson_ratio=self.poisson_ratio[index],
            height=self.height[index],
        )

    def layer_number(self, wavenumber: ArrayLike) -> Array:
        """``q = |k| H``, cut at :data:`SATURATION`, beyond which nothing depends on it."""
        return np.minimum(np.abs(np.asarray(wavenumber, dtype=float)) * self.height, SATURATION)

    def terms(self, waves: Waves, whole: bool = True) -> StiffnessTerms:
        """Scaled numerators and denominator of the stiffness; `whole`: with yy and det."""
        known = OF_ANTIPLANE if self.antiplane else FAR_SIDES
        return known[self.far_side](waves, self.poisson_ratio, whole)

    def stiffness(self, wavenumber: ArrayLike, whole: bool = True) -> Stiffness:
        """Dimensionless stiffness A at a wavenumber (1/m)."""
        below, xx, xy, xy_less, yy, det = self.terms(Waves(self.layer_number(wavenumber)), whole)
        rest = (yy / below, det / below) if whole else (None, None)
        return Stiffness(xx / below, (xy - xy_less) / below, *rest)


class Pair(NamedTuple):
    """The bodies above and below the interface, one pair or many; None stands for a rigid body."""

    upper: Layers | None
    lower: Layers | None

    @property
    def modulus(self) -> Array:
        """Shear modulus (Pa) by which G1 and G2 are normalised, of the first deformable body."""
        body = self.lower if self.upper is None else self.upper
        if body is None:
            raise ValueError("at least one of the two bodies must be deformable")
        return body.shear_modulus

    @property
    def ratio(self) -> Array | float:
        """``mu2/mu1``; 1 if a body is rigid."""
        if self.upper is None or self.lower is None:
            return 1.0
        return self.lower.shear_modulus / self.upper.shear_modulus

    def at(self, index: NDArray) -> Pair:
        """The pairs of an index."""
        return Pair(*(body and body.at(index) for body in self))

    def stiffness(self, wavenumber: ArrayLike, whole: bool = True) -> Stiffness:
        """Stiffness of the pair in series, over :attr:`modulus`, at a wavenumber (1/m).

        Unless `whole`, ``yy`` and ``det`` may be missing.
        """
        whole = whole or None not in self
        upper, lower = (body and body.stiffness(wavenumber, whole) for body in self)
        return series_stiffness(upper, lower, self.ratio)

    def transfer_functions(self, wavenumber: Array) -> tuple[Array, Array]:
        """G1 and G2 at wavenumbers (1/m) of either sign."""
        found = self.stiffness(wavenumber, whole=False)
        return np.sign(wavenumber) * found.xx, found.xy


def series_stiffness(
    upper: Stiffness | None, lower: Stiffness | None, ratio: ArrayLike
) -> Stiffness:
    """``(A^-1 + B^-1)^-1`` of the upper stiffness A and ``ratio`` times the lower one, mirrored.

    None stands for a rigid body. The result's ``xy`` has the sign of the upper body's; its
    subtraction vanishes exactly for mirror-symmetric pairs.
    """
    if upper is None:
        return Stiffness(lower.xx, -lower.xy, lower.yy, lower.det)  # type: ignore[union-attr]
    if lower is None:
        return upper
    a, b, r = upper, lower, ratio
    joint = a.det + r * (a.xx * b.yy + a.yy * b.xx + 2.0 * a.xy * b.xy) + r**2 * b.det
    share_a, share_b = r**2 * b.det / joint, r * a.det / joint
    return Stiffness(
        share_a * a.xx + share_b * b.xx,
        share_a * a.xy - share_b * b.xy,
        share_a * a.yy + share_b * b.yy,
        a.det * r**2 * b.det / joint,
    )
