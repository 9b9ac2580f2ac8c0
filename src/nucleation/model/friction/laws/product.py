"""The paper's law: an aging factor times a factor of the slip rate.

The friction coefficient (Eq. S-f, first equation of Text S2.1) is

    f(v, phi) = [1 + b log(1 + phi/phi*)] [theta v / sqrt(v^2 + v0^2) + xi log(1 + |v|/v*) sign v]

which is the paper's law for ``v >= 0``, continued as an odd function of the slip rate.
"""

import dataclasses
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ...quantities import ParameterError, quantity
from ..law import Array, Friction, law_name


@dataclasses.dataclass(frozen=True)
class Law(Friction):
    """The full friction law with the parameters of Table S1 (SI units)."""

    law: str = law_name(__name__)
    aging_coefficient: float = quantity(
        "aging coefficient", low=0.0, high=10.0, closed="low", symbol="b", default=0.075
    )
    slip_rate_scale: float = quantity(
        "slip-rate scale of rate strengthening",
        unit="m/s", low=0.0, high=1.0, symbol="v*", default=1.0e-7,
    )  # fmt: skip
    base_friction: float = quantity(
        "base friction coefficient", low=0.0, high=10.0, symbol="theta", default=5.0 / 18.0
    )
    state_scale: float = quantity(
        "state scale of aging", unit="s", low=0.0, high=1e6, symbol="phi*", default=3.3e-4
    )
    rate_coefficient: float = quantity(
        "rate-strengthening coefficient", low=0.0, high=10.0, symbol="xi", default=0.005
    )

    set_by_expansion: ClassVar[tuple[str, ...]] = (
        "base_friction", "rate_coefficient", "aging_coefficient",
    )  # fmt: skip

    def aging_factor(self, log_state: ArrayLike) -> tuple[Array, Array]:
        """``1 + b log(1 + phi/phi*)`` and its derivative by ``psi = log(phi)``."""
        scaled = np.asarray(log_state, dtype=float) - np.log(self.state_scale)
        ratio = np.exp(np.minimum(scaled, 700.0))  # phi / phi*, which must not overflow
        value = 1.0 + self.aging_coefficient * np.log1p(ratio)
        return value, self.aging_coefficient * (ratio / (1.0 + ratio))

    def rate_factor(self, slip_rate: ArrayLike) -> tuple[Array, Array]:
        """``theta v/w + xi log(1 + |v|/v*) sign(v)`` and its derivative by v (s/m)."""
        v = np.asarray(slip_rate, dtype=float)
        v0, scale = self.regularisation_slip_rate, self.slip_rate_scale
        size, by_speed = np.abs(v), 1.0 / self.slip_speed(v)
        strengthening = np.copysign(np.log1p(size / scale), v)
        value = self.base_friction * v * by_speed + self.rate_coefficient * strengthening
        slope = self.base_friction * v0**2 * by_speed * by_speed * by_speed
        return value, slope + self.rate_coefficient / (scale + size)

    def coefficient_and_slopes(
        self, slip_rate: ArrayLike, log_state: ArrayLike
    ) -> tuple[Array, Array, Array]:
        """The product of both factors, and its derivatives."""
        aging, aging_slope = self.aging_factor(log_state)
        rate, rate_slope = self.rate_factor(slip_rate)
        return aging * rate, aging * rate_slope, aging_slope * rate

    def with_expansion(self, velocity: float, f: float, a: float, zeta: float) -> Self:
        """The law with other theta, xi and b, so that :meth:`expansion` is (f, a, zeta).

        Notes
        -----
        With ``A = 1 + b log(1 + phi/phi*)``, ``w = sqrt(V^2 + v0^2)`` and the rate factor ``R(v)``,
        ``f = A R``, ``a = A V R'`` and ``a + zeta = b R (V/w)^2 / (1 + phi*/phi)``. The last gives
        b, with R = f/A; the others are linear in theta and xi.
        """
        v, v0, scale = velocity, self.regularisation_slip_rate, self.slip_rate_scale
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
        rates = np.array(
            [[v / speed, np.log1p(v / scale)], [v * v0**2 / speed**3, v / (scale + v)]]
        )  # R and V R' by theta and xi
        base, rate = np.linalg.solve(rates, np.array([f, a]) / factor)
        return dataclasses.replace(
            self,
            base_friction=float(base),
            rate_coefficient=float(rate),
            aging_coefficient=float(aging),
        )
