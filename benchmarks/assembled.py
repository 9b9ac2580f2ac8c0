"""The same finite-element problem by its assembled sparse matrices: the reference.

The ordinary way to solve the problem is an independent check of the separable solver, and the
benchmark compares their times. Element matrices come from 2x2 Gauss quadrature, exact for bilinear
elements on rectangles.
"""

import numpy as np
from numpy.typing import ArrayLike
from scipy import sparse

from nucleation.fem.grid import Grid
from nucleation.model.material import Material
from nucleation.types import Array

CORNERS = ((0, 0), (1, 0), (0, 1), (1, 1))
"""Nodes of an element along x and y; its unknowns are x and y of each."""


def _element_matrices(dx: float, dy: float, material: Material) -> tuple[Array, Array]:
    """Stiffness and consistent mass of one element, (8, 8) each."""
    point = 1.0 / np.sqrt(3.0)
    stiffness = np.zeros((8, 8))
    mass = np.zeros((8, 8))
    side_x, side_y = 2 * np.array(CORNERS).T - 1
    area = 0.25 * dx * dy
    for xi in (-point, point):
        for eta in (-point, point):
            along_x = 1 + side_x * xi
            along_y = 1 + side_y * eta
            shape = 0.25 * along_x * along_y
            by_x = 0.25 * side_x * along_y * 2 / dx
            by_y = 0.25 * side_y * along_x * 2 / dy
            values = np.zeros((2, 8))
            values[0, 0::2] = shape
            values[1, 1::2] = shape
            stiffness += _stiffness(by_x, by_y, area, material)
            mass += area * material.density * values.T @ values
    return stiffness, mass


def _stiffness(by_x: Array, by_y: Array, area: float, material: Material) -> Array:
    """Stiffness of one element from one Gauss point, by the gradients of the shape functions.

    In antiplane shear u_x is the displacement along z, and u_y bears only the load on the top.
    """
    lame = material.lame_modulus
    shear = material.shear_modulus
    if material.plane == "antiplane":
        gradients = np.zeros((4, 8))
        gradients[0, 0::2] = by_x
        gradients[1, 0::2] = by_y
        gradients[2, 1::2] = by_x
        gradients[3, 1::2] = by_y
        return area * shear * gradients.T @ gradients
    strain = np.zeros((3, 8))
    strain[0, 0::2] = by_x
    strain[1, 1::2] = by_y
    strain[2, 0::2] = by_y
    strain[2, 1::2] = by_x
    stretch = lame + 2 * shear
    elastic = np.array([[stretch, lame, 0.0], [lame, stretch, 0.0], [0.0, 0.0, shear]])
    return area * strain.T @ elastic @ strain


def unknown(grid: Grid, i: ArrayLike, j: ArrayLike, component: int) -> Array:
    """Number the unknowns.

    Parameters
    ----------
    grid : Grid
        The mesh.
    i, j : array_like of int
        Nodes along x and y.
    component : int
        0 for x and 1 for y.

    Returns
    -------
    ndarray of int
        Number of the unknown of each node.
    """
    in_row = grid.n_x + 1
    node = np.asarray(j) * in_row + np.asarray(i)
    return 2 * node + component


def assemble(grid: Grid, material: Material) -> tuple[sparse.csr_matrix, sparse.csr_matrix]:
    """Assemble the matrices of all nodes, without boundary conditions.

    Parameters
    ----------
    grid : Grid
        The mesh.
    material : Material
        Elastic moduli and density.

    Returns
    -------
    stiffness, mass : csr_matrix
        In Pa and kg/m.
    """
    columns = np.arange(grid.n_x)
    rows_of_entries = []
    columns_of_entries = []
    stiffness = []
    mass = []
    for j, dy in enumerate(np.diff(grid.y)):
        own_stiffness, own_mass = _element_matrices(grid.dx, dy, material)
        numbers = np.stack(
            [
                unknown(grid, columns + along_x, j + along_y, component)
                for along_x, along_y in CORNERS
                for component in (0, 1)
            ],
            axis=1,
        )
        rows_of_entries.append(np.repeat(numbers, 8, axis=1).ravel())
        columns_of_entries.append(np.tile(numbers, (1, 8)).ravel())
        stiffness.append(np.tile(own_stiffness.ravel(), grid.n_x))
        mass.append(np.tile(own_mass.ravel(), grid.n_x))
    places = (np.concatenate(rows_of_entries), np.concatenate(columns_of_entries))
    size = 2 * (grid.n_x + 1) * (grid.n_y + 1)
    return (
        sparse.csr_matrix((np.concatenate(stiffness), places), shape=(size, size)),
        sparse.csr_matrix((np.concatenate(mass), places), shape=(size, size)),
    )
