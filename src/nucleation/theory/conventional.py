"""The stiffnesses of the conventional approach (Eqs. 1-2) and its prefactor eta.

Their balance, Eq. (3), and other lengths of the literature: :mod:`nucleation.theory.literature`.
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ..model.linearised import InterfaceState
from ..model.material import Material
from .stiffness import Array

CONVENTIONAL_ETA = (2.0 / math.pi, 4.0 / 3.0)
"""Range of the prefactor eta of Eq. (3) in the literature (Dieterich, 1992, Table 1)."""


def homogeneous_sliding_eta(poisson_ratio: float) -> float:
    """The prefactor eta that Eq. (6) amounts to, ``pi/(1 - nu)``."""
    return math.pi / (1.0 - poisson_ratio)


def critical_spring_stiffness(normal_force: float, interface: InterfaceState) -> float:
    """Spring stiffness K_c (N/m) below which a rigid block slips unsteadily (Eq. 1).

    Parameters
    ----------
    normal_force : float
        F_N (N), compressive positive.
    interface : InterfaceState

    Notes
    -----
    ``K_c = zeta F_N / ell``; negative, so never undercut, for velocity strengthening.
    """
    return interface.zeta * normal_force / interface.slip_length


def effective_stiffness(length: ArrayLike, area: float, material: Material, eta: float) -> Array:
    """Stiffness ``eta mu A_n / L`` (N/m) of a patch of length L (m) and area A_n (m^2) (Eq. 2)."""
    return eta * material.shear_modulus * area / np.asarray(length, dtype=float)
