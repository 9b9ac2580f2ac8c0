"""What a state evolution law has to say, and the function that solves several of them.

The laws are the modules of :mod:`nucleation.model.friction.evolutions`, which differ in nothing
but the functions of :class:`StateEvolution`.
"""

from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from ...types import Array


class StateEvolution(Protocol):
    """Evolution of the state variable, a module with these functions.

    `omega` is ``phi w / D`` (dimensionless), `rate` is ``w / D`` (1/s).
    """

    @staticmethod
    def growth(omega: ArrayLike) -> Array:
        """``dphi/dt = g(omega)``, with ``g(1) = 0`` and ``g'(1) = -1``."""

    @staticmethod
    def slope(omega: ArrayLike) -> Array:
        """``g'(omega)``."""

    @staticmethod
    def implicit_log_state(history: Array, step: Array | float, rate: Array) -> tuple[Array, Array]:
        """Solve ``psi = history + step * dpsi/dt(psi, rate)``; return psi and dpsi/drate."""


def wright_omega(z: ArrayLike) -> Array:
    """The positive solution of ``w + log(w) = z`` for real z >= -700, exp(z) below -36 or so.

    Fritsch, Shafer & Crowley's fourth-order iteration (Comm. ACM 16, 123, 1973) on whole arrays,
    from a rational function of exp(z) that a straight line goes on from for z > 0. Twice as fast as
    :func:`scipy.special.wrightomega`, and the simulation calls it two to four times in each step.
    """
    z = np.maximum(z, -700.0)
    e = np.exp(np.minimum(z, 0.0))
    w = e * (1.0 + e * (4 / 3)) / (1.0 + e * (7 / 3 + e * (5 / 6))) + 0.8 * np.maximum(z, 0.0)
    while True:
        r, near = z - w - np.log(w), 1.0 + w
        t = near * (near + r * (2 / 3))
        w = w * (1.0 + r / near * ((t - 0.5 * r) / (t - r)))
        if not np.any(np.abs(r) > 1e-3):  # not finite either; then 1e-3^4 is left
            return w
