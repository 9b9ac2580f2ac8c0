"""Evolution laws of the state variable: aging and slip."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

Array = NDArray[np.float64]


def wright_omega(z: ArrayLike) -> Array:
    """The positive solution of ``w + log(w) = z`` for real z >= -700, exp(z) below -36 or so.

    Fritsch, Shafer & Crowley's fourth-order iteration (Comm. ACM 16, 123, 1973) on whole arrays,
    from a rational function of exp(z) or, for z > 0, a straight line. Twice as fast as
    :func:`scipy.special.wrightomega`, and the simulation calls it two to four times in each step.
    """
    z = np.maximum(z, -700.0)
    e = np.exp(np.minimum(z, 0.0))
    w = np.where(
        z < 0.0, e * (1.0 + e * (4 / 3)) / (1.0 + e * (7 / 3 + e * (5 / 6))), 0.56 + 0.8 * z
    )
    while True:
        r, near = z - w - np.log(w), 1.0 + w
        t = near * (near + r * (2 / 3))
        w = w * (1.0 + r / near * ((t - 0.5 * r) / (t - r)))
        if not np.abs(r).max(initial=0.0) > 1e-3:  # not finite either; then 1e-3^4 is left
            return w


class StateEvolution(Protocol):
    """Evolution of the state variable; the aging and the slip law differ only here.

    `omega` is ``phi w / D`` (dimensionless), `rate` is ``w / D`` (1/s).
    """

    name: str

    def growth(self, omega: ArrayLike) -> Array:
        """``dphi/dt = g(omega)``, with ``g(1) = 0`` and ``g'(1) = -1``."""

    def slope(self, omega: ArrayLike) -> Array:
        """``g'(omega)``."""

    def implicit_log_state(self, history: Array, step: float, rate: Array) -> tuple[Array, Array]:
        """Solve ``psi = history + step * dpsi/dt(psi, rate)``; return psi and dpsi/drate."""


class Aging:
    """The aging (Dieterich) law, ``g(omega) = 1 - omega``."""

    name = "aging"

    def growth(self, omega: ArrayLike) -> Array:
        """``dphi/dt`` (dimensionless) for given ``omega = phi w / D``."""
        return 1.0 - np.asarray(omega, dtype=float)

    def slope(self, omega: ArrayLike) -> Array:
        """``g'(omega) = -1``."""
        return -np.ones_like(np.asarray(omega, dtype=float))

    def implicit_log_state(self, history: Array, step: float, rate: Array) -> tuple[Array, Array]:
        """Closed form of ``psi = history + step (exp(-psi) - rate)`` by Wright's omega function."""
        shifted = history - step * rate
        excess = wright_omega(np.log(step) - shifted)  # = step exp(-psi)
        return shifted + excess, -step / (1.0 + excess)


class Slip:
    """The slip (Ruina) law, ``g(omega) = -omega log(omega)``."""

    name = "slip"

    def growth(self, omega: ArrayLike) -> Array:
        """``dphi/dt`` (dimensionless) for given ``omega = phi w / D``."""
        omega = np.asarray(omega, dtype=float)
        return -omega * np.log(omega)

    def slope(self, omega: ArrayLike) -> Array:
        """``g'(omega) = -1 - log(omega)``."""
        return -1.0 - np.log(np.asarray(omega, dtype=float))

    def implicit_log_state(self, history: Array, step: float, rate: Array) -> tuple[Array, Array]:
        """Closed form of ``psi = history - step rate (psi + log(rate))`` (linear in psi)."""
        log_rate = np.log(rate)
        divisor = 1.0 + step * rate
        log_state = (history - step * rate * log_rate) / divisor
        return log_state, -step * (log_state + log_rate + 1.0) / divisor


EVOLUTION_LAWS: dict[str, StateEvolution] = {law.name: law for law in (Aging(), Slip())}
