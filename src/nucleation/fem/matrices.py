"""One-dimensional matrices of linear elements, of which the bilinear ones are products."""

from __future__ import annotations

import dataclasses
from functools import cached_property

import numpy as np

from ..types import Array


@dataclasses.dataclass(frozen=True)
class Tridiagonal:
    """A tridiagonal matrix by its diagonals: ``lower[i] = A[i, i-1]``, ``upper[i] = A[i, i+1]``.

    All three have the length of the matrix; ``lower[0]`` and ``upper[-1]`` are zero.
    """

    lower: Array
    diagonal: Array
    upper: Array

    def __matmul__(self, vector: Array) -> Array:
        """Product with an array along its first axis."""
        lower, diagonal, upper = (d.reshape(-1, *[1] * (vector.ndim - 1)) for d in self.stacked)
        product = diagonal * vector
        product[1:] += lower[1:] * vector[:-1]
        product[:-1] += upper[:-1] * vector[1:]
        return product

    @cached_property
    def stacked(self) -> Array:
        """The three diagonals as one array for the kernels: lower, diagonal, upper."""
        return np.array([self.lower, self.diagonal, self.upper])

    @cached_property
    def transposed(self) -> Tridiagonal:
        """The transposed matrix."""
        return Tridiagonal(
            np.concatenate(([0.0], self.upper[:-1])),
            self.diagonal,
            np.concatenate((self.lower[1:], [0.0])),
        )

    def scaled(self, factor: float) -> Tridiagonal:
        """The matrix times a number."""
        return Tridiagonal(factor * self.lower, factor * self.diagonal, factor * self.upper)

    def __add__(self, other: Tridiagonal) -> Tridiagonal:
        return Tridiagonal(
            self.lower + other.lower, self.diagonal + other.diagonal, self.upper + other.upper
        )

    def dense(self) -> Array:
        """The matrix as a dense array."""
        return np.diag(self.diagonal) + np.diag(self.lower[1:], -1) + np.diag(self.upper[:-1], 1)


def element_matrices(nodes: Array) -> tuple[Tridiagonal, Tridiagonal, Tridiagonal]:
    """Mass, stiffness and derivative matrix of linear elements on a line of nodes (m).

    ``M[i, j] = int psi_i psi_j`` (m), ``K[i, j] = int psi_i' psi_j'`` (1/m) and
    ``C[i, j] = int psi_i psi_j'`` (dimensionless).
    """
    h = np.diff(nodes)
    zero = np.zeros(1)
    left, right = np.concatenate((zero, h)), np.concatenate((h, zero))  # element left, right of i
    mass = Tridiagonal(left / 6.0, (left + right) / 3.0, right / 6.0)
    inverse = 1.0 / h
    left, right = np.concatenate((zero, inverse)), np.concatenate((inverse, zero))
    stiffness = Tridiagonal(-left, left + right, -right)
    half = np.full(h.size, 0.5)
    diagonal = np.zeros(nodes.size)
    diagonal[0], diagonal[-1] = -0.5, 0.5
    derivative = Tridiagonal(-np.concatenate((zero, half)), diagonal, np.concatenate((half, zero)))
    return mass, stiffness, derivative
