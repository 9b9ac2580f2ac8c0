"""Rate-and-state friction: the full regularised law of the paper's Text S2.

The friction coefficient (Eq. S-f, first equation of Text S2.1) is

    f(v, phi) = [1 + b log(1 + phi/phi*)] [theta v / sqrt(v^2 + v0^2) + xi log(1 + |v|/v*) sign v]

which is the paper's law for ``v >= 0``, continued as an odd function of the slip rate, so that
friction opposes slip in either direction. The state variable ``phi`` (s) evolves by the aging
or the slip law, both with the regularised slip speed ``w = sqrt(v^2 + v0^2)``:

    aging:  dphi/dt = 1 - phi w / D
    slip:   dphi/dt = -(phi w / D) log(phi w / D)

The simulation carries the logarithm ``psi = log(phi)``: it stays positive by construction, and
friction depends on ``log(phi)`` almost linearly.
"""

from __future__ import annotations

import dataclasses
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..quantities import Checked, quantity
from .evolution import (
    EVOLUTION_LAWS,
    StateEvolution,
)

Array = NDArray[np.float64]


class Expansion(NamedTuple):
    """Coefficients of the logarithmic law about steady sliding at one slip rate (Eq. S-log)."""

    f0: float
    a: float
    zeta: float


@dataclasses.dataclass(frozen=True)
class Friction(Checked):
    """The full friction law with the parameters of Table S1 (SI units)."""

    characteristic_slip_distance: float = quantity(
        "characteristic slip distance", unit="m", low=0.0, high=1e3, symbol="D", default=5.0e-7
    )
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
    regularisation_slip_rate: float = quantity(
        "regularisation slip rate",
        unit="m/s", low=1e-30, high=1.0, closed="low", symbol="v0", default=1.0e-9,
    )  # fmt: skip
    rate_coefficient: float = quantity(
        "rate-strengthening coefficient", low=0.0, high=10.0, symbol="xi", default=0.005
    )
    evolution: str = quantity("state evolution law", choices=tuple(EVOLUTION_LAWS), default="aging")

    @property
    def evolution_law(self) -> StateEvolution:
        """The state evolution law named by ``evolution``."""
        return EVOLUTION_LAWS[self.evolution]

    def slip_speed(self, slip_rate: ArrayLike) -> Array:
        """Regularised slip speed ``w = sqrt(v^2 + v0^2)`` (m/s) of a slip rate (m/s)."""
        v = np.asarray(slip_rate, dtype=float)
        return np.sqrt(v * v + self.regularisation_slip_rate**2)

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

    def coefficient(self, slip_rate: ArrayLike, state: ArrayLike) -> Array:
        """Friction coefficient ``f(v, phi)``, broadcast over slip rate (m/s) and state (s)."""
        return self.aging_factor(np.log(state))[0] * self.rate_factor(slip_rate)[0]

    def derivatives(self, slip_rate: ArrayLike, state: ArrayLike) -> tuple[Array, Array]:
        """Exact ``df/dv`` (s/m) at fixed state and ``df/dphi`` (1/s) at fixed slip rate."""
        aging, aging_slope = self.aging_factor(np.log(state))
        rate, rate_slope = self.rate_factor(slip_rate)
        return aging * rate_slope, aging_slope / np.asarray(state, dtype=float) * rate

    def state_rate(self, slip_rate: ArrayLike, state: ArrayLike) -> Array:
        """``dphi/dt`` (dimensionless) of the chosen evolution law."""
        omega = np.asarray(state) * self.slip_speed(slip_rate) / self.characteristic_slip_distance
        return self.evolution_law.growth(omega)

    def steady_state(self, slip_rate: ArrayLike) -> Array:
        """State variable (s) of steady sliding, ``phi = D / w``, the same for both laws."""
        return self.characteristic_slip_distance / self.slip_speed(slip_rate)

    def steady_coefficient(self, slip_rate: ArrayLike) -> Array:
        """Friction coefficient of steady sliding at a slip rate (m/s) (Fig. S1)."""
        return self.coefficient(slip_rate, self.steady_state(slip_rate))

    def expansion(self, slip_rate: float) -> Expansion:
        """``f0``, ``a = v df/dv`` and ``zeta = -v df_ss/dv`` about steady sliding (Eq. S-log)."""
        v = float(slip_rate)
        state = self.steady_state(v)
        by_rate, by_state = self.derivatives(v, state)
        steady_slope = by_rate - by_state * state * v / self.slip_speed(v) ** 2
        return Expansion(
            float(self.coefficient(v, state)), float(v * by_rate), float(-v * steady_slope)
        )

    def logarithmic(self, slip_rate: ArrayLike, state: ArrayLike, reference_rate: float) -> Array:
        """The conventional law expanded about ``reference_rate`` (m/s) (Eq. S-log)."""
        f0, a, zeta = self.expansion(reference_rate)
        age = np.asarray(state) * reference_rate / self.characteristic_slip_distance
        return f0 + a * np.log(np.asarray(slip_rate) / reference_rate) + (zeta + a) * np.log(age)
