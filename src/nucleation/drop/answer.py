"""L_run and the length L at the drop of one or many faults, as answers."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from ..lengths.answer import Answer
from ..model.friction.constants import AGE
from ..model.quantities import ParameterError
from ..model.settings import Perturbation
from ..theory.creep.patches import Patches
from ..theory.critical import at_each
from ..theory.spectrum import Systems
from ..theory.status import BEYOND, EDGE_ALONE, UNKNOWN, VALUE, NoLength
from ..theory.values import FaultLike

if TYPE_CHECKING:
    from ..theory.creep.runaway import Runaway
    from .expected_drop import ExpectedDrop

FIELDS = len(Answer._fields)


def answers_of_drop(fault: FaultLike, declared: Perturbation) -> dict[str, Answer]:
    """L_run and L under a declared perturbation."""
    missing = [name for name in ("velocity", "friction") if getattr(fault, name) is None]
    if missing or fault.loading != "edge":
        needed = f"needs {' and '.join(missing)}: the drop depends on the friction law"
        none = _none(UNKNOWN, needed if missing else EDGE_ALONE)
        found = _answer(at_each(fault, lambda *_: none, rows=FIELDS))
        return {"runaway_length": found, "drop_length": found}
    from ..theory.creep.runaway import runaway_of
    from .expected_drop import expected_drop

    age = np.nan if fault.initial_state is None else fault.initial_state

    def answer(
        one: Systems, critical: float, velocity: float, distance: float, age: float
    ) -> tuple[Any, ...]:
        phi0 = AGE * distance / velocity if math.isnan(age) else age
        patches = Patches(one, evolution=fault.evolution)
        try:
            patches = patches.with_law(fault, velocity, distance)
            known = expected_drop(patches, declared, critical, phi0)
        except (NoLength, ParameterError) as none:  # a parameter: no law has these constants
            drop = _none(getattr(none, "status", UNKNOWN), str(none))
            runaway = runaway_of(patches, critical)
        else:
            runaway, drop = known.runaway, _drop(known)
        return *_runaway(runaway), *drop

    arrays = fault.velocity, fault.slip_distance, age
    rows = at_each(fault, answer, *arrays, rows=2 * FIELDS)
    return {"runaway_length": _answer(rows[:FIELDS]), "drop_length": _answer(rows[FIELDS:])}


def _answer(rows: Any) -> Answer:
    """An answer from its fields as rows of objects."""
    value, low, high = rows[:3].astype(float)
    return Answer(value, low, high, *rows[3:])


def _none(status: str, reason: str) -> Answer:
    return Answer(math.nan, math.nan, math.nan, status, reason)


def _runaway(found: Runaway) -> Answer:
    error = found.length * found.error
    return Answer(
        found.length, found.length - error, found.length + error, found.status, found.reason
    )


def _drop(known: ExpectedDrop) -> Answer:
    """L of one fault, whose friction may weaken so little that it slips slowly."""
    runaway = known.runaway
    if runaway.status == BEYOND:  # slow slip lasts longer than the law of the drop assumes
        return _none(BEYOND, runaway.reason)
    if not math.isfinite(known.stability_length):
        return _none(UNKNOWN, "no patch in steady creep turns unstable before the drop")
    if known.weak and not math.isfinite(runaway.length):
        reason = f"a patch may slip slowly, and L_run is not known: {runaway.reason}"
        return _none(UNKNOWN, reason)
    if not math.isfinite(known.length):
        return _none(BEYOND, known.doubt)
    doubts = [known.doubt] if known.doubt else []
    if known.length < known.stability_length:
        doubts.append(
            "behind its advancing front the patch turns unstable before L_s, of steady creep"
        )
    return Answer(known.length, known.low, known.high, VALUE, "", "; ".join(doubts))
