"""The Dieterich-Ruina law in its regularised form, as earthquake cycle benchmarks use it.

The logarithmic law ``f = f0 + a log(v/v*) + b log(v* phi/D)`` has no meaning at rest. Rates of
thermally activated jumps in both directions (Rice, Lapusta and Ranjith, 2001) make it

    f(v, phi) = a asinh[ v/(2 v*) exp((f0 + b log(v* phi/D)) / a) ]

which is odd in v and differs from the logarithm only where f is not large against a.
"""

import dataclasses
from typing import ClassVar, Self

import numpy as np
from numpy.typing import ArrayLike

from ....types import Array
from ...quantities import ParameterError, quantity
from .. import Friction, law_name

_LARGEST_RATIO = 1e6  # of f0 over a: beyond, round-off of f0/a is seen in log(v)
_LARGEST_EXPONENT = 650.0
_ITERATIONS = 30  # for a: with f = 2 a each iteration reduces the error by five sixths


@dataclasses.dataclass(frozen=True)
class Law(Friction):
    """The regularised Dieterich-Ruina law; its values are those of the paper's main text."""

    law: str = law_name(__name__)
    reference_friction: float = quantity(
        "friction coefficient of steady sliding at the reference slip rate",
        "(0.0, 10.0)",
        symbol="f0",
        default=0.41,
    )
    reference_slip_rate: float = quantity(
        "reference slip rate of the logarithms", "(0.0, 1.0) m/s", symbol="v*", default=1.0e-5
    )
    log_rate_coefficient: float = quantity(
        "coefficient of the logarithm of the slip rate", "(0.0, 1.0)", symbol="a", default=0.0068
    )
    log_state_coefficient: float = quantity(
        "coefficient of the logarithm of the state", "[0.0, 1.0)", symbol="b", default=0.0228
    )

    set_by_expansion: ClassVar[tuple[str, ...]] = (
        "reference_friction",
        "log_rate_coefficient",
        "log_state_coefficient",
    )
    asinh_of_rate: ClassVar[bool] = True

    def __post_init__(self) -> None:
        super().__post_init__()
        if self.reference_friction > _LARGEST_RATIO * self.log_rate_coefficient:
            least = self.reference_friction / _LARGEST_RATIO
            raise ParameterError(
                f"log_rate_coefficient = {self.log_rate_coefficient:g} is not allowed: "
                f"with reference_friction = {self.reference_friction:g} it must be {least:.3g} or "
                f"more (friction law {self.law})"
            )

    def linear_below(self, log_state: ArrayLike) -> Array:
        """``s = 2 v* exp(-(f0 + b log(v* phi/D)) / a)`` (m/s), with ``f = a asinh(v/s)``."""
        return _scale(np.asarray(log_state, dtype=float), self.constants)

    def step_at_rest(self, log_state: ArrayLike) -> Array:
        """What s would have to be smaller by, where it would underflow: part of its logarithm."""
        return _step(np.asarray(log_state, dtype=float), self.constants)

    @property
    def constants(self) -> tuple[float, ...]:
        """a, b, f0, v* and D."""
        return (
            self.log_rate_coefficient,
            self.log_state_coefficient,
            self.reference_friction,
            self.reference_slip_rate,
            self.slip_distance,
        )

    @staticmethod
    def formula(v: Array, psi: Array, constants: tuple[float, ...]) -> tuple[Array, Array, Array]:
        """``a asinh(v/s)``, ``a / sqrt(v^2 + s^2)`` and ``b v / sqrt(v^2 + s^2)``.

        Parameters
        ----------
        v, psi : ndarray
            Slip rates (m/s) and logarithms of the state (s).
        constants : tuple of float
            The law's :attr:`constants`.
        """
        a, b = constants[:2]
        s = _scale(psi, constants)
        size = np.hypot(v, s)
        step = _step(psi, constants)
        angle = np.arcsinh(v / s) + step * (v / size)
        by_rate = a / size * (1.0 + step * (s / size) ** 2)
        return a * angle, by_rate, b * (v / size)

    def with_expansion(self, velocity: float, f: float, a: float, zeta: float) -> Self:
        """The law with other f0, a and b, so that :meth:`expansion` is (f, a, zeta).

        Parameters
        ----------
        velocity : float
            Slip rate V of steady sliding (m/s).
        f, a, zeta : float
            Friction coefficient, direct effect and velocity weakening at V.

        Notes
        -----
        In steady sliding ``phi = D/w``, ``w = sqrt(V^2 + v0^2)``. With a* the law's own coefficient
        and ``c = V/sqrt(V^2 + s^2) = tanh(f/a*)`` the expansion has ``a = a* c`` and
        ``zeta = (b (V/w)^2 - a*) c``. So ``a* = a/c``; in double precision it is a itself if
        f > 19 a, otherwise a contracting iteration finds it. Then b follows, and f0 from
        ``V/s = sinh(f/a*)``.
        """
        if not 0.0 < 2.0 * a <= f:
            raise ParameterError(f"a = {a:g} must lie in (0, f/2], f = {f:g}")
        own = a
        for _ in range(_ITERATIONS):
            own = a / np.tanh(f / own)
        v = velocity
        reference = self.reference_slip_rate
        speed = float(self.slip_speed(v))
        b = (zeta * own / a + own) * (speed / v) ** 2
        log_two_sinh = f / own + np.log1p(-np.exp(-2.0 * f / own))  # of f/a*
        f0 = own * (np.log(reference / v) + log_two_sinh) - b * np.log(reference / speed)
        return dataclasses.replace(
            self,
            reference_friction=float(f0),
            log_rate_coefficient=float(own),
            log_state_coefficient=float(b),
        )


def _scale(psi: Array, constants: tuple[float, ...]) -> Array:
    """The slip rate s (m/s) of ``f = a asinh(v/s)``."""
    exponent = _exponent(psi, constants)
    exponent = np.minimum(np.maximum(exponent, -_LARGEST_EXPONENT), _LARGEST_EXPONENT)
    return 2.0 * constants[3] * np.exp(-exponent)


def _step(psi: Array, constants: tuple[float, ...]) -> Array:
    """What is left of the exponent where s would underflow.

    There asinh(v/s) is log(2 v/s), which this part shifts. At rest the shift passes through zero
    over a few s, so that each stress has a slip rate.
    """
    return np.maximum(_exponent(psi, constants) - _LARGEST_EXPONENT, 0.0)


def _exponent(psi: Array, constants: tuple[float, ...]) -> Array:
    a, b, f0, rate, distance = constants
    return (f0 + b * (psi + np.log(rate / distance))) / a
