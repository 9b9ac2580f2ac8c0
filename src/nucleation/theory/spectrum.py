"""The linear stability spectrum of homogeneous sliding, Eq. (5)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..model.linearised import InterfaceState
from ..types import ComplexArray
from .stiffness import Array, Pair
from .transfer import Body, RigidBody, as_wavenumber


class Systems(NamedTuple):
    """Pairs of bodies that slide upon each other, one or many, as the linear theory sees them."""

    pair: Pair
    friction: Array
    a: Array  # direct effect
    zeta: Array  # velocity weakening
    softness: Array  # mu ell/sigma0 (m), mu of Pair.modulus
    rate: Array  # V/ell (1/s)

    @property
    def b(self) -> Array:
        """``b = a + zeta``."""
        return self.a + self.zeta

    def at(self, index: NDArray) -> Systems:
        """The systems of an index."""
        return Systems(self.pair.at(index), *(x[index] for x in self[1:]))

    def load_and_coupling(self, wavenumber: Array) -> tuple[Array, Array]:
        """``g = mu |k| ell |G1|/sigma0`` and ``rho = f G2/|G1|`` at wavenumbers (1/m)."""
        found = self.pair.stiffness(wavenumber, whole=False)
        g = self.softness * np.abs(wavenumber) * found.xx
        return g, self.friction * found.xy / found.xx

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
        root = np.where((np.conj(half) * root).real < 0.0, -root, root)
        larger = -(half + root)
        pair = np.stack([larger, product / larger])
        pair = np.where(pair[0].real >= pair[1].real, pair, pair[::-1])
        return pair * self.rate


def system(upper: Body | RigidBody, lower: Body | RigidBody, interface: InterfaceState) -> Systems:
    """One system of two bodies and their interface."""
    pair = Pair(upper.layers, lower.layers)
    s = interface
    softness = pair.modulus * s.slip_length / s.normal_stress
    return Systems(pair, s.friction, s.a, s.zeta, softness, s.velocity / s.slip_length)


def growth_rates(
    wavenumber: ArrayLike,
    upper: Body | RigidBody,
    lower: Body | RigidBody,
    interface: InterfaceState,
) -> ComplexArray:
    """Both roots Lambda (1/s) of Eq. (5) at wavenumbers k (1/m), of either sign and not zero.

    Shape ``(2,) + k.shape``; the root that grows faster comes first.
    """
    return system(upper, lower, interface).growth_rates(as_wavenumber(wavenumber))
