"""Closed forms of the paper: transfer functions and critical lengths of special systems."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import ArrayLike

from ..model.linearised import InterfaceState
from ..model.material import Material
from .critical import NoInstability
from .crossings import marginal_stiffness
from .stiffness import Array
from .transfer import RIGID, Body, as_wavenumber, transfer_functions


def identical_half_spaces(wavenumber: ArrayLike, poisson_ratio: float) -> tuple[Array, Array]:
    """G1 and G2 of two identical half-spaces, ``sign(k)/[2(1 - nu)]`` and 0 (Eq. S-G_gen)."""
    k = as_wavenumber(wavenumber)
    return np.sign(k) / (2.0 * (1.0 - poisson_ratio)), np.zeros_like(k)


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


def bimaterial_modulus(upper: Material, lower: Material) -> float:
    """The effective modulus ``M`` (Pa) of two half-spaces (Eq. 8), ``mu/(1 - nu)`` if identical."""
    psi = lower.shear_modulus / upper.shear_modulus
    nu1, nu2 = upper.in_plane_ratio, lower.in_plane_ratio
    beta = bimaterial_contrast(upper, lower)
    sum_ = psi * (1.0 - nu1) + (1.0 - nu2)
    return 2.0 * lower.shear_modulus / (1.0 - beta**2) / sum_


def bimaterial_half_spaces(
    wavenumber: ArrayLike, upper: Material, lower: Material
) -> tuple[Array, Array]:
    """G1 and G2 of two half-spaces, ``M sign(k)/(2 mu1)`` and ``beta M/(2 mu1)`` (Eq. 7)."""
    k = as_wavenumber(wavenumber)
    g1 = bimaterial_modulus(upper, lower) / (2.0 * upper.shear_modulus)
    return g1 * np.sign(k), np.full_like(k, bimaterial_contrast(upper, lower) * g1)


def block_on_rigid_base(
    wavenumber: ArrayLike, height: float, poisson_ratio: float
) -> tuple[Array, Array]:
    """G1 and G2 of a block of a height (m) on a rigid base, constant stress on top (Eq. 10).

    Free of overflow and cancellation for every ``Hk``.
    """
    block = Body(Material(poisson_ratio=poisson_ratio), height, "traction")
    return transfer_functions(wavenumber, block, RIGID)


def half_spaces_length(material: Material, interface: InterfaceState) -> float:
    """L_c (m) of two identical half-spaces, ``pi mu ell / [zeta (1 - nu) sigma0]`` (Eq. 6).

    Raises
    ------
    NoInstability
        Unless ``zeta > 0``.
    """
    modulus = material.shear_modulus / (1.0 - material.in_plane_ratio)
    return math.pi * modulus * _weakening_length(interface)


def bimaterial_length_ratio(f_beta: ArrayLike, zeta_over_a: ArrayLike) -> Array:
    """L_c of two half-spaces over ``L_c^M = pi M ell / (zeta sigma0)`` (Eq. 9, Fig. 2).

    Parameters
    ----------
    f_beta : array_like
        Friction coefficient times bimaterial contrast, of either sign.
    zeta_over_a : array_like
        Velocity weakening over direct effect; broadcast against `f_beta`.

    Returns
    -------
    ratio : ndarray
        Dimensionless; negative with ``L_c^M`` for ``zeta < 0``; NaN where sliding is stable.

    Notes
    -----
    The paper's bracket subtracts nearly equal numbers for small ``zeta/a``. Times its conjugate
    it is ``zeta / h_plus`` with h_plus of :func:`.crossings.marginal_stiffness`, which adds
    positive numbers. Equally ``1 - |f beta|/w`` with ``w = |omega| ell / V`` the positive root of
    ``a w^2 - |f beta| (a + zeta) w - zeta = 0``.
    """
    rho, z = np.broadcast_arrays(*(np.asarray(x, dtype=float) for x in (f_beta, zeta_over_a)))
    rho, b = np.abs(rho), 1.0 + z
    square = (rho * b) ** 2 + 4.0 * z
    unstable = (square >= 0.0) & (b > 0.0) & ((z != 0.0) | (rho != 0.0))
    root = np.sqrt(np.where(unstable, square, np.nan))
    twice_h_plus = (2.0 * z + rho**2 * b + rho * root) / (1.0 + rho**2)
    return 2.0 * z / twice_h_plus


def bimaterial_length(upper: Material, lower: Material, interface: InterfaceState) -> float:
    """L_c (m) of two half-spaces of different materials (Eq. 9), for either sign of zeta.

    Raises
    ------
    NoInstability
        For ``zeta <= 0`` below :func:`velocity_strengthening_threshold`.
    """
    f_beta = interface.friction * bimaterial_contrast(upper, lower)
    h_plus = float(marginal_stiffness(f_beta, interface.a, interface.zeta)[1])
    if not h_plus > 0.0:
        raise NoInstability(
            f"two half-spaces with f beta = {f_beta:g} slide stably for a = {interface.a:g}, "
            f"zeta = {interface.zeta:g}"
        )
    modulus = bimaterial_modulus(upper, lower)
    return math.pi * modulus * interface.slip_length / (h_plus * interface.normal_stress)


def thin_limit_length(height: ArrayLike, material: Material, interface: InterfaceState) -> Array:
    """L_c (m) of a block on a rigid base as ``Hk -> 0`` (Eq. 11), shape of the height (m).

    Raises
    ------
    NoInstability
        Unless ``zeta > 0``.
    """
    modulus = material.shear_modulus / (1.0 - material.in_plane_ratio)
    height = np.asarray(height, dtype=float)
    return 2.0 * math.pi * np.sqrt(2.0 * height * modulus * _weakening_length(interface))


def uncoupled_angular_frequency(interface: InterfaceState) -> float:
    """``omega = sqrt(zeta/a) V/ell`` (rad/s) of the marginal mode if ``G2 = 0`` (Text S1.4).

    Raises
    ------
    NoInstability
        Unless ``zeta > 0``.
    """
    _weakening_length(interface)
    rate = interface.velocity / interface.slip_length
    return math.sqrt(interface.zeta / interface.a) * rate


def velocity_strengthening_threshold(a: ArrayLike, zeta: ArrayLike) -> Array:
    """Least ``|f beta|`` of instability, ``2 sqrt(-a zeta)/(a + zeta)`` for ``zeta < 0`` (Sec. 4).

    Zero for ``zeta >= 0`` (any contrast will do) and infinite for ``a + zeta <= 0``.
    """
    a, zeta = np.broadcast_arrays(np.asarray(a, dtype=float), np.asarray(zeta, dtype=float))
    b = a + zeta
    bounded = 2.0 * np.sqrt(a * np.maximum(-zeta, 0.0)) / np.where(b > 0.0, b, 1.0)
    return np.where(b > 0.0, bounded, np.inf)


def _weakening_length(interface: InterfaceState) -> float:
    """``ell / (zeta sigma0)`` (m/Pa), raising NoInstability unless ``zeta > 0``."""
    if interface.zeta <= 0.0:
        raise NoInstability(
            f"zeta = {interface.zeta:g} is not positive: without velocity weakening this system "
            "slides stably"
        )
    return interface.slip_length / (interface.zeta * interface.normal_stress)
