"""The largest marginal wavenumber of many systems at once.

At a marginal point ``Lambda = i omega``. With ``w = omega ell / V``, ``b = a + zeta`` and

    g(k) = mu |k| ell |G1| / sigma0,    rho(k) = f G2 / |G1| ,

the real and imaginary parts of Eq. (5), Eq. (S-ReIm), read ``g = b w^2/(1 + w^2)`` and
``rho g = w (a w^2 - zeta)/(1 + w^2)``. Their quotient ``a w^2 - rho b w - zeta = 0`` gives w, and
eliminating w leaves a quadratic in g,

    (g - zeta)^2 = rho^2 g (b - g) ,    0 < g < b ,

with roots ``h_minus(rho) <= h_plus(rho)``, one for either sign of omega when ``zeta > 0``.
Sliding is stable for ``g > h_plus``; for velocity strengthening, ``zeta < 0``, also for
``g < h_minus`` and wherever the roots are not real, ``rho^2 b^2 < -4 a zeta``.

The largest crossing is not missed:

- ``g >= b`` is stable, whatever rho. Above ``k = SATURATION/H`` every layer is a half-space, G1
  and G2 are constant and g is proportional to k; the larger of that k and of the one where the
  half-spaces have ``g = b`` bounds k_c from above.
- Below, an interval of log k is dismissed only if bounds of G1 and G2 over all of it
  (:mod:`.bounds`) prove it stable; the others are divided until an unstable point and a stable
  one right above it are closer than :data:`RESOLUTION`, which is thus the narrowest unstable
  band that is certainly found.
- Where all ``Hk < 1e-3``, G1 and G2 are powers of k.
"""

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .bounds import transfer_bounds
from .spectrum import Systems
from .stiffness import SATURATION, Array

RESOLUTION = 1e-4  # an unstable band narrower than this in log k may be overlooked
LONG_WAVES = 1e-3  # Hk below which the transfer functions are powers of k
INTERVALS = 64  # of log k at first
PARTS = 16  # into which an undecided interval is divided
TOGETHER = 1000  # systems that are searched at once, so that their arrays stay in the cache


def marginal_stiffness(rho: ArrayLike, a: ArrayLike, zeta: ArrayLike) -> tuple[Array, Array]:
    """The roots ``h_minus <= h_plus`` of ``(g - zeta)^2 = rho^2 g (a + zeta - g)``.

    NaN where they are not real or ``a + zeta <= 0``; even in rho, h_plus grows with ``|rho|``.
    """
    rho = np.abs(np.asarray(rho, dtype=float))
    b = a + zeta
    discriminant = (rho * b) ** 2 + 4.0 * a * zeta
    real = (discriminant >= 0.0) & (b > 0.0)
    root = np.sqrt(np.where(real, discriminant, np.nan))
    plus = (2.0 * zeta + rho**2 * b + rho * root) / (2.0 * (1.0 + rho**2))
    with np.errstate(divide="ignore", invalid="ignore"):
        minus = np.where(plus > 0.0, zeta**2 / ((1.0 + rho**2) * plus), plus)
    return minus, plus


def stability_margin(systems: Systems, k: Array) -> Array:
    """Negative where a mode grows, positive where none does, continuous in k (1/m)."""
    g, rho = systems.load_and_coupling(k)
    zeta = systems.zeta
    with np.errstate(invalid="ignore"):
        weakening = g - marginal_stiffness(rho, systems.a, zeta)[1]
    return np.where(zeta < 0.0, (g - zeta) ** 2 - rho**2 * g * (systems.b - g), weakening)


def certainly_stable(systems: Systems, k_low: Array, k_high: Array) -> NDArray[np.bool_]:
    """Whether no mode in ``[k_low, k_high]`` grows, from rigorous bounds of g and rho."""
    bounds = transfer_bounds(k_low, k_high, systems.pair)
    zeta = systems.zeta
    rho = systems.friction * bounds.g2_high / bounds.g1_low
    minus, plus = marginal_stiffness(rho, systems.a, zeta)
    stable = systems.softness * k_low * bounds.g1_low > plus
    low_enough = systems.softness * k_high * bounds.g1_high < minus
    return stable | ((zeta < 0.0) & (np.isnan(plus) | low_enough))


def largest_crossings(systems: Systems) -> Array:
    """The largest ``k > 0`` (1/m) with ``Re Lambda = 0``, (n,), of systems with fields (n,).

    NaN where sliding is stable at every k.
    """
    heights = [body.height for body in systems.pair if body is not None]
    k = half_space_crossings(systems)
    layered = np.flatnonzero(np.isfinite(np.minimum.reduce(heights)) & (systems.b > 0.0))
    for start in range(0, layered.size, TOGETHER):
        chosen = layered[start : start + TOGETHER]
        part = systems.at(chosen)
        low, high = _brackets(part)
        k[chosen] = _refined(part, low, high)
    return k


def half_space_crossings(systems: Systems) -> Array:
    """The same if all layers were half-spaces, whose g is proportional to k, in closed form."""
    short = np.full(np.shape(systems.a), np.inf)  # any k will do: q is infinite
    pair = systems.pair._replace(
        **{side: body._replace(height=short) for side, body in systems.pair._asdict().items()
           if body is not None}
    )  # fmt: skip
    g, rho = systems._replace(pair=pair).load_and_coupling(np.ones_like(short))
    k = marginal_stiffness(rho, systems.a, systems.zeta)[1] / g
    return np.where(k > 0.0, k, np.nan)


