"""Closed forms of the paper: critical lengths of special systems."""

import math

import numpy as np
from numpy.typing import ArrayLike

from ..model.linearised import InterfaceState
from ..model.material import Material
from .critical import NoInstability
from .crossings import marginal_stiffness
from .stiffness import Array


def bimaterial_contrast(upper: Material, lower: Material) -> float:
    """The bimaterial contrast beta of two half-spaces (Eq. 8).

    Notes
    -----
    ``beta = [psi (1 - 2 nu1) - (1 - 2 nu2)] / {2 [psi (1 - nu1) + (1 - nu2)]}``, ``psi = mu2/mu1``.
    It changes sign when the bodies are exchanged and vanishes for identical ones. For a rigid lower
    body it is ``(1 - 2 nu1)/[2 (1 - nu1)]``, 1/4 for ``nu1 = 1/3``.
    """
    psi = lower.shear_modulus / upper.shear_modulus
    nu1, nu2 = upper.in_plane_ratio, lower.in_plane_ratio
    difference = psi * (1.0 - 2.0 * nu1) - (1.0 - 2.0 * nu2)
    return difference / (2.0 * (psi * (1.0 - nu1) + (1.0 - nu2)))


def bimaterial_length_ratio(f_beta: ArrayLike, zeta_over_a: ArrayLike) -> Array:
    """L_c of two half-spaces over ``L_c^M = pi M ell / (zeta sigma0)`` (Eq. 9, Fig. 2).

    Of f beta, of either sign, and zeta/a, which broadcast; negative with ``L_c^M`` for
    ``zeta < 0``, NaN where sliding is stable.

    Notes
    -----
    The paper's bracket subtracts nearly equal numbers for small ``zeta/a``. Times its conjugate
    it is ``zeta / h_plus`` with h_plus of :func:`.crossings.marginal_stiffness`, which adds
    positive numbers. Equally ``1 - |f beta|/w`` with ``w = |omega| ell / V`` the positive root of
    ``a w^2 - |f beta| (a + zeta) w - zeta = 0``.
    """
    z = np.asarray(zeta_over_a, dtype=float)
    with np.errstate(invalid="ignore"):  # 0/0 without coupling and weakening
        return z / marginal_stiffness(f_beta, 1.0, z)[1]


def thin_limit_length(height: ArrayLike, material: Material, interface: InterfaceState) -> Array:
    """L_c (m) of a block on a rigid base as ``Hk -> 0`` (Eq. 11), shape of the height (m).

    Raises
    ------
    NoInstability
        Unless ``zeta > 0``.
    """
    if interface.zeta <= 0.0:
        raise NoInstability(
            f"zeta = {interface.zeta:g} is not positive: without velocity weakening a thin layer "
            "slides stably"
        )
    modulus = material.shear_modulus / (1.0 - material.in_plane_ratio)
    weakening_length = interface.slip_length / (interface.zeta * interface.normal_stress)
    height = np.asarray(height, dtype=float)
    return 2.0 * math.pi * np.sqrt(2.0 * height * modulus * weakening_length)
