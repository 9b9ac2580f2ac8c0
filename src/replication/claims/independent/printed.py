"""The paper's formulas as they are printed, for comparison with independent evaluations.

No formula is rearranged for accuracy: arguments are moderate. Where only ``q = Hk`` matters,
lengths are in units of 1/k.
"""

import math
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from nucleation.model.linearised import InterfaceState
from nucleation.types import Array, ComplexArray


def over_formula(
    ours: Callable[..., Any],
    formula: Callable[..., Any],
    cases: Iterable[tuple[float, ...]],
) -> Array:
    """Our numbers over a printed formula's.

    Parameters
    ----------
    ours, formula : callable
        Our evaluation and the formula, with the same arguments: one number, or G1 and G2.
    cases : iterable of tuple
        Arguments.

    Returns
    -------
    array, shape (cases,) or (cases, 2)
    """
    return np.array([np.divide(ours(*case), formula(*case)) for case in cases])


def half_space_wavenumber(
    nu: float,
    modulus: float,
    at: InterfaceState,
) -> float:
    """k_c of two identical half-spaces (Sect. 3).

    Parameters
    ----------
    nu : float
        Poisson's ratio in the plane.
    modulus : float
        Shear modulus (Pa).
    at : InterfaceState
        Friction and its derivatives at V.

    Returns
    -------
    float
        Wavenumber (1/m).
    """
    load = 2.0 * (1.0 - nu) * at.zeta * at.normal_stress
    return load / modulus / at.slip_length


def bimaterial_modulus(
    psi: float,
    nu1: float,
    nu2: float,
) -> float:
    """M over the upper body's shear modulus (Eq. 8).

    Parameters
    ----------
    psi : float
        Shear modulus of the lower body over the upper body's.
    nu1, nu2 : float
        Poisson's ratio of the upper and of the lower body.
    """
    beta = bimaterial_contrast(psi, nu1, nu2)
    compliance = psi * (1.0 - nu1) + (1.0 - nu2)
    return 2.0 * psi / (1.0 - beta**2) / compliance


def bimaterial_contrast(
    psi: float,
    nu1: float,
    nu2: float,
) -> float:
    """beta (Eq. 8).

    Parameters
    ----------
    psi, nu1, nu2 : float
        As in :func:`bimaterial_modulus`.
    """
    difference = psi * (1.0 - 2.0 * nu1) - (1.0 - 2.0 * nu2)
    compliance = psi * (1.0 - nu1) + (1.0 - nu2)
    return difference / (2.0 * compliance)


def bimaterial_transfer(
    psi: float,
    nu1: float,
    nu2: float,
) -> tuple[float, float]:
    """G1 and G2 of two half-spaces (Eq. 7).

    Parameters
    ----------
    psi, nu1, nu2 : float
        As in :func:`bimaterial_modulus`.
    """
    g1 = 0.5 * bimaterial_modulus(psi, nu1, nu2)
    g2 = bimaterial_contrast(psi, nu1, nu2) * g1
    return g1, g2


def bimaterial_ratio(
    f_beta: float,
    z: float,
) -> float:
    """L_c over L_c^M (Eq. 9).

    Parameters
    ----------
    f_beta : float
        Friction coefficient times beta.
    z : float
        zeta/a.
    """
    square = f_beta**2
    root = math.sqrt((1.0 + z) ** 2 + 4.0 * z / square)
    dividend = square * (1.0 + z - root) + 2.0 * z
    return dividend / (2.0 * z)


def strengthening_threshold(
    a: float,
    zeta: float,
) -> float:
    """The f beta from which sliding is unstable, for zeta < 0 (Sect. 4).

    Parameters
    ----------
    a, zeta : float
        Direct effect and velocity weakening.
    """
    return 2.0 * math.sqrt(-a * zeta) / (a + zeta)


