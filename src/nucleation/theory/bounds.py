"""Rigorous bounds of the transfer functions over intervals of the wavenumber.

Every entry of a body's stiffness is ``N(q)/D(q)`` with N and D positive and increasing in
``q = |k| H`` (:mod:`.transfer`), hence ``N(q1)/D(q2) <= N/D <= N(q2)/D(q1)`` for ``q1 <= q <= q2``.
The stiffness of a pair combines these by sums, products and one quotient of positive quantities,
whose extremes come from the ends in the same way. The bounds close linearly with the interval.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from .transfer import Array, Body, RigidBody, Stiffness


class TransferBounds(NamedTuple):
    """``g1_low <= |G1| <= g1_high`` and ``|G2| <= g2_high`` over each interval."""

    g1_low: Array
    g1_high: Array
    g2_high: Array


def stiffness_bounds(k_low: Array, k_high: Array, body: Body) -> tuple[Stiffness, Stiffness]:
    """Lower and upper bounds of a body's dimensionless stiffness over ``[k_low, k_high]``."""
    q_low, q_high = body.layer_number(k_low), body.layer_number(k_high)
    *at_low, least = body.stiffness_terms(q_low)
    *at_high, greatest = body.stiffness_terms(q_high)
    rescale = np.exp(2.0 * (q_high - q_low))  # the terms carry exp(-2q)
    low = Stiffness(*(numerator / greatest / rescale for numerator in at_low))
    high = Stiffness(*(numerator / least * rescale for numerator in at_high))
    return low, high


def transfer_bounds(
    k_low: Array, k_high: Array, upper: Body | RigidBody, lower: Body | RigidBody
) -> TransferBounds:
    """Bounds of the transfer functions over intervals ``0 < k_low <= k <= k_high`` (1/m)."""
    if isinstance(upper, RigidBody) or isinstance(lower, RigidBody):
        body = lower if isinstance(upper, RigidBody) else upper
        low, high = stiffness_bounds(k_low, k_high, body)
        return TransferBounds(low.xx, high.xx, high.xy)
    r = lower.material.shear_modulus / upper.material.shear_modulus
    (a, a_high), (b, b_high) = (stiffness_bounds(k_low, k_high, x) for x in (upper, lower))

    def joint(a: Stiffness, b: Stiffness) -> Array:
        return a.det + r * (a.xx * b.yy + a.yy * b.xx + 2.0 * a.xy * b.xy) + r**2 * b.det

    def diagonal(a: Stiffness, b: Stiffness) -> Array:
        return r**2 * b.det * a.xx + r * a.det * b.xx

    coupling = np.maximum(
        r**2 * b_high.det * a_high.xy - r * a.det * b.xy,
        r * a_high.det * b_high.xy - r**2 * b.det * a.xy,
    )
    least, greatest = joint(a, b), joint(a_high, b_high)
    return TransferBounds(
        diagonal(a, b) / greatest, diagonal(a_high, b_high) / least, coupling / least
    )
