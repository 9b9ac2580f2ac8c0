"""Bisection between two lengths."""

import math
from collections.abc import Callable


def bisected(
    beyond: Callable[[float], bool],
    low: float,
    high: float,
    precision: float,
) -> float:
    """The length from which on a condition holds, by bisection of its logarithm.

    Parameters
    ----------
    beyond : callable
        Whether the condition holds at a length (m).
    low, high : float
        Lengths (m) at which it does not hold, and holds.
    precision : float
        Relative, of the result.

    Returns
    -------
    float
        The length (m).
    """
    while high > low * (1.0 + precision):
        middle = math.sqrt(low * high)
        if beyond(middle):
            high = middle
        else:
            low = middle
    return math.sqrt(low * high)
