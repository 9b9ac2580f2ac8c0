"""Static response of elastic layers to one Fourier mode, from Navier's equation.

This evaluation of the transfer functions uses neither the paper's formulas nor the library's. It
solves equilibrium at Chebyshev points with the bodies' boundary conditions. Fields vary as
``exp(-i k x)``. With ``u = (U, i W)``, ``sigma_xy = T`` and ``sigma_yy = i N`` all numbers are
real. Lengths are in units of 1/k, stresses in units of k times the upper body's shear modulus.
"""

import numpy as np
from scipy.linalg import block_diag

HALF_SPACE = 40.0
"""Layer number k H of a body that counts as a half-space, ``exp(-40) = 4e-18``."""


def _chebyshev(points, end):
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
    """

    def __init__(self, q, poisson_ratio, modulus=1.0, far_side="velocity", points=64):
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

    def field(self, rows, values):
        """(U, W) for the values of two rows at the interface."""
        equations = np.vstack([self.own, rows])
        return _solve(equations, values)

    def field_of_slip(self):
        """(U, W) for a rigid other body, if the layer slips by one."""
        displacement = self.at_interface[:2]
        return self.field(displacement, (1.0, 0.0))


def pair_transfer(upper, lower=None):
    """G1 and G2 of two layers in contact."""
    field = upper.field_of_slip() if lower is None else _joint_field(upper, lower)
    _, _, t, n = upper.at_interface
    return -float(t @ field), float(n @ field)


def _joint_field(above, below):
    """(U, W) of the upper one of two layers that slip by one."""
    own = block_diag(above.own, below.own)
    jumps = np.hstack([above.at_interface, -below.at_interface])
    rows = np.vstack([own, jumps])
    field = _solve(rows, (1.0, 0.0, 0.0, 0.0))
    return field[: 2 * above.y.size]


def half_spaces(nu, psi=1.0, nu2=None, points=64):
    """G1 and G2 of two half-spaces."""
    upper = Layer(HALF_SPACE, nu, points=points)
    if nu2 is None:
        nu2 = nu
    lower = Layer(-HALF_SPACE, nu2, psi, points=points)
    return pair_transfer(upper, lower)


def compliance(layer):
    """The matrix ``M`` of ``u_i = M_ij sigma_yj``, times k and the shear modulus, (2, 2)."""
    u, w = layer.at_interface[:2]
    tractions = layer.at_interface[2:]
    shear = layer.field(tractions, (1.0, 0.0))
    normal = layer.field(tractions, (0.0, 1.0))
    fields = np.stack([shear, normal], axis=1)
    matrix = np.stack([u @ fields, 1j * w @ fields])
    return matrix * [1.0, -1j]  # sigma_yy = i N


def block_field(layer):
    """The displacement of a layer on a rigid base that slips by one."""
    field = layer.field_of_slip()
    return layer.y, layer.u @ field, layer.w @ field


def _solve(rows, values):
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
