"""Rigorous bounds of the transfer functions over intervals of the wavenumber.

Every entry of a layer's stiffness is ``N(q)/D(q)`` with N and D sums of positive functions of
``q = |k| H`` (:mod:`.stiffness`), each of which is monotonic, as it is or times ``exp(-2q)``; so
its extremes are at the ends of the interval, and ``min N/max D <= N/D <= max N/min D``. Only
``A_xy`` may have a difference of two such N. The stiffness of a pair combines these by sums,
products and one quotient, by the arithmetic of intervals. The bounds close linearly with the
interval; where layers are thick they are close whatever the interval.
"""

from typing import NamedTuple

import numpy as np

from .stiffness import Array, Layers, Pair, Stiffness
from .waves import Waves


class TransferBounds(NamedTuple):
    """``g1_low <= |G1| <= g1_high`` and ``|G2| <= g2_high`` over each interval."""

    g1_low: Array
    g1_high: Array
    g2_high: Array


class Extremes:
    """The least or the greatest values of :class:`~.waves.Waves` over intervals of q.

    Where ``q >= 1`` in all of the interval they are those of the functions times ``exp(-2q)``,
    elsewhere those without the factor, over ``exp(2 q)`` at the upper end.
    """

    def __init__(self, low: Waves, high: Waves, greatest: bool) -> None:
        self.low, self.high, self.greatest = low, high, greatest
        self.thick = low.q >= 1.0
        self.grow = np.exp(2.0 * (high.q - low.q))

    def __getattr__(self, name: str) -> Array:
        low, high = getattr(self.low, name), getattr(self.high, name)
        if self.greatest:
            return np.where(self.thick, np.maximum(low, high), high)
        return np.where(self.thick, np.minimum(low, high), low / self.grow)


def stiffness_bounds(
    k_low: Array, k_high: Array, layers: Layers, whole: bool = True
) -> tuple[Stiffness, Stiffness]:
    """Lower and upper bounds of the dimensionless stiffness of layers over ``[k_low, k_high]``."""
    at_low, at_high = (Waves(layers.layer_number(k)) for k in (k_low, k_high))
    least = layers.terms(Extremes(at_low, at_high, greatest=False), whole)
    greatest = layers.terms(Extremes(at_low, at_high, greatest=True), whole)
    below, above = least.denominator, greatest.denominator
    low = [x / above if x is not None else None for x in (least.xx, least.yy, least.det)]
    high = [x / below if x is not None else None for x in (greatest.xx, greatest.yy, greatest.det)]
    xy_low, xy_high = least.xy - greatest.xy_less, greatest.xy - least.xy_less
    xy_low = xy_low / np.where(xy_low > 0.0, above, below)
    xy_high = xy_high / np.where(xy_high > 0.0, below, above)
    return Stiffness(low[0], xy_low, *low[1:]), Stiffness(high[0], xy_high, *high[1:])


def _product(low: Array, high: Array, x_low: Array, x_high: Array) -> tuple[Array, Array]:
    """The extremes of a positive quantity times one of either sign."""
    return (np.where(x_low > 0.0, low, high) * x_low, np.where(x_high > 0.0, high, low) * x_high)


def transfer_bounds(k_low: Array, k_high: Array, pair: Pair) -> TransferBounds:
    """Bounds of the transfer functions over intervals ``0 < k_low <= k <= k_high`` (1/m)."""
    if pair.upper is None or pair.lower is None:
        low, high = stiffness_bounds(k_low, k_high, pair.upper or pair.lower, whole=False)
        return TransferBounds(low.xx, high.xx, np.maximum(np.abs(low.xy), np.abs(high.xy)))
    r = pair.ratio
    (a, a_high), (b, b_high) = (stiffness_bounds(k_low, k_high, x) for x in pair)
    corners = [x * y for x in (a.xy, a_high.xy) for y in (b.xy, b_high.xy)]
    cross, cross_high = np.minimum.reduce(corners), np.maximum.reduce(corners)
    dets = a.det + r**2 * b.det
    # A and B are positive definite, hence A_xx B_yy + A_yy B_xx + 2 A_xy B_xy >= 0
    least = dets + r * np.maximum(a.xx * b.yy + a.yy * b.xx + 2.0 * cross, 0.0)
    greatest = (
        a_high.det
        + r * (a_high.xx * b_high.yy + a_high.yy * b_high.xx + 2.0 * cross_high)
        + r**2 * b_high.det
    )
    from_a = _product(r**2 * b.det, r**2 * b_high.det, a.xy, a_high.xy)
    from_b = _product(r * a.det, r * a_high.det, b.xy, b_high.xy)
    coupling = np.maximum(from_a[1] - from_b[0], from_b[1] - from_a[0])
    return TransferBounds(
        (r**2 * b.det * a.xx + r * a.det * b.xx) / greatest,
        (r**2 * b_high.det * a_high.xx + r * a_high.det * b_high.xx) / least,
        coupling / least,
    )
