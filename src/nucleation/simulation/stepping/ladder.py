"""The step-size ladder: few values of the leading coefficient serve a whole run."""

import math

RUNGS_PER_OCTAVE = 4


def rung_below(beta: float) -> int:
    """The largest rung of the ladder ``2^(n / RUNGS_PER_OCTAVE)`` seconds not above `beta`."""
    return math.floor(RUNGS_PER_OCTAVE * math.log2(beta) + 1e-9)


def rung_nearest(beta: float) -> int:
    """The rung whose value is nearest to `beta` (s)."""
    return round(RUNGS_PER_OCTAVE * math.log2(beta))


def rung_value(rung: int) -> float:
    """The value of beta (s) of a rung."""
    return 2.0 ** (rung / RUNGS_PER_OCTAVE)
