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
layer that cannot expand sideways, compression by slip exceeds the half-space's uplift.

A zone of gouge or of damaged rock, a layer ``0 < y < h``, may be bonded to the body behind it. Let
B be the body's stiffness over the layer's modulus, and let P and Q be the layer's own for
displacements of its near and its far face. Then the stiffness of both together is

    C = P - Q (P + B)^-1 Q .

As a quotient of determinants each entry of C is linear in ``B_xx``, ``B_yy``, ``B_xy`` and det B:
numerators and the denominator of C are the sum of those of a free layer, of layers with the far
sides ``velocity``, ``roller`` and ``clamped`` times ``(1 - nu) B_xx``, ``(1 - nu) B_yy`` and
``det B/2``, and of a mixed term times ``B_xy``. Every other term is positive. So C is
accurate from ``kh -> 0``, where it is that of the body, to thick layers, which hide the body. In
antiplane shear it is the sum of a free layer and a held one times ``B_xx``.
"""

from collections.abc import Callable
from typing import NamedTuple, TypeAlias

import numpy as np

from ..types import Array

SATURATION = 25.0
"""A layer with ``q = |k| H`` above this is a half-space: ``q^2 exp(-2q) < 2e-19``."""

_ORDERS = np.arange(17.0, 3.0, -2.0)
_COEFFICIENTS = (1.0 / ((_ORDERS - 1.0) * _ORDERS)).tolist()


def _scaled_sinh_excess(x: Array) -> Array:
    """``(sinh(x) - x) exp(-x)`` for ``x >= 0`` without cancellation (power series below 1)."""
    decay = np.exp(-x)
    excess = np.asarray(-0.5 * np.expm1(-2.0 * x) - x * decay)
    below = x < 1.0
    small = x[below]
    square = small**2
    series = np.ones_like(small)
    for coefficient in _COEFFICIENTS:
        series = 1.0 + series * square * coefficient
    excess[below] = small**3 / 6.0 * series * decay[below]
    return excess


class Waves(NamedTuple):
    """Functions of ``q = |k| H`` in a layer's stiffness, times ``exp(-2q)``; all are positive."""

    decay: Array  # 1
    linear: Array  # 2 q
    square: Array  # q^2
    sinh_2q: Array
    sinh_squared: Array  # sinh^2 q
    cosh_squared: Array  # cosh^2 q
    excess: Array  # sinh 2q - 2q
    square_excess: Array  # sinh^2 q - q^2


def waves(q: Array) -> Waves:
    """The functions of layers, ``q >= 0``."""
    decay = np.exp(-2.0 * q)
    minus = np.expm1(-2.0 * q)
    return Waves(
        decay=decay,
        linear=2.0 * q * decay,
        square=q**2 * decay,
        sinh_2q=-0.5 * np.expm1(-4.0 * q),
        sinh_squared=0.25 * minus**2,
        cosh_squared=0.25 * (1.0 + decay) ** 2,
        excess=_scaled_sinh_excess(2.0 * q),
        square_excess=_scaled_sinh_excess(q) * (-0.5 * minus + q * np.exp(-q)),
    )


Terms: TypeAlias = tuple[Array, Array, Array, Array, Array]
"""The denominator of A, and numerators of ``A_xx, A_xy, A_yy, det A``, all times ``exp(-2q)``.

Each but ``A_xy`` is a sum of :class:`Waves` with positive coefficients.
"""


class Stiffness(NamedTuple):
    """Dimensionless entries of A (:mod:`nucleation.theory.stiffness`), shape of the wavenumber."""

    xx: Array
    xy: Array
    yy: Array
    det: Array


def _velocity_terms(w: Waves, nu: Array) -> Terms:
    """``u_x = sigma_yy = 0``: the inverse of the paper's M (Eq. S-general_M)."""
    return (
        (3.0 - 4.0 * nu) * w.sinh_2q + w.linear,
        8.0 * (1.0 - nu) * w.cosh_squared,
        2.0 * (w.linear + (1.0 - 2.0 * nu) * w.sinh_2q),
        8.0 * (1.0 - nu) * w.sinh_squared,
        4.0 * w.excess,
    )


def _roller_terms(w: Waves, nu: Array) -> Terms:
    """``u_y = sigma_xy = 0``: symmetric fields where those of `velocity` are antisymmetric.

    ``A_xy D = 2 [(1 - 2 nu) sinh 2q - 2q]`` with ``D = (3 - 4 nu) sinh 2q - 2q``.
    """
    return (
        2.0 * (1.0 - 2.0 * nu) * w.sinh_2q + w.excess,
        8.0 * (1.0 - nu) * w.sinh_squared,
        2.0 * (w.excess - 2.0 * nu * w.sinh_2q),
        8.0 * (1.0 - nu) * w.cosh_squared,
        4.0 * (w.sinh_2q + w.linear),
    )


