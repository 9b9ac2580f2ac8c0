"""One-dimensional matrices of linear elements; the bilinear elements' matrices are products.

A tridiagonal matrix A of size n is an array (3, n) of its diagonals: ``A[i, i-1]``, ``A[i, i]`` and
``A[i, i+1]`` in row i. The first entry of the first diagonal and the last entry of the last one are
zero.
"""

import numpy as np

from ..types import Array


def element_matrices(nodes: Array) -> tuple[Array, Array, Array]:
    """Integrate products of the hat functions psi_i of a line of nodes.

    Parameters
    ----------
    nodes : ndarray
        Positions of the nodes (m), shape (n,).

    Returns
    -------
    mass, stiffness, derivative : ndarray
        ``int psi_i psi_j`` (m), ``int psi_i' psi_j'`` (1/m) and ``int psi_i psi_j'``
        (dimensionless), shape (3, n) each.
    """
    h = np.diff(nodes)
    left, right = _beside_nodes(h)
    mass = np.array(
        [
            left / 6.0,
            (left + right) / 3.0,
            right / 6.0,
        ]
    )
    left, right = _beside_nodes(1.0 / h)
    stiffness = np.array([-left, left + right, -right])
    halves = np.full(h.size, 0.5)
    left, right = _beside_nodes(halves)
    diagonal = np.zeros(nodes.size)
    diagonal[0] = -0.5
    diagonal[-1] = 0.5
    derivative = np.array([-left, diagonal, right])
    return mass, stiffness, derivative


def _beside_nodes(values: Array) -> tuple[Array, Array]:
    """Values of the elements on the left and on the right of each node, zero without one."""
    left = np.concatenate(([0.0], values))
    right = np.concatenate((values, [0.0]))
    return left, right


def product(matrix: Array, values: Array) -> Array:
    """Multiply a tridiagonal matrix with an array along its first axis.

    Parameters
    ----------
    matrix : ndarray
        Diagonals, shape (3, n).
    values : ndarray
        Shape (n, ...).

    Returns
    -------
    ndarray
        Shape (n, ...).
    """
    further_axes = [1] * (values.ndim - 1)
    lower, diagonal, upper = matrix.reshape(3, -1, *further_axes)
    out = diagonal * values
    out[1:] += lower[1:] * values[:-1]
    out[:-1] += upper[:-1] * values[1:]
    return out


def transposed(matrix: Array) -> Array:
    """Return the diagonals of the transposed matrix, (3, n)."""
    lower, diagonal, upper = matrix
    return np.array(
        [
            np.roll(upper, 1),
            diagonal,
            np.roll(lower, -1),
        ]
    )


def dense(matrix: Array) -> Array:
    """Return a tridiagonal matrix as a dense array, (n, n)."""
    lower, diagonal, upper = matrix
    out = np.diag(diagonal)
    out += np.diag(lower[1:], -1)
    out += np.diag(upper[:-1], 1)
    return out
