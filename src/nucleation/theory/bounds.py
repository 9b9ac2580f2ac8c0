"""Rigorous bounds of the transfer functions over intervals of the wavenumber.

Every entry of a layer's stiffness is ``N(q)/D(q)`` with N and D sums of positive functions of
``q = |k| H`` (:mod:`.stiffness`). Each function is monotonic, with or without a factor
``exp(-2q)``. So its extremes are at the ends of the interval, and ``min N/max D <= N/D <= max N/min
D``. Only ``A_xy`` may be a difference of two such N. The stiffness of a pair, and of a body with a
zone (:mod:`.zone`), combines the entries by sums, products and one quotient of intervals.
The bounds converge linearly with the length of the interval; where layers are thick they are close
for any length. With a zone they are NaN over intervals that are too long for any bound.
"""

from collections.abc import Iterable
from typing import NamedTuple, TypeAlias, cast

import numpy as np

from .pair import LayerPair
from .stiffness import Array, Layers, Stiffness, StiffnessTerms
from .waves import Waves
from .zone import Zone

_Interval: TypeAlias = tuple[Array, Array]
"""Lower and upper bounds."""


class _TransferBounds(NamedTuple):
    """``g1_low <= |G1| <= g1_high`` and ``|G2| <= g2_high`` over each interval."""

    g1_low: Array
    g1_high: Array
    g2_high: Array


class _Extremes:
    """The least or the greatest values of :class:`~.waves.Waves` over intervals of q.

    Where ``q >= 1`` in all of the interval they are the extremes of the functions times
    ``exp(-2q)``. Elsewhere they are the extremes without the factor, over ``exp(2 q)`` at the upper
    end.
    """

    def __init__(
        self,
        low: Waves,
        high: Waves,
        greatest: bool,
    ) -> None:
        self.low = low
        self.high = high
        self.greatest = greatest
        self.thick = low.q >= 1.0
        self.growth = np.exp(2.0 * (high.q - low.q))

    def __getattr__(self, name: str) -> Array:
        low = getattr(self.low, name)
        high = getattr(self.high, name)
        if self.greatest:
            return np.where(self.thick, np.maximum(low, high), high)
        return np.where(self.thick, np.minimum(low, high), low / self.growth)


def wave_bounds(layers: Layers, k_low: Array, k_high: Array) -> tuple[Waves, Waves]:
    """The least and the greatest values of the waves in layers over intervals of wavenumbers.

    Parameters
    ----------
    layers : Layers
        Fields of shape (n,).
    k_low, k_high : ndarray
        Ends of the intervals (1/m), shape (n,).

    Returns
    -------
    least, greatest : Waves
        Bounds with the attributes of :class:`~nucleation.theory.waves.Waves`, shape (n,).
    """
    low = Waves(layers.layer_number(k_low))
    high = Waves(layers.layer_number(k_high))
    least, greatest = _Extremes(low, high, greatest=False), _Extremes(low, high, greatest=True)
    return cast(Waves, least), cast(Waves, greatest)


