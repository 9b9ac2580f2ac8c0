"""The stability length L_s: the shortest creeping patch with a growing mode.

The eigenproblem of :mod:`.linearised` is solved at lengths that rise by a constant factor until a
mode grows, and then between the last two. The first length is below the L_s of any known fault.

All modes count, oscillating or not. A real growth rate cannot cross zero: its mode would satisfy
the balance of forces at rest, ``(K1 + f S2) dw = 0``, and a patch of any length resists slip. So
growth begins with a pair of complex rates. Where ``a << zeta`` that pair oscillates only in a
narrow window of lengths and then grows without oscillation: a search for oscillating modes would
miss the window and find nothing, or a longer patch.
"""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Iterable
from functools import lru_cache
from typing import Any

import numpy as np

from ...model.quantities import ParameterError
from ...types import Array
from ..critical import critical_lengths, of_distinct
from ..roots import roots
from ..spectrum import Systems
from ..status import BEYOND, STABLE, VALUE, NoLength
from ..values import FaultLike
from .patches import Patches
from .response import extrapolation_error, has_slim_zone

LEAST_WEAKENING = 1e-10  # stiffness at L_c over a: growth is about half as much, over D/V
LONGEST = 3.0  # patches up to this multiple of L_c are tried
LEAST = 1e-3  # and down to this multiple
SHORTEST = 0.7  # where the search starts, over its guess
FACTOR = 1.12  # from one length to the next
PRECISION = 1e-9  # relative, of L_s for a given number of modes
STEP = 1e-3  # of log L, in the derivative of the growth rate
LARGEST_ERROR = 1e-3  # relative, of L_s, beyond which there are twice as many modes
LARGEST_LINEAR = 0.1  # relative error beyond which it is no derivative any more
NEAR = 0.97  # times L_s by fewer modes, where the search begins anew


@lru_cache(maxsize=4)  # L_run and L need that of the same fault
def stability_point(patches: Patches, critical: float) -> tuple[float, float]:
    """L_s (m) of one fault with L_c (m) or NaN, and its relative error.

    The error is that of three quarters of the modes, of slim layers and of slim zones. Raises
    NoLength if homogeneous sliding is stable, no patch up to ``LONGEST L_c`` has a growing mode or
    all down to ``LEAST L_c`` have one, the creep opens the fault, or round-off hides the growth.
    """
    if math.isinf(critical):
        raise NoLength("if there is an L_c, it is longer than any that can be computed", BEYOND)
    if not math.isfinite(critical):
        raise NoLength("homogeneous sliding is stable", STABLE)
    _, a, zeta = patches.constants
    marginal = patches.one.load_and_coupling(np.array([2.0 * math.pi / critical]))[0] / a
    if marginal < LEAST_WEAKENING:
        raise NoLength(
            "friction weakens so little that round-off hides the growth: at L_c the stiffness is "
            f"{float(marginal[0]):.3g} of the direct effect, {LEAST_WEAKENING:g} is needed"
        )
    ratio = max(zeta / a, 1e-6)
    guess = min(0.5 * (1.0 + 0.25 / ratio), 1.0)  # L_s/L_c of a thin layer, or 1
    length, error = _point_beyond(patches, SHORTEST * guess * critical, critical)
    if error >= LARGEST_ERROR and patches.refinement == 1:
        patches = dataclasses.replace(patches, refinement=2)
        length, error = _point_beyond(patches, NEAR * length, critical)
    return length, error + _error_of_slim_zones(patches, length)


def _error_of_slim_zones(patches: Patches, length: float) -> float:
    """The relative error of L_s (m) where thicker zones replace slim ones.

    A thicker zone has too large an effect: the front of the patch is within it. So the true length
    is between the one found and that without a zone.
    """
    if not has_slim_zone(patches.one, length):
        return 0.0
    bare = patches.one._replace(pair=patches.one.pair.without_zones)
    critical = float(critical_lengths(bare)[0])
    if math.isnan(critical):
        raise NoLength("the zone is too slim to be resolved, and without it sliding is stable")
    without = _first_growing(dataclasses.replace(patches, one=bare), NEAR * length, critical)
    return math.exp(abs(math.log(without / length))) - 1.0


def _point_beyond(patches: Patches, start: float, critical: float) -> tuple[float, float]:
    """Length (m) at which a pair of modes begins to grow, by a search from another; and error."""
    length = _first_growing(patches, start, critical)
    rates = patches.at(length).eigenvalues
    pairs = rates[rates.imag > 0.0]
    rate = complex(pairs[0] if pairs.size else rates[0])

    def growth_near(other: float, number: int | None = None) -> float:
        """Growth of another patch (m), in the mode with the nearest rate."""
        near = patches.at(other, number).eigenvalues
        return float(near[np.abs(near - rate).argmin()].real)

    before, after = (growth_near(length * math.exp(step)) for step in (-STEP, STEP))
    slope = (after - before) / (2.0 * STEP)
    fewer = 3 * patches.number // 4
    with_fewer_modes = growth_near(length, fewer)
    error = abs(with_fewer_modes - rate.real) / slope if slope > 0.0 else math.inf
    if error > LARGEST_LINEAR:  # where the mode with the nearest rate is another one
        error = abs(_first_growing(patches, start, critical, fewer) / length - 1.0)
    return length, error + PRECISION + extrapolation_error(patches.one, length)


def _first_growing(
    patches: Patches, start: float, critical: float, number: int | None = None
) -> float:
    """Length (m) from which on a mode grows, by a search from another and in a number of modes."""

    def growths(log_lengths: Iterable[float], _: object = None) -> Array:
        rates = (patches.at(math.exp(at), number).eigenvalues for at in log_lengths)
        return np.array([of_one[0].real for of_one in rates])

    step = math.log(FACTOR)
    longest = math.log(LONGEST * critical)
    low = math.log(start)
    while growths([low])[0] > 0.0:
        low -= 2.0 * step
        if low < math.log(LEAST * critical):
            raise NoLength(f"all patches down to {LEAST:g} L_c have a growing mode")
    high = low + step
    while growths([high])[0] <= 0.0:
        low = high
        high += step
        if low > longest:
            raise NoLength(f"no patch up to {LONGEST:g} L_c has a growing mode", BEYOND)
    (log_length,) = roots(growths, np.array([low]), np.array([high]), PRECISION)
    return math.exp(log_length)


def stability_answers(fault: FaultLike) -> tuple[Any, Any, Any, Any]:
    """L_s (m), its relative error, its status and the reason for it.

    A ParameterError if the friction law is not allowed with the loading.
    """
    law = fault.friction_law
    if law is not None and fault.loading != "edge":
        raise ParameterError(
            f"friction_law is not allowed with loading = {fault.loading}: there the slip rate is "
            "not V, and a and b are constant"
        )

    def answer(one: Systems, critical: float, *at: float) -> tuple[Any, ...]:
        patches = Patches(one, loading=fault.loading, evolution=str(fault.evolution))
        if law is not None:
            patches = patches.with_law(fault, *at)
        return *stability_point(patches, critical), VALUE, ""

    if law is None:
        rows = of_distinct(fault, answer, rows=4, problem=Systems.of_constants)
    else:
        rows = of_distinct(fault, answer, fault.velocity, fault.slip_distance, rows=4)
    length, error = rows[:2].astype(float)
    return length, error, rows[2], rows[3]


def stability_length_of(patches: Patches, critical: float) -> float:
    """L_s (m) of a fault with L_c (m) `critical`; NaN if there is none."""
    try:
        return stability_point(patches, critical)[0]
    except NoLength:
        return math.nan
