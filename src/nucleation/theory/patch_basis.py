"""Slip on a patch in Legendre polynomials, and what multiplies its Fourier modes.

Slip on ``|x| < h`` is ``sum_n u_n p_n(x/h)`` with orthonormal Legendre polynomials p_n, and zero
elsewhere. The Fourier transform of p_n is ``2 sqrt(n + 1/2) i^n j_n(q)``, ``q = k h``, with the
spherical Bessel functions j_n. So an operator that multiplies each Fourier mode by F(k) is, on the
patch, the matrix

    F_mn = (2/pi) N_mn i^(n - m) integral_0^inf [F(q) + (-1)^(m + n) F(-q)] j_m(q) j_n(q) dq ,

with ``N_mn = sqrt((m + 1/2)(n + 1/2))``. The line beyond the patch is infinite: there is no period.

F is smooth in log q, the Bessel functions oscillate. In each octave of q the polynomial through F
at :data:`POINTS` is integrated with the Bessel functions exactly; its weights don't depend on F.
Beyond the last octave, at Q, the products of Bessel functions are replaced by their mean over an
oscillation, which falls as ``1/q^2``. Its size is that which makes F = 1 the identity.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.special import spherical_jn

from ..types import Array, ComplexArray

OCTAVES = -24, 12  # of q, as powers of 2
POINTS = 10  # in an octave, at which F is evaluated
SPACING = 2.0  # of q, in which Bessel functions are integrated by GAUSS points
GAUSS = 12


class _PatchBasis(NamedTuple):
    """Legendre polynomials on a patch and the weights of the integral over q."""

    wavenumber: Array  # q, (points,)
    even: Array  # weights of F(q) + F(-q), (points, number^2)
    odd: Array  # weights of i [F(q) - F(-q)], (points, number^2)
    number: int

    def matrices(self, forward: ComplexArray, backward: ComplexArray) -> ComplexArray:
        """Matrices of operators on the patch.

        Returns: (operators, number, number).
        """
        found = (forward + backward) @ self.even
        difference = forward - backward
        if np.any(difference):
            found = found + 1j * difference @ self.odd
        return found.reshape(-1, self.number, self.number)


@lru_cache(maxsize=8)
def patch_basis(number: int) -> _PatchBasis:
    """The basis of a number of polynomials."""
    octaves = [_octave(number, power) for power in range(*OCTAVES)]
    wavenumber = np.concatenate([points for points, _ in octaves])
    weights = np.concatenate([own for _, own in octaves])
    beyond, share = _beyond()
    n = np.arange(number)
    power = np.subtract.outer(n, n).T  # n - m
    missing = 0.5 * np.eye(number).ravel() - weights.sum(axis=0)
    missing[power.ravel() % 2 == 1] = 0.0  # the mean of a sine times a cosine
    wavenumber = np.concatenate([wavenumber, beyond])
    weights = np.concatenate([weights, share[:, None] * missing])
    # i^(n - m) is real where n - m is even, and i times a real number where it is odd
    even = np.where(
        power % 2 == 0,
        (-1.0) ** (power // 2),
        0.0,
    )
    odd = np.where(
        power % 2 == 1,
        (-1.0) ** (power // 2),
        0.0,
    )
    return _PatchBasis(
        wavenumber,
        weights * even.ravel(),
        weights * odd.ravel(),
        number,
    )


def _octave(number: int, power: int) -> tuple[Array, Array]:
    """The points of an octave of q and their weights, (points,) and (points, number^2)."""
    begin, end = 2.0**power, 2.0 ** (power + 1)
    nodes, _ = np.polynomial.legendre.leggauss(POINTS)
    q, weight = _gauss(begin, end)
    polynomials = np.polynomial.legendre.legvander
    position = 2.0 * (np.log2(q) - power) - 1.0
    interpolation = polynomials(position, POINTS - 1) @ np.linalg.inv(
        polynomials(nodes, POINTS - 1)
    )
    n = np.arange(number)[:, None]
    bessel = np.sqrt(n + 0.5) * spherical_jn(n, q)
    products = bessel[:, None] * bessel[None]
    weights = products.reshape(-1, q.size) @ (weight[:, None] * interpolation)
    return 2.0 ** (power + 0.5 * (nodes + 1.0)), 2.0 / np.pi * weights.T


def _beyond() -> tuple[Array, Array]:
    """Points beyond the last octave, at Q, and their weights in ``Q integral_Q^inf F dq/q^2``."""
    nodes, weights = np.polynomial.legendre.leggauss(POINTS)
    return 2.0 ** OCTAVES[1] / (0.5 * (nodes + 1.0)), 0.5 * weights


def _gauss(begin: float, end: float) -> tuple[Array, Array]:
    """Points and weights of an integral over an interval, dense enough for Bessel functions."""
    edges = np.linspace(
        begin,
        end,
        1 + max(1, round((end - begin) / SPACING)),
    )
    half = 0.5 * np.diff(edges)[:, None]
    middle = 0.5 * (edges[1:] + edges[:-1])[:, None]
    nodes, weights = np.polynomial.legendre.leggauss(GAUSS)
    return (middle + half * nodes).ravel(), (half * weights).ravel()
