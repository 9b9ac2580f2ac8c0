"""The aging (Dieterich) law, ``g(omega) = 1 - omega``: the state grows with time at rest."""

import numpy as np
from numpy.typing import ArrayLike

from . import Array, wright_omega


def growth(omega: ArrayLike) -> Array:
    """``dphi/dt`` (dimensionless) for given ``omega = phi w / D``."""
    return 1.0 - np.asarray(omega, dtype=float)


def slope(omega: ArrayLike) -> Array:
    """``g'(omega) = -1``."""
    return np.full_like(omega, -1.0, dtype=float)


def implicit_log_state(history: Array, step: Array | float, rate: Array) -> tuple[Array, Array]:
    """Closed form of ``psi = history + step (exp(-psi) - rate)`` by Wright's omega function."""
    shifted = history - step * rate
    excess = wright_omega(np.log(step) - shifted)  # = step exp(-psi)
    slope = -step / (1.0 + excess)
    return shifted + excess, slope
