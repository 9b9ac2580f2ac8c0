"""The slip (Ruina) law, ``g(omega) = -omega log(omega)``: the state changes by slip alone."""

import numpy as np
from numpy.typing import ArrayLike

from . import Array


def growth(omega: ArrayLike) -> Array:
    """``dphi/dt`` (dimensionless) for given ``omega = phi w / D``."""
    omega = np.asarray(omega, dtype=float)
    return -omega * np.log(omega)


def slope(omega: ArrayLike) -> Array:
    """``g'(omega) = -1 - log(omega)``."""
    return -1.0 - np.log(omega)


def implicit_log_state(history: Array, step: Array | float, rate: Array) -> tuple[Array, Array]:
    """Closed form of ``psi = history - step rate (psi + log(rate))`` (linear in psi)."""
    log_rate = np.log(rate)
    divisor = 1.0 + step * rate
    log_state = (history - step * rate * log_rate) / divisor
    slope = -step * (log_state + log_rate + 1.0) / divisor
    return log_state, slope
