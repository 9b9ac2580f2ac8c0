"""The linear stability spectrum of homogeneous sliding, Eq. (5), and its marginal points.

Where a mode neither grows nor decays, ``Lambda = i omega``. With ``w = omega ell / V``,
``b = a + zeta`` and

    g(k) = mu |k| ell |G1| / sigma0,    rho(k) = f G2 / |G1| ,

the real and imaginary parts of Eq. (5), Eq. (S-ReIm), read ``g = b w^2/(1 + w^2)`` and
``rho g = w (a w^2 - zeta)/(1 + w^2)``. Their quotient ``a w^2 - rho b w - zeta = 0`` gives w, and
eliminating w leaves a quadratic in g,

    (g - zeta)^2 = rho^2 g (b - g) ,    0 < g < b ,

with roots ``h_minus(rho) <= h_plus(rho)``, one for either sign of omega when ``zeta > 0``.
Sliding is stable for ``g > h_plus``; for velocity strengthening, ``zeta < 0``, also for
``g < h_minus`` and wherever the roots are not real, ``rho^2 b^2 < -4 a zeta``.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..types import Array, ComplexArray
from .pair import LayerPair, rounded

BITS = 44
"""Bits of numbers of a problem without units: equal problems in other units differ in the last."""

FEWER_BITS = 36
"""The same of a problem that was rounded before, so that both roundings agree."""

ROUND_OFF = 1e-15
"""Of G2/G1: the difference between bodies that are alike but for their heights."""


class Systems(NamedTuple):
    """Pairs of bodies in steady sliding, one or many: the input of the linear theory."""

    pair: LayerPair
    friction: Array
    a: Array  # direct effect
    zeta: Array  # velocity weakening
    softness: Array  # mu ell/sigma0 (m), mu of LayerPair.modulus
    rate: Array  # V/ell (1/s)

    @property
    def b(self) -> Array:
        """``b = a + zeta``."""
        return self.a + self.zeta

    def at(self, index: NDArray) -> Systems:
        """The systems of an index or a mask."""
        return Systems(
            pair=self.pair.at(index),
            friction=self.friction[index],
            a=self.a[index],
            zeta=self.zeta[index],
            softness=self.softness[index],
            rate=self.rate[index],
        )

    def in_metres(self) -> tuple[Systems, Array]:
        """The systems themselves, and their unit of length, 1 m."""
        return self, np.ones_like(self.softness)

    def without_units(self) -> tuple[Systems, Array]:
        """The problem that all similar systems share, and their unit of length (m), mu ell/sigma0.

        The softness and the rate are 1, and heights are rounded: ratios of numbers in other units
        differ in the last bits.
        """
        unit = self.softness
        one = np.ones_like(unit)
        return self._replace(pair=self.pair.over(unit, BITS), softness=one, rate=one), unit

    def of_constants(self) -> tuple[Systems, Array]:
        """The same with constant a and b, and the unit ``mu ell/(a sigma0)``.

        Then a is 1, lengths depend on zeta/a alone, and on f where slip changes the normal stress.
        """
        own, unit = self.without_units()
        further = 1.0 / own.a
        found = own._replace(
            pair=own.pair.over(further, FEWER_BITS),
            friction=np.where(own.pair.mirrored, 0.0, own.friction),
            a=own.softness,
            zeta=rounded(own.zeta / own.a, FEWER_BITS),
        )
        return found, unit * further

    @property
    def numbers(self) -> list[Array]:
        """All numbers, each (n,)."""
        return _arrays(self)

    def load_and_coupling(self, wavenumber: Array) -> tuple[Array, Array]:
        """``g = mu |k| ell |G1|/sigma0`` and ``rho = f G2/|G1|`` at wavenumbers (1/m)."""
        found = self.pair.stiffness(wavenumber)
        g = self.softness * np.abs(wavenumber) * found.xx
        alike = np.abs(found.xy) < ROUND_OFF * found.xx
        return g, np.where(alike, 0.0, self.friction * found.xy / found.xx)

    def growth_rates(self, wavenumber: Array) -> ComplexArray:
        """Both roots Lambda (1/s) of Eq. (5), the faster one first, shape ``(2,) + broadcast``.

        With ``lambda = Lambda ell/V`` and the elastic stiffness over the frictional one, ``Gamma =
        mu k ell (G1 - i f G2)/sigma0``, Eq. (5) times ``1 + lambda`` is ``a lambda^2 + (Gamma -
        zeta) lambda + Gamma = 0``. The larger root is formed by an addition, the other one from
        their product, Gamma/a. ``Lambda(-k)`` is the complex conjugate of ``Lambda(k)``.
        """
        g1, g2 = self.pair.transfer_functions(wavenumber)
        gamma = self.softness * wavenumber * (g1 - 1j * self.friction * g2)
        half = 0.5 * (gamma - self.zeta) / self.a
        product = gamma / self.a
        root = np.sqrt(half**2 - product)
        opposite = (np.conj(half) * root).real < 0.0
        root = np.where(opposite, -root, root)
        larger = -(half + root)
        roots = np.stack([larger, product / larger])
        in_order = roots[0].real >= roots[1].real
        ordered = np.where(in_order, roots, roots[::-1])
        return np.asarray(ordered * self.rate, dtype=complex)


def _arrays(of: tuple[Any, ...]) -> list[Array]:
    """The arrays in a tuple and in those within."""
    found: list[Array] = []
    for item in of:
        if isinstance(item, np.ndarray):
            found.append(item)
        elif isinstance(item, tuple):
            found += _arrays(item)
    return found


def marginal_stiffness(
    rho: Array | float, a: Array | float, zeta: Array | float
) -> tuple[Array, Array]:
    """The roots ``h_minus <= h_plus``, NaN where they are not real or ``a + zeta <= 0``.

    They are even in rho; h_plus grows with ``|rho|``.
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


def stability_margin(systems: Systems, k: Array) -> Array:
    """Negative where a mode of wavenumber k (1/m) grows, positive where none does, (n,)."""
    g, rho = systems.load_and_coupling(k)
    zeta = systems.zeta
    strengthening = (g - zeta) ** 2 - rho**2 * g * (systems.b - g)
    with np.errstate(invalid="ignore"):
        _, h_plus = marginal_stiffness(rho, systems.a, zeta)
        weakening = g - h_plus
    return np.where(zeta < 0.0, strengthening, weakening)


def marginal_frequencies(systems: Systems, k: Array) -> Array:
    """omega (rad/s) at marginal wavenumbers (1/m), (n,).

    It is the root of ``a w^2 - rho b w - zeta = 0`` that fits g. If ``G2 = 0`` both signs are
    marginal, and the positive one is given.
    """
    b, ratio = systems.b, systems.zeta / systems.a
    g, rho = systems.load_and_coupling(k)
    half = 0.5 * rho * b / systems.a
    size = np.abs(half) + np.sqrt(np.maximum(half**2 + ratio, 0.0))
    large = np.copysign(size, np.where(rho == 0.0, 1.0, rho))
    with np.errstate(divide="ignore", invalid="ignore"):  # of the least weakening
        small = -ratio / large

    misfits = [np.abs(b * w**2 / (1.0 + w**2) - g) for w in (large, small)]
    return np.where((rho != 0.0) & (misfits[1] < misfits[0]), small, large) * systems.rate
