"""Body force and tractions of a manufactured displacement as nodal forces of the solver.

They are integrated against the bilinear basis by Gauss quadrature, far more accurate than the
elements themselves.
"""

from __future__ import annotations

import numpy as np

from ...fem.field import Field
from ...fem.grid import Grid
from ...types import Array
from .fields import Displacement

POINTS = 4  # Gauss points per element and direction


def quadrature(nodes: Array) -> tuple[Array, Array]:
    """Gauss points (m) and the matrix of ``weight_g N_i(point_g)`` (m) of linear elements."""
    points, weights = np.polynomial.legendre.leggauss(POINTS)
    lengths, local = np.diff(nodes), 0.5 * (1 + points)
    n, g = lengths.size, points.size
    weighted = np.zeros((n + 1, n, g))
    for e in range(n):
        weighted[e, e] = 0.5 * lengths[e] * weights * (1 - local)
        weighted[e + 1, e] = 0.5 * lengths[e] * weights * local
    return (nodes[:-1, None] + lengths[:, None] * local).ravel(), weighted.reshape(n + 1, n * g)


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
