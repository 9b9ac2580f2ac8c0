"""Quasi-static response of elastic bodies to a Fourier mode of interfacial slip (Text S1.1).

All fields vary as ``exp(Lambda t - i k x)``. The upper body (1) occupies ``0 < y < H1``, the lower
body (2) ``-H2 < y < 0``; plane strain. One body responds to tractions by
``du_i = M_ij dsigma_yj``, and a pair of bodies that slides without opening by

    dsigma_xy = -mu k G1 deps,    dsigma_yy = i mu k G2 deps .

Stable form. With ``u_y = i W`` and ``sigma_yy = i N`` every relation is real. For the upper body
and k > 0 the tractions are ``(T, N) = -mu k A (U, W)`` with the dimensionless stiffness

    A = [[A_xx, -A_xy], [-A_xy, A_yy]],    A_xx, A_xy, A_yy, det A > 0 ,

whose entries are quotients of sums of positive terms that increase with ``q = |k| H``. The lower
body is the mirror image: ``-A_xy`` changes sign. In ``G = (M1 - M2)^-1`` the stiffnesses act in
series; for 2x2 matrices that is, without a subtraction in the diagonal entries,

    (A^-1 + B^-1)^-1 = (det(B) A + det(A) B) / det(A + B) .

So nothing is lost when M is singular (a free body translates as a whole for Hk -> 0), when the
pair is ill-conditioned, or when ``cosh(2Hk)`` overflows (a factor ``exp(-2q)`` is taken out).
"""

from __future__ import annotations

import dataclasses
import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..model.material import Material
from ..model.quantities import Checked, quantity

Array = NDArray[np.float64]

SATURATION = 25.0
"""A layer with ``q = |k| H`` above this is a half-space: ``q^2 exp(-2q) < 2e-19``."""


class StiffnessTerms(NamedTuple):
    """Numerators of ``A_xx, A_xy, A_yy, det A`` and their denominator, all times ``exp(-2q)``."""

    xx: Array
    xy: Array
    yy: Array
    det: Array
    denominator: Array


class Stiffness(NamedTuple):
    """Dimensionless entries of A (see the module's text), shape of the wavenumber."""

    xx: Array
    xy: Array
    yy: Array
    det: Array


def scaled_sinh_excess(x: ArrayLike) -> Array:
    """``(sinh(x) - x) exp(-x)`` for ``x >= 0`` without cancellation (power series below 1)."""
    x = np.asarray(x, dtype=float)
    direct = -0.5 * np.expm1(-2.0 * x) - x * np.exp(-x)
    small = np.minimum(x, 1.0)
    square, series = small**2, np.ones_like(small)
    for order in range(17, 3, -2):
        series = 1.0 + series * square / ((order - 1.0) * order)
    return np.where(x < 1.0, small**3 / 6.0 * series * np.exp(-small), direct)


def _velocity_terms(q: Array, nu: float) -> StiffnessTerms:
    """Far side held (``u_x = 0, sigma_yy = 0``): the inverse of the paper's M (Eq. S-general_M)."""
    decay = np.exp(-2.0 * q)
    sinh_2q = -0.5 * np.expm1(-4.0 * q)
    linear = 2.0 * q * decay
    return StiffnessTerms(
        xx=2.0 * (1.0 - nu) * (1.0 + decay) ** 2,
        xy=2.0 * (linear + (1.0 - 2.0 * nu) * sinh_2q),
        yy=2.0 * (1.0 - nu) * np.expm1(-2.0 * q) ** 2,
        det=4.0 * scaled_sinh_excess(2.0 * q),
        denominator=(3.0 - 4.0 * nu) * sinh_2q + linear,
    )


