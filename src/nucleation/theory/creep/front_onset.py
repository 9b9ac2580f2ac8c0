"""L_s of a patch with its advancing front: the shortest that has a growing mode."""

from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from ...types import Array
from ..roots import bisected
from ..status import BEYOND, NoLength
from .front import Advance, advance, fastest, oscillating
from .patches import Patches

SHORTEST = 0.3  # where the search for L_s starts, over L_c
TRIED = 14  # number of patches that are tried
NEAR = np.array([-0.05, 0.0, 0.05])  # log(L/L_s) of the patches to which a parabola is fitted
CLOSE = 2e-3  # relative, within which the parabola's L_s must have decay and growth
NARROW = 1e-4  # relative width of a bracket at which bisection ends
REAL = 1e-9  # imaginary part below which a parabola's root is real


def first_growing(
    patches: Patches,
    critical: float,
    initial_state: float,
    initial_stress: float = 0.0,
) -> float:
    """L_s of a patch with its advancing front.

    Growth begins between two of the lengths tried, with a pair of modes that oscillates
    (:mod:`nucleation.theory.creep.lengths`). L_s is the root of a parabola through the pair's
    growth. Where the pair oscillates in a narrow window only, the parabola's root is not where
    growth begins, and L_s is bisected.

    Takes critical (m), initial_state (s). Returns: L_s (m).
    """

    def advanced(lengths: ArrayLike) -> Advance:
        return advance(patches, lengths, initial_state, initial_stress)

    low, high, pair = _bracket(advanced, critical)
    if np.isfinite(pair).all():
        log_at = np.interp(0.0, pair, np.log([low, high]))
        onset = _vanishing(advanced, float(np.exp(log_at)))
        around = onset * np.array([1.0 - CLOSE, 1.0 + CLOSE])
        before, after = fastest(advanced(around))
        if before < 0.0 < after:
            return onset
    return bisected(
        lambda length: bool(fastest(advanced([length]))[0] > 0.0),
        low,
        high,
        NARROW,
    )


def _bracket(
    advanced: Callable[[ArrayLike], Advance],
    critical: float,
) -> tuple[float, float, Array]:
    """Neighbouring lengths (m) without and with growth, and the oscillating modes' growth there."""
    tried = np.geomspace(SHORTEST, 1.0, TRIED) * critical
    longer = tried * (1.0 / SHORTEST) ** (1.0 - 1.0 / TRIED)
    for lengths in (tried, longer):
        found = advanced(lengths)
        growing = fastest(found) > 0.0
        if growing.any():
            break
    else:
        longest = lengths[-1]
        raise NoLength(
            f"no patch up to {longest / critical:.2g} L_c = {longest:.4g} m has a growing mode",
            BEYOND,
        )
    i = int(np.argmax(growing))
    if i == 0:
        first = lengths[0] / critical
        raise NoLength(f"a mode of the patch grows at {first:.2g} L_c already, or before")
    low, high = lengths[i - 1 : i + 1]
    return low, high, oscillating(found)[i - 1 : i + 1].real


def _vanishing(
    advanced: Callable[[ArrayLike], Advance],
    at: float,
) -> float:
    """Root of a parabola through the pair's growth around a length (m); `at` without a root."""
    growth = oscillating(advanced(at * np.exp(NEAR))).real
    if not np.isfinite(growth).all():
        return at
    roots = np.polynomial.Polynomial.fit(NEAR, growth, 2).roots()
    real = roots[np.abs(roots.imag) < REAL].real
    if real.size == 0:
        return at
    nearest = real[np.abs(real).argmin()]
    return float(at * np.exp(nearest))