def _traction_terms(w: Waves, nu: Array) -> Terms:
    """``sigma_xy = sigma_yy = 0``: the first column is Eq. (10)."""
    compression = 4.0 * (1.0 - nu)
    constant = compression**2 / 2.0 * w.decay
    return (
        constant + 2.0 * w.square + 2.0 * (3.0 - 4.0 * nu) * w.sinh_squared,
        compression * (w.sinh_2q + w.linear),
        4.0 * (w.square + (1.0 - 2.0 * nu) * w.sinh_squared),
        compression * w.excess,
        8.0 * w.square_excess,
    )


def _clamped_terms(w: Waves, nu: Array) -> Terms:
    """``u_x = u_y = 0``, with ``kappa = 3 - 4 nu > 1``.

    ``A_xx, A_yy = 2 (1 - nu) (kappa sinh 2q -+ 2q) / D``,
    ``A_xy = 2 [(1 - 2 nu) kappa sinh^2 q - q^2] / D``,
    ``det A = 4 [kappa sinh^2 q + q^2 + 4 (1 - nu)^2] / D``, ``D = kappa^2 sinh^2 q - q^2``.
    """
    kappa = 3.0 - 4.0 * nu
    kappa_less = 2.0 * (1.0 - 2.0 * nu)  # kappa - 1
    coupling = 2.0 * (1.0 - nu) * (1.0 - 4.0 * nu)  # (1 - 2 nu) kappa - 1
    constant = 4.0 * (1.0 - nu) ** 2 * w.decay
    return (
        4.0 * (1.0 - nu) * kappa_less * w.sinh_squared + w.square_excess,
        2.0 * (1.0 - nu) * (kappa_less * w.sinh_2q + w.excess),
        2.0 * (coupling * w.sinh_squared + w.square_excess),
        2.0 * (1.0 - nu) * (kappa * w.sinh_2q + w.linear),
        4.0 * (kappa * w.sinh_squared + w.square + constant),
    )


def _mixed_terms(w: Waves, nu: Array) -> Terms:
    """The factor of ``B_xy``; its entries may be negative."""
    compression = 1.0 - nu
    expansion = 1.0 - 2.0 * nu
    kappa = 3.0 - 4.0 * nu
    constant = 8.0 * compression**2 * w.decay
    return (
        2.0 * (expansion * kappa * w.sinh_squared - w.square),
        4.0 * compression * (expansion * w.sinh_2q - w.linear),
        constant + 4.0 * (expansion**2 * w.sinh_squared - w.square),
        4.0 * compression * (expansion * w.sinh_2q + w.linear),
        8.0 * (expansion * w.sinh_squared + w.square),
    )


FAR_SIDES: dict[str, Callable[[Waves, Array], Terms]] = {
    "velocity": _velocity_terms,
    "free": _traction_terms,
    "clamped": _clamped_terms,
    "roller": _roller_terms,
}
"""Boundary conditions on the far side, by name."""

OF_ANTIPLANE = {"velocity": True, "free": False, "clamped": True}
"""Whether they hold the far side in antiplane shear. Rollers let a layer slide along x alone."""


def _antiplane_terms(numerator: Array, denominator: Array) -> Terms:
    """A quotient for ``A_xx`` and ``det A``; ``A_yy = 1`` and ``A_xy = 0``."""
    return denominator, numerator, 0.0 * denominator, denominator, numerator


def layer_stiffness(w: Waves, nu: Array, far_side: str, antiplane: bool) -> Stiffness:
    """Dimensionless stiffness A of a layer; in antiplane shear ``tanh q`` or ``coth q``."""
    if antiplane:
        free = w.sinh_2q, 2.0 * w.cosh_squared
        terms = _antiplane_terms(*(free[::-1] if OF_ANTIPLANE[far_side] else free))
    else:
        terms = FAR_SIDES[far_side](w, nu)
    below, *above = terms
    return Stiffness(*(numerator / below for numerator in above))


def stiffness_with_zone(
    w: Waves, nu: Array, antiplane: bool, behind: Stiffness, ratio: Array
) -> Stiffness:
    """The stiffness of a zone with its body behind, over the body's modulus, `ratio` times its."""
    xx = ratio * behind.xx
    one = np.ones_like(xx)
    if antiplane:
        held, free = 2.0 * w.cosh_squared, w.sinh_2q
        found = [(one, _antiplane_terms(free, held)), (xx, _antiplane_terms(held, free))]
    else:
        shares = {
            "free": one,
            "velocity": (1.0 - nu) * xx,
            "roller": (1.0 - nu) * ratio * behind.yy,
            "clamped": 0.5 * ratio**2 * behind.det,
        }
        found = [(share, FAR_SIDES[name](w, nu)) for name, share in shares.items()]
        found.append((ratio * behind.xy, _mixed_terms(w, nu)))
    terms = [share * np.stack(of_layer) for share, of_layer in found]
    below, *above = np.add.reduce(terms)
    xx, xy, yy, det = (numerator / below for numerator in above)
    scale = 1.0 / ratio  # from over the zone's modulus
    return Stiffness(scale * xx, scale * xy, scale * yy, scale**2 * det)
