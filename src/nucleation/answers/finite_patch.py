"""Linear stability of sliding patches of a fixed length in a full space, with nothing beyond them.

Slip ``u(x)`` on a patch ``|x| < h`` loads it by the crack operator, ``tau = -(mu*/h) K u``, which
with ``x = h cos(theta)`` takes ``sin(n theta)`` to ``(n/2) sin(n theta)/sin(theta)``. Friction,
linearised about steady sliding at a rate ``V(x)``, weakens by the slip of a perturbation
``u exp(Lambda t)``, with either state law, by

    sigma0 b (u/D) [s - alpha s (1 + s)]/(1 + s) ,    s = Lambda D/V,  alpha = a/b .

Two base states slide steadily:

- an **asperity** whose surroundings creep at the same V, and keep to it: V is uniform, each mode of
  K is a spring block, and the patch is unstable from the length on at which the softest one has the
  critical stiffness ``zeta sigma0/D``, ``zeta = b - a``. That eigenvalue is the one of Uenishi and
  Rice (2003), so ``L = 1.158 mu* D/(zeta sigma0)``, whatever a/b.
- a **loaded patch** between ends that do not slip, under a shear stress that rises steadily:
  friction stays as it is, so elasticity takes up the load, and ``V(x) = V(0) sqrt(1 - (x/h)^2)``.
  The outer parts forget more slowly than the middle, and the factor depends on a/b.

These are, by our own derivation, the two scenarios of the linear part of Viesca and Garagash (2025,
arXiv:2512.18729) as its abstract states them; neither their equations nor their fits are used here.
"""

from functools import lru_cache
from typing import Any

import numpy as np
from numpy.polynomial import chebyshev
from numpy.typing import NDArray

from ..types import Array

TERMS = 24  # slip modes sin(n theta), n odd: the first instability is even in x
NODES = 200  # of the quadrature over theta
DEGREE = 12  # of the polynomial in log(1 - a/b) through the logarithms of the computed factors
NEAREST = 0.99  # largest a/b of a loaded patch: nearer to 1 its mode shrinks to the patch's middle


@lru_cache(maxsize=1)
def _basis() -> tuple[Array, Array, Array]:
    """n; sin(theta) at the nodes; ``sin(m theta) sin(n theta)`` times the weights, (m, n, node)."""
    points, weights = np.polynomial.legendre.leggauss(NODES)
    theta = 0.5 * np.pi * (points + 1.0)
    n = 2 * np.arange(TERMS) + 1
    sines = np.sin(np.outer(n, theta))
    return n.astype(float), np.sin(theta), weights * sines[:, None] * sines[None]


def softest(answer: NDArray) -> complex:
    """Largest ``1/(2 lambda)`` at which ``K u = lambda answer u``, lambda in units of 1/h.

    `answer` is friction's per ``u/sin(theta)``, at the nodes of theta.
    """
    n, _, products = _basis()
    values = np.linalg.eigvals((products @ answer) / n[:, None])
    return complex(values[np.argmax(values.real)])


def marginal_loaded_patch(a_over_b: float) -> float:
    """``L zeta sigma0/(mu* D)`` at which a loaded patch loses stability, for a/b in (0, 1)."""
    _, sine, _ = _basis()

    def compliance(frequency: float) -> complex:
        rate = 1j * frequency
        return softest(rate * sine / (rate + sine) - rate * a_over_b)

    low, high = 0.0, np.sqrt((1.0 - a_over_b) / a_over_b)  # that of a uniform V(0)
    while high - low > 1e-9 * high:
        middle = 0.5 * (low + high)
        low, high = (middle, high) if compliance(middle).imag > 0.0 else (low, middle)
    return (1.0 - a_over_b) / compliance(high).real


@lru_cache(maxsize=1)
def polynomial() -> Array:
    """Chebyshev coefficients of the factor's logarithm, over nearness to neutral from -1 to 1."""
    points = np.cos(np.pi * (np.arange(DEGREE + 1) + 0.5) / (DEGREE + 1))
    ratios = 1.0 - np.exp(0.5 * (1.0 + points) * np.log(1.0 - NEAREST))
    factors = [marginal_loaded_patch(ratio) for ratio in ratios]
    return chebyshev.chebfit(points, np.log(factors), DEGREE)


def loaded_patch_factor(a_over_b: Any) -> Any:
    """``L zeta sigma0/(mu* D)`` of a loaded patch with a/b from 0 to :data:`NEAREST`."""
    # how near to neutral: -1 without direct effect, 1 at the nearest
    near = 2.0 * np.log(1.0 - a_over_b) / np.log(1.0 - NEAREST) - 1.0
    return np.exp(chebyshev.chebval(near, polynomial()))
