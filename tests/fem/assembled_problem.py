"""The block by its assembled sparse matrix, for comparison with the separable solver."""

import numpy as np
from scipy.sparse.linalg import splu

from benchmarks.assembled import assemble, unknown
from nucleation.fem.grid import Grid
from nucleation.model.material import Material


def nodal_forces(modes, levels):
    """Nodal forces (N/m) at 1..n_x and 0..n_x whose generalised ones per mode are given."""
    one, nothing = np.ones(modes.n_x), np.zeros((2, modes.n_x))
    by_level = [modes.forces(level, one, nothing) for level in levels]
    return map(np.array, zip(*by_level, strict=True))


class AssembledBlock:
    """All nodes of the block; u_x = V t on the left edge, u_y = 0 and given u_x at the bottom."""

    def __init__(self, grid: Grid, material: Material) -> None:
        self.grid = grid
        self.stiffness, self.mass = assemble(grid, material)
        i, j = np.meshgrid(np.arange(grid.n_x + 1), np.arange(grid.n_y + 1))
        self.x, self.y = unknown(grid, i, j, 0), unknown(grid, i, j, 1)
        self.fixed = np.zeros(self.stiffness.shape[0], dtype=bool)
        self.fixed[self.x[:, 0]] = True
        self.fixed[self.x[0]] = True
        self.fixed[self.y[0]] = True
        self.free = ~self.fixed
        self._factors = {}

    def top_load(self, normal_stress: float) -> np.ndarray:
        load = np.zeros(self.stiffness.shape[0])
        load[self.y[-1]] = -normal_stress * self.grid.nodal_lengths
        return load

    def matrix(self, s: float):
        return (self.stiffness + s * self.mass).tocsr()

    def solve(self, s: float, load: np.ndarray, prescribed: np.ndarray):
        """Displacement of all unknowns and the reactions, for values given at the fixed ones."""
        matrix = self.matrix(s)
        if s not in self._factors:
            self._factors[s] = splu(matrix[self.free][:, self.free].tocsc())
        u = np.where(self.fixed, prescribed, 0.0)
        u[self.free] = self._factors[s].solve((load - matrix @ u)[self.free])
        return u, matrix @ u - load
