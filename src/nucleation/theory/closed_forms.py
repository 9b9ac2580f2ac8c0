"""Closed forms of the paper: critical lengths of special systems."""

import math

import numpy as np
from numpy.typing import ArrayLike

from ..model.material import Material, in_plane_ratio
from ..types import Array
from .spectrum import marginal_stiffness
from .status import STABLE, NoLength
from .values import FaultLike


def bimaterial_contrast(upper: Material, lower: Material) -> float:
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


def bimaterial_length_ratio(f_beta: ArrayLike, zeta_over_a: ArrayLike) -> Array:
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


def thin_limit_length(height: ArrayLike, fault: FaultLike) -> Array:
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
