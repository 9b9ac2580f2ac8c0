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

from ...model.friction.constants import ANY
from ...model.quantities import ParameterError
from ...types import Array
from ..critical import largest_crossings, of_distinct
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
DISTURBANCES = 0.005, 0.02  # least and largest, of log(phi) at the start, in the patch's middle
GUESS = 0.57  # L_run over L_c k_b/k_c: .4 to .62
SHORTEST, LONGEST = 0.78, 2.0  # times the guess, of the lengths of the brief search
SPACING, BRIEFLY = 1.06, (10, 2)  # of them; lengths and disturbances in it
BRIEF, STRONGER = 0.2, 2.0  # times the duration and the disturbances, in it
SOONER = 0.94  # times the length of which half the patches run away briefly: about L_run
REACH, FIRST = 0.1, (16, 4)  # of log L to both sides of it; lengths and disturbances tried first
CLOSE, LAST = 2.0, (6, 8)  # widths of the transition to both sides, tried last; as above
INSIDE = 0.8  # share of what is tried to both sides in which L_run must lie
SEARCHES = 6
PRECISION = 0.005  # standard error of log L_run up to which the first are enough
WIDTHS = (0.005, 0.05)  # of log L, between which that of the transition is sought
ERROR = 0.01  # relative, over k_b/k_c: `python -m benchmarks.runaway` measures it
LEAST_ERROR = 0.02  # relative


class _Trials(NamedTuple):
    """Patches of several lengths, and the times over D/V after which they run away."""

    lengths: Array  # m, (patch,)
    times: Array  # (patch,)

    def ends(self) -> tuple[float, float]:
        """Lengths (m): the last up to which none runs away, and the first from which all do.

        They are 0 and inf if there is none.
        """
        runs = np.isfinite(self.times)
        lasting = self.lengths[self.lengths < self.lengths[runs].min(initial=np.inf)]
        running = self.lengths[self.lengths > self.lengths[~runs].max(initial=0.0)]
        return lasting.max(initial=0.0), running.min(initial=np.inf)

    def transition(self) -> tuple[float, float, float]:
        """The log of the length of which half the patches run away, its width, and standard error.

        Logistic regression: the share is ``1/(1 + exp(-(log L - middle)/width))``.
        """
        from scipy.optimize import minimize  # slow to load, and few processes need it

        logs, runs = np.log(self.lengths), np.isfinite(self.times)

        def unlikelihood(at: Array) -> float:
            beyond = (logs - at[0]) / math.exp(at[1])
            return float(np.sum(np.logaddexp(0.0, beyond) - runs * beyond))

        narrow, wide = np.log(WIDTHS)
        bounds = [(logs.min(), logs.max()), (narrow, wide)]
        # from a middle: all run away that are longer, if as many as do are the longest
        middle = np.quantile(logs, 1.0 - runs.mean())
        found = minimize(unlikelihood, [middle, 0.5 * (narrow + wide)], bounds=bounds)
        middle, width = found.x[0], math.exp(found.x[1])
        share = 1.0 / (1.0 + np.exp((middle - logs) / width))
        information = np.sum(share * (1.0 - share)) / width**2
        return float(middle), width, float(information**-0.5)


