"""Static response of elastic layers to one Fourier mode, straight from Navier's equation.

An evaluation of the transfer functions that uses none of the paper's formulas nor the library's:
equilibrium at Chebyshev points, with the boundary conditions as they are. Fields vary as
``exp(-i k x)``; with ``u = (U, i W)``, ``sigma_xy = T`` and ``sigma_yy = i N`` all is real, and
with lengths in units of 1/k and stresses in units of k times the upper body's shear modulus no
dimension is left.
"""

import dataclasses

import numpy as np
from numpy.typing import NDArray

from ...types import Array

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


def pair_transfer(
    upper: Layer, lower: Layer | None = None, points: int = 64
) -> tuple[float, float]:
    """G1 and G2 of two layers in contact; None stands for a rigid lower body."""
    above = _Equations(upper, points)
    if lower is None:
        rows = [above.inside, above.far, above.u[:1], above.w[:1]]
        load = np.zeros(2 * points)
        load[-2] = 1.0
    else:
        below = _Equations(lower, points)
        none = np.zeros((2 * points - 2, 2 * points))
        own = [np.vstack([e.inside, e.far]) for e in (above, below)]
        joint = [
            np.hstack([getattr(above, field)[:1], -getattr(below, field)[:1]]) for field in "uwtn"
        ]
        rows = [np.hstack([own[0], none]), np.hstack([none, own[1]]), *joint]
        load = np.zeros(4 * points)
        load[-4] = 1.0
    field = _solve(np.vstack(rows), load)[: 2 * points]
    return -float(above.t[0] @ field), float(above.n[0] @ field)


def half_spaces(
    nu: float, psi: float = 1.0, nu2: float | None = None, points: int = 64
) -> tuple[float, float]:
    """G1 and G2 of two half-spaces; Poisson's ratios are alike if the lower one's is not given."""
    below = Layer(-HALF_SPACE, nu if nu2 is None else nu2, psi)
    return pair_transfer(Layer(HALF_SPACE, nu), below, points)


def compliance(layer: Layer, points: int = 64) -> NDArray[np.complex128]:
    """The matrix ``M`` of ``u_i = M_ij sigma_yj``, times k and the shear modulus."""
    body = _Equations(layer, points)
    rows = np.vstack([body.inside, body.far, body.t[:1], body.n[:1]])
    columns = []
    for traction, phase in ((-2, 1.0), (-1, -1j)):  # sigma_yy = i N
        load = np.zeros(2 * points)
        load[traction] = 1.0
        field = _solve(rows, load)
        columns.append([phase * (body.u[0] @ field), phase * 1j * (body.w[0] @ field)])
    return np.array(columns).T


def block_field(layer: Layer, points: int = 64) -> tuple[Array, Array, Array]:
    """``y``, ``U`` and ``W`` of a layer on a rigid base that slips by one."""
    body = _Equations(layer, points)
    load = np.zeros(2 * points)
    load[-2] = 1.0
    rows = np.vstack([body.inside, body.far, body.u[:1], body.w[:1]])
    field = _solve(rows, load)
    return body.y, body.u @ field, body.w @ field


def _solve(rows: Array, load: Array) -> Array:
    """The solution, rows scaled to one and refined once: derivatives have large entries."""
    scale = np.abs(rows).max(axis=1)
    matrix, right = rows / scale[:, None], load / scale
    field = np.linalg.solve(matrix, right)
    return field + np.linalg.solve(matrix, right - matrix @ field)
