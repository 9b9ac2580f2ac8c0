"""Nucleation lengths in use in the literature, of numbers, arrays or DataArrays.

All are full lengths (not half-lengths), in plane strain, with ``mu* = mu/(1 - nu)``,
``b = a + zeta`` and ``zeta = b - a``; a and b belong to **natural** logarithms. SI units. What is
computed outside its range of validity is NaN. In plane stress nu is to be ``nu/(1 + nu)``. The list
of them with formulas and sources in words is :mod:`nucleation.theory.literature_table`.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from .fault import Values, where
from .finite_patch import NEAREST, loaded_patch_factor

CONVENTIONAL_ETA = (2.0 / math.pi, 4.0 / 3.0)
"""Range of the prefactor eta of Eq. (3) (Dieterich, 1992, Table 1)."""

LOCALISED_LIMIT = 0.3781
"""Largest a/b at which a patch of fixed length accelerates (Rubin and Ampuero, 2005)."""

THIN = 0.3
"""Largest ``2 pi H/L`` at which a layer counts as thin: Eq. (11) is then 8 % above the theory."""


FINITE_PATCH = 1.158
"""Least unstable length, in ``mu*/W``, of a patch that weakens by W per slip (Uenishi-Rice)."""

NEGLIGIBLE = 0.1
"""Largest a/b of a law whose direct effect is left out, and largest ``f |beta|`` of a pair whose
coupling of slip to normal stress is: a tenth of what is kept."""


def plane_strain_modulus(shear_modulus: Values, poisson_ratio: Values) -> Any:
    """``mu* = mu/(1 - nu)`` (Pa) for mu (Pa)."""
    return shear_modulus / (1.0 - poisson_ratio)


def conventional_length(
    eta: Values, shear_modulus: Values, normal_stress: Values, zeta: Values, slip_distance: Values
) -> Any:
    """Conventional critical length ``eta mu D/(zeta sigma0)`` (m) of a spring block (Eq. 3).

    The patch's stiffness per area ``eta mu/L`` (Eq. 2) undercuts the critical one,
    ``K_c/A = zeta sigma0/D`` (Eq. 1). eta depends on the crack model, 2/pi to 4/3 in the
    literature (Dieterich, 1992, Table 1). Valid for ``zeta > 0``.

    Parameters
    ----------
    eta, zeta : array_like
        Dimensionless.
    shear_modulus, normal_stress : array_like
        Pa.
    slip_distance : array_like
        D (m).
    """
    return _where(zeta > 0.0, eta * shear_modulus * slip_distance / (_nan0(zeta) * normal_stress))


def dieterich_shortest_length(
    shear_modulus: Values, normal_stress: Values, zeta: Values, slip_distance: Values
) -> Any:
    """Eq. (3) with the smallest prefactor in use, ``eta = 2/pi`` (Dieterich, 1992, Table 1)."""
    return conventional_length(
        CONVENTIONAL_ETA[0], shear_modulus, normal_stress, zeta, slip_distance
    )


def dieterich_longest_length(
    shear_modulus: Values, normal_stress: Values, zeta: Values, slip_distance: Values
) -> Any:
    """Eq. (3) with the largest prefactor in use, ``eta = 4/3`` (Dieterich, 1992, Table 1)."""
    return conventional_length(
        CONVENTIONAL_ETA[1], shear_modulus, normal_stress, zeta, slip_distance
    )


def homogeneous_sliding_length(
    shear_modulus: Values,
    poisson_ratio: Values,
    normal_stress: Values,
    zeta: Values,
    slip_distance: Values,
) -> Any:
    """``pi mu* D/(zeta sigma0)`` (m), the theory for two identical half-spaces (Eq. 6).

    Eq. (3) with ``eta = pi/(1 - nu)``. Valid for ``zeta > 0``, near steady sliding, either law.
    """
    eta = math.pi / (1.0 - poisson_ratio)
    return conventional_length(eta, shear_modulus, normal_stress, zeta, slip_distance)


def rice_ruina_length(
    shear_modulus: Values,
    poisson_ratio: Values,
    normal_stress: Values,
    zeta: Values,
    slip_distance: Values,
) -> Any:
    """``h* = (pi/4) mu* D/(zeta sigma0)`` (m).

    Source: linear stability of steady sliding, ``K < K_c``, Rice and Ruina (1983), as a patch
    length in Lapusta and Liu (2009); a quarter of Eq. (6). Valid for ``zeta > 0``, either law.
    """
    eta = 0.25 * math.pi / (1.0 - poisson_ratio)
    return conventional_length(eta, shear_modulus, normal_stress, zeta, slip_distance)


def state_evolution_length(
    shear_modulus: Values,
    poisson_ratio: Values,
    normal_stress: Values,
    b: Values,
    slip_distance: Values,
) -> Any:
    """``L_b = mu* D/(b sigma0)`` (m), the elastic length of state evolution.

    Source: Dieterich (1992); Rubin and Ampuero (2005). Valid far above steady state, where
    friction falls by ``b sigma0`` per slip D, for ``b > 0``; a mesh has to resolve it.
    """
    modulus = plane_strain_modulus(shear_modulus, poisson_ratio)
    return _where(b > 0.0, modulus * slip_distance / (_nan0(b) * normal_stress))


def rubin_ampuero_localised_length(
    shear_modulus: Values,
    poisson_ratio: Values,
    normal_stress: Values,
    a: Values,
    b: Values,
    slip_distance: Values,
) -> Any:
    """``2 x 1.3774 L_b`` (m): a patch of fixed length that accelerates.

    Source: Rubin and Ampuero (2005), ``2 L_nu``. Valid for the aging law and ``a/b < 0.3781``.
    """
    length = state_evolution_length(shear_modulus, poisson_ratio, normal_stress, b, slip_distance)
    return _where(a < LOCALISED_LIMIT * b, 2.0 * 1.3774 * length)


def rubin_ampuero_crack_length(
    shear_modulus: Values,
    poisson_ratio: Values,
    normal_stress: Values,
    a: Values,
    b: Values,
    slip_distance: Values,
) -> Any:
    """``(2/pi) mu* b D/[(b - a)^2 sigma0]`` (m): the largest size of an expanding patch.

    Source: Rubin and Ampuero (2005), ``2 L_infinity``, by a fracture energy balance. Valid for
    the aging law and ``1/2 < a/b < 1``.
    """
    length = state_evolution_length(shear_modulus, poisson_ratio, normal_stress, b, slip_distance)
    return _where((a > 0.5 * b) & (a < b), 2.0 / math.pi * _nan0((b - a) / b) ** -2 * length)


def uenishi_rice_length(
    shear_modulus: Values, poisson_ratio: Values, weakening_rate: Values
) -> Any:
    """``1.158 mu*/W`` (m) under linear slip weakening at a rate W (Pa/m).

    Source: Uenishi and Rice (2003); independent of the shape of the load. Valid while strength
    falls linearly with slip all over the patch, ``W > 0``. Far above steady state the aging law
    weakens at ``W = b sigma0/D``, which makes it ``1.158 L_b``, as long as its direct effect is
    negligible: where a/b is .3 a patch has to be more than twice as long to accelerate.
    """
    modulus = plane_strain_modulus(shear_modulus, poisson_ratio)
    return _where(weakening_rate > 0.0, FINITE_PATCH * modulus / _nan0(weakening_rate))


def creeping_asperity_length(
    shear_modulus: Values,
    poisson_ratio: Values,
    normal_stress: Values,
    zeta: Values,
    slip_distance: Values,
) -> Any:
    """``1.158 mu* D/(zeta sigma0)`` (m): an asperity whose surroundings creep on at its own rate.

    Source: the first scenario of Viesca and Garagash (2025, arXiv:2512.18729) by our derivation
    (:mod:`.finite_patch`): each elastic mode of a patch of fixed length is a spring block, and the
    softest is that of Uenishi and Rice (2003) with ``W = zeta sigma0/D``. Linear, quasi-static,
    exact for any a/b < 1; either law. 0.369 of Eq. (6). Valid for ``zeta > 0``.
    """
    eta = FINITE_PATCH / (1.0 - poisson_ratio)
    return conventional_length(eta, shear_modulus, normal_stress, zeta, slip_distance)


def loaded_patch_length(
    shear_modulus: Values,
    poisson_ratio: Values,
    normal_stress: Values,
    a: Values,
    b: Values,
    slip_distance: Values,
) -> Any:
    """``C(a/b) mu* D/(zeta sigma0)`` (m): a patch with pinned ends under a steadily rising load.

    Source: the second scenario of Viesca and Garagash (2025, arXiv:2512.18729) by our derivation
    and computation (:mod:`.finite_patch`), not their algebraic fit. C is 1.158 without a direct
    effect, 1.24 at a/b = 0.5 and 2.87 at 0.99, as slip is slower towards the ends, where the state
    lags behind. Linear, quasi-static; either law. Valid for ``0 < a/b < 0.99``.
    """
    length = state_evolution_length(shear_modulus, poisson_ratio, normal_stress, b, slip_distance)
    valid = (a > 0.0) & (a < NEAREST * b)
    part = where(valid, a / _nan0(b), 0.5)
    return _where(valid, loaded_patch_factor(part) / (1.0 - part) * length)


def bimaterial(
    shear_modulus: Values,
    poisson_ratio: Values,
    second_shear_modulus: Values,
    second_poisson_ratio: Values,
) -> tuple[Any, Any]:
    """Modulus M (Pa) and contrast beta of two half-spaces (Eq. 8), the second one perhaps rigid.

    Slip on their interface changes the shear stress as between two half-spaces of one material
    with ``mu* = M``, and the normal stress by beta times as much, a quarter wavelength apart
    (Eq. 7). For identical materials M is ``mu*`` and beta vanishes.
    """
    softness = shear_modulus / second_shear_modulus  # 1/psi, 0 for a rigid second body
    nu, nu2 = poisson_ratio, second_poisson_ratio
    total = (1.0 - nu) + (1.0 - nu2) * softness
    beta = 0.5 * ((1.0 - 2.0 * nu) - (1.0 - 2.0 * nu2) * softness) / total
    return 2.0 * shear_modulus / ((1.0 - beta**2) * total), beta


def thin_limit_length(
    shear_modulus: Values,
    poisson_ratio: Values,
    normal_stress: Values,
    zeta: Values,
    slip_distance: Values,
    height: Values,
) -> Any:
    """``2 pi sqrt{2 mu* H D/(zeta sigma0)}`` (m), the theory as ``Hk -> 0`` (Eq. 11).

    For a layer of height H (m) on a rigid body, constant stress on its far side. Valid for
    ``zeta > 0`` and ``2 pi H/L < 0.3``; there it is up to 8 % above the full theory (paper's
    friction).
    """
    length = rice_ruina_length(shear_modulus, poisson_ratio, normal_stress, zeta, slip_distance)
    return _thin(2.0 * math.pi * np.sqrt(2.0 * height * length * 4.0 / math.pi), height)


def thin_layer_length(
    shear_modulus: Values,
    poisson_ratio: Values,
    normal_stress: Values,
    a: Values,
    b: Values,
    slip_distance: Values,
    height: Values,
) -> Any:
    """``2 pi sqrt{2 mu* H D/(b sigma0)}`` (m): accelerating patch under a thin layer.

    Source: Viesca (2016), blow-up solutions with the elasticity of a layer of height H (m),
    stress free on top, on a rigid base. Valid for the aging law, ``a/b < 1/2`` and
    ``2 pi H/L < 0.3``. The linear counterpart is Eq. (11), with zeta in the place of b.
    """
    length = state_evolution_length(shear_modulus, poisson_ratio, normal_stress, b, slip_distance)
    return _thin(_where(a < 0.5 * b, 2.0 * math.pi * np.sqrt(2.0 * height * length)), height)


def _where(condition: Any, values: Any) -> Any:
    """The values where the condition holds, NaN elsewhere; arrays or DataArrays."""
    return where(condition, values, np.nan)


def _nan0(values: Any) -> Any:
    """The values, NaN in place of zero, which nothing may be divided by."""
    return where(values != 0.0, values, np.nan)


def _thin(length: Any, height: Values) -> Any:
    """The lengths of a layer (m) where it is thin."""
    return _where(2.0 * math.pi * height < THIN * length, length)
