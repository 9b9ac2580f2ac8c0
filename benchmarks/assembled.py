"""The same finite-element problem by its assembled sparse matrices: the reference.

The ordinary way to solve the problem, kept as an independent check of the separable solver and
as the yardstick of the benchmark. Element matrices come from 2x2 Gauss quadrature, exact for
bilinear elements on rectangles.
"""

import numpy as np
from numpy.typing import ArrayLike
from scipy import sparse

from nucleation.fem.grid import Grid
from nucleation.model.material import Material
from nucleation.types import Array


def _element_matrices(dx: float, dy: float, material: Material) -> tuple[Array, Array]:
    """Stiffness and consistent mass of one element; unknowns (x, y) of nodes 00, 10, 01, 11."""
    point = 1.0 / np.sqrt(3.0)
    stiffness, mass = np.zeros((8, 8)), np.zeros((8, 8))
    lame, shear = material.lame_modulus, material.shear_modulus
    elastic = np.array(
        [[lame + 2 * shear, lame, 0.0], [lame, lame + 2 * shear, 0.0], [0.0, 0.0, shear]]
    )
    signs = np.array([[-1, -1], [1, -1], [-1, 1], [1, 1]])
    area = 0.25 * dx * dy
    for xi, eta in ((a, b) for a in (-point, point) for b in (-point, point)):
        shape = 0.25 * (1 + signs[:, 0] * xi) * (1 + signs[:, 1] * eta)
        by_x = 0.25 * signs[:, 0] * (1 + signs[:, 1] * eta) * 2 / dx
        by_y = 0.25 * signs[:, 1] * (1 + signs[:, 0] * xi) * 2 / dy
        if material.plane == "antiplane":  # u_x stands for u_z; u_y only bears the load on the top
            for own in (slice(0, None, 2), slice(1, None, 2)):
                gradients = np.zeros((2, 8))
                gradients[0, own], gradients[1, own] = by_x, by_y
                stiffness += area * shear * gradients.T @ gradients
            values = np.zeros((2, 8))
            values[0, 0::2] = values[1, 1::2] = shape
            mass += area * material.density * values.T @ values
            continue
        strain = np.zeros((3, 8))
        strain[0, 0::2], strain[1, 1::2] = by_x, by_y
        strain[2, 0::2], strain[2, 1::2] = by_y, by_x
        stiffness += area * strain.T @ elastic @ strain
        values = np.zeros((2, 8))
        values[0, 0::2] = values[1, 1::2] = shape
        mass += area * material.density * values.T @ values
    return stiffness, mass


def unknown(grid: Grid, i: ArrayLike, j: ArrayLike, component: int) -> Array:
    """Number of the unknown of node (i, j), component 0 (x) or 1 (y)."""
    return 2 * (np.asarray(j) * (grid.n_x + 1) + np.asarray(i)) + component


def assemble(grid: Grid, material: Material) -> tuple[sparse.csr_matrix, sparse.csr_matrix]:
    """Stiffness (Pa) and mass matrix (kg/m) of all nodes, without boundary conditions."""
    size = 2 * (grid.n_x + 1) * (grid.n_y + 1)
    columns = np.arange(grid.n_x)
    parts = []
    for j, dy in enumerate(np.diff(grid.y)):
        local = _element_matrices(grid.dx, dy, material)
        corners = ((0, 0), (1, 0), (0, 1), (1, 1))
        numbers = np.stack(
            [unknown(grid, columns + a, j + b, c) for a, b in corners for c in (0, 1)],
            axis=1,
        )
        rows = np.repeat(numbers, 8, axis=1).ravel()
        cols = np.tile(numbers, (1, 8)).ravel()
        parts.append((rows, cols, *(np.tile(m.ravel(), grid.n_x) for m in local)))
    rows, cols, stiffness, mass = (np.concatenate(p) for p in zip(*parts, strict=True))
    return tuple(
        sparse.csr_matrix((values, (rows, cols)), shape=(size, size))
        for values in (stiffness, mass)
    )
