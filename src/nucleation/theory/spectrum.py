"""The linear stability spectrum of homogeneous sliding, Eq. (5)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..types import ComplexArray
from .stiffness import Array, LayerPair


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

    def load_and_coupling(self, wavenumber: Array) -> tuple[Array, Array]:
        """``g = mu |k| ell |G1|/sigma0`` and ``rho = f G2/|G1|`` at wavenumbers (1/m)."""
        found = self.pair.stiffness(wavenumber)
        g = self.softness * np.abs(wavenumber) * found.xx
        rho = self.friction * found.xy / found.xx
        return g, rho

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


def as_wavenumber(wavenumber: ArrayLike) -> Array:
    """The wavenumber as a float array; raises ValueError unless it is finite and not zero."""
    k = np.asarray(wavenumber, dtype=float)
    if not np.all(np.isfinite(k) & (k != 0.0)):
        raise ValueError("the wavenumber k (1/m) must be finite and different from zero")
    return k
