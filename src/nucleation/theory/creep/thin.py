"""The thin limit: where ``kH`` is small, L_s over L_c is a function of zeta/a alone.

A thin layer on a rigid base resists slip by ``2 mu H/(1 - nu) d^2u/dx^2``. The patch creeps with
``v = V y``, ``y = 1 - x/L``, and with ``S = i omega D/V`` and the length in
``lambda = (1 - nu) sigma0 L^2/(2 mu H D)`` the marginal mode obeys

    y (S + y) u'' = lambda S (a S - zeta y) u ,      u(0) = u(1) = 0 .

Since Eq. (11) has ``zeta lambda = 4 pi^2`` at L_c, ``(L/L_c)^2 = zeta lambda/(4 pi^2)``. The
derivation is in ``docs/creeping_patch.md``. It is solved in Chebyshev polynomials here, and by its
power series and by shooting in a test.
"""

from functools import lru_cache
from typing import NamedTuple

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from ...types import Array
from ..roots import roots

DEGREE = 48  # of the polynomials: eigenvalues to 1e-10 for zeta/a from 0.1 on
LOWEST = 1e-3  # angular frequency over V/D at which the search begins
PRECISION = 1e-12  # of the frequency over V/D


class _ThinLimit(NamedTuple):
    """The patch of a thin layer where it turns unstable."""

    length_ratio: float  # L_s over L_c of Eq. (11)
    frequency: float  # angular frequency of its mode over V/D


@lru_cache(maxsize=4)
def _second_derivative(degree: int) -> tuple[Array, Array]:
    """Inner Chebyshev points y in (0, 1) and the matrix of ``d^2/dy^2`` with u = 0 at the ends."""
    points = np.cos(np.pi * np.arange(degree + 1) / degree)
    to_values = chebyshev.chebvander(points, degree)
    twice = chebyshev.chebder(np.eye(degree + 1), 2)
    values_of_twice = chebyshev.chebvander(points, degree - 2)
    second = 4.0 * values_of_twice @ twice @ np.linalg.inv(to_values)
    inner = points[1:-1]
    return 0.5 * (inner + 1.0), second[1:-1, 1:-1]


def _longest_wave(
    ratio: float,
    frequency: float,
    degree: int,
) -> complex:
    """``1/(zeta lambda)`` of the longest wave at an angular frequency over V/D."""
    y, second = _second_derivative(degree)
    rate = 1j * frequency
    # 1/lambda u = (d^2/dy^2)^-1 [S (a S - zeta y)/(y (S + y))] u, with a = 1/ratio, zeta = 1
    answer = rate * (rate / ratio - y) / (y * (rate + y))
    values = np.linalg.eigvals(np.linalg.solve(second, np.diag(answer)))
    return complex(values[np.argmax(values.real)])


def thin_limit(
    zeta_over_a: float,
    degree: int = DEGREE,
) -> _ThinLimit:
    """Length and frequency of the thin limit; checked to 1e-6 from ``zeta/a = 0.2`` on.

    Returns: L_s over L_c, and the frequency of its mode over V/D.
    """
    if not zeta_over_a > 0.0:
        raise ValueError(f"zeta/a = {zeta_over_a} is not allowed: without weakening nothing grows")

    def negative(frequency: Array, _: NDArray) -> Array:
        return np.array([-_longest_wave(zeta_over_a, at, degree).imag for at in frequency])

    homogeneous = np.sqrt([zeta_over_a])  # the frequency of homogeneous sliding
    (frequency,) = roots(negative, np.array([LOWEST]), homogeneous, PRECISION)
    found = _longest_wave(zeta_over_a, frequency, degree)
    ratio = 1.0 / (2.0 * np.pi * np.sqrt(found.real))
    return _ThinLimit(float(ratio), float(frequency))
