"""The drop that a user's fault is to be expected to have, by theory alone."""

import dataclasses
import math
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from ..model.linearised import interface_state
from ..model.parameters import Geometry, Parameters
from ..theory.creep.lengths import NoPatch, Patches, stability_length_of
from ..theory.creep.runaway import runaway_point
from ..theory.critical import NoInstability, run_length
from ..theory.status import UNKNOWN, VALUE
from .continued import trend
from .delay import ClosedForm, Drop, growth
from .mode_history import ModeHistory, mode_history

LATEST_GROWTH = 0.85  # of the longest patch followed, up to which L_s leaves something to trend
STRONGEST = 0.02  # eps_eff beyond which bursts that come to rest make the drop late
WEAK = 2.0  # zeta/a below which a patch may slip slowly up to L_run
EARLIER, LATER = 0.03, 0.10
"""Relative range about L_run, below and above, in which the force drops after slow slip: the error
of L_run, and its delay where the front is fast. Simulated drops are 0 to 8 % above L_run."""
CONSTANT = 0.05  # relative change of L_s by friction's scales up to which L_run is used
SLOWEST_GROWTH = 4.0  # growth in a period at the drop, below which they do so too
NEAR_END = 0.6  # part of the block's length up to which its far end is not felt in a thin block
THICK = 0.5  # height over the patch's length from which a block is thick
THICK_REACH = 0.2  # and (L + H) over the block's length up to which its far end is not felt then


class NoDrop(ValueError):
    """The theory has no length at the drop for this fault.

    Parameters
    ----------
    reason : str
        Why, in words.
    status : {"stable", "beyond", "unknown"}
        Which kind of reason it is: see :mod:`nucleation.theory.status`.
    """

    def __init__(self, reason: str, status: str = UNKNOWN):
        super().__init__(reason)
        self.status = status


class ExpectedDrop(NamedTuple):
    """What is to be expected of a fault under its declared perturbation; lengths in m."""

    stability_length: float  # L_s
    drop: Drop
    closed_form: ClosedForm
    doubt: str  # why the answer should not be relied upon, empty if it should
    runaway_length: float = math.nan  # L_run where friction weakens little, else NaN
    runaway_status: str = VALUE  # "value", "stable", "beyond" or "unknown"
    runaway_reason: str = ""  # why there is no L_run, empty where there is

    @property
    def length(self) -> float:
        """The length (m) at the drop: the law's median, or L_run if slow slip lasts until then."""
        return float(np.fmax(self.drop.length, self.runaway_length))

    @property
    def low(self) -> float:
        """The least length (m) that is expected at the drop."""
        return float(np.fmax(self.drop.low, self.runaway_length * (1.0 - EARLIER)))

    @property
    def high(self) -> float:
        """The largest length (m) that is expected at the drop."""
        return float(np.fmax(self.drop.high, self.runaway_length * (1.0 + LATER)))

    @property
    def slips_slowly(self) -> bool:
        """Whether the patch slips in a limit cycle before the drop, which comes at L_run."""
        return bool(self.runaway_length > self.drop.length)

    @property
    def trusted(self) -> bool:
        """Whether the law holds as far as its own numbers tell."""
        return not self.doubt


def expected_drop(parameters: Parameters) -> ExpectedDrop:
    """L_s and the length at the drop of a fault under its declared perturbation.

    Mesh and steps do not matter.

    Raises
    ------
    NoDrop
        Nothing is perturbed, or no patch turns unstable.
    ParameterError
        If it is no uniform fault that is pushed at its edge.
    """
    parameters.require_edge("the law of the drop")
    declared = parameters.perturbation
    if not declared.acts:
        raise NoDrop("nothing is perturbed: without a strength the drop depends on round-off")
    try:
        critical = run_length(parameters, interface_state(parameters))
        history = mode_history(parameters, critical)
    except (NoInstability, NoPatch) as error:
        raise NoDrop(str(error), error.status) from None
    found = growth(history, declared)
    drop = found.drop(declared.strength)
    closed = found.closed_form(history, declared.strength)
    stable = stability_length_of(parameters, critical)
    known = ExpectedDrop(stable, drop, closed, "", *_runaway_length(parameters, critical))
    return known._replace(doubt="; ".join(_doubts(history, known, critical)))


