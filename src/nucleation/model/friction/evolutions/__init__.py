"""The evolution laws of the state variable, one file each; its name is the law's name.

Each file has three functions of ``omega = phi w / D`` and ``rate = w / D`` (1/s):

    growth(omega)     dphi/dt = g(omega), with g(1) = 0 and g'(1) = -1
    slope(omega)      g'(omega)
    implicit_log_state(history, step, rate)
                      psi = log(phi) of psi = history + step dpsi/dt(psi, rate), and dpsi/drate (s);
                      history is the part of psi that follows from earlier steps, step (s) the time
                      step times the coefficient of the time scheme

They use this module and nothing else of the project.
"""

import numpy as np
from numpy.typing import ArrayLike

from ....types import Array


def wright_omega(z: ArrayLike) -> Array:
    """The positive solution of ``w + log(w) = z`` for real z >= -700, exp(z) below -36 or so.

    Fritsch, Shafer & Crowley's fourth-order iteration (Comm. ACM 16, 123, 1973) on whole arrays.
    It starts from a rational function of exp(z), continued by a straight line for z > 0. It is
    twice as fast as :func:`scipy.special.wrightomega`; the simulation calls it two to four times
    in each step.
    """
    z = np.maximum(z, -700.0)
    below = np.minimum(z, 0.0)
    e = np.exp(below)
    numerator = e * (1.0 + e * (4 / 3))
    denominator = 1.0 + e * (7 / 3 + e * (5 / 6))
    w = numerator / denominator + 0.8 * np.maximum(z, 0.0)
    while True:
        r = z - w - np.log(w)
        near = 1.0 + w
        t = near * (near + r * (2 / 3))
        correction = (t - 0.5 * r) / (t - r)
        w = w * (1.0 + r / near * correction)
        large = np.abs(r) > 1e-3  # false for NaN; after this step 1e-3 becomes 1e-3^4
        if not np.any(large):
            return w
