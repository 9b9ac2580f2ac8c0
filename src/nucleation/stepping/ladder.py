"""The step-size ladder: few values of the leading coefficient serve a whole run."""

from __future__ import annotations

import math

RUNGS_PER_OCTAVE = 4


def rung_below(beta: float) -> int:
    """The largest rung of the ladder ``2^(n / RUNGS_PER_OCTAVE)`` seconds not above `beta`."""
    return math.floor(RUNGS_PER_OCTAVE * math.log2(beta) + 1e-9)


def rung_value(rung: int) -> float:
    """The value of beta (s) of a rung."""
    return 2.0 ** (rung / RUNGS_PER_OCTAVE)


def beta_of_step(step: float, previous_step: float) -> float:
    """The leading coefficient (s) of a BDF2 step."""
    r = step / previous_step
    return step * (1 + r) / (1 + 2 * r)
