"""The paper's law: an aging factor times a factor of the slip rate.

The friction coefficient (Eq. S-f, first equation of Text S2.1) is

    f(v, phi) = [1 + b log(1 + phi/phi*)] [theta v / sqrt(v^2 + v0^2) + xi log(1 + |v|/v*) sign v]

which is the paper's law for ``v >= 0``, continued as an odd function of the slip rate.
"""

import dataclasses
from typing import ClassVar, Self

import numpy as np

from ....types import Array
from ...quantities import ParameterError, quantity
from .. import Friction, law_name


@dataclasses.dataclass(frozen=True)
class Law(Friction):
    """The full friction law with the parameters of Table S1 (SI units)."""

    law: str = law_name(__name__)
    aging_coefficient: float = quantity(
        "aging coefficient", "[0.0, 10.0)", symbol="b", default=0.075
    )
    slip_rate_scale: float = quantity(
        "slip-rate scale of rate strengthening", "(0.0, 1.0) m/s", symbol="v*", default=1.0e-7
    )
    base_friction: float = quantity(
        "base friction coefficient", "(0.0, 10.0)", symbol="theta", default=5.0 / 18.0
    )
    state_scale: float = quantity(
        "state scale of aging", "(0.0, 1e6) s", symbol="phi*", default=3.3e-4
    )
    rate_coefficient: float = quantity(
        "rate-strengthening coefficient", "(0.0, 10.0)", symbol="xi", default=0.005
    )

    set_by_expansion: ClassVar[tuple[str, ...]] = (
        "base_friction",
        "rate_coefficient",
        "aging_coefficient",
    )

    @property
    def constants(self) -> tuple[float, ...]:
        """v0, b, v*, theta, phi* and xi."""
        return (
            self.regularisation_slip_rate,
            self.aging_coefficient,
            self.slip_rate_scale,
            self.base_friction,
            self.state_scale,
            self.rate_coefficient,
        )

    @staticmethod
    def formula(v: Array, psi: Array, constants: tuple[float, ...]) -> tuple[Array, Array, Array]:
        """The product of both factors, and its derivatives by v (s/m) and psi.

        Parameters
        ----------
        v, psi : ndarray
            Slip rates (m/s) and logarithms of the state (s).
        constants : tuple of float
            The law's :attr:`constants`.
        """
        v0, b, scale, theta, state_scale, xi = constants
        ratio = np.exp(np.minimum(psi - np.log(state_scale), 700.0))  # phi/phi*, no overflow
        aging = 1.0 + b * np.log1p(ratio)
        size = np.abs(v)
        by_speed = 1.0 / np.sqrt(v * v + v0**2)
        strengthening = np.copysign(np.log1p(size / scale), v)
        rate = theta * v * by_speed + xi * strengthening
        by_rate = theta * v0**2 * by_speed * by_speed * by_speed + xi / (scale + size)
        by_log_state = b * (ratio / (1.0 + ratio)) * rate
        return aging * rate, aging * by_rate, by_log_state

    def with_expansion(self, velocity: float, f: float, a: float, zeta: float) -> Self:
        """The law with other theta, xi and b, so that :meth:`expansion` is (f, a, zeta).

        Parameters
        ----------
        velocity : float
            Slip rate V of steady sliding (m/s).
        f, a, zeta : float
            Friction coefficient, direct effect and velocity weakening at V.

        Notes
        -----
        With ``A = 1 + b log(1 + phi/phi*)``, ``w = sqrt(V^2 + v0^2)`` and the rate factor ``R(v)``,
        ``f = A R``, ``a = A V R'`` and ``a + zeta = b R (V/w)^2 / (1 + phi*/phi)``. The last gives
        b, with R = f/A; the others are linear in theta and xi.
        """
        if not f > 0.0:
            raise ParameterError(f"f = {f:g} must be positive")
        v = velocity
        v0 = self.regularisation_slip_rate
        scale = self.slip_rate_scale
        speed = float(self.slip_speed(v))
        age = float(self.steady_state(v)) / self.state_scale
        per_aging = (a + zeta) / f * (speed / v) ** 2 * (1.0 + 1.0 / age)  # b / (1 + b l)
        growth = per_aging * np.log1p(age)
        if not 0.0 <= growth < 1.0:
            raise ParameterError(
                f"(a + zeta)/f log(1 + phi/phi*) = {growth:.3g} must lie "
                f"in [0, 1), with phi = D/V; phi* = {self.state_scale:g} s is state_scale. "
                "The law dieterich_ruina (friction_law) has no such limit"
            )
        aging = per_aging / (1.0 - growth)
        factor = 1.0 + aging * np.log1p(age)
        of_rate = [v / speed, np.log1p(v / scale)]  # R by theta and xi
        of_slope = [v * v0**2 / speed**3, v / (scale + v)]  # V R' by theta and xi
        rates = np.array([of_rate, of_slope])
        base, rate = np.linalg.solve(rates, np.array([f, a]) / factor)
        return dataclasses.replace(
            self,
            base_friction=float(base),
            rate_coefficient=float(rate),
            aging_coefficient=float(aging),
        )
