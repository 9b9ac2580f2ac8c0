"""L, at which the patch runs away, and L_run, as answers; they depend on a perturbation.

L is the larger of the law's median (:mod:`nucleation.drop`) and L_run. Without a velocity the time
D/V is the unit, on which no length depends. Without a friction coefficient, which sets how strongly
a load acts, L is bounded by the coefficients and the noise that faults may have.
"""

from __future__ import annotations

import dataclasses
import math
from typing import TYPE_CHECKING

import numpy as np

from ..model.friction.constants import AGE
from ..model.quantities import ParameterError
from ..model.settings import Perturbation
from ..theory.creep.patches import Patches
from ..theory.critical import at_each
from ..theory.spectrum import Systems
from ..theory.status import BETWEEN, BEYOND, UNKNOWN, VALUE, NoLength
from ..theory.values import FaultLike
from .answer import FIELDS, Answer, short

if TYPE_CHECKING:
    from ..drop.expected_drop import ExpectedDrop
    from ..theory.creep.runaway import Runaway

FRICTIONS = (0.1, 0.9)
"""Friction coefficients of faults, from wet clay to rough rock."""

STRENGTHS = (1e-7, 1e-2)
"""Relative noise of a load, from the quietest to the strongest that is plausible."""

USUAL_STRENGTH = 1e-4
"""Relative noise if none is given."""

_REMOTE = "under a load from afar it depends on the weak spot where the patch begins"

_ALIKE = 1.02
"""Ratio of lengths up to which they are one number: L_run is known to 2 %."""


def run_away(fault: FaultLike, declared: Perturbation | None, usual: Perturbation) -> list[Answer]:
    """L and L_run of each fault under a declared perturbation, or the usual one if None.

    Where the friction coefficient is missing, a perturbation that is not declared may have any of
    the :data:`STRENGTHS`.
    """
    age = np.nan if fault.initial_state is None else fault.initial_state
    velocity = np.nan if fault.velocity is None else fault.velocity

    def answer(
        one: Systems, critical: float, velocity: float, distance: float, age: float
    ) -> tuple[object, ...]:
        if fault.loading != "edge":
            none = Answer.none(UNKNOWN, _REMOTE)
            return *none, *none
        if math.isnan(velocity) and not math.isnan(age):
            none = Answer.none(UNKNOWN, "needs velocity: the age of the interface is in seconds")
            return *none, *none
        if math.isnan(velocity):
            velocity = distance  # in units of D/V
        phi0 = AGE * distance / velocity if math.isnan(age) else age
        patches = Patches(one, evolution=str(fault.evolution))
        known = _Known(fault, patches, critical, velocity, distance, phi0)
        if fault.friction is not None:
            drop, runaway = known.under(declared or usual)
        else:
            drop, runaway = known.of_any_friction(declared, usual)
        return *drop, *runaway

    rows = at_each(fault, answer, velocity, fault.slip_distance, age, rows=2 * FIELDS)
    return [Answer.of_rows(rows[:FIELDS]), Answer.of_rows(rows[FIELDS:])]


@dataclasses.dataclass(frozen=True)
class _Known:
    """One fault with its L_c (m) or NaN, V (m/s), D (m) and phi0 (s)."""

    fault: FaultLike
    patches: Patches
    critical: float
    velocity: float
    distance: float
    initial_state: float

    def under(self, declared: Perturbation) -> tuple[Answer, Answer]:
        """L and L_run under a perturbation."""
        from ..drop.expected_drop import expected_drop
        from ..theory.creep.runaway import runaway_of

        patches = self.patches
        try:
            patches = patches.with_law(self.fault, self.velocity, self.distance)
            known = expected_drop(patches, declared, self.critical, self.initial_state)
        except (NoLength, ParameterError) as none:  # a parameter: no law has these constants
            drop = Answer.none(getattr(none, "status", UNKNOWN), str(none))
            return drop, _runaway(runaway_of(patches, self.critical))
        return _drop(known), _runaway(known.runaway)

    def of_any_friction(
        self, declared: Perturbation | None, usual: Perturbation
    ) -> tuple[Answer, Answer]:
        """L between those of the :data:`FRICTIONS` and, if none is declared, of all strengths."""
        slick, rough = FRICTIONS
        faint, loud = (
            declared or dataclasses.replace(usual, strength=strength) for strength in STRENGTHS
        )
        longest, runaway = self._with_friction(slick).under(faint)
        if not longest.exists:
            return longest, runaway
        shortest, _ = self._with_friction(rough).under(loud)
        if shortest.exists and longest.value < _ALIKE * shortest.value:
            basis = (
                f"friction coefficients of {slick:g} to {rough:g} and the noise change it little"
            )
            ends = [self._with_friction(friction).under(usual)[0] for friction in FRICTIONS]
            low, high = min(one.low for one in ends), max(one.high for one in ends)
            doubt = ends[1].doubt or ends[0].doubt
            return ends[1]._replace(low=low, high=high, doubt=doubt, basis=basis), runaway
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
        return Answer(math.nan, low, longest.high, BETWEEN, reason), runaway

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
    doubt = "; ".join(doubts)
    basis = _basis(known)
    return Answer(known.length, known.low, known.high, VALUE, "", doubt, basis)


def _basis(known: ExpectedDrop) -> str:
    """How the length depends on the noise."""
    if known.slips_slowly:
        return "slow slip lasts up to this length, whatever the noise"
    strength = known.strength
    texts = []
    for noise in (0.1 * strength, 10.0 * strength):
        length = np.fmax(known.at_strength(noise).length, known.runaway.length)
        if np.isfinite(length):
            texts.append(f"{length:.3g} m ({short(noise)})")
    return f"with other noise it is {', '.join(texts)}" if texts else ""
