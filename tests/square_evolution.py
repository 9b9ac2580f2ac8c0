"""A state evolution of one's own, ``g(Omega) = (1 - Omega^2)/2``: it weakens fast at a front."""

import numpy as np


def growth(omega):
    """``dphi/dt``."""
    return 0.5 * (1.0 - np.square(omega))


def slope(omega):
    """``g'(omega)``."""
    return -np.asarray(omega, dtype=float)


def implicit_log_state(history, step, rate):
    """Newton's solution of ``y + s sinh(y) = c``: ``y = psi + log(rate)``, ``s = step rate``."""
    log_rate = np.log(rate)
    s = step * rate
    c = history + log_rate
    of_large = np.arcsinh(c / s)
    y = np.where(np.abs(of_large) < np.abs(c), of_large, c)
    for _ in range(60):
        change = (y + s * np.sinh(y) - c) / (1.0 + s * np.cosh(y))
        y = y - change
        if not np.any(np.abs(change) > 1e-13 * (1.0 + np.abs(y))):
            break
    by_rate = (1.0 / rate - step * np.sinh(y)) / (1.0 + s * np.cosh(y))
    return y - log_rate, by_rate - 1.0 / rate
