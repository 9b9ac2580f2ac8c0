"""The paper's formulas as they are printed, to be held against independent evaluations.

Nothing here is rearranged for accuracy; arguments are moderate. Lengths in units of 1/k
where only Hk matters.
"""

import math

import numpy as np

from ...model.linearised import InterfaceState
from ...types import Array, ComplexArray


def half_space_wavenumber(nu: float, modulus: float, at: InterfaceState) -> float:
    """k_c (1/m) of two identical half-spaces (Sect. 3)."""
    return 2.0 * (1.0 - nu) * at.zeta * at.normal_stress / modulus / at.slip_length


def bimaterial_modulus(psi: float, nu1: float, nu2: float) -> float:
    """M over the upper body's shear modulus (Eq. 8)."""
    beta = bimaterial_contrast(psi, nu1, nu2)
    return 2.0 * psi / (1.0 - beta**2) / (psi * (1.0 - nu1) + (1.0 - nu2))


def bimaterial_contrast(psi: float, nu1: float, nu2: float) -> float:
    """beta (Eq. 8)."""
    difference = psi * (1.0 - 2.0 * nu1) - (1.0 - 2.0 * nu2)
    return difference / (2.0 * (psi * (1.0 - nu1) + (1.0 - nu2)))


def bimaterial_transfer(psi: float, nu1: float, nu2: float) -> tuple[float, float]:
    """G1 and G2 of two half-spaces (Eq. 7)."""
    g1 = 0.5 * bimaterial_modulus(psi, nu1, nu2)
    return g1, bimaterial_contrast(psi, nu1, nu2) * g1


def bimaterial_ratio(f_beta: float, z: float) -> float:
    """L_c over L_c^M (Eq. 9), z = zeta/a."""
    root = math.sqrt((1.0 + z) ** 2 + 4.0 * z / f_beta**2)
    return (f_beta**2 * (1.0 + z - root) + 2.0 * z) / (2.0 * z)


def strengthening_threshold(a: float, zeta: float) -> float:
    """f beta of instability for zeta < 0 (Sect. 4)."""
    return 2.0 * math.sqrt(-a * zeta) / (a + zeta)


def block_transfer(q: float, nu: float) -> tuple[float, float]:
    """G1 and G2 of a block on a rigid base, q = Hk (Eq. 10)."""
    divisor = 2.0 * q**2 + (3.0 - 4.0 * nu) * math.cosh(2.0 * q) - 4.0 * nu * (3.0 - 2.0 * nu) + 5.0
    g1 = 4.0 * (1.0 - nu) * (2.0 * q + math.sinh(2.0 * q)) / divisor
    g2 = 4.0 * (q**2 + (1.0 - 2.0 * nu) * math.sinh(q) ** 2) / divisor
    return g1, g2


def response_matrix(q: float, nu: float) -> ComplexArray:
    """M of a layer, times k and the shear modulus (Eq. S-general_M)."""
    cross = 1j * (2.0 * q + (1.0 - 2.0 * nu) * math.sinh(2.0 * q))
    own = [-4.0 * (1.0 - nu) * part(q) ** 2 for part in (math.sinh, math.cosh)]
    matrix = np.array([[own[0], cross], [-cross, own[1]]], np.complex128)
    return matrix / (2.0 * (math.sinh(2.0 * q) - 2.0 * q))


def half_space_response(nu: float) -> ComplexArray:
    """The same for Hk -> infinity (Eq. S-M_inf)."""
    cross = 1j * (1.0 - 2.0 * nu)
    return np.array([[-2.0 * (1.0 - nu), cross], [-cross, -2.0 * (1.0 - nu)]], np.complex128) / 2.0


def block_field(q: float, y: Array, nu: float) -> ComplexArray:
    """(u_x, u_y) of a block on a rigid base at ``y/H``, amplitude one (Eq. S-sol_inf)."""
    sinh, cosh = np.sinh, np.cosh
    divisor = 2.0 * q + math.exp(2.0 * q) + 3.0 - 4.0 * nu
    u_x = 2.0 * (
        2.0 * q**2 * (y - 1.0) * cosh(q * y)
        + q * ((4.0 * nu - 3.0) * (y - 2.0) * sinh(q * y) - y * sinh(q * (y - 2.0)))
        + (4.0 * nu - 3.0) * cosh(q * (y - 2.0))
        + (4.0 * (3.0 - 2.0 * nu) * nu - 5.0) * cosh(q * y)
    )
    u_y = 1j * (
        4.0 * (q**2 * y + 4.0 * nu**2 - 6.0 * nu - q**2 + 2.0) * sinh(q * y)
        - 2.0 * q * y * ((3.0 - 4.0 * nu) * cosh(q * y) + cosh(q * (y - 2.0)))
    )
    return np.array([u_x, u_y], np.complex128) / divisor


def thin_length(height: float, nu: float, modulus: float, at: InterfaceState) -> float:
    """L_c (m) for Hk -> 0 (Eq. 11)."""
    weakening = at.zeta * (1.0 - nu) * at.normal_stress
    return 2.0 * math.pi * math.sqrt(2.0 * height * modulus * at.slip_length / weakening)
