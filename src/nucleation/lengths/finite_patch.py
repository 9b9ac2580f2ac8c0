"""Linear stability of sliding patches of a fixed length in a full space.

Slip ``u(x)`` on a patch ``|x| < h`` changes its stress by the crack operator,
``tau = -(mu*/h) K u``. With ``x = h cos(theta)`` it maps ``sin(n theta)`` to
``(n/2) sin(n theta)/sin(theta)``. Friction, linearised about steady sliding at a rate ``V(x)``,
decreases by the slip of a perturbation ``u exp(Lambda t)``, with either state law, by

    sigma0 b (u/D) [s - alpha s (1 + s)]/(1 + s) ,    s = Lambda D/V,  alpha = a/b .

Two unperturbed states slide steadily:

- an **asperity** whose surroundings creep at the constant rate V. The slip rate is uniform, and
  each mode of K is a spring block. The patch is unstable above the length at which the softest mode
  has the critical stiffness ``zeta sigma0/D``, ``zeta = b - a``. This eigenvalue is that of Uenishi
  and Rice (2003), so ``L = 1.158 mu* D/(zeta sigma0)`` for any a/b.
- a **loaded patch** between pinned ends, under a shear stress that rises steadily. Friction stays
  constant, so elasticity balances the load, and ``V(x) = V(0) sqrt(1 - (x/h)^2)``. The state
  evolves more slowly near the ends than in the middle, and the factor depends on a/b.

By our own derivation these are the two scenarios of the linear part of Viesca and Garagash (2025,
arXiv:2512.18729), as its abstract states them; their equations and fits are not used here.
"""

from functools import lru_cache
from typing import Any, cast

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from ..theory.roots import roots
from ..types import Array

TERMS = 24  # slip modes sin(n theta), n odd: the first instability is even in x
NODES = 200  # of the quadrature over theta
LOWEST = 1e-3  # frequency over that of a uniform slip rate at which a search begins
PRECISION = 1e-10  # of the frequency over V(0)/D
_DEGREE = 12  # of the polynomial in log(1 - a/b) through the logarithms of the computed factors
NEAREST = 0.99  # largest a/b of a loaded patch: closer to 1 the mode is confined to the middle


@lru_cache(maxsize=1)
def _basis() -> tuple[Array, Array, Array]:
    """n; sin(theta) at the nodes; ``sin(m theta) sin(n theta)`` times the weights, (node, m n)."""
    points, weights = np.polynomial.legendre.leggauss(NODES)
    theta = 0.5 * np.pi * (points + 1.0)
    n = 2 * np.arange(TERMS) + 1
    sines = np.sin(np.outer(n, theta))
    products = weights * sines[:, None] * sines[None]
    return n.astype(float), np.sin(theta), products.reshape(-1, NODES).T.astype(complex)


def marginal_loaded_patches(a_over_b: Array) -> Array:
    """``L zeta sigma0/(mu* D)`` at which loaded patches become unstable, for a/b in (0, 1), (n,).

    The softest mode has the largest ``1/(2 lambda)`` of ``K u = lambda answer u``, lambda over 1/h.
    """
    n, sine, products = _basis()

    def compliance(frequency: Array, index: NDArray) -> Array:
        rate = 1j * frequency[:, None]
        answer = rate * sine / (rate + sine) - rate * a_over_b[index, None]
        values = np.linalg.eigvals((answer @ products).reshape(-1, n.size, n.size) / n[:, None])
        softest = np.argmax(values.real, axis=1)
        return values[np.arange(softest.size), softest]

    def negative(frequency: Array, index: NDArray) -> Array:
        return -compliance(frequency, index).imag / frequency

    uniform = np.sqrt((1.0 - a_over_b) / a_over_b)  # the frequency of a uniform slip rate V(0)
    frequency = roots(negative, LOWEST * uniform, uniform, PRECISION)
    return (1.0 - a_over_b) / compliance(frequency, np.arange(frequency.size)).real


@lru_cache(maxsize=1)
def polynomial() -> Array:
    """Chebyshev coefficients of the factor's logarithm, over a scaled log(1 - a/b) in (-1, 1)."""
    points = np.cos(np.pi * (np.arange(_DEGREE + 1) + 0.5) / (_DEGREE + 1))
    ratios = 1.0 - np.exp(0.5 * (1.0 + points) * np.log(1.0 - NEAREST))
    factors = marginal_loaded_patches(ratios)
    return cast(Array, chebyshev.chebfit(points, np.log(factors), _DEGREE))


def loaded_patch_factor(a_over_b: Any) -> Any:
    """``L zeta sigma0/(mu* D)`` of a loaded patch with a/b from 0 to :data:`NEAREST`."""
    # -1 without direct effect, 1 at NEAREST
    scaled = 2.0 * np.log(1.0 - a_over_b) / np.log(1.0 - NEAREST) - 1.0
    return np.exp(chebyshev.chebval(scaled, polynomial()))
