"""The largest marginal wavenumber of many systems at once (:mod:`.marginal`).

``g >= b`` is stable for any rho. Above ``k = SATURATION/H`` every layer is a half-space, G1 and G2
are constant and g is proportional to k; the larger of that k and of the one where the half-spaces
have ``g = b`` bounds k_c from above. Where all ``Hk < 1e-3``, times the contrast of a zone with its
body, G1 and G2 are powers of k. Between these the margin of stability is computed at POINTS
wavenumbers. Every dip of it above the last unstable point is searched for its minimum, so that no
unstable band between two points is overlooked.
"""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from .marginal import marginal_stiffness, stability_margin
from .spectrum import Systems
from .stiffness import SATURATION, Array

POINTS = 200  # of log k, at first
PARTS = 16  # of the interval around a dip, in each of the ZOOMS
ZOOMS = 4
LONG_WAVES = 1e-3  # Hk below which the transfer functions are powers of k
HALVINGS = 60  # of k, in the search among long waves
TOGETHER = 50  # systems that are searched at once, so that their arrays stay in the cache
MOST_STEPS = 100  # of Ridders' method, which needs about ten
ROUND_OFF = 1e-16  # change of log k at which it ends


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
        k[chosen] = _refined(part, *_brackets(part))
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
    finite = [
        np.where(
            np.isfinite(height),
            height,
            np.nan,
        )
        for height in heights
    ]
    bottom = LONG_WAVES * systems.pair.contrast / np.fmax.reduce(finite)
    high = SATURATION / np.fmin.reduce(finite)
    g, _ = systems.load_and_coupling(high)
    top = np.maximum(high, high * systems.b / g)
    return bottom, top


def _brackets(systems: Systems) -> Array:
    """Neighbouring wavenumbers, unstable and stable, around the largest crossings; or NaN."""
    bottom, top = _ends(systems)
    rows = np.arange(bottom.size)
    k = _spaced(bottom, top, POINTS)
    margin = _margins(systems, k)
    unstable = margin < 0.0
    has_any = unstable.any(axis=1)
    last = np.where(
        has_any,
        POINTS - 1 - np.argmax(unstable[:, ::-1], axis=1),
        0,
    )
    bracket = np.where(
        has_any,
        [k[rows, last], k[rows, last + 1]],
        np.nan,
    )

    before, middle, after = margin[:, :-2], margin[:, 1:-1], margin[:, 2:]
    dips = (middle > 0.0) & (middle < before) & (middle < after)
    owner, place = np.nonzero(dips & (np.arange(POINTS - 2) >= last[:, None]))
    above = k[owner, place + 2]
    lowest = _minima(systems.at(owner), k[owner, place], above)
    found = stability_margin(systems.at(owner), lowest) < 0.0
    bracket[:, owner[found]] = lowest[found], above[found]  # of several the last, the largest k

    missing = np.flatnonzero(np.isnan(bracket[0]))
    bracket[:, missing] = _brackets_of_long_waves(systems.at(missing), bottom[missing])
    return bracket


def _minima(systems: Systems, low: Array, high: Array) -> Array:
    """Wavenumbers (1/m) of the least margins between others, (n,)."""
    rows = np.arange(low.size)
    for _ in range(ZOOMS if low.size else 0):
        k = _spaced(low, high, PARTS + 1)
        least = np.argmin(_margins(systems, k), axis=1).clip(1, PARTS - 1)
        low, high = k[rows, least - 1], k[rows, least + 1]
    return np.sqrt(low * high)


def _spaced(low: Array, high: Array, number: int) -> Array:
    """Wavenumbers (1/m) with equal ratios between two others, (n, number)."""
    share = np.linspace(0.0, 1.0, number)
    return low[:, None] * (high / low)[:, None] ** share


def _margins(systems: Systems, k: Array) -> Array:
    """The margins of stability at wavenumbers of shape (n, m)."""
    owner = np.broadcast_to(np.arange(k.shape[0])[:, None], k.shape)
    return stability_margin(systems.at(owner), k)


def _brackets_of_long_waves(
    systems: Systems,
    bottom: Array,
) -> Array:
    """The same where all ``Hk`` are small: every quantity is a power of k."""
    k = bottom[:, None] * 0.5 ** np.arange(HALVINGS)  # at the first of them sliding is stable
    rows = np.arange(bottom.size)
    growing = _margins(systems, k) < 0.0
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