def _ends(systems: Systems) -> tuple[Array, Array]:
    """Wavenumbers (1/m) below which all layers are thin, and above which sliding is stable."""
    heights = [body.height for body in systems.pair if body is not None]
    finite = [np.where(np.isfinite(h), h, np.nan) for h in heights]
    high = SATURATION / np.fmin.reduce(finite)
    g, _ = systems.load_and_coupling(high)
    return LONG_WAVES / np.fmax.reduce(finite), np.maximum(high, high * systems.b / g)


def _brackets(systems: Systems) -> tuple[Array, Array]:
    """Neighbouring wavenumbers, unstable and stable, around the largest crossings; or NaN.

    Intervals of log k that are certainly stable are dropped, those below a point known to be
    unstable as well; the others are divided down to :data:`RESOLUTION`.
    """
    bottom, top = _ends(systems)
    number = bottom.size
    unstable = np.zeros(number)
    bracket = np.full((2, number), np.nan)
    owner, low, high = _divided(np.arange(number), bottom, top, INTERVALS)
    while owner.size:
        growing = stability_margin(systems.at(owner), low) < 0.0
        np.maximum.at(unstable, owner[growing], low[growing])
        keep = low == unstable[owner]
        above = np.flatnonzero(low > unstable[owner])
        keep[above] = ~certainly_stable(systems.at(owner[above]), low[above], high[above])
        owner, low, high = owner[keep], low[keep], high[keep]
        narrow = np.log(high / low) < RESOLUTION
        found = narrow & (low == unstable[owner])
        bracket[:, owner[found]] = low[found], high[found]
        wide = ~narrow
        owner, low, high = _divided(owner[wide], low[wide], high[wide], PARTS)
    missing = np.flatnonzero(np.isnan(bracket[0]))
    bracket[:, missing] = _brackets_of_long_waves(systems.at(missing), bottom[missing])
    return bracket[0], bracket[1]


def _divided(owner: NDArray, low: Array, high: Array, parts: int) -> tuple[NDArray, Array, Array]:
    """Intervals of log k divided into equal parts, in their order."""
    share = np.arange(1, parts) / parts
    inner = low[:, None] * (high / low)[:, None] ** share
    edges = np.concatenate([low[:, None], inner, high[:, None]], axis=1)
    return np.repeat(owner, parts), edges[:, :-1].ravel(), edges[:, 1:].ravel()


def _brackets_of_long_waves(systems: Systems, bottom: Array) -> Array:
    """The same where all ``Hk`` are small: every quantity is a power of k."""
    k = bottom[:, None] * 0.5 ** np.arange(60)  # at the first of them sliding is stable
    index = np.broadcast_to(np.arange(bottom.size)[:, None], k.shape)
    growing = stability_margin(systems.at(index), k) < 0.0
    first = np.argmax(growing, axis=1)
    rows = np.arange(bottom.size)
    found = np.stack([k[rows, first], k[rows, first - 1]])
    return np.where(growing.any(axis=1), found, np.nan)


def _refined(systems: Systems, low: Array, high: Array) -> Array:
    """The crossings within brackets, by Ridders' method in ``log(k/low)``, to round-off.

    NaN brackets stay NaN. What is found does not depend on the other systems.
    """
    found = np.full(low.size, np.nan)
    index = np.flatnonzero(np.isfinite(low))
    own, base = systems.at(index), low[index]
    left, right = np.zeros_like(base), np.log(high[index] / base)
    f_left, f_right = stability_margin(own, base), stability_margin(own, high[index])
    last = right
    for _ in range(100):
        middle = 0.5 * (left + right)
        f_middle = stability_margin(own, base * np.exp(middle))
        new = middle - (middle - left) * f_middle / np.sqrt(f_middle**2 - f_left * f_right)
        f_new = stability_margin(own, base * np.exp(new))
        left, f_left, right, f_right = _narrowed(left, f_left, right, f_right, middle, f_middle)
        left, f_left, right, f_right = _narrowed(left, f_left, right, f_right, new, f_new)
        found[index] = base * np.exp(new)
        on = (np.abs(new - last) > 1e-16) & (f_new != 0.0) & (f_left * f_right < 0.0)
        if not on.any():
            break
        index, own, base, last = index[on], own.at(on), base[on], new[on]
        left, f_left, right, f_right = left[on], f_left[on], right[on], f_right[on]
    return found


def _narrowed(
    left: Array, f_left: Array, right: Array, f_right: Array, x: Array, f: Array
) -> tuple[Array, Array, Array, Array]:
    """Brackets of a change from negative to positive, narrowed by a point within."""
    inside = (left < x) & (x < right)
    lower, upper = inside & (f < 0.0), inside & (f >= 0.0)
    return (
        np.where(lower, x, left), np.where(lower, f, f_left),
        np.where(upper, x, right), np.where(upper, f, f_right),
    )  # fmt: skip


def marginal_frequencies(systems: Systems, k: Array) -> Array:
    """omega (rad/s) at marginal k (1/m): the root of ``a w^2 - rho b w - zeta = 0`` that fits g.

    If ``G2 = 0`` both signs are marginal; the positive one is given.
    """
    a, zeta, b = systems.a, systems.zeta, systems.b
    g, rho = systems.load_and_coupling(k)
    root = np.sqrt(np.maximum((rho * b) ** 2 + 4.0 * a * zeta, 0.0))
    large = np.copysign((np.abs(rho) * b + root) / (2.0 * a), np.where(rho == 0.0, 1.0, rho))
    small = -zeta / (a * large)
    misfit = [np.abs(b * w**2 / (1.0 + w**2) - g) for w in (large, small)]
    return np.where(misfit[0] <= misfit[1], large, small) * systems.rate
