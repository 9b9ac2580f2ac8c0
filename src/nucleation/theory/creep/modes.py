"""The stress due to slip of a patch, in modes that fit the patch's two ends.

With ``x = L cos(theta)`` and U the displacement of an edge that is pushed, slip is expanded as

    odd       u(x) = U phi_0 + sum_n c_n sin(2 n theta),    phi_0 = 2 theta/pi,    u - U odd in x,
    even      u(x) = sum_n c_n sin((2 n - 1) theta),                               u even in x,

n = 1 ... N. Odd slip is that of an edge that is pushed. Under a remote load it is the sum of both
without U, with L half the patch. Each mode vanishes at the front (theta = 0) as a square root. At x
= 0 is the edge, which has no shear stress, or the middle of the patch; beyond it fields continue as
their mirror image, and beyond the front ``u = 0``. The Fourier transform of ``sin(m theta)'`` is
then a sum of ``-pi m (-i)^m J_m(k L)`` (DLMF 10.9), that of ``phi_0'`` has ``2/pi`` for m and J_0.
With the transfer functions of :mod:`nucleation.theory.stiffness` and ``kappa = k L > 0``

    shear stress lost:     mu int G1 s_m m J_m(kappa) sin(kappa x/L) dkappa/L ,    m even,
    compression gained:    mu int G2 s_m m J_m(kappa) cos(kappa x/L) dkappa/L ,

``s_m = -(-1)^(m/2)``; for odd m with cos and -sin, ``s_m = (-1)^((m-1)/2)``. For half-spaces G1 and
G2 are constant and the integrals known, ``mu G1 m sin(m theta)/(L sin theta)`` and ``mu G2 u'``.
The difference between layers and half-spaces is integrated up to ``kH = CUT``, where it vanishes.
There is no box and no mesh.
"""

import dataclasses
from functools import lru_cache

import numpy as np
from scipy.special import jv

from ...types import Array

CUT = 14.0  # kH beyond which layers are half-spaces: q^2 exp(-2 q) is 1e-10
WIDTH = 6.0  # of the panels of kappa: J_2n(kappa) oscillates with 2 pi
POINTS = 10  # Gauss points of a panel
FINEST = 1e-3  # the first panel, of thick layers
NEGLIGIBLE = 1e-100  # of J_m at small kappa, whose products underflow
GRADED = 14  # ends of panels that grow from the finest to the full width


@dataclasses.dataclass(frozen=True)
class Modes:
    """The modes at `theta`, for any fault; column 0 is the imposed displacement."""

    theta: Array  # (N,), from the front to the edge, or on to the other front
    values: Array  # phi_0, or zero, and the sines at theta, (N, N + 1)
    smoothing: Array  # factors that damp the last sines, (N + 1,)

    @property
    def inverse(self) -> Array:
        """From values at theta to the sines' coefficients, (N, N)."""
        sines: Array = self.values[:, 1:]
        return np.asarray(np.linalg.inv(sines), dtype=float)

    def at(self, theta: Array) -> Array:
        """phi_0 and the sines of a pushed edge at other angles, (angle, N + 1)."""
        n = np.arange(self.theta.size + 1)
        values = np.sin(2.0 * np.outer(theta, n))
        values[:, 0] = 2.0 * theta / np.pi
        return values


@dataclasses.dataclass(frozen=True)
class _MirrorModes(Modes):
    """Modes that are even or odd about x = 0, and their tables on a grid of `kappa`."""

    gradients: Array  # L u', (N, N + 1)
    half_space: Array  # L/(mu G1) times the shear stress lost in half-spaces, (N, N + 1)
    kappa: Array
    shear: Array  # sin(kappa x/L) at theta, or cos, (kappa, N)
    normal: Array  # cos(kappa x/L), or -sin
    slip: Array  # weight of the quadrature times s_m m J_m(kappa), (kappa, N + 1)


@lru_cache(maxsize=16)
def mirror_modes(
    number: int,
    slimmest: float = 0.0,
    even: bool = False,
) -> _MirrorModes:
    """The modes of one symmetry about x = 0.

    Returns: The modes at N angles, and their tables.
    """
    n = np.arange(number + 1)
    theta = 0.5 * np.pi * (np.arange(number) + 0.5) / number
    sine_of_theta = np.sin(theta)[:, None]
    if even:
        orders = np.abs(2 * n - 1)
        angles = np.outer(theta, orders)
        imposed: Array | float = 0.0
        weight_imposed = 0.0
    else:
        orders = 2 * n
        angles = 2.0 * np.outer(theta, n)
        imposed = 2.0 * theta / np.pi
        weight_imposed = 2.0 / np.pi
    values = np.sin(angles)
    values[:, 0] = imposed
    weights = np.where(n == 0, weight_imposed, orders)
    kappa, shares = _quadrature(CUT * slimmest)
    bessel = jv(orders, kappa[:, None]) * shares[:, None]
    bessel[np.abs(bessel) < NEGLIGIBLE] = 0.0
    phase = np.outer(kappa, np.cos(theta))
    sine, cosine = np.sin(phase), np.cos(phase)
    return _MirrorModes(
        theta=theta,
        values=values,
        smoothing=np.exp(-36.0 * (n / (number + 1)) ** 6),
        gradients=-weights * np.cos(angles) / sine_of_theta,
        half_space=orders * (n > 0) * np.sin(angles) / sine_of_theta,
        kappa=kappa,
        shear=cosine if even else sine,
        normal=-sine if even else cosine,
        slip=-bessel * weights * (-1.0) ** n,
    )


def _quadrature(largest: float) -> tuple[Array, Array]:
    """Points and weights of integrals over kappa, up to a panel beyond the `largest`."""
    graded = np.geomspace(FINEST, WIDTH, GRADED)
    edges = np.append(0.0, graded)
    even = np.arange(edges[-1] + WIDTH, largest + WIDTH, WIDTH)
    edges = np.append(edges, even)
    points, shares = np.polynomial.legendre.leggauss(POINTS)
    half = 0.5 * np.diff(edges)[:, None]
    kappa = edges[:-1, None] + half * (1.0 + points)
    return kappa.ravel(), (half * shares).ravel()
