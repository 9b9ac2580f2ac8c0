"""Closed forms of the paper: critical lengths of special systems; and L_s of thin layers.

Where ``kH`` is small, L_s over L_c is a function of zeta/a alone. A thin layer on a rigid base
resists slip by ``2 mu H/(1 - nu) d^2u/dx^2``. The patch creeps with
``v = V y``, ``y = 1 - x/L``, and with ``S = i omega D/V`` and the length in
``lambda = (1 - nu) sigma0 L^2/(2 mu H D)`` the marginal mode obeys

    y (S + y) u'' = lambda S (a S - zeta y) u ,      u(0) = u(1) = 0 .

Since Eq. (11) has ``zeta lambda = 4 pi^2`` at L_c, ``(L/L_c)^2 = zeta lambda/(4 pi^2)``. The
derivation is in ``docs/creeping_patch.md``. It is solved in Chebyshev polynomials here, and by its
power series and by shooting in a test.
"""

import math

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import ArrayLike, NDArray

from ..model.material import Material, in_plane_ratio
from ..types import Array
from .roots import roots
from .spectrum import marginal_stiffness
from .status import STABLE, NoLength
from .values import FaultLike

DEGREE = 48  # of the polynomials: eigenvalues to 1e-10 for zeta/a from 0.1 on
LOWEST = 1e-3  # angular frequency over V/D at which the search begins
PRECISION = 1e-12  # of the frequency over V/D


def bimaterial_contrast(
    upper: Material,
    lower: Material,
) -> float:
    """The bimaterial contrast beta of two half-spaces (Eq. 8).

    Parameters
    ----------
    upper, lower : Material
        Materials of the two half-spaces.

    Returns
    -------
    float
        beta, dimensionless.

    Notes
    -----
    ``beta = [psi (1 - 2 nu1) - (1 - 2 nu2)] / {2 [psi (1 - nu1) + (1 - nu2)]}``, ``psi = mu2/mu1``.
    It changes sign when the bodies are exchanged and vanishes for identical ones. For a rigid lower
    body it is ``(1 - 2 nu1)/[2 (1 - nu1)]``, 1/4 for ``nu1 = 1/3``.
    """
    psi = lower.shear_modulus / upper.shear_modulus
    nu1 = upper.in_plane_ratio
    nu2 = lower.in_plane_ratio
    difference = psi * (1.0 - 2.0 * nu1) - (1.0 - 2.0 * nu2)
    total = psi * (1.0 - nu1) + (1.0 - nu2)
    return difference / (2.0 * total)


def bimaterial_length_ratio(
    f_beta: ArrayLike,
    zeta_over_a: ArrayLike,
) -> Array:
    """L_c of two half-spaces over ``L_c^M = pi M ell / (zeta sigma0)`` (Eq. 9, Fig. 2).

    Parameters
    ----------
    f_beta : array_like
        Friction coefficient times bimaterial contrast, of either sign.
    zeta_over_a : array_like
        Velocity weakening over direct effect; broadcasts with `f_beta`.

    Returns
    -------
    ndarray
        The ratio, broadcast shape; negative as ``L_c^M`` is for ``zeta < 0``, NaN where sliding is
        stable.

    Notes
    -----
    The paper's bracket subtracts nearly equal numbers for small ``zeta/a``. Times its conjugate
    it is ``zeta / h_plus`` with h_plus of :func:`.spectrum.marginal_stiffness`, which adds
    positive numbers. Equally ``1 - |f beta|/w`` with ``w = |omega| ell / V`` the positive root of
    ``a w^2 - |f beta| (a + zeta) w - zeta = 0``.
    """
    coupling = np.asarray(f_beta, dtype=float)
    zeta = np.asarray(zeta_over_a, dtype=float)
    with np.errstate(invalid="ignore"):  # 0/0 without coupling and weakening
        _, h_plus = marginal_stiffness(coupling, 1.0, zeta)
        return zeta / h_plus


def thin_limit_length(
    height: ArrayLike,
    fault: FaultLike,
) -> Array:
    """L_c (m) of blocks of heights H (m) on a rigid base as ``Hk -> 0`` (Eq. 11).

    Only the first body and the friction of the fault matter; NoLength unless ``zeta > 0``.
    """
    if fault.zeta <= 0.0:
        raise NoLength(
            f"zeta = {fault.zeta:g} is not positive: "
            "without velocity weakening a thin layer slides stably",
            STABLE,
        )
    modulus = fault.shear_modulus / (1.0 - in_plane_ratio(fault.poisson_ratio, fault.plane))
    weakening_length = fault.slip_distance / (fault.zeta * fault.normal_stress)
    height = np.asarray(height, dtype=float)
    return 2.0 * math.pi * np.sqrt(2.0 * height * modulus * weakening_length)


def thin_limit(zeta_over_a: float) -> tuple[float, float]:
    """L_s over L_c in the thin limit, and the frequency of its mode over V/D.

    Checked to 1e-6 from ``zeta/a = 0.2`` on.
    """
    if not zeta_over_a > 0.0:
        raise ValueError(f"zeta/a = {zeta_over_a} is not allowed: without weakening nothing grows")
    points = np.cos(np.pi * np.arange(DEGREE + 1) / DEGREE)
    to_values = chebyshev.chebvander(points, DEGREE)
    twice = chebyshev.chebder(np.eye(DEGREE + 1), 2)
    second = 4.0 * chebyshev.chebvander(points, DEGREE - 2) @ twice @ np.linalg.inv(to_values)
    second = second[1:-1, 1:-1]  # d^2/dy^2 with u = 0 at the ends
    y = 0.5 * (points[1:-1] + 1.0)

    def longest_wave(frequency: float) -> complex:
        """``1/(zeta lambda)`` of the longest wave."""
        rate = 1j * frequency
        # 1/lambda u = (d^2/dy^2)^-1 [S (a S - zeta y)/(y (S + y))] u, a = 1/zeta_over_a, zeta = 1
        answer = rate * (rate / zeta_over_a - y) / (y * (rate + y))
        values = np.linalg.eigvals(np.linalg.solve(second, np.diag(answer)))
        return complex(values[np.argmax(values.real)])

    def negative(frequency: Array, _: NDArray) -> Array:
        return np.array([-longest_wave(at).imag for at in frequency])

    homogeneous = np.sqrt([zeta_over_a])  # the frequency of homogeneous sliding
    (frequency,) = roots(
        negative,
        np.array([LOWEST]),
        homogeneous,
        PRECISION,
    )
    found = longest_wave(frequency)
    return float(1.0 / (2.0 * np.pi * np.sqrt(found.real))), float(frequency)