class _Search:
    """Trials of one fault's patches."""

    def __init__(self, patches: Patches, critical: float) -> None:
        self.patches = patches
        self.critical = critical
        self.stable = stability_point(patches, critical)[0]
        self.cohesive = cohesive_wavenumber(patches, critical)
        self.guess = GUESS * critical**2 * self.cohesive / (2.0 * math.pi)
        _, a, zeta = patches.constants
        self.duration = DURATION * min(1.0, a / zeta)

    def tried(self, lengths: Array, number: int, stronger: float, briefer: float) -> _Trials:
        """Patches of rising length (m), each with a number of disturbances."""
        disturbances = stronger * np.geomspace(*DISTURBANCES, number)
        modes = modes_that_resolve(self.cohesive, float(lengths[-1]))
        duration = briefer * self.duration
        times = lifetimes(self.patches, lengths, modes, disturbances, duration)
        return _Trials(np.repeat(lengths, len(disturbances)), times.ravel())

    def brief(self) -> _Trials:
        """Trials from lengths at which slow slip lasts to those at which it soon runs away."""
        low = max(self.stable, SHORTEST * self.guess)
        number, disturbances = BRIEFLY
        rising: Array = SPACING ** np.arange(float(number))
        while low < LONGEST * self.guess:
            lengths = low * rising
            trials = self.tried(lengths, disturbances, STRONGER, BRIEF)
            none, every = trials.ends()
            if none == 0.0 and low > self.stable:
                low = max(self.stable, low / rising[-2])
            elif every <= lengths[-1]:
                return trials
            else:
                low = max(none, lengths[number // 2])
        raise NoLength(
            f"no slow slip of a patch up to {lengths[-1] / self.critical:.3g} L_c runs away in "
            f"{BRIEF * self.duration:g} D/V",
            BEYOND,
        )

    def transition(self) -> float:
        """The log of L_run (m), in the middle of the transition."""
        around = self.brief().transition()[0] + math.log(SOONER)
        reach, (number, disturbances) = REACH, FIRST
        trials = _Trials(np.empty(0), np.empty(0))
        for _ in range(SEARCHES):
            lengths = np.exp(around + np.linspace(-reach, reach, number))
            more = self.tried(lengths, disturbances, 1.0, 1.0)
            trials = _Trials(*map(np.append, trials, more))
            middle, width, deviation = trials.transition()
            if abs(middle - around) < INSIDE * reach:
                if deviation < PRECISION or disturbances == LAST[1]:
                    return middle
                reach, (number, disturbances) = CLOSE * width, LAST
            around = middle
        length = math.exp(around) / self.critical
        raise NoLength(f"slow slip of a patch of {length:.3g} L_c has no clear end", UNKNOWN)


def runaway_point(patches: Patches, critical: float) -> tuple[float, float]:
    """L_run (m) of one fault with L_c (m), and its relative error.

    Slow slip is chaotic, so that one patch's lifetime depends on the last bits, and differs from
    one processor to another. L_run is that of many patches. Its error is that of all faults with
    the same k_b/k_c, by half and twice the duration, the modes and the disturbances.
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
    log_length = search.transition()
    fronts = search.cohesive * critical / (2.0 * math.pi)
    return math.exp(log_length), max(ERROR * fronts, LEAST_ERROR)


class Runaway(NamedTuple):
    """L_run of one fault; NaN with a status and a reason where there is none."""

    length: float  # m
    error: float  # relative
    status: str
    reason: str


@lru_cache(maxsize=4)  # laws that differ in their scales share it
def _of_constants(patches: Patches) -> tuple[float, float]:
    """The same with constant a and b, of the problem that similar faults share."""
    return runaway_point(patches, 2.0 * math.pi / float(largest_crossings(patches.one)[0]))


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
        if patches.law is not None:
            return Runaway(*runaway_point(patches, critical), VALUE, "")
        shared, unit = patches.one.of_constants()
        length, error = _of_constants(dataclasses.replace(patches, one=shared))
        return Runaway(length * float(unit[0]), error, VALUE, "")
    except NoLength as none:
        return Runaway(math.nan, math.nan, none.status, str(none))


def runaway_answers(fault: FaultLike) -> tuple[Any, Any, Any, Any]:
    """L_run (m), its relative error, its status and the reason for it, of each fault.

    With a velocity and f it is that of the friction law, else of constant a and b: that one
    :func:`nucleation.answers.drop.run_away` leaves out, since it takes a second.
    """
    known = fault.velocity is not None and fault.friction is not None

    def answer(one: Systems, critical: float, *at: float) -> Runaway:
        patches = Patches(one, loading=fault.loading, evolution=str(fault.evolution))
        if known:
            with contextlib.suppress(ParameterError):  # no law has these constants
                patches = patches.with_law(fault, *at)
        return runaway_of(patches, critical)

    if known:
        own = fault.friction_law is None
        of_law = (ANY, ANY) if own else (fault.velocity, fault.slip_distance)
        rows = of_distinct(fault, answer, *of_law, rows=4)
    else:
        rows = of_distinct(fault, answer, rows=4, problem=Systems.of_constants)
    length, error = rows[:2].astype(float)
    return length, error, rows[2], rows[3]
