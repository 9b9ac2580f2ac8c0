"""The conventional nucleation length (Eqs. 1-3) and other lengths of the literature.

The lengths of the literature are full lengths (not half-lengths) of patches between identical
half-spaces in plane strain, unless said otherwise, with ``mu* = mu/(1 - nu)``, ``b = a + zeta`` and
``D = ell`` (``g'(1) = -1`` for the aging and the slip law).
"""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ..elasticity import Material
from .critical import NoInstability
from .spectrum import InterfaceState
from .transfer import Array

CONVENTIONAL_ETA = (2.0 / math.pi, 4.0 / 3.0)
"""Range of the prefactor eta of Eq. (3) in the literature (Dieterich, 1992, Table 1)."""

LOCALISED_LIMIT = 0.3781
"""Largest a/b at which a patch of fixed length accelerates (Rubin and Ampuero, 2005)."""


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


def conventional_length(material: Material, interface: InterfaceState, eta: float) -> float:
    """Conventional critical length ``eta mu ell / (zeta sigma0)`` (m) (Eq. 3).

    `eta` lies in :data:`CONVENTIONAL_ETA`; :func:`homogeneous_sliding_eta` gives Eq. (6).

    Raises
    ------
    NoInstability
        Unless ``zeta > 0``.
    """
    zeta = _weakening(interface)
    return eta * material.shear_modulus * interface.slip_length / (zeta * interface.normal_stress)


def rice_ruina_length(material: Material, interface: InterfaceState) -> float:
    """``h* = (pi/4) mu* D / (zeta sigma0)`` (m).

    Source: linear stability of steady sliding, Rice and Ruina (1983), as a patch length in Lapusta
    and Liu (2009); a quarter of Eq. (6). Valid for ``zeta > 0``, near steady sliding, either
    evolution law. Raises NoInstability unless ``zeta > 0``.
    """
    return conventional_length(
        material, interface, 0.25 * homogeneous_sliding_eta(material.poisson_ratio)
    )


def state_evolution_length(material: Material, interface: InterfaceState) -> float:
    """``L_b = mu* D / (b sigma0)`` (m), the elastic length of state evolution.

    Source: Dieterich (1992); Rubin and Ampuero (2005). Valid far above steady state, where friction
    falls by ``b sigma0`` per slip D; to be resolved by any mesh. Raises NoInstability unless
    ``b = a + zeta > 0``.
    """
    b = interface.state_coefficient
    if b <= 0.0:
        raise NoInstability(f"b = a + zeta = {b:g} is not positive: friction does not evolve down")
    return _plane_modulus(material) * interface.slip_length / (b * interface.normal_stress)


def rubin_ampuero_localised_length(material: Material, interface: InterfaceState) -> float:
    """``2 x 1.3774 L_b`` (m): a patch of fixed length that accelerates.

    Source: Rubin and Ampuero (2005), ``2 L_nu``. Valid for the aging law and ``a/b < 0.3781``;
    raises ValueError outside.
    """
    ratio = _direct_over_state(interface)
    if not ratio < LOCALISED_LIMIT:
        raise ValueError(
            f"a/b = {ratio:g} is not allowed: a patch of fixed length needs a/b < {LOCALISED_LIMIT}"
        )
    return 2.0 * 1.3774 * state_evolution_length(material, interface)


def rubin_ampuero_crack_length(material: Material, interface: InterfaceState) -> float:
    """``(2/pi) mu* b D / (zeta^2 sigma0)`` (m): the largest size of an expanding patch.

    Source: Rubin and Ampuero (2005), ``2 L_infinity``, by a fracture energy balance. Valid for the
    aging law and ``1/2 < a/b < 1``; raises ValueError outside.
    """
    ratio = _direct_over_state(interface)
    if not 0.5 < ratio < 1.0:
        raise ValueError(
            f"a/b = {ratio:g} is not allowed: an expanding crack-like patch needs 1/2 < a/b < 1"
        )
    return 2.0 / math.pi / (1.0 - ratio) ** 2 * state_evolution_length(material, interface)


def uenishi_rice_length(material: Material, weakening_rate: float) -> float:
    """``1.158 mu* / W`` (m) under linear slip weakening at a rate W (Pa/m).

    Source: Uenishi and Rice (2003); independent of the shape of the load. Valid while strength
    falls linearly with slip all over the patch. Raises ValueError unless ``W > 0``.
    """
    if not weakening_rate > 0.0:
        raise ValueError(f"weakening_rate = {weakening_rate!r} Pa/m is not allowed: it must be > 0")
    return 1.158 * _plane_modulus(material) / weakening_rate


def thin_layer_length(height: ArrayLike, material: Material, interface: InterfaceState) -> Array:
    """``2 pi sqrt{2 mu H D / [(1 - nu) b sigma0]}`` (m): accelerating patch under a thin layer.

    Source: Viesca (2016), blow-up solutions with the elasticity of a layer of height H (m), stress
    free on top, on a rigid base. Valid for the aging law, ``a/b < 1/2`` and a length much larger
    than H; raises ValueError for a larger a/b. The linear counterpart is Eq. (11), with zeta in
    the place of b.
    """
    ratio = _direct_over_state(interface)
    if not ratio < 0.5:
        raise ValueError(f"a/b = {ratio:g} is not allowed: a thin-layer patch needs a/b < 1/2")
    height = np.asarray(height, dtype=float)
    return 2.0 * math.pi * np.sqrt(2.0 * height * state_evolution_length(material, interface))


def _plane_modulus(material: Material) -> float:
    """``mu* = mu/(1 - nu)`` (Pa)."""
    return material.shear_modulus / (1.0 - material.poisson_ratio)


def _direct_over_state(interface: InterfaceState) -> float:
    """``a/b``; infinite if friction does not evolve down."""
    b = interface.state_coefficient
    return interface.a / b if b > 0.0 else math.inf


def _weakening(interface: InterfaceState) -> float:
    """Zeta, raising NoInstability unless it is positive."""
    if interface.zeta <= 0.0:
        raise NoInstability(
            f"zeta = {interface.zeta:g} is not positive: the conventional length needs velocity "
            "weakening"
        )
    return interface.zeta
