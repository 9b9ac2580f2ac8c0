"""Static response of elastic layers to one Fourier mode, straight from Navier's equation.

An evaluation of the transfer functions that uses none of the paper's formulas nor the library's:
equilibrium at Chebyshev points, with the boundary conditions as they are. Fields vary as
``exp(-i k x)``; with ``u = (U, i W)``, ``sigma_xy = T`` and ``sigma_yy = i N`` all is real, and
with lengths in units of 1/k and stresses in units of k times the upper body's shear modulus no
dimension is left.
"""

import dataclasses
from collections.abc import Callable

import numpy as np
from scipy.linalg import block_diag

from ...types import Array, ComplexArray
from ..said import Ours

HALF_SPACE = 40.0
"""Layer number k H of a body that counts as a half-space, ``exp(-40) = 4e-18``."""


@dataclasses.dataclass(frozen=True)
class Layer:
    """A layer from the interface to its far side, above (``q > 0``) or below it (``q < 0``).

    ``q = k H``; `modulus` is over the upper body's; `far_side` is velocity or traction.
    """

    q: float
    poisson_ratio: float
    modulus: float = 1.0
    far_side: str = "velocity"


def chebyshev(points: int, end: float) -> tuple[Array, Array]:
    """Points from 0 to `end` and the matrix that differentiates values at them."""
    theta = np.pi * np.arange(points) / (points - 1)
    x = np.cos(theta)
    weight = np.where((np.arange(points) == 0) | (np.arange(points) == points - 1), 2.0, 1.0)
    weight *= (-1.0) ** np.arange(points)
    difference = x[:, None] - x[None, :] + np.eye(points)
    matrix = weight[:, None] / weight[None, :] / difference
    matrix -= np.diag(matrix.sum(axis=1))
    return 0.5 * end * (1.0 - x), matrix * (-2.0 / end)


class _Equations:
    """Rows of the discrete equations of one layer, acting on (U, W) at its points."""

    def __init__(self, layer: Layer, points: int) -> None:
        nu, mu = layer.poisson_ratio, layer.modulus
        lame = 2.0 * mu * nu / (1.0 - 2.0 * nu)
        self.y, d = chebyshev(points, layer.q)
        one, none = np.eye(points), np.zeros((points, points))
        self.u, self.w = np.hstack([one, none]), np.hstack([none, one])
        du, dw = np.hstack([d, none]), np.hstack([none, d])
        self.t = mu * (du + self.w)
        self.n = (lame + 2.0 * mu) * dw - lame * self.u
        normal_x = lame * dw - (lame + 2.0 * mu) * self.u  # sigma_xx / i
        self.inside = np.vstack([(normal_x + d @ self.t)[1:-1], (d @ self.n - self.t)[1:-1]])
        first, second = {"velocity": (self.u, self.n), "traction": (self.t, self.n)}[layer.far_side]
        self.far = np.vstack([first[-1], second[-1]])

    def field(self, at_interface: list[Array], load: tuple[float, float]) -> Array:
        """(U, W) for two fields given at the interface."""
        return _solve(np.vstack([self.inside, self.far, *at_interface]), load)


def pair_transfer(
    upper: Layer, lower: Layer | None = None, points: int = 64
) -> tuple[float, float]:
    """G1 and G2 of two layers in contact; None stands for a rigid lower body."""
    above = _Equations(upper, points)
    if lower is None:
        field = above.field([above.u[0], above.w[0]], (1.0, 0.0))
    else:
        below = _Equations(lower, points)
        own = block_diag(*(np.vstack([body.inside, body.far]) for body in (above, below)))
        joint = [np.append(getattr(above, n)[0], -getattr(below, n)[0]) for n in "uwtn"]
        field = _solve(np.vstack([own, *joint]), (1.0, 0.0, 0.0, 0.0))[: 2 * points]
    return -float(above.t[0] @ field), float(above.n[0] @ field)


def half_spaces(
    nu: float, psi: float = 1.0, nu2: float | None = None, points: int = 64
) -> tuple[float, float]:
    """G1 and G2 of two half-spaces; Poisson's ratios are alike if the lower one's is not given."""
    below = Layer(-HALF_SPACE, nu if nu2 is None else nu2, psi)
    return pair_transfer(Layer(HALF_SPACE, nu), below, points)


def refined(number: Callable[[int], float]) -> Ours:
    """A number by 64 points, known to its difference from that by 48."""
    return Ours.within(number(64), number(64) - number(48))


def compliance(layer: Layer, points: int = 64) -> ComplexArray:
    """The matrix ``M`` of ``u_i = M_ij sigma_yj``, times k and the shear modulus."""
    body = _Equations(layer, points)
    given = [body.t[0], body.n[0]]
    fields = np.stack([body.field(given, load) for load in ((1.0, 0.0), (0.0, 1.0))], axis=1)
    return np.stack([body.u[0] @ fields, 1j * body.w[0] @ fields]) * [1.0, -1j]  # sigma_yy = i N


def block_field(layer: Layer, points: int = 64) -> tuple[Array, Array, Array]:
    """``y``, ``U`` and ``W`` of a layer on a rigid base that slips by one."""
    body = _Equations(layer, points)
    field = body.field([body.u[0], body.w[0]], (1.0, 0.0))
    return body.y, body.u @ field, body.w @ field


def _solve(rows: Array, load: tuple[float, ...]) -> Array:
    """The solution for what the last rows are equal to, all others to zero.

    Rows are scaled to one and it is refined once: derivatives have large entries.
    """
    scale = np.abs(rows).max(axis=1)
    right = np.append(np.zeros(len(rows) - len(load)), load) / scale
    matrix = rows / scale[:, None]
    field = np.linalg.solve(matrix, right)
    return field + np.linalg.solve(matrix, right - matrix @ field)
