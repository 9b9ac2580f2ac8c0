"""Functions of the layer number ``q = |k| H``, free of overflow and cancellation."""

from functools import cached_property

import numpy as np

from ..types import Array

_ORDERS = np.arange(17.0, 3.0, -2.0)
_COEFFICIENTS = (1.0 / ((_ORDERS - 1.0) * _ORDERS)).tolist()


def _scaled_sinh_excess(x: Array) -> Array:
    """``(sinh(x) - x) exp(-x)`` for ``x >= 0`` without cancellation (power series below 1)."""
    decay = np.exp(-x)
    direct = -0.5 * np.expm1(-2.0 * x) - x * decay
    if np.all(x >= 1.0):
        return direct
    small = np.minimum(x, 1.0)
    square = small**2
    series = 1.0
    for coefficient in _COEFFICIENTS:
        series = 1.0 + series * square * coefficient
    return np.where(x < 1.0, small**3 / 6.0 * series * decay, direct)


class Waves:
    """The functions of ``q = |k| H`` in a layer's stiffness, times ``exp(-2q)``.

    Each is computed when first used. All are positive.
    """

    def __init__(self, q: Array) -> None:
        self.q = q

    @cached_property
    def decay(self) -> Array:
        """1."""
        return np.exp(-2.0 * self.q)

    @cached_property
    def linear(self) -> Array:
        """``2 q``."""
        return 2.0 * self.q * self.decay

    @cached_property
    def square(self) -> Array:
        """``q^2``."""
        return self.q**2 * self.decay

    @cached_property
    def sinh_2q(self) -> Array:
        """``sinh 2q``."""
        return -0.5 * np.expm1(-4.0 * self.q)

    @cached_property
    def sinh_squared(self) -> Array:
        """``sinh^2 q``."""
        return 0.25 * np.expm1(-2.0 * self.q) ** 2

    @cached_property
    def cosh_squared(self) -> Array:
        """``cosh^2 q``."""
        return 0.25 * (1.0 + self.decay) ** 2

    @cached_property
    def excess(self) -> Array:
        """``sinh 2q - 2q``."""
        return _scaled_sinh_excess(2.0 * self.q)

    @cached_property
    def square_excess(self) -> Array:
        """``sinh^2 q - q^2``."""
        sinh_plus = -0.5 * np.expm1(-2.0 * self.q) + self.q * np.exp(-self.q)
        return _scaled_sinh_excess(self.q) * sinh_plus
