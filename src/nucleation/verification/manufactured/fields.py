"""Displacement fields with exact derivatives, and the nodal forces that they need.

Fields are sums of products ``amplitude X(x) Y(y) T(t)``. Their body forces and tractions are
integrated against the bilinear basis by Gauss quadrature, far more accurate than the elements.
"""

import dataclasses
from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from ...fem.grid import Field, Grid
from ...model.material import Material
from ...types import Array

Factor: TypeAlias = Callable[..., Array]  # of a variable and the order of the derivative, 0 without
POINTS = 4  # Gauss points per element and direction


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

        xx, xy, yy = slope(0, 1, 0), slope(0, 0, 1) + slope(1, 1, 0), slope(1, 0, 1)
        trace = lame * (xx + yy)
        return trace + 2 * shear * xx, shear * xy, trace + 2 * shear * yy

    def body_force(self, x: Array, y: Array, t: float) -> tuple[Array, Array]:
        """``rho u_tt - div sigma`` (N/m^3), both components."""
        along_x, along_y = self.stress(x, y, t, by_x=1), self.stress(x, y, t, by_y=1)
        inertia = [self.material.density * self.value(c, x, y, t, by_t=2) for c in (0, 1)]
        return inertia[0] - along_x[0] - along_y[1], inertia[1] - along_x[1] - along_y[2]


def quadrature(nodes: Array) -> tuple[Array, Array]:
    """Gauss points (m) and the matrix of ``weight_g N_i(point_g)`` (m) of linear elements."""
    points, weights = np.polynomial.legendre.leggauss(POINTS)
    lengths, local = np.diff(nodes)[:, None], 0.5 * (1 + points)
    e = np.arange(lengths.size)
    weighted = np.zeros((e.size + 1, e.size, POINTS))
    weighted[e, e] = 0.5 * lengths * weights * (1 - local)
    weighted[e + 1, e] = 0.5 * lengths * weights * local
    return (nodes[:-1, None] + lengths * local).ravel(), weighted.reshape(e.size + 1, -1)


class Loads:
    """Nodal forces of a manufactured displacement on a grid.

    ``x``, ``y`` are the Gauss points (m) along either direction; ``along_x @ g`` and
    ``along_y @ g`` integrate values at them against the nodes' hat functions.
    """

    def __init__(self, grid: Grid, exact: Displacement) -> None:
        self.grid, self.exact = grid, exact
        (self.x, self.along_x), (self.y, self.along_y) = quadrature(grid.x), quadrature(grid.y)

    def nodal(self, t: float) -> Array:
        """Forces (N/m) along x and y at t (s), (2, n_y + 1, n_x + 1); none of the interface's."""
        force = self.exact.body_force(self.x[None], self.y[:, None], t)
        out = np.array([self.along_y @ f @ self.along_x.T for f in force])
        height, length = self.grid.height, self.grid.length
        _, xy, yy = self.exact.stress(self.x, np.full_like(self.x, height), t)
        out[0, -1] += self.along_x @ xy
        out[1, -1] += self.along_x @ yy
        xx, xy, _ = self.exact.stress(np.full_like(self.y, length), self.y, t)
        out[0, :, -1] += self.along_y @ xx
        out[1, :, -1] += self.along_y @ xy
        _, xy, _ = self.exact.stress(np.zeros_like(self.y), self.y, t)
        out[1, :, 0] -= self.along_y @ xy
        return out

    def interface_stress(self, t: float) -> tuple[Array, Array]:
        """sigma_xy and sigma_yy (Pa) at the Gauss points of the interface."""
        _, shear, normal = self.exact.stress(self.x, np.zeros_like(self.x), t)
        return shear, normal

    def mean_over_area(self, error: Array) -> float:
        """Root mean square of nodal errors (2, n_y + 1, n_x + 1) over the body's area."""
        area = np.outer(self.along_y.sum(axis=1), self.along_x.sum(axis=1))
        return float(np.sqrt((error**2).sum(axis=0).ravel() @ area.ravel() / area.sum()))

    def field(self, forces: Array) -> Field:
        """Nodal forces (2, n_y + 1, n_x + 1) as a load of the solver: ``2/n sum_i F_i sin``."""
        n = self.grid.n_x
        theta, i = (np.arange(n) + 0.5) * np.pi / n, np.arange(1, n + 1)
        modes = np.empty((self.grid.n_y + 1, 2, n))
        modes[:, 0] = 2 / n * forces[0, :, 1:] @ np.sin(np.outer(i, theta))
        modes[:, 1] = 2 / n * forces[1, :, :-1] @ np.cos(np.outer(i - 1, theta))
        return Field(modes, forces[1, :, -1].copy())
