"""The largest marginal wavenumber of many systems at once (:mod:`.marginal`).

The largest crossing is not missed:

- ``g >= b`` is stable for any rho. Above ``k = SATURATION/H`` every layer is a half-space, G1
  and G2 are constant and g is proportional to k; the larger of that k and of the one where the
  half-spaces have ``g = b`` bounds k_c from above.
- Below, an interval of log k is dropped only if bounds of G1 and G2 over all of it
  (:mod:`.bounds`) prove it stable. The others are divided until an unstable point and a stable
  one right above it are closer than :data:`RESOLUTION`, which is thus the narrowest unstable
  band that is certainly found.
- Where all ``Hk < 1e-3``, times the contrast of a zone with its body, G1 and G2 are powers of k.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .bounds import transfer_bounds
from .marginal import marginal_stiffness, stability_margin
from .spectrum import Systems
from .stiffness import SATURATION, Array

RESOLUTION = 1e-4  # an unstable band narrower than this in log k may be overlooked
LONG_WAVES = 1e-3  # Hk below which the transfer functions are powers of k
HALVINGS = 60  # of k, in the search among long waves
INTERVALS = 64  # of log k at first
PARTS = 16  # into which an undecided interval is divided
TOGETHER = 1000  # systems that are searched at once, so that their arrays stay in the cache
MOST_STEPS = 100  # of Ridders' method, which needs about ten
ROUND_OFF = 1e-16  # change of log k at which it ends


def certainly_stable(
    systems: Systems,
    k_low: Array,
    k_high: Array,
) -> NDArray[np.bool_]:
    """Whether no mode in ``[k_low, k_high]`` grows, from rigorous bounds of g and rho.

    Parameters
    ----------
    systems : Systems
        Fields of shape (n,).
    k_low, k_high : ndarray
        Ends of the intervals of wavenumbers (1/m), shape (n,).

    Returns
    -------
    ndarray
        True where all of the interval is stable, shape (n,).
    """
    bounds = transfer_bounds(k_low, k_high, systems.pair)
    zeta = systems.zeta
    rho = systems.friction * bounds.g2_high / bounds.g1_low
    minus, plus = marginal_stiffness(rho, systems.a, zeta)
    high_enough = systems.softness * k_low * bounds.g1_low > plus
    low_enough = systems.softness * k_high * bounds.g1_high < minus
    without_roots = np.isnan(plus) & np.isfinite(rho)
    return high_enough | ((zeta < 0.0) & (without_roots | low_enough))


def largest_crossings(systems: Systems) -> Array:
    """The largest ``k > 0`` (1/m) with ``Re Lambda = 0``, (n,), of systems with fields (n,).

    NaN where sliding is stable at every k.
    """
    k = _half_space_crossings(systems)
    has_layers = np.isfinite(np.minimum.reduce(systems.pair.thicknesses))
    layered = np.flatnonzero(has_layers & (systems.b > 0.0))
    for start in range(0, layered.size, TOGETHER):
        chosen = layered[start : start + TOGETHER]
        part = systems.at(chosen)
        low, high = _brackets(part)
        k[chosen] = _refined(part, low, high)
    return k


def _half_space_crossings(systems: Systems) -> Array:
    """The largest crossings of half-spaces of the same materials: their g is proportional to k."""
    one = np.ones(np.shape(systems.a))  # any k has the same G1 and G2: q is infinite
    pair = systems.pair.with_heights(lambda height: np.inf * one)
    g, rho = systems._replace(pair=pair).load_and_coupling(one)
    _, h_plus = marginal_stiffness(rho, systems.a, systems.zeta)
    k = h_plus / g
    return np.where(k > 0.0, k, np.nan)


def _ends(systems: Systems) -> tuple[Array, Array]:
    """Wavenumbers (1/m) below which all layers are thin, and above which sliding is stable."""
    heights = systems.pair.thicknesses
    finite = [np.where(np.isfinite(height), height, np.nan) for height in heights]
    bottom = LONG_WAVES * systems.pair.contrast / np.fmax.reduce(finite)
    high = SATURATION / np.fmin.reduce(finite)
    g, _ = systems.load_and_coupling(high)
    top = np.maximum(high, high * systems.b / g)
    return bottom, top


def _brackets(systems: Systems) -> tuple[Array, Array]:
    """Neighbouring wavenumbers, unstable and stable, around the largest crossings; or NaN.

    Intervals of log k that are certainly stable are dropped, and so are those below a point known
    to be unstable; the others are divided down to :data:`RESOLUTION`.
    """
    bottom, top = _ends(systems)
    number = bottom.size
    unstable = np.zeros(number)  # largest wavenumber known to be unstable
    bracket = np.full((2, number), np.nan)
    owner, low, high = _divided(np.arange(number), bottom, top, INTERVALS)
    while owner.size:
        growing = stability_margin(systems.at(owner), low) < 0.0
        np.maximum.at(unstable, owner[growing], low[growing])
        keep = low == unstable[owner]
        above = np.flatnonzero(low > unstable[owner])
        part = systems.at(owner[above])
        keep[above] = ~certainly_stable(part, low[above], high[above])
        owner = owner[keep]
        low = low[keep]
        high = high[keep]
        narrow = np.log(high / low) < RESOLUTION
        found = narrow & (low == unstable[owner])
        bracket[:, owner[found]] = low[found], high[found]
        wide = ~narrow
        owner, low, high = _divided(owner[wide], low[wide], high[wide], PARTS)
    missing = np.flatnonzero(np.isnan(bracket[0]))
    bracket[:, missing] = _brackets_of_long_waves(systems.at(missing), bottom[missing])
    return bracket[0], bracket[1]


def _divided(
    owner: NDArray,
    low: Array,
    high: Array,
    parts: int,
) -> tuple[NDArray, Array, Array]:
    """Intervals of log k divided into equal parts, in their order."""
    first = low[:, None]
    last = high[:, None]
    share = np.arange(1, parts) / parts
    inner = first * (last / first) ** share
    edges = np.concatenate([first, inner, last], axis=1)
    lows = edges[:, :-1].ravel()
    highs = edges[:, 1:].ravel()
    return np.repeat(owner, parts), lows, highs


def _brackets_of_long_waves(
    systems: Systems,
    bottom: Array,
) -> Array:
    """The same where all ``Hk`` are small: every quantity is a power of k."""
    k = bottom[:, None] * 0.5 ** np.arange(HALVINGS)  # at the first of them sliding is stable
    rows = np.arange(bottom.size)
    index = np.broadcast_to(rows[:, None], k.shape)
    growing = stability_margin(systems.at(index), k) < 0.0
    first = np.argmax(growing, axis=1)
    found = np.stack([k[rows, first], k[rows, first - 1]])
    return np.where(growing.any(axis=1), found, np.nan)


class _Bracket(NamedTuple):
    """Changes from negative to positive: positions and values to the left and to the right."""

    left: Array
    f_left: Array
    right: Array
    f_right: Array

    def narrowed(
        self,
        x: Array,
        f: Array,
    ) -> "_Bracket":
        """The brackets narrowed by a point within."""
        inside = (self.left < x) & (x < self.right)
        lower = inside & (f < 0.0)
        upper = inside & (f >= 0.0)
        return _Bracket(
            left=np.where(lower, x, self.left),
            f_left=np.where(lower, f, self.f_left),
            right=np.where(upper, x, self.right),
            f_right=np.where(upper, f, self.f_right),
        )

    def at(self, index: NDArray[np.bool_]) -> "_Bracket":
        return _Bracket(*(values[index] for values in self))


def _refined(
    systems: Systems,
    low: Array,
    high: Array,
) -> Array:
    """The crossings within brackets, by Ridders' method in ``log(k/low)``, to round-off.

    NaN brackets stay NaN. A crossing does not depend on the other systems.
    """
    found = np.full(low.size, np.nan)
    index = np.flatnonzero(np.isfinite(low))
    own = systems.at(index)
    base = low[index]
    bracket = _Bracket(
        left=np.zeros_like(base),
        f_left=stability_margin(own, base),
        right=np.log(high[index] / base),
        f_right=stability_margin(own, high[index]),
    )
    last = bracket.right
    for _ in range(MOST_STEPS):
        left, f_left, right, f_right = bracket
        middle = 0.5 * (left + right)
        f_middle = stability_margin(own, base * np.exp(middle))
        scale = np.sqrt(f_middle**2 - f_left * f_right)
        new = middle - (middle - left) * f_middle / scale
        f_new = stability_margin(own, base * np.exp(new))
        bracket = bracket.narrowed(middle, f_middle).narrowed(new, f_new)
        found[index] = base * np.exp(new)
        moving = np.abs(new - last) > ROUND_OFF
        on = moving & (f_new != 0.0) & (bracket.f_left * bracket.f_right < 0.0)
        if not on.any():
            break
        index = index[on]
        own = own.at(on)
        base = base[on]
        last = new[on]
        bracket = bracket.at(on)
    return found
