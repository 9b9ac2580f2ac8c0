"""The expected drop of a user's fault, by theory alone."""

import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ..model.settings import NEAR_END, THICK, THICK_REACH, Perturbation
from ..theory.creep.lengths import stability_length_of
from ..theory.creep.patches import Patches
from ..theory.creep.runaway import WEAK, Runaway, runaway_of
from ..theory.status import VALUE, NoLength
from .continued import trend
from .delay import ClosedForm, Drop, Growth, growth
from .mode_history import ModeHistory, mode_history

LATEST_GROWTH = 0.85  # over the longest patch followed, up to which L_s leaves lengths for a trend
STRONGEST = 0.1  # eps_eff beyond which bursts drop the force early, or come to rest and it is late
SLOWEST_GROWTH = 4.0  # growth in a period at the drop, below which they do so too
EARLIEST, LATEST = 0.05, 0.95  # parts of the realisations that have dropped at the range's ends


class Margin(NamedTuple):
    """How far the range goes beyond the law's own spread and the error of L_run, relative."""

    earlier: float
    later: float


OF_STRONG = Margin(0.055, 0.03)
OF_WEAK = Margin(0.085, 0.08)
OF_STRONG_NOISE = Margin(0.11, 0.31)
"""The margins, for zeta/a above and below WEAK and where the perturbation is strong.

With them the ranges have all drops of the blind faults with even numbers, in each regime: they are
fewer than twenty faults, whose realisations deviate together. The later one of weak friction is
that of other simulations, which drop up to 10 % above L_run (docs/drop.md).
"""

SLIP_BURSTS = 0.5  # zeta/a below which, by the slip law, bursts hardly lower the force


class ExpectedDrop(NamedTuple):
    """The expected drop of a fault under a declared perturbation; lengths in m.

    Its length is that of the law, or L_run where slow slip lasts up to it.
    """

    stability_length: float  # L_s
    strength: float  # of the perturbation
    growth: Growth  # of the oscillating mode
    law: Drop  # the law of the drop, which holds where the patch does not slip slowly
    closed_form: ClosedForm
    doubt: str  # why the answer is uncertain, empty if it is not
    runaway: Runaway
    weak: bool  # whether friction weakens so little that a patch may slip slowly up to L_run

    @property
    def length(self) -> float:
        """The length (m) at the drop: the law's median, or L_run if slow slip lasts up to it."""
        return float(np.fmax(self.law.length, self.runaway.length))

    @property
    def noisy(self) -> bool:
        """Whether the perturbation is strong."""
        return self.closed_form.effective >= STRONGEST

    @property
    def margin(self) -> Margin:
        """The margin of the fault's regime."""
        if self.noisy:
            return OF_STRONG_NOISE
        return OF_WEAK if self.weak else OF_STRONG

    @property
    def low(self) -> float:
        """The length (m) before which one in twenty drops."""
        (earliest,) = self.growth.dropped_at(self.strength, EARLIEST)
        slow = self.runaway.length * (1.0 - self.runaway.error)
        return float(np.fmax(earliest, slow)) * (1.0 - self.margin.earlier)

    @property
    def high(self) -> float:
        """The length (m) beyond which one in twenty drops."""
        (latest,) = self.growth.dropped_at(self.strength, LATEST)
        slow = self.runaway.length * (1.0 + self.runaway.error)
        return float(np.fmax(latest, slow)) * (1.0 + self.margin.later)

    def at_strength(self, strength: float) -> Drop:
        """The law of the drop at another strength of the perturbation."""
        return self.growth.drop(strength)

    @property
    def slips_slowly(self) -> bool:
        """Whether the patch slips in a limit cycle before the drop, which comes at L_run."""
        return bool(self.runaway.length > self.law.length)


