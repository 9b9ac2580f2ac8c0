"""Where functions change their sign: importing scipy.optimize takes longer than most answers."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..types import Array

MOST_STEPS = 100  # of Ridders' method, which needs about ten


def roots(
    function: Callable[[Array, NDArray[np.intp]], Array], low: Array, high: Array, precision: float
) -> Array:
    """Where functions rise through zero between `low` and `high`, (n,), by Ridders' method.

    `function` takes positions and the numbers of the functions. NaN remains NaN. The method ends
    where a step is below `precision`; a root does not depend on the other functions.
    """
    found = np.full(low.size, np.nan)
    index = np.flatnonzero(np.isfinite(low))
    left, right = low[index], high[index]
    f_left, f_right = function(left, index), function(right, index)
    # products of the smallest numbers vanish; a power of two changes no digit
    power = np.zeros(low.size, dtype=int)
    power[index] = np.frexp(np.maximum(np.abs(f_left), np.abs(f_right)))[1]
    f_left, f_right = np.ldexp(f_left, -power[index]), np.ldexp(f_right, -power[index])
    last = right
    for _ in range(MOST_STEPS):
        middle = 0.5 * (left + right)
        f_middle = np.ldexp(function(middle, index), -power[index])
        scale = np.sqrt(f_middle**2 - f_left * f_right)
        new = middle - (middle - left) * f_middle / scale
        f_new = np.ldexp(function(new, index), -power[index])
        for x, f in ((middle, f_middle), (new, f_new)):
            inside = (left < x) & (x < right)
            lower, upper = inside & (f < 0.0), inside & (f >= 0.0)
            left, f_left = np.where(lower, (x, f), (left, f_left))
            right, f_right = np.where(upper, (x, f), (right, f_right))
        found[index] = new
        on = (np.abs(new - last) > precision) & (f_new != 0.0) & (f_left * f_right < 0.0)
        if not on.any():
            break
        index, last = index[on], new[on]
        left, f_left, right, f_right = (values[on] for values in (left, f_left, right, f_right))
    return found
