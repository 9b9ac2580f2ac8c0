"""Marginal points: where a mode of homogeneous sliding neither grows nor decays.

At a marginal point ``Lambda = i omega``. With ``w = omega ell / V``, ``b = a + zeta`` and

    g(k) = mu |k| ell |G1| / sigma0,    rho(k) = f G2 / |G1| ,

the real and imaginary parts of Eq. (5), Eq. (S-ReIm), read ``g = b w^2/(1 + w^2)`` and
``rho g = w (a w^2 - zeta)/(1 + w^2)``. Their quotient ``a w^2 - rho b w - zeta = 0`` gives w, and
eliminating w leaves a quadratic in g,

    (g - zeta)^2 = rho^2 g (b - g) ,    0 < g < b ,

with roots ``h_minus(rho) <= h_plus(rho)``, one for either sign of omega when ``zeta > 0``.
Sliding is stable for ``g > h_plus``; for velocity strengthening, ``zeta < 0``, also for
``g < h_minus`` and wherever the roots are not real, ``rho^2 b^2 < -4 a zeta``.
"""

import numpy as np

from .spectrum import Systems
from .stiffness import Array


def marginal_stiffness(
    rho: Array | float,
    a: Array | float,
    zeta: Array | float,
) -> tuple[Array, Array]:
    """The roots ``h_minus <= h_plus`` of ``(g - zeta)^2 = rho^2 g (a + zeta - g)``.

    Returns: Broadcast shape; NaN where they are not real or ``a + zeta <= 0``. Even in rho; h_plus
    grows with ``|rho|``.
    """
    rho = np.abs(np.asarray(rho, dtype=float))
    b = a + zeta
    discriminant = (rho * b) ** 2 + 4.0 * a * zeta
    real = (discriminant >= 0.0) & (b > 0.0)
    root = np.sqrt(np.where(real, discriminant, np.nan))
    leading = 1.0 + rho**2
    plus = (2.0 * zeta + rho**2 * b + rho * root) / (2.0 * leading)
    with np.errstate(divide="ignore", invalid="ignore"):
        product_over_plus = zeta**2 / (leading * plus)
    minus = np.where(plus > 0.0, product_over_plus, plus)
    return minus, plus


def stability_margin(
    systems: Systems,
    k: Array,
) -> Array:
    """Negative where a mode grows, positive where none does, continuous in k.

    Takes k (1/m). Returns: The margin, dimensionless, shape (n,).
    """
    g, rho = systems.load_and_coupling(k)
    zeta = systems.zeta
    strengthening = (g - zeta) ** 2 - rho**2 * g * (systems.b - g)
    with np.errstate(invalid="ignore"):
        _, h_plus = marginal_stiffness(rho, systems.a, zeta)
        weakening = g - h_plus
    return np.where(zeta < 0.0, strengthening, weakening)


def marginal_frequencies(
    systems: Systems,
    k: Array,
) -> Array:
    """omega at marginal wavenumbers: the root of ``a w^2 - rho b w - zeta = 0`` that fits g.

    Takes k (1/m). Returns: Angular frequencies (rad/s), shape (n,). If ``G2 = 0`` both signs are
    marginal, and the positive one is given.
    """
    a, zeta, b = systems.a, systems.zeta, systems.b
    g, rho = systems.load_and_coupling(k)
    discriminant = (rho * b) ** 2 + 4.0 * a * zeta
    root = np.sqrt(np.maximum(discriminant, 0.0))
    size = (np.abs(rho) * b + root) / (2.0 * a)
    sign = np.where(rho == 0.0, 1.0, rho)
    large = np.copysign(size, sign)
    small = -zeta / (a * large)

    def misfit(w: Array) -> Array:
        return np.abs(b * w**2 / (1.0 + w**2) - g)

    return (
        np.where(
            misfit(large) <= misfit(small),
            large,
            small,
        )
        * systems.rate
    )