@np.errstate(under="ignore")  # what is far below the loading counts as nothing
def expected_drop(
    patches: Patches,
    declared: Perturbation,
    critical: float,
    initial_state: float,
    initial_stress: float = 0.0,
    block: tuple[float, float] | None = None,
) -> ExpectedDrop:
    """The expected drop of one fault with its friction law, pushed at its edge.

    L_c is in m, phi0 in s, the initial shear stress over sigma0; a simulated block has a length and
    a height (m). Raises NoLength if nothing is perturbed or no patch turns unstable.
    """
    if not declared.acts:
        raise NoLength("nothing is perturbed: without a strength the drop depends on round-off")
    history = mode_history(patches, critical, initial_state, initial_stress)
    found = growth(history, declared)
    stable = stability_length_of(patches, critical)
    runaway = runaway_of(patches, critical)
    _, a, zeta = patches.constants
    known = ExpectedDrop(
        stability_length=stable,
        strength=declared.strength,
        growth=found,
        law=found.drop(declared.strength),
        closed_form=found.closed_form(history, declared.strength),
        doubt="",
        runaway=runaway,
        weak=zeta < WEAK * a,
    )
    if known.slips_slowly:
        doubts = [*_doubts_of_runaway(patches)]
    else:
        doubts = [*_doubts_of_law(history, known.law, known.closed_form, critical)]
    if known.noisy:
        doubts.append(
            f"the perturbation is strong (eps_eff = {known.closed_form.effective:.2g}, the law "
            f"holds below {STRONGEST:g}): bursts may drop the force early, or come to rest"
        )
    if runaway.status != VALUE and known.weak:
        doubts.append(
            f"the patch may slip slowly beyond this length, since L_run is not known: "
            f"{runaway.reason}"
        )
    if block is not None:
        doubts += _doubts_of_block(known, block)
    return known._replace(doubt="; ".join(doubts))


def _doubts_of_runaway(patches: Patches) -> Iterator[str]:
    """Why L_run is uncertain: a burst may hardly lower the force."""
    _, a, zeta = patches.constants
    ratio = zeta / a
    if patches.evolution == "slip" and ratio < SLIP_BURSTS:
        yield (
            f"by the slip law and zeta/a = {ratio:.3g}, below {SLIP_BURSTS:g}, bursts hardly lower "
            "the force: in simulations it did not drop up to 1.3 times this length"
        )


def _doubts_of_law(
    history: ModeHistory, drop: Drop, closed: ClosedForm, critical: float
) -> Iterator[str]:
    """Why the law of the drop is uncertain."""
    longest = history.length[-1]
    if closed.front_length > LATEST_GROWTH * longest:
        yield (
            "growth begins near the longest patch with a mode that could be followed, at "
            f"{closed.front_length / longest:.2g} of its length: its further growth is not known"
        )
    if not np.isfinite([drop.length, drop.low, drop.high]).all():
        yield "the drop is beyond the lengths to which the mode's trends are continued"
        return
    grown = grown_in_period(history, drop.length)
    if grown < SLOWEST_GROWTH:
        yield (
            f"the mode grows by a factor of {grown:.2g} in a period where it is as large as the "
            f"loading (the law holds from {SLOWEST_GROWTH:g} on): bursts that come to rest may "
            "make the drop later"
        )
    if drop.high > longest:
        yield (
            "the drop is beyond the patches with a mode that could be followed, "
            f"{longest / critical:.2g} L_c"
        )


def grown_in_period(history: ModeHistory, length: float) -> float:
    """Growth factor of a patch (m) in a period of its mode; inf if that oscillates no more."""
    at = np.array([length])
    rate, frequency = (
        float(trend(history, values)(at)[0]) for values in (history.rate.real, history.rate.imag)
    )
    return float(np.exp(2.0 * np.pi * rate / frequency)) if frequency > 0.0 else math.inf


def _doubts_of_block(known: ExpectedDrop, block: tuple[float, float]) -> Iterator[str]:
    """Whether the patch feels the far end of its block when it drops."""
    highest = np.fmax(known.law.high, known.runaway.length)
    length, height = block
    if highest > NEAR_END * length:
        yield (
            f"the patch would be {highest / length:.2g} of the block long, and would feel "
            "the block's far end"
        )
    elif feels_far_end(known.length, block):
        reach = (known.length + height) / length
        yield (
            f"the block is thick: its height and the patch together are {reach:.2g} of its length "
            f"(the law was compared up to {THICK_REACH:g}), so that the patch feels the far end; "
            "simulated drops came 3 to 10 % later"
        )


def feels_far_end(length: float, block: tuple[float, float]) -> bool:
    """Whether a patch of a length (m) in a thick block feels the far end.

    A thin block's end has no effect at a distance of some heights. In a thick one its effect
    decreases with the distance over ``L + H``: simulated drops in blocks of H = 1.2 m that are 8, 6
    and 4 L_c long came 2.9, 5.8 and 9.8 % later than by the law, at 0.26, 0.34 and 0.51.
    """
    whole, height = block
    return height > THICK * length and length + height > THICK_REACH * whole
