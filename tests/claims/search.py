"""The critical wavenumber, by a search for growing roots of Eq. (5) alone.

In units of V/ell the growth rate x solves ``a x^2 + (g - zeta) x + g = 0`` with the load
``g = mu k ell (G1 - i f G2) / sigma0``.
"""

import cmath
import itertools

import numpy as np
from scipy.optimize import brentq, minimize_scalar


def _growth(load, a, zeta):
    """The root with the larger real part, over V/ell."""
    half = 0.5 * (load - zeta) / a
    root = cmath.sqrt(half**2 - load / a)
    rates = (root - half, -root - half)
    return max(rates, key=lambda rate: rate.real)


def growth_at(wavenumber, transfer, modulus, interface):
    """The root of Eq. (5) with the larger real part, over V/ell."""
    g1, g2 = transfer(wavenumber)
    scale = modulus * wavenumber * interface.slip_distance / interface.normal_stress
    load = scale * (g1 - 1j * interface.friction * g2)
    return _growth(load, interface.a, interface.zeta)


def critical_wavenumber(transfer, modulus, interface, guess):
    """The largest wavenumber with growth."""

    def rate(wavenumber):
        return growth_at(wavenumber, transfer, modulus, interface)

    tried = guess * np.geomspace(30.0, 1e-3, 400)
    k = _largest_growing(rate, tried)
    return k, abs(rate(k).imag)


def half_space_load(f_beta, a, zeta):
    """The largest real part of the load with growth, for two half-spaces: ``zeta L_c^M / L_c``."""

    def rate(load):
        return _growth(load * (1.0 - 1j * f_beta), a, zeta)

    scale = a + abs(zeta)
    tried = scale * np.geomspace(30.0, 1e-4, 2000)
    return _largest_growing(rate, tried)


def _largest_growing(rate, falling):
    """The largest value with growth, bracketed by a falling grid and found to round-off."""

    def growth(logarithm):
        value = float(np.exp(logarithm))
        return rate(value).real

    grid = np.log(falling)
    for stable, growing in itertools.pairwise(grid):
        if growth(growing) > 0.0:
            root = brentq(growth, growing, stable, xtol=1e-13)
            return float(np.exp(root))
    raise ValueError("there is no growth in the range of the search")


def strengthening_threshold(a, zeta):
    """The least f beta at which two half-spaces with ``zeta < 0`` slide unstably."""

    def largest_rate(f_beta):
        def decay(log_load):
            load = np.exp(log_load) * (1.0 - 1j * f_beta)
            return -_growth(load, a, zeta).real

        loads = a * np.geomspace(1e-4, 10.0, 300)
        grid = np.log(loads)
        decays = [decay(x) for x in grid]
        least = int(np.argmin(decays))
        near = grid[max(least - 1, 0) : least + 2]
        ends, fine = (near[0], near[-1]), {"xatol": 1e-12}
        found = minimize_scalar(decay, bounds=ends, method="bounded", options=fine)
        return -found.fun

    return float(brentq(largest_rate, 1e-3, 50.0, xtol=1e-10))
