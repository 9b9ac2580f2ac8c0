"""Static response of elastic layers to one Fourier mode, from Navier's equation.

This evaluation of the transfer functions uses neither the paper's formulas nor the library's. It
solves equilibrium at Chebyshev points with the bodies' boundary conditions. Fields vary as
``exp(-i k x)``. With ``u = (U, i W)``, ``sigma_xy = T`` and ``sigma_yy = i N`` all numbers are
real. Lengths are in units of 1/k, stresses in units of k times the upper body's shear modulus.
"""

import dataclasses
from collections.abc import Callable

import numpy as np
from scipy.linalg import block_diag

from ...types import Array, ComplexArray
from ..expected import Estimate

HALF_SPACE = 40.0
"""Layer number k H of a body that counts as a half-space, ``exp(-40) = 4e-18``."""


@dataclasses.dataclass(frozen=True)
class Layer:
    """A layer from the interface to its far side.

    Attributes
    ----------
    q : float
        ``k H``, dimensionless; negative for a layer below the interface.
    poisson_ratio : float
        Poisson's ratio in the plane.
    modulus : float
        Shear modulus over the upper body's.
    far_side : str
        What vanishes at the far side: slip parallel to the interface ("velocity") or all stresses
        ("traction").
    """

    q: float
    poisson_ratio: float
    modulus: float = 1.0
    far_side: str = "velocity"


def _chebyshev(points: int, end: float) -> tuple[Array, Array]:
    """Points from 0 to `end` and the matrix that differentiates values at them."""
    index = np.arange(points)
    at_ends = (index == 0) | (index == points - 1)
    x = np.cos(np.pi * index / (points - 1))
    weight = np.where(at_ends, 2.0, 1.0)
    weight *= (-1.0) ** index
    difference = x[:, None] - x[None, :] + np.eye(points)
    matrix = weight[:, None] / weight[None, :] / difference
    matrix -= np.diag(matrix.sum(axis=1))
    y = 0.5 * end * (1.0 - x)
    return y, matrix * (-2.0 / end)


class _Equations:
    """The discrete equations of one layer: rows of coefficients of (U, W) at its points.

    Attributes
    ----------
    y : array, shape (points,)
        Distance from the interface.
    u, w, t, n : array, shape (points, 2 points)
        Rows that give U, W, T and N at the points.
    inside : array, shape (2 points - 4, 2 points)
        Equilibrium at the inner points.
    far : array, shape (2, 2 points)
        Values that vanish at the far side.
    """

    def __init__(self, layer: Layer, points: int) -> None:
        nu = layer.poisson_ratio
        mu = layer.modulus
        lame = 2.0 * mu * nu / (1.0 - 2.0 * nu)
        stiffness = lame + 2.0 * mu
        self.y, d = _chebyshev(points, layer.q)
        one = np.eye(points)
        none = np.zeros((points, points))
        self.u = np.hstack([one, none])
        self.w = np.hstack([none, one])
        du = np.hstack([d, none])
        dw = np.hstack([none, d])
        self.t = mu * (du + self.w)
        self.n = stiffness * dw - lame * self.u
        normal_x = lame * dw - stiffness * self.u  # sigma_xx / i
        along_x = normal_x + d @ self.t
        along_y = d @ self.n - self.t
        self.inside = np.vstack([along_x[1:-1], along_y[1:-1]])
        tangential = {"velocity": self.u, "traction": self.t}[layer.far_side]
        self.far = np.vstack([tangential[-1], self.n[-1]])

    @property
    def own(self) -> Array:
        """The equations of the body without those of the interface."""
        return np.vstack([self.inside, self.far])

    def at_interface(self) -> tuple[Array, Array, Array, Array]:
        """The rows of U, W, T and N at the interface."""
        return self.u[0], self.w[0], self.t[0], self.n[0]

    def field(self, first: Array, second: Array, values: tuple[float, float]) -> Array:
        """(U, W) for the values of two rows at the interface."""
        rows = np.vstack([self.own, first, second])
        return _solve(rows, values)


