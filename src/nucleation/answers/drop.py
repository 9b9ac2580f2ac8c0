"""L, at which the patch runs away, and L_run, as answers; they depend on a perturbation.

L is the larger of the law's median (:mod:`nucleation.drop`) and L_run. Without a velocity the time
D/V is the unit, on which no length depends. Without a friction coefficient, which sets how strongly
a load acts, L is bounded by the coefficients and the noise that faults may have.
"""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from ..model.friction.constants import AGE, ANY
from ..model.quantities import ParameterError
from ..model.settings import Perturbation
from ..model.units import in_metres
from ..theory.creep.patches import Patches
from ..theory.critical import of_distinct
from ..theory.spectrum import Systems
from ..theory.status import BETWEEN, BEYOND, UNKNOWN, VALUE, NoLength
from ..theory.values import FaultLike
from .answer import FIELDS, Answer, elementwise, short

if TYPE_CHECKING:
    from ..drop.expected_drop import ExpectedDrop
    from ..theory.creep.runaway import Runaway

FRICTIONS = (0.1, 0.9)
"""Friction coefficients of faults, from wet clay to rough rock."""

STRENGTHS = (1e-7, 1e-2)
"""Relative noise of a load, from the quietest to the strongest that is plausible."""

USUAL_STRENGTH = 1e-4
"""Relative noise if none is given."""

SLOW_SLIP = "slow slip lasts up to this length, whatever the noise"
"""On what L depends where it is L_run."""

_REMOTE = "under a load from afar it depends on the weak spot where the patch begins"

_ALIKE = 1.02
"""Ratio of lengths up to which they are one number: L_run is known to 2 %."""


def run_away(fault: FaultLike, declared: Perturbation | None, usual: Perturbation) -> list[Answer]:
    """L and L_run of each fault under a declared perturbation, or the usual one if None.

    Where the friction coefficient is missing, a perturbation that is not declared may have any of
    the :data:`STRENGTHS`.
    """
    velocity, distance, age = fault.velocity, fault.slip_distance, fault.initial_state
    if fault.friction_law is not None:
        of_law = velocity, distance, AGE * distance / velocity if age is None else age
    elif age is None or velocity is None:
        of_law = ANY, ANY, AGE
    else:
        of_law = ANY, ANY, age * velocity / distance

    def answer(one: Systems, critical: float, *at: float) -> tuple[object, ...]:
        if fault.loading != "edge":
            none = Answer.none(UNKNOWN, _REMOTE)
            return _Found(none, none).rows
        if velocity is None and age is not None:
            none = Answer.none(UNKNOWN, "needs velocity: the age of the interface is in seconds")
            return _Found(none, none).rows
        known = _Known(fault, Patches(one, evolution=str(fault.evolution)), critical, *at)
        if fault.friction is not None:
            return known.under(declared or usual).rows
        return known.of_any_friction(declared, usual).rows

    # a correlation length is in metres, unlike the lengths of problems without units
    problem = Systems.in_metres if usual.along_x else Systems.without_units
    lengths, words = _LENGTHS, 2 * FIELDS + 2 - _LENGTHS
    rows = of_distinct(
        fault, answer, *of_law, rows=lengths + words, lengths=lengths, problem=problem
    )
    drop, runaway = (Answer.of_rows(rows[own]) for own in _OF_ANSWERS)
    noises = 0.1 * usual.strength, 10.0 * usual.strength

    def basis(text: str, *others: float) -> str:
        if np.isnan(others).all():
            return text
        listed = [
            f"{in_metres(length, form='.3g')} ({short(noise)})"
            for length, noise in zip(others, noises, strict=True)
            if np.isfinite(length)
        ]
        return f"with other noise it is {', '.join(listed)}"

    return [drop._replace(basis=elementwise(basis, drop.basis, rows[6], rows[7])), runaway]


class _Found(NamedTuple):
    """L and L_run; and L with a tenth of the noise and with ten times as much, NaN if unknown."""

    drop: Answer
    runaway: Answer
    others: tuple[float, float] = (math.nan, math.nan)

    @property
    def rows(self) -> tuple[object, ...]:
        """Lengths first: those of both answers, and the others; then the words of both."""
        return (*self.drop[:3], *self.runaway[:3], *self.others, *self.drop[3:], *self.runaway[3:])


_LENGTHS = 8
_OF_ANSWERS = [0, 1, 2, 8, 9, 10, 11], [3, 4, 5, 12, 13, 14, 15]
"""Rows of lengths in :class:`_Found`, and rows of its two answers."""


