"""L_run and the length L at the drop of one or many faults, as answers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ..lengths.answer import Answer
from ..model.friction.constants import AGE, law_of
from ..model.quantities import ParameterError
from ..model.settings import Perturbation
from ..theory.creep.patches import Patches
from ..theory.critical import at_each
from ..theory.spectrum import Systems
from ..theory.status import BEYOND, UNKNOWN, VALUE, NoLength
from ..theory.values import FaultLike

if TYPE_CHECKING:
    from .expected_drop import ExpectedDrop

FIELDS = len(Answer._fields)


def answers_of_drop(fault: FaultLike, declared: Perturbation) -> dict[str, Answer]:
    """L_run and L under a declared perturbation."""
    missing = [name for name in ("velocity", "friction") if getattr(fault, name) is None]
    reason = ""
    if missing:
        reason = f"needs {' and '.join(missing)}: the drop depends on the friction law"
    elif fault.loading != "edge":
        reason = "it is known for a patch that is pushed at its edge"
    if reason:
        none = _none(UNKNOWN, reason)
        found = _answer(at_each(fault, lambda *_: none, rows=FIELDS))
        return {"runaway_length": found, "drop_length": found}
    from .expected_drop import WEAK, expected_drop

    age = np.nan if fault.initial_state is None else fault.initial_state

    def answer(
        one: Systems,
        critical: float,
        velocity: float,
        distance: float,
        age: float,
    ) -> tuple[Any, ...]:
        constants = (float(one.friction[0]), float(one.a[0]), float(one.zeta[0]))
        phi0 = AGE * distance / velocity if math.isnan(age) else age
        given = fault.friction_law, fault.evolution
        try:
            law = law_of(*given, velocity, distance, *constants)
            patches = Patches(one, law, velocity, evolution=fault.evolution)
            known = expected_drop(patches, declared, critical, phi0)
        except NoLength as none:
            runaway = drop = _none(none.status, str(none))
        except ParameterError as refused:  # no law has these constants
            runaway = drop = _none(UNKNOWN, str(refused))
        else:
            runaway, drop = _both(known, constants[2] < WEAK * constants[1])
        return *runaway, *drop

    arrays = fault.velocity, fault.slip_distance, age
    rows = at_each(fault, answer, *arrays, rows=2 * FIELDS)
    return {"runaway_length": _answer(rows[:FIELDS]), "drop_length": _answer(rows[FIELDS:])}


def _answer(rows: Any) -> Answer:
    """An answer from its fields as rows of objects."""
    value, low, high = rows[:3].astype(float)
    return Answer(value, low, high, *rows[3:])


def _none(status: str, reason: str) -> Answer:
    return Answer(
        math.nan,
        math.nan,
        math.nan,
        status,
        reason,
    )


def _both(known: ExpectedDrop, slowly: bool) -> tuple[Answer, Answer]:
    """L_run and L of one fault, whose friction may weaken so little that it slips slowly."""
    longest, status = known.runaway_length, known.runaway_status
    error = longest * known.runaway_error
    runaway = Answer(
        longest,
        longest - error,
        longest + error,
        status,
        known.runaway_reason,
    )
    if status == BEYOND:  # slow slip lasts longer than the law of the drop assumes
        return runaway, _none(BEYOND, known.runaway_reason)
    if not math.isfinite(known.stability_length):
        return runaway, _none(UNKNOWN, "no patch in steady creep turns unstable before the drop")
    if slowly and not math.isfinite(longest):
        reason = f"a patch may slip slowly, and L_run is not known: {known.runaway_reason}"
        return runaway, _none(UNKNOWN, reason)
    if not math.isfinite(known.length):
        return runaway, _none(BEYOND, known.doubt)
    doubts = [known.doubt] if known.doubt else []
    if known.length < known.stability_length:
        doubts.append(
            "behind its advancing front the patch turns unstable before L_s, of steady creep"
        )
    drop = Answer(
        known.length,
        known.low,
        known.high,
        VALUE,
        "",
        "; ".join(doubts),
    )
    return runaway, drop
