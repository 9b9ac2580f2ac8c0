"""The critical wavenumber and the critical nucleation length (Secs. 3-5, Text S1.4).

The critical wavenumber k_c is the largest one with ``Re Lambda = 0``, for one system or for
thousands.

``g >= b`` is stable for any rho. Above ``k = SATURATION/H`` every layer is a half-space, G1 and G2
are constant and g is proportional to k; the larger of that k and of the one where the half-spaces
have ``g = b`` bounds k_c from above. Where all ``Hk < 1e-3``, times the contrast of a zone with its
body, G1 and G2 are powers of k. Between these the margin of stability is computed at POINTS
wavenumbers, or at more where layers of unlike heights leave many decades. Every dip of it above the
last unstable point is searched for its minimum, so that no unstable band between two points is
overlooked.
"""

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..types import Array
from .evaluation import evaluate, single_system
from .roots import roots
from .spectrum import Systems, marginal_frequencies, marginal_stiffness, stability_margin
from .status import STABLE, NoLength
from .stiffness import SATURATION
from .values import FaultLike, Values

POINTS = 200  # of log k, at first, or a multiple
DECADES = 10.0  # that so many points resolve
SPAN = 1e70  # ratio of the shortest to the longest waves: fourth powers of it are numbers
PARTS = 16  # of the interval around a dip, in each of the ZOOMS
ZOOMS = 4
LONG_WAVES = 1e-3  # Hk below which the transfer functions are powers of k
FALLING = 1.5  # ratio of the loads of a wave and of one twice as long: 2 or 4, or 1 if it is held
LONG_POINTS = 60  # of log k, among long waves
TOGETHER = 50  # systems that are searched at once, so that their arrays stay in the cache
BEYOND_ROUND_OFF = 1.01  # ratio of wavenumbers whose stability round-off does not confuse
ROUND_OFF = 1e-16  # change of log k at which a search ends


class CriticalMode(NamedTuple):
    """The marginally stable mode with the largest wavenumber: numbers or arrays of any kind.

    Its ``exp(i omega t - i k_c x)`` propagates along +x if omega is positive. Where slip changes no
    normal stress both signs are marginal, and the positive one is given.

    Examples
    --------
    >>> from nucleation.api import PAPER
    >>> mode = PAPER.critical_mode()
    >>> round(float(mode.length), 3), round(float(mode.wavenumber), 3)
    (0.238, 26.395)
    """

    length: Any  # L_c = 2 pi/k_c (m)
    wavenumber: Any  # k_c (1/m)
    angular_frequency: Any  # omega (rad/s)


def critical_modes(systems: Systems) -> CriticalMode:
    """The critical modes of systems (n,); NaN where sliding is stable, inf as in their lengths."""
    k = largest_crossings(systems)
    with np.errstate(divide="ignore", invalid="ignore"):  # of a length beyond the longest waves
        return CriticalMode(2.0 * np.pi / k, k, marginal_frequencies(systems, k))


def critical_lengths(systems: Systems) -> Array:
    """L_c (m) of systems (n,); NaN where sliding is stable, inf beyond the longest waves."""
    with np.errstate(divide="ignore", over="ignore"):
        return np.asarray(2.0 * np.pi / largest_crossings(systems))


def unstable_modes(systems: Systems) -> CriticalMode:
    """The same; raises NoLength with the reason if one of the systems is stable."""
    found = critical_modes(systems)
    stable = np.flatnonzero(np.isnan(found.wavenumber))
    if stable.size:
        raise NoLength(stability_reason(systems.at(stable[:1])), STABLE)
    return found


def critical_length_of(fault: FaultLike) -> float:
    """L_c (m) of a single fault; a NoLength has the reason where there is none."""
    return float(unstable_modes(single_system(fault)).length[0])


def stability_reason(one: Systems) -> str:
    """Why homogeneous sliding of one stable system is stable at every wavelength."""
    friction, a, zeta, b = (x.item() for x in (one.friction, one.a, one.zeta, one.b))
    if b <= 0.0:
        return f"a + zeta = {b:g} is not positive: friction grows with slip rate at every frequency"
    facts = f"sliding is stable at every wavenumber for zeta = {zeta:g}, a = {a:g}"
    if zeta <= 0.0:
        reason = f"{facts}: friction does not weaken with slip rate"
        if friction:
            reason += f", and with f = {friction:g} slip changes the normal stress too little"
        return reason
    bodies = one.pair.deformable
    held = " and ".join(f"{body.far_side} (H = {body.height.item():g} m)" for body in bodies)
    return (
        f"{facts}, although friction weakens: with the far side {held} the layer is stiffer than "
        "friction's critical stiffness at every wavelength; a higher or softer layer, a larger "
        "normal stress or a far side under traction make it unstable"
    )


def of_distinct(
    fault: FaultLike,
    answer: Callable[..., tuple[Any, ...]],
    *arrays: Values,
    rows: int,
    lengths: int = 1,
    problem: Callable[[Systems], tuple[Systems, Array]] = Systems.without_units,
) -> Any:
    """Rows of objects: the answer to the problem of each fault, of which each is solved once.

    `problem` gives the one that similar faults share. `answer` takes a single system of it, its L_c
    and entries of arrays, which are no lengths. It returns rows of which the first are lengths:
    these become m. Where it raises NoLength there are NaN, and status and reason in the last two.
    """

    def points(systems: Systems, *values: Array) -> NDArray:
        alike, unit = problem(systems)
        numbers = np.stack([*alike.numbers, *values], axis=1) + 0.0  # zero has one sign
        _, first, of = np.unique(
            numbers.view(np.uint64), axis=0, return_index=True, return_inverse=True
        )
        distinct = alike.at(first)
        found = np.full((rows, first.size), np.nan, dtype=object)
        for i, length in enumerate(critical_lengths(distinct)):
            try:
                own = (float(array[first[i]]) for array in values)
                found[:, i] = answer(distinct.at(np.array([i])), float(length), *own)
            except NoLength as none:
                found[-2:, i] = none.status, str(none)
        found = found[:, of.ravel()]
        found[:lengths] *= unit
        return found

    return evaluate(fault, points, *arrays, rows=rows, dtype=object)