def pair_transfer(
    upper: Layer,
    lower: Layer | None = None,
    points: int = 64,
) -> tuple[float, float]:
    """G1 and G2 of two layers in contact.

    Parameters
    ----------
    upper, lower : Layer
        The layers; None is a rigid lower body.
    points : int
        Number of collocation points in each layer.
    """
    above = _Equations(upper, points)
    if lower is None:
        field = above.field(above.u[0], above.w[0], (1.0, 0.0))
    else:
        field = _joint_field(above, _Equations(lower, points))
    g1 = -float(above.t[0] @ field)
    g2 = float(above.n[0] @ field)
    return g1, g2


def _joint_field(above: _Equations, below: _Equations) -> Array:
    """(U, W) of the upper one of two layers that slip by one."""
    own = block_diag(above.own, below.own)
    jumps = []
    for upper, lower in zip(above.at_interface(), below.at_interface(), strict=True):
        jumps.append(np.append(upper, -lower))
    field = _solve(np.vstack([own, *jumps]), (1.0, 0.0, 0.0, 0.0))
    return field[: 2 * above.y.size]


def half_spaces(
    nu: float,
    psi: float = 1.0,
    nu2: float | None = None,
    points: int = 64,
) -> tuple[float, float]:
    """G1 and G2 of two half-spaces.

    Parameters
    ----------
    nu : float
        Poisson's ratio of the upper body.
    psi : float
        Shear modulus of the lower body over the upper body's.
    nu2 : float, optional
        Poisson's ratio of the lower body, by default that of the upper one.
    points : int
        Number of collocation points in each body.
    """
    upper = Layer(HALF_SPACE, nu)
    lower = Layer(-HALF_SPACE, nu if nu2 is None else nu2, psi)
    return pair_transfer(upper, lower, points)


def refined(number: Callable[[int], float]) -> Estimate:
    """A number with 64 points; its error is the difference from that with 48."""
    return Estimate.within(number(64), number(64) - number(48))


def compliance(layer: Layer, points: int = 64) -> ComplexArray:
    """The matrix ``M`` of ``u_i = M_ij sigma_yj``, times k and the shear modulus.

    Parameters
    ----------
    layer : Layer
        The layer.
    points : int
        Number of collocation points.

    Returns
    -------
    array, shape (2, 2)
    """
    body = _Equations(layer, points)
    t, n = body.t[0], body.n[0]
    loads = ((1.0, 0.0), (0.0, 1.0))
    fields = np.stack([body.field(t, n, load) for load in loads], axis=1)
    u_x = body.u[0] @ fields
    u_y = 1j * body.w[0] @ fields
    return np.stack([u_x, u_y]) * [1.0, -1j]  # sigma_yy = i N


def block_field(layer: Layer, points: int = 64) -> tuple[Array, Array, Array]:
    """The displacement of a layer on a rigid base that slips by one.

    Parameters
    ----------
    layer : Layer
        The layer.
    points : int
        Number of collocation points.

    Returns
    -------
    y, u, w : array, shape (points,)
        Distance from the interface, U and W.
    """
    body = _Equations(layer, points)
    field = body.field(body.u[0], body.w[0], (1.0, 0.0))
    return body.y, body.u @ field, body.w @ field


def _solve(rows: Array, values: tuple[float, ...]) -> Array:
    """The solution of equations with the given right-hand sides in the last rows, else zero.

    Derivatives have large entries. Rows are therefore scaled to one, and the solution is improved
    by one step of iterative refinement.
    """
    scale = np.abs(rows).max(axis=1)
    right = np.append(np.zeros(len(rows) - len(values)), values) / scale
    matrix = rows / scale[:, None]
    field = np.linalg.solve(matrix, right)
    residual = right - matrix @ field
    return field + np.linalg.solve(matrix, residual)