def block_transfer(
    q: float,
    nu: float,
) -> tuple[float, float]:
    """G1 and G2 of a block on a rigid base (Eq. 10).

    Parameters
    ----------
    q : float
        Hk.
    nu : float
        Poisson's ratio in the plane.
    """
    constant = 4.0 * nu * (3.0 - 2.0 * nu)
    growing = (3.0 - 4.0 * nu) * math.cosh(2.0 * q)
    divisor = 2.0 * q**2 + growing - constant + 5.0
    shear = 2.0 * q + math.sinh(2.0 * q)
    g1 = 4.0 * (1.0 - nu) * shear / divisor
    normal = q**2 + (1.0 - 2.0 * nu) * math.sinh(q) ** 2
    g2 = 4.0 * normal / divisor
    return g1, g2


def response_matrix(
    q: float,
    nu: float,
) -> ComplexArray:
    """M of a layer, times k and the shear modulus (Eq. S-general_M).

    Parameters
    ----------
    q : float
        Hk.
    nu : float
        Poisson's ratio in the plane.

    Returns
    -------
    array, shape (2, 2)
    """
    sinh = math.sinh(2.0 * q)
    cross = 1j * (2.0 * q + (1.0 - 2.0 * nu) * sinh)
    own = -4.0 * (1.0 - nu)
    tangential = own * math.sinh(q) ** 2
    normal = own * math.cosh(q) ** 2
    matrix = np.array(
        [
            [tangential, cross],
            [-cross, normal],
        ],
        np.complex128,
    )
    return matrix / (2.0 * (sinh - 2.0 * q))


def half_space_response(nu: float) -> ComplexArray:
    """M of a half-space, the limit Hk -> infinity (Eq. S-M_inf)."""
    cross = 1j * (1.0 - 2.0 * nu)
    own = -2.0 * (1.0 - nu)
    matrix = np.array(
        [
            [own, cross],
            [-cross, own],
        ],
        np.complex128,
    )
    return matrix / 2.0


def block_field(
    q: float,
    y: Array,
    nu: float,
) -> ComplexArray:
    """Displacement of a block on a rigid base, up to its amplitude (Eq. S-sol_inf).

    Parameters
    ----------
    q : float
        Hk.
    y : array, shape (points,)
        Distance from the interface over H.
    nu : float
        Poisson's ratio in the plane.

    Returns
    -------
    array, shape (2, points)
        u_x and u_y.
    """
    kolosov = 4.0 * nu - 3.0
    near = q * y
    far = q * (y - 2.0)
    divisor = 2.0 * q + math.exp(2.0 * q) + 3.0 - 4.0 * nu

    quadratic = 2.0 * q**2 * (y - 1.0) * np.cosh(near)
    linear = kolosov * (y - 2.0) * np.sinh(near)
    linear = q * (linear - y * np.sinh(far))
    outer = kolosov * np.cosh(far)
    constant = 4.0 * (3.0 - 2.0 * nu) * nu - 5.0
    inner = constant * np.cosh(near)
    u_x = quadratic + linear + outer + inner

    factor = q**2 * y + 4.0 * nu**2 - 6.0 * nu - q**2 + 2.0
    odd = 4.0 * factor * np.sinh(near)
    even = (3.0 - 4.0 * nu) * np.cosh(near) + np.cosh(far)
    u_y = odd - 2.0 * q * y * even

    field = np.array([2.0 * u_x, 1j * u_y], np.complex128)
    return field / divisor


def thin_length(
    height: float,
    nu: float,
    modulus: float,
    at: InterfaceState,
) -> float:
    """L_c for Hk -> 0 (Eq. 11).

    Parameters
    ----------
    height : float
        Height of the block (m).
    nu : float
        Poisson's ratio in the plane.
    modulus : float
        Shear modulus (Pa).
    at : InterfaceState
        Friction and its derivatives at V.

    Returns
    -------
    float
        Length (m).
    """
    weakening = at.zeta * (1.0 - nu) * at.normal_stress
    squared = 2.0 * height * modulus * at.slip_length / weakening
    return 2.0 * math.pi * math.sqrt(squared)
