"""The runaway length L_run: the shortest patch with slow slip that ends in an event.

Where friction weakens little, the oscillation that begins at the stability length L_s saturates: a
longer patch slips slowly, alternately faster and slower than V. From a length L_run on slow slip
does not last (:mod:`.slow_slip`). It ends after an irregular time, which is shorter in a longer
patch, so that L_run depends a little on how long one waits: it is the length at which weakly
disturbed patches begin to run away within DURATION. A disturbance that changes the logarithm of the
state by 0.1 or more makes shorter patches run away.

With k_b of :mod:`.slow_slip` and ``k_c = 2 pi/L_c``, L_run is about ``GUESS L_c k_b/k_c`` in layers
of any height. In a thin layer that is ``1.8 (1/pi) sqrt(b/zeta) L_c``. The factor is 1 where the
strain energy released by a patch equals the fracture energy of its front.
"""

import contextlib
import dataclasses
import math
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from ...model.quantities import ParameterError
from ...types import Array
from ..critical import at_each
from ..spectrum import Systems
from ..status import BEYOND, EDGE_ALONE, UNKNOWN, VALUE, NoLength
from ..values import FaultLike
from .lengths import stability_length_of, stability_point
from .patches import Patches
from .slow_slip import cohesive_wavenumber, lifetimes, modes_that_resolve

WEAK = 2.0  # zeta/a below which a patch may slip slowly up to L_run
CONSTANT = 0.05  # relative change of L_s by friction's scales up to which a and b count as constant
WEAKENINGS = (0.1, 10.0)  # zeta/a that were tried
DURATION = 1500.0  # over D/V, or over (a/zeta) D/V where that is shorter: slow slip must last it
DISTURBANCES = np.geomspace(0.005, 0.02, 4)  # of log(phi) at the start, in the patch's middle
LENGTHS = 10  # tried at once
GUESS = 0.57  # L_run over L_c k_b/k_c: .45 to .62
SHORTEST, LONGEST = 0.78, 2.0  # times the guess, of the lengths tried first
SPACING = 1.06  # of them
BRIEF, STRONGER = 0.2, 2.0  # times the duration and the disturbances, of the first search
SOONER = 0.86  # times the shortest patch that runs away briefly: about the first that ever does
PRECISION = 0.01  # relative, of L_run by the lengths and disturbances that are tried
SHARP = 3  # lengths between those at which none and all disturbances run away: more are no use
FEW = 0.3  # share of disturbances that may run away at the shortest length, or not at the longest
SEARCHES = 4  # over as many ranges of lengths
DEVIATIONS = 2.0  # standard errors that the stated error has
LEAST_ERROR = 0.02  # relative, by the modes


class _Ladder(NamedTuple):
    """Patches of rising length, and the times over D/V after which they run away."""

    lengths: Array  # m
    times: Array  # (length, disturbance)

    def share(self, duration: float) -> Array:
        """The share of the disturbances that run away in a time (D/V), of each length."""
        return np.mean(self.times < duration, axis=1)

    def ends(self) -> tuple[int, int]:
        """The last length up to which none runs away, or -1, and the first from which all do."""
        share = self.share(np.inf)
        some = np.append(share > 0.0, True)
        not_all = np.append(True, share < 1.0)
        return int(some.argmax()) - 1, int(np.flatnonzero(not_all)[-1])

    def threshold(self, duration: float) -> tuple[float, float]:
        """The mean of log L at which patches begin to run away, and its standard error.

        Spearman's and Karber's estimate: none runs away below the lengths, and all do beyond.
        """
        logs = np.log(self.lengths)
        spacing = logs[1] - logs[0]
        share = self.share(duration)
        mean = logs[-1] + spacing * (0.5 - share.sum())
        variance = np.sum(share * (1.0 - share)) / (self.times.shape[1] - 1) + 1.0 / 12.0
        return float(mean), float(spacing * math.sqrt(variance))


