"""The critical wavenumber found by searching the roots of Eq. (5) for growth, nothing else.

In units of V/ell the growth rate solves ``a x^2 + (g - zeta) x + g = 0`` with
``g = mu k ell (G1 - i f G2) / sigma0``.
"""

import cmath
from collections.abc import Callable

import numpy as np
from scipy.optimize import brentq, minimize_scalar

from ...model.linearised import InterfaceState
from ...types import Array

Transfer = Callable[[float], tuple[float, float]]


def growth(load: complex, a: float, zeta: float) -> complex:
    """The root of the larger real part, over V/ell."""
    half = 0.5 * (load - zeta) / a
    root = cmath.sqrt(half**2 - load / a)
    return max(root - half, -root - half, key=lambda rate: rate.real)


def growth_at(
    wavenumber: float, transfer: Transfer, modulus: float, interface: InterfaceState
) -> complex:
    """The same at a wavenumber (1/m), for transfer functions of it."""
    g1, g2 = transfer(wavenumber)
    scale = modulus * wavenumber * interface.slip_length / interface.normal_stress
    load = scale * (g1 - 1j * interface.friction * g2)
    return growth(load, interface.a, interface.zeta)


def critical_wavenumber(
    transfer: Transfer, modulus: float, interface: InterfaceState, guess: float
) -> tuple[float, float]:
    """The largest wavenumber (1/m) with growth, and the frequency over V/ell there.

    It is sought downwards from 30 times the guess to a thousandth of it.
    """

    k = _largest_growing(
        lambda k: growth_at(k, transfer, modulus, interface), guess * np.geomspace(30.0, 1e-3, 400)
    )
    return k, abs(growth_at(k, transfer, modulus, interface).imag)


def half_space_load(f_beta: float, a: float, zeta: float) -> float:
    """The largest real part of the load with growth, two half-spaces: ``zeta L_c^M / L_c``."""
    return _largest_growing(
        lambda load: growth(load * (1.0 - 1j * f_beta), a, zeta),
        (a + abs(zeta)) * np.geomspace(30.0, 1e-4, 2000),
    )


def _largest_growing(rate: Callable[[float], complex], falling: Array) -> float:
    """The largest of some values with growth, to all digits between them."""

    def real(logarithm: float) -> float:
        return rate(float(np.exp(logarithm))).real

    grid = np.log(falling)
    below = next(i for i, logarithm in enumerate(grid) if real(logarithm) > 0.0)
    return float(np.exp(brentq(real, grid[below], grid[below - 1], xtol=1e-13)))


def strengthening_threshold(a: float, zeta: float) -> float:
    """The least f beta at which two half-spaces with ``zeta < 0`` slide unstably."""

    def largest_rate(f_beta: float) -> float:
        def slowness(log_load: float) -> float:
            return -growth(np.exp(log_load) * (1.0 - 1j * f_beta), a, zeta).real

        grid = np.log(a * np.geomspace(1e-4, 10.0, 300))
        start = int(np.argmin([slowness(x) for x in grid]))
        ends = grid[max(start - 1, 0)], grid[min(start + 1, grid.size - 1)]
        return -minimize_scalar(slowness, bounds=ends, method="bounded",
                                options={"xatol": 1e-12}).fun  # fmt: skip

    return float(brentq(largest_rate, 1e-3, 50.0, xtol=1e-10))
