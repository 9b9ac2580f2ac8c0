"""Static response of elastic layers to one Fourier mode, from Navier's equation.

This evaluation of the transfer functions uses neither the paper's formulas nor the library's. It
solves equilibrium at Chebyshev points with the bodies' boundary conditions. Fields vary as
``exp(-i k x)``. With ``u = (U, i W)``, ``sigma_xy = T`` and ``sigma_yy = i N`` all numbers are
real. Lengths are in units of 1/k, stresses in units of k times the upper body's shear modulus.
"""

from collections.abc import Callable

import numpy as np
from scipy.linalg import block_diag

from nucleation.types import Array, ComplexArray

from ..expected import Estimate

HALF_SPACE = 40.0
"""Layer number k H of a body that counts as a half-space, ``exp(-40) = 4e-18``."""


def _chebyshev(points: int, end: float) -> tuple[Array, Array]:
    """Points from 0 to `end` and the matrix that differentiates values at them."""
    index = np.arange(points)
    x = np.cos(np.pi * index / (points - 1))
    weight = (-1.0) ** index
    weight[[0, -1]] *= 2.0
    difference = np.subtract.outer(x, x) + np.eye(points)
    matrix = np.divide.outer(weight, weight) / difference
    matrix -= np.diag(matrix.sum(axis=1))
    y = 0.5 * end * (1.0 - x)
    return y, matrix * (-2.0 / end)


class Layer:
    """A layer from the interface to its far side, and its discrete equations.

    The equations are rows of coefficients of (U, W) at the collocation points.

    Parameters
    ----------
    q : float
        ``k H``, dimensionless; negative for a layer below the interface.
    poisson_ratio : float
        Poisson's ratio in the plane.
    modulus : float
        Shear modulus over the upper body's.
    far_side : str
        Condition at the far side besides zero normal stress: zero displacement along it
        ("velocity") or zero shear stress ("traction").
    points : int
        Number of collocation points.

    Attributes
    ----------
    y : array, shape (points,)
        Distance from the interface.
    u, w : array, shape (points, 2 points)
        Rows that give U and W at the points.
    at_interface : array, shape (4, 2 points)
        Rows that give U, W, T and N at the interface.
    own : array, shape (2 points - 2, 2 points)
        Rows that vanish: equilibrium at the inner points, and the conditions at the far side.
    """

    def __init__(
        self,
        q: float,
        poisson_ratio: float,
        modulus: float = 1.0,
        far_side: str = "velocity",
        points: int = 64,
    ) -> None:
        lame = 2.0 * modulus * poisson_ratio / (1.0 - 2.0 * poisson_ratio)
        stiffness = lame + 2.0 * modulus
        self.y, d = _chebyshev(points, q)
        self.u, self.w = np.split(np.eye(2 * points), 2)
        du = d @ self.u
        dw = d @ self.w
        t = modulus * (du + self.w)
        n = stiffness * dw - lame * self.u
        normal_x = lame * dw - stiffness * self.u  # sigma_xx / i
        along_x = normal_x + d @ t
        along_y = d @ n - t
        far_sides = {"velocity": self.u, "traction": t}
        far = far_sides[far_side]
        inside = slice(1, -1)
        fields = (self.u, self.w, t, n)
        self.at_interface = np.stack([rows[0] for rows in fields])
        self.own = np.vstack([along_x[inside], along_y[inside], far[-1], n[-1]])

    def field(
        self,
        rows: Array,
        values: tuple[float, float],
    ) -> Array:
        """(U, W) for the values of two rows at the interface.

        Parameters
        ----------
        rows : array, shape (2, 2 points)
            Two of the rows at the interface.
        values : tuple of float
            The value that each has.

        Returns
        -------
        array, shape (2 points,)
        """
        equations = np.vstack([self.own, rows])
        return _solve(equations, values)

    def field_of_slip(self) -> Array:
        """(U, W) for a rigid other body, if the layer slips by one."""
        displacement = self.at_interface[:2]
        return self.field(displacement, (1.0, 0.0))


def pair_transfer(
    upper: Layer,
    lower: Layer | None = None,
) -> tuple[float, float]:
    """G1 and G2 of two layers in contact.

    Parameters
    ----------
    upper, lower : Layer
        The layers; None is a rigid lower body.
    """
    field = upper.field_of_slip() if lower is None else _joint_field(upper, lower)
    _, _, t, n = upper.at_interface
    return -float(t @ field), float(n @ field)


def _joint_field(above: Layer, below: Layer) -> Array:
    """(U, W) of the upper one of two layers that slip by one."""
    own = block_diag(above.own, below.own)
    jumps = np.hstack([above.at_interface, -below.at_interface])
    rows = np.vstack([own, jumps])
    field = _solve(rows, (1.0, 0.0, 0.0, 0.0))
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
    upper = Layer(HALF_SPACE, nu, points=points)
    if nu2 is None:
        nu2 = nu
    lower = Layer(-HALF_SPACE, nu2, psi, points=points)
    return pair_transfer(upper, lower)


def refined(number: Callable[[int], float]) -> Estimate:
    """A number with 64 points; its error is the difference from that with 48."""
    value = number(64)
    error = value - number(48)
    return Estimate.within(value, error)


def compliance(layer: Layer) -> ComplexArray:
    """The matrix ``M`` of ``u_i = M_ij sigma_yj``, times k and the shear modulus, (2, 2)."""
    u, w = layer.at_interface[:2]
    tractions = layer.at_interface[2:]
    shear = layer.field(tractions, (1.0, 0.0))
    normal = layer.field(tractions, (0.0, 1.0))
    fields = np.stack([shear, normal], axis=1)
    matrix = np.stack([u @ fields, 1j * w @ fields])
    return matrix * [1.0, -1j]  # sigma_yy = i N


def block_field(layer: Layer) -> tuple[Array, Array, Array]:
    """The displacement of a layer on a rigid base that slips by one.

    Parameters
    ----------
    layer : Layer
        The layer.

    Returns
    -------
    y, u, w : array, shape (points,)
        Distance from the interface, U and W.
    """
    field = layer.field_of_slip()
    return layer.y, layer.u @ field, layer.w @ field


def _solve(rows: Array, values: tuple[float, ...]) -> Array:
    """The solution of equations with the given right-hand sides in the last rows, else zero.

    Derivatives have large entries. Rows are therefore scaled to one, and the solution is improved
    by one step of iterative refinement.
    """
    scale = np.abs(rows).max(axis=1)
    right = np.zeros(len(rows))
    right[-len(values) :] = values
    right /= scale
    matrix = rows / scale[:, None]
    field = np.linalg.solve(matrix, right)
    residual = right - matrix @ field
    return field + np.linalg.solve(matrix, residual)