class _Search:
    """Trials of one fault's patches."""

    def __init__(self, patches: Patches, critical: float) -> None:
        self.patches = patches
        self.stable = stability_point(patches, critical)[0]
        self.cohesive = cohesive_wavenumber(patches, critical)
        self.guess = GUESS * critical**2 * self.cohesive / (2.0 * math.pi)
        _, a, zeta = patches.constants
        self.duration = DURATION * min(1.0, a / zeta)

    def tried(self, lengths: Array, disturbances: Array, duration: float) -> _Ladder:
        """Patches of rising length (m), followed for a time (D/V)."""
        number = modes_that_resolve(self.cohesive, float(lengths[-1]))
        times = lifetimes(self.patches, lengths, number, disturbances, duration)
        return _Ladder(lengths, times)

    def bracketed(self) -> tuple[float, float]:
        """Lengths (m) below which slow slip lasts, and from which it soon runs away."""
        low = max(self.stable, SHORTEST * self.guess)
        rising: Array = SPACING ** np.arange(float(LENGTHS))
        disturbances = STRONGER * DISTURBANCES[1::2]
        while low < LONGEST * self.guess:
            ladder = self.tried(low * rising, disturbances, BRIEF * self.duration)
            none, every = ladder.ends()
            if none < 0 and low > self.stable:
                low = max(self.stable, low / rising[-2])
            elif every < LENGTHS:
                sooner = SOONER * ladder.lengths[none + 1]
                return max(self.stable, sooner), ladder.lengths[every]
            else:
                low = ladder.lengths[max(none, LENGTHS // 2)]
        raise NoLength(
            f"no slow slip of a patch up to {ladder.lengths[-1]:.4g} m runs away in "
            f"{BRIEF * self.duration:g} D/V",
            BEYOND,
        )

    def refined(self, low: float, high: float) -> _Ladder:
        """Trials that begin between two lengths (m) and close in on where patches run away."""
        for _ in range(SEARCHES):
            lengths = np.geomspace(low, high, LENGTHS)
            ladder = self.tried(lengths, DISTURBANCES, self.duration)
            none, every = ladder.ends()
            first, last = ladder.share(self.duration)[[0, -1]]
            if first > FEW and low > self.stable:
                low = max(self.stable, SOONER * low)
                high = lengths[min(every, LENGTHS - 1)]
            elif last < 1.0 - FEW:
                low = lengths[max(none, 0)]
                high = high / SOONER
            elif every - none > SHARP or ladder.threshold(self.duration)[1] < PRECISION:
                return ladder
            else:
                low, high = lengths[max(none, 0)], lengths[min(every, LENGTHS - 1)]
        raise NoLength(f"slow slip of a patch of {low:.4g} m has no clear end", UNKNOWN)


def runaway_point(patches: Patches, critical: float) -> tuple[float, float]:
    """L_run (m) of one fault with L_c (m), and its relative error.

    The error is that by the lengths and disturbances, by half the duration, and by the modes.
    Raises NoLength if no patch is unstable or runs away, the creep opens the fault, or slow slip of
    such a fault was not tried.
    """
    _, a, zeta = patches.constants
    low, high = WEAKENINGS
    if zeta > 0.0 and not low <= zeta / a <= high:
        raise NoLength(
            f"it was tried for zeta/a from {low:g} to {high:g}: zeta/a = {zeta / a:.3g}", UNKNOWN
        )
    search = _Search(patches, critical)
    ladder = search.refined(*search.bracketed())
    log_length, deviation = ladder.threshold(search.duration)
    by_duration = log_length - ladder.threshold(0.5 * search.duration)[0]
    error = math.hypot(DEVIATIONS * deviation, by_duration)
    return math.exp(log_length), max(error, LEAST_ERROR)


class Runaway(NamedTuple):
    """L_run of one fault; NaN with a status and a reason where there is none."""

    length: float  # m
    error: float  # relative
    status: str
    reason: str


@lru_cache(maxsize=4)  # L needs it of each perturbation
def runaway_of(patches: Patches, critical: float) -> Runaway:
    """L_run of one fault with L_c (m) whose friction weakens little.

    Integration with the friction law takes longer: it is for laws with another L_s than that of
    constant a and b.
    """
    _, a, zeta = patches.constants
    try:
        if patches.loading != "edge":
            raise NoLength(EDGE_ALONE, UNKNOWN)
        if zeta >= WEAK * a:
            reason = f"it is computed for zeta/a < {WEAK:g}: zeta/a = {zeta / a:.3g}"
            raise NoLength(reason, UNKNOWN)
        if patches.law is not None:
            constant = dataclasses.replace(patches, law=None, velocity=1.0)
            own, usual = (stability_length_of(one, critical) for one in (patches, constant))
            if abs(own / usual - 1.0) < CONSTANT:
                patches = constant
        return Runaway(*runaway_point(patches, critical), VALUE, "")
    except NoLength as none:
        return Runaway(math.nan, math.nan, none.status, str(none))


def runaway_answers(fault: FaultLike) -> tuple[Any, Any, Any, Any]:
    """L_run (m), its relative error, its status and the reason for it, of each fault.

    With a velocity and f it is that of the friction law, else of constant a and b: that one
    :func:`nucleation.drop.answer.answers_of_drop` leaves out, since it takes a second.
    """
    known = fault.velocity is not None and fault.friction is not None

    def answer(one: Systems, critical: float, velocity: float, distance: float) -> Runaway:
        patches = Patches(one, loading=fault.loading, evolution=fault.evolution)
        if known:
            with contextlib.suppress(ParameterError):  # no law has these constants
                patches = patches.with_law(fault, velocity, distance)
        return runaway_of(patches, critical)

    velocity = fault.velocity if known else np.nan
    rows = at_each(fault, answer, velocity, fault.slip_distance, rows=4)
    length, error = rows[:2].astype(float)
    return length, error, rows[2], rows[3]
