"""Displacement fields with exact derivatives: sums of products ``amplitude X(x) Y(y) T(t)``."""

from __future__ import annotations

import dataclasses
from typing import Protocol

import numpy as np
from numpy.typing import ArrayLike

from ...model.material import Material
from ...types import Array


class Factor(Protocol):
    """A function of one variable and its derivatives."""

    def __call__(self, x: Array, order: int = 0) -> Array:
        """The derivative of an order at x."""


@dataclasses.dataclass(frozen=True)
class Sine:
    """``sin(rate x + phase)``."""

    rate: float
    phase: float = 0.0

    def __call__(self, x: Array, order: int = 0) -> Array:
        """The derivative of an order at x."""
        return self.rate**order * np.sin(self.rate * x + self.phase + order * np.pi / 2)


class Power:
    """The polynomial ``c0 + c1 x + c2 x^2 ..``."""

    def __init__(self, *coefficients: float) -> None:
        self.polynomial = np.polynomial.Polynomial(coefficients)

    def __call__(self, x: Array, order: int = 0) -> Array:
        """The derivative of an order at x."""
        return self.polynomial.deriv(order)(x) + np.zeros_like(x)


@dataclasses.dataclass(frozen=True)
class Term:
    """``amplitude X(x) Y(y) T(t)``."""

    amplitude: float
    x: Factor
    y: Factor
    t: Factor

    def __call__(
        self, x: Array, y: Array, t: ArrayLike, by_x: int = 0, by_y: int = 0, by_t: int = 0
    ) -> Array:
        """The derivative of the given orders at x, y (m) and t (s)."""
        factors = self.x(x, by_x) * self.y(y, by_y) * self.t(np.asarray(t, float), by_t)
        return self.amplitude * factors


@dataclasses.dataclass(frozen=True)
class Displacement:
    """``w_x`` (zero at x = 0) and ``u_y`` (zero at y = 0), each a sum of terms (m)."""

    terms: tuple[tuple[Term, ...], tuple[Term, ...]]
    material: Material

    def value(self, component: int, x: Array, y: Array, t: float, **orders: int) -> Array:
        """w_x (component 0) or u_y (1), or a derivative, at x, y (m) and t (s)."""
        return sum(term(x, y, t, **orders) for term in self.terms[component])  # type: ignore[return-value]

    def stress(
        self, x: Array, y: Array, t: float, by_x: int = 0, by_y: int = 0
    ) -> tuple[Array, Array, Array]:
        """sigma_xx, sigma_xy, sigma_yy (Pa), or a derivative of them."""
        lame, shear = self.material.lame_modulus, self.material.shear_modulus

        def slope(component: int, along_x: int, along_y: int) -> Array:
            orders = {"by_x": by_x + along_x, "by_y": by_y + along_y}
            return self.value(component, x, y, t, **orders)

        xx, yy = slope(0, 1, 0), slope(1, 0, 1)
        trace = lame * (xx + yy)
        return trace + 2 * shear * xx, shear * (slope(0, 0, 1) + slope(1, 1, 0)), (
            trace + 2 * shear * yy
        )  # fmt: skip

    def body_force(self, x: Array, y: Array, t: float) -> tuple[Array, Array]:
        """``rho u_tt - div sigma`` (N/m^3), both components."""
        along_x, along_y = self.stress(x, y, t, by_x=1), self.stress(x, y, t, by_y=1)
        inertia = [self.material.density * self.value(c, x, y, t, by_t=2) for c in (0, 1)]
        return inertia[0] - along_x[0] - along_y[1], inertia[1] - along_x[1] - along_y[2]