def _traction_terms(q: Array, nu: float) -> StiffnessTerms:
    """Far side free (``sigma_xy = sigma_yy = 0``): the first column is Eq. (10)."""
    decay = np.exp(-2.0 * q)
    sinh_2q = -0.5 * np.expm1(-4.0 * q)
    sinh_squared = 0.25 * np.expm1(-2.0 * q) ** 2
    sinh_plus = -0.5 * np.expm1(-2.0 * q) + q * np.exp(-q)  # (sinh q + q) exp(-q)
    square = q**2 * decay
    return StiffnessTerms(
        xx=4.0 * (1.0 - nu) * (sinh_2q + 2.0 * q * decay),
        xy=4.0 * (square + (1.0 - 2.0 * nu) * sinh_squared),
        yy=4.0 * (1.0 - nu) * scaled_sinh_excess(2.0 * q),
        det=8.0 * scaled_sinh_excess(q) * sinh_plus,
        denominator=8.0 * (1.0 - nu) ** 2 * decay
        + 2.0 * square
        + 2.0 * (3.0 - 4.0 * nu) * sinh_squared,
    )


_TERMS = {"velocity": _velocity_terms, "traction": _traction_terms}


@dataclasses.dataclass(frozen=True)
class Body(Checked):
    """An elastic body, infinite along x, on one side of the interface (SI units)."""

    material: Material = Material()
    height: float = quantity(
        "height of the body (inf: half-space)", unit="m", low=0.0, high=math.inf, closed="high",
        symbol="H", default=math.inf,
    )  # fmt: skip
    far_side: str = quantity(
        "condition on the side away from the interface: velocity (u_x and sigma_yy imposed) or "
        "traction (sigma_xy and sigma_yy imposed)",
        choices=tuple(_TERMS), default="velocity",
    )  # fmt: skip

    def layer_number(self, wavenumber: ArrayLike) -> Array:
        """``q = |k| H``, cut at :data:`SATURATION`, beyond which nothing depends on it."""
        k = np.abs(np.asarray(wavenumber, dtype=float))
        if math.isinf(self.height):
            return np.full_like(k, SATURATION)
        return np.minimum(k * self.height, SATURATION)

    def stiffness_terms(self, q: Array) -> StiffnessTerms:
        """Scaled numerators and denominator of the stiffness; each unscaled one grows with q."""
        return _TERMS[self.far_side](q, self.material.poisson_ratio)

    def stiffness(self, wavenumber: ArrayLike) -> Stiffness:
        """Dimensionless stiffness A at a wavenumber (1/m)."""
        *numerators, denominator = self.stiffness_terms(self.layer_number(wavenumber))
        return Stiffness(*(numerator / denominator for numerator in numerators))


@dataclasses.dataclass(frozen=True)
class RigidBody:
    """A body that does not deform (``M = 0``)."""


RIGID = RigidBody()


def as_wavenumber(wavenumber: ArrayLike) -> Array:
    """The wavenumber as a float array; raises ValueError unless it is finite and not zero."""
    k = np.asarray(wavenumber, dtype=float)
    if not np.all(np.isfinite(k) & (k != 0.0)):
        raise ValueError("the wavenumber k (1/m) must be finite and different from zero")
    return k


def reference_modulus(upper: Body | RigidBody, lower: Body | RigidBody) -> float:
    """Shear modulus mu (Pa) by which G1 and G2 are normalised.

    That of the upper body (Eq. S-sig_G); of the lower body if the upper one is rigid.

    Raises
    ------
    ValueError
        If both bodies are rigid: nothing can slip non-uniformly then.
    """
    for body in (upper, lower):
        if isinstance(body, Body):
            return body.material.shear_modulus
    raise ValueError("at least one of the two bodies must be deformable")