def largest_crossings(systems: Systems) -> Array:
    """The largest ``k > 0`` (1/m) with ``Re Lambda = 0``, (n,), of systems with fields (n,).

    NaN where sliding is stable at every k, and 0 where it is below the longest waves.
    """
    g, rho = _half_spaces(systems)
    k = marginal_stiffness(rho, systems.a, systems.zeta)[1] / g
    k = np.where(k > 0.0, k, np.nan)
    thinnest = np.minimum.reduce(systems.pair.thicknesses)
    has_layers = np.isfinite(thinnest) & ~(k >= SATURATION / thinnest)
    layered = np.flatnonzero(has_layers & (systems.b > 0.0))
    bottom, top = _bounds(systems.at(layered))
    multiples = np.maximum(1.0, np.ceil(np.log10(top / bottom) / DECADES))
    for multiple in np.unique(multiples):
        alike = np.flatnonzero(multiples == multiple)
        for start in range(0, alike.size, TOGETHER):
            part = alike[start : start + TOGETHER]
            own, points = systems.at(layered[part]), POINTS * int(multiple)
            k[layered[part]] = _refined(own, bottom[part], top[part], points)
    return k


def _half_spaces(systems: Systems) -> tuple[Array, Array]:
    """Load over k (m) and coupling where all layers are half-spaces."""
    one = np.ones(np.shape(systems.a))  # any k has the same G1 and G2: q is infinite
    pair = systems.pair.with_heights(lambda height: np.inf * one)
    return systems._replace(pair=pair).load_and_coupling(one)


def _bounds(systems: Systems) -> tuple[Array, Array]:
    """Wavenumbers (1/m) between which the largest crossings are, unless it is among long waves."""
    heights = systems.pair.thicknesses
    finite = [np.where(np.isfinite(height), height, np.nan) for height in heights]
    ratios = [body.zone_ratio for body in systems.pair.deformable]
    contrast = np.minimum.reduce([np.minimum(ratio, 1.0 / ratio) for ratio in ratios])
    bottom = LONG_WAVES * contrast / np.fmax.reduce(finite)  # all layers are thin
    high = SATURATION / np.fmin.reduce(finite)
    top = np.maximum(high, systems.b / _half_spaces(systems)[0])
    top = BEYOND_ROUND_OFF * top  # stable beyond
    return np.maximum(bottom, top / SPAN), top


def _refined(systems: Systems, bottom: Array, top: Array, points: int) -> Array:
    """The crossings between wavenumbers (1/m), to round-off, by a number of points at first."""
    low, high = _brackets(systems, bottom, top, points)

    def margins(log_ratio: Array, index: NDArray) -> Array:
        return stability_margin(systems.at(index), low[index] * np.exp(log_ratio))

    found = low * np.exp(roots(margins, 0.0 * low, np.log(high / low), ROUND_OFF))
    beyond = np.isnan(found) & _weakens_below(systems, top / SPAN)
    return np.where(beyond, 0.0, found)


def _brackets(systems: Systems, bottom: Array, top: Array, points: int) -> Array:
    """Neighbouring wavenumbers, unstable and stable, around the largest crossings; or NaN."""
    rows = np.arange(bottom.size)
    k = _spaced(bottom, top, points)
    margin = _margins(systems, k)
    unstable = margin < 0.0
    has_any = unstable.any(axis=1)
    last = np.where(has_any, points - 1 - np.argmax(unstable[:, ::-1], axis=1), 0)
    bracket = np.where(has_any, [k[rows, last], k[rows, last + 1]], np.nan)

    before, middle, after = margin[:, :-2], margin[:, 1:-1], margin[:, 2:]
    dips = (middle > 0.0) & (middle < before) & (middle < after)
    is_above = np.arange(points - 2) >= last[:, None]
    owner, place = np.nonzero(dips & is_above)
    above = k[owner, place + 2]
    lowest = _minima(systems.at(owner), k[owner, place], above)
    found = stability_margin(systems.at(owner), lowest) < 0.0
    bracket[:, owner[found]] = lowest[found], above[found]  # of several the last, the largest k

    missing = np.flatnonzero(np.isnan(bracket[0]))
    if missing.size:  # all Hk may be small
        k = _spaced(bottom[missing], top[missing] / SPAN, LONG_POINTS)  # stable at the first
        growing = _margins(systems.at(missing), k) < 0.0
        rows, first = np.arange(missing.size), np.argmax(growing, axis=1)
        found = np.stack([k[rows, first], k[rows, first - 1]])
        bracket[:, missing] = np.where(growing.any(axis=1), found, np.nan)
    return bracket


def _weakens_below(systems: Systems, k: Array) -> NDArray[np.bool_]:
    """Whether the load falls on below k (1/m), and friction weakens: a longer wave may grow."""
    load, shorter = (systems.load_and_coupling(at)[0] for at in (k, 2.0 * k))
    return np.asarray((systems.zeta > 0.0) & (shorter > FALLING * load))


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