def transfer_bounds(
    k_low: Array,
    k_high: Array,
    pair: LayerPair,
) -> _TransferBounds:
    """Bounds of the transfer functions over intervals ``0 < k_low <= k <= k_high``.

    Parameters
    ----------
    k_low, k_high : ndarray
        Ends of the intervals (1/m), shape (n,).
    pair : LayerPair
        The bodies, fields of shape (n,).

    Returns
    -------
    _TransferBounds
        Dimensionless, shape (n,).
    """
    if pair.upper is None or pair.lower is None:
        (body,) = pair.deformable
        low, high = _stiffness_bounds(k_low, k_high, body)
        coupling = np.maximum(np.abs(low.xy), np.abs(high.xy))
        return _TransferBounds(low.xx, high.xx, coupling)
    r = pair.ratio
    a, a_high = _stiffness_bounds(k_low, k_high, pair.upper)
    b, b_high = _stiffness_bounds(k_low, k_high, pair.lower)
    a_xy = a.xy, a_high.xy
    b_xy = b.xy, b_high.xy
    cross, cross_high = _product_of_any_sign(a_xy, b_xy)
    # A and B are positive definite, hence A_xx B_yy + A_yy B_xx + 2 A_xy B_xy >= 0
    mixed = a.xx * b.yy + a.yy * b.xx + 2.0 * cross
    mixed = np.maximum(mixed, 0.0)
    mixed_high = a_high.xx * b_high.yy + a_high.yy * b_high.xx + 2.0 * cross_high
    joint = a.det + r**2 * b.det + r * mixed
    joint_high = a_high.det + r * mixed_high + r**2 * b_high.det
    share_a = r**2 * b.det, r**2 * b_high.det
    share_b = r * a.det, r * a_high.det
    from_a, from_a_high = _product(share_a, a_xy)
    from_b, from_b_high = _product(share_b, b_xy)
    coupling = np.maximum(from_a_high - from_b, from_b_high - from_a)
    xx = share_a[0] * a.xx + share_b[0] * b.xx
    xx_high = share_a[1] * a_high.xx + share_b[1] * b_high.xx
    return _TransferBounds(
        g1_low=xx / joint_high,
        g1_high=xx_high / joint,
        g2_high=coupling / joint,
    )


def _stiffness_bounds(
    k_low: Array,
    k_high: Array,
    layers: Layers | Zone,
) -> tuple[Stiffness, Stiffness]:
    """Lower and upper bounds of the dimensionless stiffness of layers over ``[k_low, k_high]``."""
    if isinstance(layers, Zone):
        return _zone_bounds(k_low, k_high, layers)
    least, greatest = wave_bounds(layers, k_low, k_high)
    return _quotients(layers.terms(least, greatest), layers.terms(greatest, least))


def _zone_bounds(
    k_low: Array,
    k_high: Array,
    zone: Zone,
) -> tuple[Stiffness, Stiffness]:
    """The same of bodies with a zone; NaN over intervals too long for positive bounds."""
    least, greatest = wave_bounds(zone.layer, k_low, k_high)
    behind = _stiffness_bounds(k_low, k_high, zone.body)
    shares = zip(*map(zone.shares, behind), strict=True)
    factors = zip(zone.factors(least, greatest), zone.factors(greatest, least), strict=True)
    low = high = np.zeros(1)
    for share, (factor, factor_high) in zip(shares, factors, strict=True):
        terms = np.stack(factor), np.stack(factor_high)
        term, term_high = _product_of_any_sign(share, terms)
        low = low + term
        high = high + term_high
    positive = np.ones((len(StiffnessTerms._fields), 1), dtype=bool)
    positive[StiffnessTerms._fields.index("xy")] = False
    low = np.where(positive & (low <= 0.0), np.nan, low)
    least_quotients, greatest_quotients = _quotients(low, high)
    return zone.normalised(least_quotients), zone.normalised(greatest_quotients)


def _quotients(least: Iterable[Array], greatest: Iterable[Array]) -> tuple[Stiffness, Stiffness]:
    """Bounds of numerators over a positive denominator, which is the first of the terms."""
    below, *least_above = least
    below_high, *greatest_above = greatest
    low = [value / np.where(value > 0.0, below_high, below) for value in least_above]
    high = [value / np.where(value > 0.0, below, below_high) for value in greatest_above]
    return Stiffness(*low), Stiffness(*high)


def _product(
    positive: _Interval,
    other: _Interval,
) -> _Interval:
    """The bounds of a positive quantity times one of either sign."""
    low, high = positive
    x_low, x_high = other
    least = np.where(x_low > 0.0, low, high) * x_low
    greatest = np.where(x_high > 0.0, high, low) * x_high
    return least, greatest


def _product_of_any_sign(
    first: _Interval,
    second: _Interval,
) -> _Interval:
    """The bounds of the product of two quantities of either sign."""
    corners = [x * y for x in first for y in second]
    return np.minimum.reduce(corners), np.maximum.reduce(corners)