def series_stiffness(upper: Stiffness | None, lower: Stiffness | None, ratio: float) -> Stiffness:
    """``(A^-1 + B^-1)^-1`` of the upper stiffness A and ``ratio`` times the lower one, mirrored.

    None stands for a rigid body. The result's ``xy`` has the sign of the upper body's; it is the
    only entry with a subtraction, which vanishes exactly for mirror-symmetric pairs.
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


def _pair_stiffness(k: Array, upper: Body | RigidBody, lower: Body | RigidBody) -> Stiffness:
    stiffness = [b.stiffness(k) if isinstance(b, Body) else None for b in (upper, lower)]
    ratio = 1.0
    if isinstance(upper, Body) and isinstance(lower, Body):
        ratio = lower.material.shear_modulus / upper.material.shear_modulus
    return series_stiffness(*stiffness, ratio)  # type: ignore[call-arg]


def transfer_functions(
    wavenumber: ArrayLike, upper: Body | RigidBody, lower: Body | RigidBody
) -> tuple[Array, Array]:
    """Elastic transfer functions of a pair of bodies.

    Parameters
    ----------
    wavenumber : array_like
        k (1/m), any shape, either sign, not zero.
    upper, lower : Body or RigidBody
        The bodies above and below the interface; at most one is rigid.

    Returns
    -------
    G1, G2 : ndarray
        Dimensionless, shape of k; G1 is odd and G2 even in k.

    Notes
    -----
    ``G1 = -G_xx/(mu k)`` and ``G2 = -i G_yx/(mu k)`` with ``G = (M1 - M2)^-1`` (Eqs. S-defG and
    S-sig_G) and mu of :func:`reference_modulus`.
    """
    k = as_wavenumber(wavenumber)
    reference_modulus(upper, lower)
    pair = _pair_stiffness(k, upper, lower)
    return np.sign(k) * pair.xx, pair.xy


def interface_matrix(
    wavenumber: ArrayLike, upper: Body | RigidBody, lower: Body | RigidBody
) -> NDArray[np.complex128]:
    """``G = (M1 - M2)^-1`` (Pa/m, shape ``k.shape + (2, 2)``) of Eq. (S-defG)."""
    k = as_wavenumber(wavenumber)
    modulus = reference_modulus(upper, lower)
    pair = _pair_stiffness(k, upper, lower)
    cross = 1j * np.sign(k) * pair.xy
    rows = [[-pair.xx, -cross], [cross, -pair.yy]]
    return _matrix(rows) * (modulus * np.abs(k))[..., None, None]


def response_matrix(
    wavenumber: ArrayLike, body: Body | RigidBody, side: str = "upper"
) -> NDArray[np.complex128]:
    """Response ``M`` of one body, ``du_i = M_ij dsigma_yj`` at the interface.

    Parameters
    ----------
    wavenumber : array_like
        k (1/m), any shape, not zero.
    body : Body or RigidBody
    side : {"upper", "lower"}
        The side of the interface on which the body lies.

    Returns
    -------
    M : ndarray
        Complex, m/Pa, shape ``k.shape + (2, 2)``.

    Raises
    ------
    ValueError
        For another side, or a wavenumber that is zero or not finite.

    Notes
    -----
    Far side "velocity": Eq. (S-general_M); half-space: Eq. (S-M_inf).
    """
    if side not in ("upper", "lower"):
        raise ValueError(f"side = {side!r} is not allowed: it must be one of upper, lower")
    k = as_wavenumber(wavenumber)
    if isinstance(body, RigidBody):
        return np.zeros((*k.shape, 2, 2), dtype=complex)
    terms = body.stiffness_terms(body.layer_number(k))
    cross = 1j * np.sign(k) * terms.xy / terms.det
    sign = -1.0 if side == "upper" else 1.0
    rows = [[sign * terms.yy / terms.det, cross], [-cross, sign * terms.xx / terms.det]]
    return _matrix(rows) / (body.material.shear_modulus * np.abs(k))[..., None, None]


def _matrix(rows: list[list[NDArray]]) -> NDArray[np.complex128]:
    entries = [np.stack([np.asarray(entry, dtype=complex) for entry in row], -1) for row in rows]
    return np.stack(entries, -2)