@dataclasses.dataclass(frozen=True)
class _Known:
    """One fault with its L_c (m) or NaN, V (m/s), D (m) and phi0 (s)."""

    fault: FaultLike
    patches: Patches
    critical: float
    velocity: float
    distance: float
    initial_state: float

    def under(self, declared: Perturbation) -> _Found:
        """L and L_run under a perturbation."""
        from ..drop.expected_drop import expected_drop
        from ..theory.creep.runaway import runaway_of

        patches = self.patches
        try:
            patches = patches.with_law(self.fault, self.velocity, self.distance)
            known = expected_drop(patches, declared, self.critical, self.initial_state)
        except (NoLength, ParameterError) as none:  # a parameter: no law has these constants
            drop = Answer.none(getattr(none, "status", UNKNOWN), str(none))
            return _Found(drop, _runaway(runaway_of(patches, self.critical)))
        drop = _drop(known)
        others = _others(known) if drop.exists else (math.nan, math.nan)
        return _Found(drop, _runaway(known.runaway), others)

    def of_any_friction(self, declared: Perturbation | None, usual: Perturbation) -> _Found:
        """L between those of the :data:`FRICTIONS` and, if none is declared, of all strengths."""
        slick, rough = FRICTIONS
        faint, loud = (
            declared or dataclasses.replace(usual, strength=strength) for strength in STRENGTHS
        )
        known = self._with_friction(slick).under(faint)
        longest, runaway = known.drop, known.runaway
        if not longest.exists:
            return known
        shortest = self._with_friction(rough).under(loud).drop
        if shortest.exists and longest.value < _ALIKE * shortest.value:
            basis = (
                f"friction coefficients of {slick:g} to {rough:g} and the noise change it little"
            )
            ends = [self._with_friction(friction).under(usual).drop for friction in FRICTIONS]
            low, high = min(one.low for one in ends), max(one.high for one in ends)
            doubt = ends[1].doubt or ends[0].doubt
            found = ends[1]._replace(low=low, high=high, doubt=doubt, basis=basis)
            return _Found(found, runaway)
        from ..theory.creep.lengths import stability_length_of

        low = stability_length_of(self.patches, self.critical)
        if shortest.exists:
            low = min(low, shortest.low)
        noise = ""
        if declared is None:
            noise = f"on the noise (here {short(faint.strength)} to {short(loud.strength)}), and "
        reason = (
            f"it depends {noise}on the friction coefficient (here {slick:g} to {rough:g}), which "
            "sets how strongly a load acts; with the friction coefficient it is one number"
        )
        return _Found(Answer(math.nan, low, longest.high, BETWEEN, reason), runaway)

    def _with_friction(self, friction: float) -> _Known:
        one = self.patches.one._replace(friction=np.array([friction]))
        return dataclasses.replace(self, patches=dataclasses.replace(self.patches, one=one))


def _runaway(found: Runaway) -> Answer:
    error = found.length * found.error
    low, high = found.length - error, found.length + error
    return Answer(found.length, low, high, found.status, found.reason)


def _drop(known: ExpectedDrop) -> Answer:
    """L of one fault, whose friction may weaken so little that it slips slowly."""
    runaway = known.runaway
    if runaway.status == BEYOND:  # slow slip lasts longer than the law of the drop assumes
        return Answer.none(BEYOND, runaway.reason)
    if not math.isfinite(known.stability_length):
        reason = "no patch in steady creep turns unstable before the drop"
        return Answer.none(UNKNOWN, reason)
    if known.weak and not math.isfinite(runaway.length):
        reason = f"a patch may slip slowly, and L_run is not known: {runaway.reason}"
        return Answer.none(UNKNOWN, reason)
    if not math.isfinite(known.length):
        return Answer.none(BEYOND, known.doubt)
    doubts = [known.doubt] if known.doubt else []
    if known.length < known.stability_length:
        doubts.append(
            "behind its advancing front the patch turns unstable before L_s, of steady creep"
        )
    basis = SLOW_SLIP if known.slips_slowly else ""
    return Answer(known.length, known.low, known.high, VALUE, "", "; ".join(doubts), basis)


def _others(known: ExpectedDrop) -> tuple[float, float]:
    """The length with a tenth of the noise, and with ten times as much; NaN if it has no effect."""
    if known.slips_slowly:
        return math.nan, math.nan
    quieter, louder = (
        float(np.fmax(known.at_strength(share * known.strength).length, known.runaway.length))
        for share in (0.1, 10.0)
    )
    return quieter, louder