def _runaway_length(parameters: Parameters, critical: float) -> tuple[float, str, str]:
    """L_run (m) with status and reason; NaN where weakening is strong or no patch runs away."""
    interface = interface_state(parameters)
    if interface.zeta >= WEAK * interface.a:
        ratio = interface.zeta / interface.a
        return math.nan, UNKNOWN, f"it is computed for zeta/a < {WEAK:g}: zeta/a = {ratio:.3g}"
    patches = dataclasses.replace(Patches.of(parameters), law=None)
    try:
        return runaway_point(patches, critical, parameters.friction.evolution), VALUE, ""
    except NoPatch as none:
        return math.nan, none.status, str(none)


def _doubts(history: ModeHistory, known: ExpectedDrop, critical: float) -> Iterator[str]:
    """Why the answer should not be relied upon, a text for each reason."""
    if known.slips_slowly:
        yield from _doubts_of_runaway(history, known, critical)
    else:
        yield from _doubts_of_law(history, known.drop, known.closed_form, critical)
    yield from _doubts_of_block(history, known)


def _doubts_of_runaway(history: ModeHistory, known: ExpectedDrop, critical: float) -> Iterator[str]:
    """Why L_run should not be relied upon: it is that of constant a and b, and of few bodies."""
    own, below = history.parameters, history.parameters.below
    if below is not None and (below.material, below.geometry) != (own.material, own.geometry):
        yield (
            "L_run was compared with simulations on a rigid base and between bodies alike, and not "
            "between unlike ones"
        )
    constant = stability_length_of(own, critical, constant=True)
    if not abs(known.stability_length / constant - 1.0) < CONSTANT:
        yield (
            "friction's own scales change a and b along the patch (L_s is "
            f"{known.stability_length:.3g} m, with constant a and b {constant:.3g} m), and L_run "
            "is that of constant a and b"
        )


def _doubts_of_law(
    history: ModeHistory, drop: Drop, closed: ClosedForm, critical: float
) -> Iterator[str]:
    """Why the law of the drop should not be relied upon."""
    longest = history.length[-1]
    if closed.effective >= STRONGEST:
        yield (
            f"the perturbation is strong (eps_eff = {closed.effective:.2g}, the law holds below "
            f"{STRONGEST:g}): bursts that come to rest may make the drop later"
        )
    if closed.front_length > LATEST_GROWTH * longest:
        yield (
            "growth begins near the longest patch whose mode could be followed, at "
            f"{closed.front_length / longest:.2g} of its length: how it goes on is not known"
        )
    if not np.isfinite([drop.length, drop.low, drop.high]).all():
        yield "the drop lies beyond the lengths that the mode's trends are carried on to"
        return
    grown = _growth_in_period(history, drop.length)
    if grown < SLOWEST_GROWTH:
        yield (
            f"the mode grows by a factor of {grown:.2g} in a period where it is as large as the "
            f"loading (the law holds from {SLOWEST_GROWTH:g} on): bursts that come to rest may "
            "make the drop later"
        )
    if drop.high > longest:
        yield (
            "the drop lies beyond the patches whose mode could be followed, "
            f"{longest / critical:.2g} L_c"
        )


def _doubts_of_block(history: ModeHistory, known: ExpectedDrop) -> Iterator[str]:
    """Whether the patch feels the far end of its block when it drops."""
    geometry = history.parameters.geometry
    highest = np.fmax(known.drop.high, known.runaway_length)
    if highest > NEAR_END * geometry.length:
        yield (
            f"the patch would be {highest / geometry.length:.2g} of the block long, whose far "
            "end it feels"
        )
    elif feels_far_end(known.length, geometry):
        reach = (known.length + geometry.height) / geometry.length
        yield (
            f"the block is thick: its height and the patch together are {reach:.2g} of its length "
            f"(the law was compared up to {THICK_REACH:g}), so that the patch feels the far end; "
            "simulated drops came 3 to 10 % later"
        )


def feels_far_end(length: float, geometry: Geometry) -> bool:
    """Whether a patch of a length (m) in a thick block feels the far end.

    In a thin block the end is not felt at a distance of some heights. In a thick one its effect
    falls off with the distance over ``L + H``: simulated drops in blocks of H = 1.2 m that are 8, 6
    and 4 L_c long came 2.9, 5.8 and 9.8 % later than by the law, at 0.26, 0.34 and 0.51.
    """
    is_thick = geometry.height > THICK * length
    return is_thick and length + geometry.height > THICK_REACH * geometry.length


def _growth_in_period(history: ModeHistory, length: float) -> float:
    """The mode's growth in one of its periods at a patch length (m), by the trends."""
    rate, turn = (
        float(trend(history, part)(np.array([length]))[0])
        for part in (history.rate.real, history.rate.imag)
    )
    return float(np.exp(2.0 * np.pi * rate / turn)) if turn > 0.0 else float("inf")
