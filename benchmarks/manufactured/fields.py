"""Displacement fields with exact derivatives, and the nodal forces that they need.

Fields are sums of products ``amplitude X(x) Y(y) T(t)``. Their body forces and tractions are
integrated against the bilinear basis by Gauss quadrature, far more accurately than the elements do.
"""

import dataclasses
from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import ArrayLike

from nucleation.fem.grid import Field, Grid
from nucleation.model.material import Material
from nucleation.types import Array

Factor: TypeAlias = Callable[..., Array]
"""A function of one variable and of the order of its derivative, zero by default."""

POINTS = 4  # Gauss points per element and direction


def sine(rate: float, phase: float = 0.0) -> Factor:
    """The factor ``sin(rate x + phase)``."""

    def at(x: Array, order: int = 0) -> Array:
        shift = order * np.pi / 2
        return rate**order * np.sin(rate * x + phase + shift)

    return at


def power(*coefficients: float) -> Factor:
    """The polynomial factor ``c0 + c1 x + c2 x^2 ..``."""
    polynomial = np.polynomial.Polynomial(coefficients)

    def at(x: Array, order: int = 0) -> Array:
        return polynomial.deriv(order)(x) + np.zeros_like(x)

    return at


@dataclasses.dataclass(frozen=True)
class Term:
    """The product ``amplitude X(x) Y(y) T(t)``."""

    amplitude: float
    x: Factor
    y: Factor
    t: Factor

    def __call__(
        self, x: Array, y: Array, t: ArrayLike, by_x: int = 0, by_y: int = 0, by_t: int = 0
    ) -> Array:
        """The derivative of the given orders at x, y (m) and t (s)."""
        along_x = self.x(x, by_x)
        along_y = self.y(y, by_y)
        in_time = self.t(np.asarray(t, float), by_t)
        return self.amplitude * (along_x * along_y * in_time)


Terms = tuple[Term, ...]
"""The terms of a sum."""


@dataclasses.dataclass(frozen=True)
class Displacement:
    """A displacement of a block: ``w_x``, zero at x = 0, and ``u_y``, zero at y = 0."""

    terms: tuple[Terms, Terms]
    material: Material

    def value(self, component: int, x: Array, y: Array, t: float, **orders: int) -> Array:
        """A component or a derivative of it."""
        terms = (term(x, y, t, **orders) for term in self.terms[component])
        return sum(terms, np.zeros(()))

    def stress(
        self, x: Array, y: Array, t: float, by_x: int = 0, by_y: int = 0
    ) -> tuple[Array, Array, Array]:
        """The stress or a derivative of it."""
        lame = self.material.lame_modulus
        shear = self.material.shear_modulus
        along_x = {"by_x": by_x + 1, "by_y": by_y}
        along_y = {"by_x": by_x, "by_y": by_y + 1}
        xx = self.value(0, x, y, t, **along_x)
        xy = self.value(0, x, y, t, **along_y)
        xy = xy + self.value(1, x, y, t, **along_x)
        yy = self.value(1, x, y, t, **along_y)
        trace = lame * (xx + yy)
        return (trace + 2 * shear * xx, shear * xy, trace + 2 * shear * yy)

    def body_force(self, x: Array, y: Array, t: float) -> tuple[Array, Array]:
        """``rho u_tt - div sigma``."""
        density = self.material.density
        xx_by_x, xy_by_x, _ = self.stress(x, y, t, by_x=1)
        _, xy_by_y, yy_by_y = self.stress(x, y, t, by_y=1)
        inertia_x = density * self.value(0, x, y, t, by_t=2)
        inertia_y = density * self.value(1, x, y, t, by_t=2)
        along_x = inertia_x - xx_by_x - xy_by_y
        along_y = inertia_y - xy_by_x - yy_by_y
        return along_x, along_y


def _quadrature(nodes: Array) -> tuple[Array, Array]:
    """Gauss points (m) and the matrix of ``weight_g N_i(point_g)`` (m) of linear elements."""
    points, weights = np.polynomial.legendre.leggauss(POINTS)
    local = 0.5 * (1 + points)
    lengths = np.diff(nodes)[:, None]
    e = np.arange(lengths.size)
    left = nodes[:-1, None]
    scaled = 0.5 * lengths * weights
    weighted = np.zeros((nodes.size, e.size, POINTS))
    weighted[e, e] = scaled * (1 - local)
    weighted[e + 1, e] = scaled * local
    positions = left + lengths * local
    return positions.ravel(), weighted.reshape(nodes.size, -1)


class Loads:
    """Nodal forces of a manufactured displacement on a grid."""

    def __init__(self, grid: Grid, exact: Displacement) -> None:
        self.grid = grid
        self.exact = exact
        self.x, self.along_x = _quadrature(grid.x)
        self.y, self.along_y = _quadrature(grid.y)

    def nodal(self, t: float) -> Array:
        """The forces (N/m) along x and y at t (s), (2, n_y + 1, n_x + 1).

        They do not contain the traction on the interface.
        """
        x = self.x[None]
        y = self.y[:, None]
        force = self.exact.body_force(x, y, t)
        to_nodes = self.along_x.T
        out = np.array([self.along_y @ component @ to_nodes for component in force])
        top = np.full_like(self.x, self.grid.height)
        _, xy, yy = self.exact.stress(self.x, top, t)
        out[0, -1] += self.along_x @ xy
        out[1, -1] += self.along_x @ yy
        right = np.full_like(self.y, self.grid.length)
        xx, xy, _ = self.exact.stress(right, self.y, t)
        out[0, :, -1] += self.along_y @ xx
        out[1, :, -1] += self.along_y @ xy
        left = np.zeros_like(self.y)
        _, xy, _ = self.exact.stress(left, self.y, t)
        out[1, :, 0] -= self.along_y @ xy
        return out

    def interface_stress(self, t: float) -> tuple[Array, Array]:
        """Sigma_xy and sigma_yy (Pa) at the Gauss points of the interface at t (s)."""
        _, shear, normal = self.exact.stress(self.x, np.zeros_like(self.x), t)
        return shear, normal

    def mean_over_area(self, error: Array) -> float:
        """The root mean square of nodal errors (2, n_y + 1, n_x + 1) over the area."""
        rows = self.along_y.sum(axis=1)
        columns = self.along_x.sum(axis=1)
        area = np.outer(rows, columns)
        squares = (error**2).sum(axis=0)
        total = squares.ravel() @ area.ravel()
        return float(np.sqrt(total / area.sum()))

    def field(self, forces: Array) -> Field:
        """Nodal forces (2, n_y + 1, n_x + 1) as a load: ``2/n sum_i F_i sin`` per mode."""
        n = self.grid.n_x
        mode = np.arange(n)
        node = np.arange(1, n + 1)
        theta = (mode + 0.5) * np.pi / n
        sines = np.sin(np.outer(node, theta))
        cosines = np.cos(np.outer(node - 1, theta))
        x, y = forces
        modes = np.empty((self.grid.n_y + 1, 2, n))
        modes[:, 0] = 2 / n * x[:, 1:] @ sines
        modes[:, 1] = 2 / n * y[:, :-1] @ cosines
        return Field(modes, y[:, -1].copy())
