"""The paper's formulas as they are printed, to be compared with the library.

No formula is rearranged for accuracy: arguments are moderate. Where only ``q = Hk`` matters,
lengths are in units of 1/k. ``psi`` is the shear modulus of the lower body over the upper one's,
``nu`` Poisson's ratio in the plane.
"""

import math

import numpy as np

from nucleation.types import Array, ComplexArray


def bimaterial_transfer(psi: float, nu1: float, nu2: float) -> tuple[float, float]:
    """G1 and G2 of two half-spaces (Eq. 7), with beta and M over the upper modulus (Eq. 8)."""
    compliance = psi * (1.0 - nu1) + (1.0 - nu2)
    difference = psi * (1.0 - 2.0 * nu1) - (1.0 - 2.0 * nu2)
    beta = difference / (2.0 * compliance)
    modulus = 2.0 * psi / (1.0 - beta**2) / compliance
    g1 = 0.5 * modulus
    return g1, beta * g1


def bimaterial_ratio(f_beta: float, z: float) -> float:
    """L_c over L_c^M (Eq. 9), for a zeta/a."""
    square = f_beta**2
    root = math.sqrt((1.0 + z) ** 2 + 4.0 * z / square)
    numerator = square * (1.0 + z - root) + 2.0 * z
    return numerator / (2.0 * z)


def friction_perturbation(rate: ComplexArray, a: float, zeta: float) -> ComplexArray:
    """Change of friction by a slip of ell, for rates over V/ell (Eq. S-delta_f)."""
    return rate * (a * rate - zeta) / (1.0 + rate)


def strengthening_threshold(a: float, zeta: float) -> float:
    """The f beta from which sliding is unstable, for zeta < 0 (Sect. 4)."""
    return 2.0 * math.sqrt(-a * zeta) / (a + zeta)


def block_transfer(q: float, nu: float) -> tuple[float, float]:
    """G1 and G2 of a block on a rigid base (Eq. 10)."""
    constant = 4.0 * nu * (3.0 - 2.0 * nu)
    growing = (3.0 - 4.0 * nu) * math.cosh(2.0 * q)
    divisor = 2.0 * q**2 + growing - constant + 5.0
    shear = 2.0 * q + math.sinh(2.0 * q)
    normal = q**2 + (1.0 - 2.0 * nu) * math.sinh(q) ** 2
    return 4.0 * (1.0 - nu) * shear / divisor, 4.0 * normal / divisor


def response_matrix(q: float, nu: float) -> ComplexArray:
    """M of a layer, times k and the shear modulus, (2, 2) (Eq. S-general_M)."""
    sinh = math.sinh(2.0 * q)
    cross = 1j * (2.0 * q + (1.0 - 2.0 * nu) * sinh)
    own = -4.0 * (1.0 - nu)
    tangential = own * math.sinh(q) ** 2
    normal = own * math.cosh(q) ** 2
    return np.array([[tangential, cross], [-cross, normal]], np.complex128) / (
        2.0 * (sinh - 2.0 * q)
    )


def half_space_response(nu: float) -> ComplexArray:
    """M of a half-space, the limit Hk -> infinity (Eq. S-M_inf)."""
    cross = 1j * (1.0 - 2.0 * nu)
    own = -2.0 * (1.0 - nu)
    return np.array([[own, cross], [-cross, own]], np.complex128) / 2.0


def block_field(q: float, y: Array, nu: float) -> ComplexArray:
    """u_x and u_y of a block on a rigid base at y over H, up to an amplitude (Eq. S-sol_inf)."""
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

    factor = q**2 * y + 4.0 * nu**2 - 6.0 * nu
    factor = factor - q**2 + 2.0
    odd = 4.0 * factor * np.sinh(near)
    even = (3.0 - 4.0 * nu) * np.cosh(near) + np.cosh(far)
    u_y = odd - 2.0 * q * y * even
    return np.array([2.0 * u_x, 1j * u_y], np.complex128) / divisor
