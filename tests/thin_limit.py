"""L_s of thin layers, by an equation of its own.

Where ``kH`` is small, L_s over L_c is a function of zeta/a alone. A thin layer on a rigid base
resists slip by ``2 mu H/(1 - nu) d^2u/dx^2``. The patch creeps with
``v = V y``, ``y = 1 - x/L``, and with ``S = i omega D/V`` and the length in
``lambda = (1 - nu) sigma0 L^2/(2 mu H D)`` the marginal mode obeys

    y (S + y) u'' = lambda S (a S - zeta y) u ,      u(0) = u(1) = 0 .

Since Eq. (11) has ``zeta lambda = 4 pi^2`` at L_c, ``(L/L_c)^2 = zeta lambda/(4 pi^2)``. The
derivation is in ``docs/creeping_patch.md``. It is solved in Chebyshev polynomials here, and by its
power series and by shooting in ``theory/creep/test_thin.py``.
"""

import numpy as np
from numpy.polynomial import chebyshev

from nucleation.theory.roots import roots

DEGREE = 48  # of the polynomials: eigenvalues to 1e-10 for zeta/a from 0.1 on
LOWEST = 1e-3  # angular frequency over V/D at which the search begins
PRECISION = 1e-12  # of the frequency over V/D


def thin_limit(zeta_over_a):
    """L_s over L_c in the thin limit, and the frequency of its mode over V/D.

    Checked to 1e-6 from ``zeta/a = 0.2`` on.
    """
    points = np.cos(np.pi * np.arange(DEGREE + 1) / DEGREE)
    to_values = chebyshev.chebvander(points, DEGREE)
    twice = chebyshev.chebder(np.eye(DEGREE + 1), 2)
    second = 4.0 * chebyshev.chebvander(points, DEGREE - 2) @ twice @ np.linalg.inv(to_values)
    second = second[1:-1, 1:-1]  # d^2/dy^2 with u = 0 at the ends
    y = 0.5 * (points[1:-1] + 1.0)

    def longest_wave(frequency):
        """``1/(zeta lambda)`` of the longest wave."""
        rate = 1j * frequency
        # 1/lambda u = (d^2/dy^2)^-1 [S (a S - zeta y)/(y (S + y))] u, a = 1/zeta_over_a, zeta = 1
        answer = rate * (rate / zeta_over_a - y) / (y * (rate + y))
        values = np.linalg.eigvals(np.linalg.solve(second, np.diag(answer)))
        return complex(values[np.argmax(values.real)])

    def negative(frequency, _):
        return np.array([-longest_wave(at).imag for at in frequency])

    homogeneous = np.sqrt([zeta_over_a])  # the frequency of homogeneous sliding
    (frequency,) = roots(negative, np.array([LOWEST]), homogeneous, PRECISION)
    found = longest_wave(frequency)
    return float(1.0 / (2.0 * np.pi * np.sqrt(found.real))), float(frequency)
