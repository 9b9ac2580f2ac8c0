"""One-dimensional matrices of linear elements; the bilinear elements' matrices are products.

A tridiagonal matrix A of size n is an array (3, n) of its diagonals: ``A[i, i-1]``, ``A[i, i]`` and
``A[i, i+1]`` in row i. The first entry of the first diagonal and the last entry of the last one are
zero.
"""

import numpy as np

from ..types import Array


def element_matrices(nodes: Array) -> tuple[Array, Array, Array]:
    """Integrals of products of the hat functions psi_i of a line of nodes (m).

    ``int psi_i psi_j`` (m), ``int psi_i' psi_j'`` (1/m) and ``int psi_i psi_j'``.
    """
    h = np.diff(nodes)
    left, right = _beside_nodes(h)
    mass = np.array([left / 6.0, (left + right) / 3.0, right / 6.0])
    left, right = _beside_nodes(1.0 / h)
    stiffness = np.array([-left, left + right, -right])
    left, right = _beside_nodes(np.full(h.size, 0.5))
    diagonal = np.zeros(nodes.size)
    diagonal[0] = -0.5
    diagonal[-1] = 0.5
    return mass, stiffness, np.array([-left, diagonal, right])


def _beside_nodes(values: Array) -> tuple[Array, Array]:
    """Values of the elements on the left and on the right of each node, zero without one."""
    return np.append(0.0, values), np.append(values, 0.0)


def product(matrix: Array, values: Array) -> Array:
    """Product of a tridiagonal matrix with an array along its first axis, (n, ...)."""
    further_axes = [1] * (values.ndim - 1)
    lower, diagonal, upper = matrix.reshape(3, -1, *further_axes)
    out = diagonal * values
    out[1:] += lower[1:] * values[:-1]
    out[:-1] += upper[:-1] * values[1:]
    return out


def transposed(matrix: Array) -> Array:
    """The diagonals of the transposed matrix."""
    lower, diagonal, upper = matrix
    return np.array([np.roll(upper, 1), diagonal, np.roll(lower, -1)])


def dense(matrix: Array) -> Array:
    """The matrix as a dense array, (n, n)."""
    return product(matrix, np.eye(matrix.shape[1]))
