"""The largest marginal wavenumber of many systems at once (:mod:`.marginal`).

``g >= b`` is stable for any rho. Above ``k = SATURATION/H`` every layer is a half-space, G1 and G2
are constant and g is proportional to k; the larger of that k and of the one where the half-spaces
have ``g = b`` bounds k_c from above. Where all ``Hk < 1e-3``, times the contrast of a zone with its
body, G1 and G2 are powers of k. Between these the margin of stability is computed at POINTS
wavenumbers. Every dip of it above the last unstable point is searched for its minimum, so that no
unstable band between two points is overlooked.
"""

import numpy as np
from numpy.typing import NDArray

from .marginal import marginal_stiffness, stability_margin
from .roots import roots
from .spectrum import Systems
from .stiffness import SATURATION, Array

POINTS = 200  # of log k, at first
PARTS = 16  # of the interval around a dip, in each of the ZOOMS
ZOOMS = 4
LONG_WAVES = 1e-3  # Hk below which the transfer functions are powers of k
HALVINGS = 60  # of k, in the search among long waves
TOGETHER = 50  # systems that are searched at once, so that their arrays stay in the cache
ROUND_OFF = 1e-16  # change of log k at which a search ends


def largest_crossings(systems: Systems) -> Array:
    """The largest ``k > 0`` (1/m) with ``Re Lambda = 0``, (n,), of systems with fields (n,).

    NaN where sliding is stable at every k.
    """
    k = _half_space_crossings(systems)
    has_layers = np.isfinite(np.minimum.reduce(systems.pair.thicknesses))
    layered = np.flatnonzero(has_layers & (systems.b > 0.0))
    for start in range(0, layered.size, TOGETHER):
        chosen = layered[start : start + TOGETHER]
        k[chosen] = _refined(systems.at(chosen))
    return k


def _refined(systems: Systems) -> Array:
    """The crossings, to round-off."""
    low, high = _brackets(systems)

    def margins(log_ratio: Array, index: NDArray) -> Array:
        return stability_margin(systems.at(index), low[index] * np.exp(log_ratio))

    return low * np.exp(roots(margins, 0.0 * low, np.log(high / low), ROUND_OFF))


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
