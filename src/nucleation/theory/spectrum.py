"""The linear stability spectrum of homogeneous sliding, Eq. (5)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ..model.linearised import InterfaceState
from .transfer import Body, RigidBody, as_wavenumber, reference_modulus, transfer_functions

ComplexArray = NDArray[np.complex128]


def elastic_load(
    wavenumber: ArrayLike,
    upper: Body | RigidBody,
    lower: Body | RigidBody,
    interface: InterfaceState,
) -> ComplexArray:
    """Elastic stiffness over frictional weakening, ``Gamma = mu k ell (G1 - i f G2) / sigma0``.

    Dimensionless, shape of k (1/m). ``Re Gamma > 0`` for every k.
    """
    k = as_wavenumber(wavenumber)
    g1, g2 = transfer_functions(k, upper, lower)
    scale = reference_modulus(upper, lower) * interface.slip_length / interface.normal_stress
    return scale * k * (g1 - 1j * interface.friction * g2)


def growth_rates(
    wavenumber: ArrayLike,
    upper: Body | RigidBody,
    lower: Body | RigidBody,
    interface: InterfaceState,
) -> ComplexArray:
    """Both roots Lambda of Eq. (5) at each wavenumber.

    Parameters
    ----------
    wavenumber : array_like
        k (1/m), any shape, not zero.
    upper, lower : Body or RigidBody
    interface : InterfaceState

    Returns
    -------
    growth_rate : ndarray
        Complex, 1/s, shape ``(2,) + k.shape``; the root that grows faster comes first.

    Notes
    -----
    With ``lambda = Lambda ell / V`` and Gamma of :func:`elastic_load`, Eq. (5) times
    ``1 + lambda`` is ``a lambda^2 + (Gamma - zeta) lambda + Gamma = 0``. The larger root is
    formed by an addition and the other one from the product of the roots, Gamma/a. Perturbations
    vary as ``exp(Lambda t - i k x)``; ``Lambda(-k)`` is the complex conjugate of ``Lambda(k)``.
    """
    gamma = elastic_load(wavenumber, upper, lower, interface)
    half = 0.5 * (gamma - interface.zeta) / interface.a
    product = gamma / interface.a
    root = np.sqrt(half**2 - product)
    root = np.where((np.conj(half) * root).real < 0.0, -root, root)
    larger = -(half + root)
    pair = np.stack([larger, product / larger])
    pair = np.where(pair[0].real >= pair[1].real, pair, pair[::-1])
    return pair * (interface.velocity / interface.slip_length)


def spectrum_branches(
    wavenumber: ArrayLike,
    upper: Body | RigidBody,
    lower: Body | RigidBody,
    interface: InterfaceState,
) -> ComplexArray:
    """Both roots of Eq. (5), ordered so that each row is continuous in k.

    Parameters
    ----------
    wavenumber : array_like
        k (1/m), one-dimensional, monotonic and of one sign, fine enough that a branch moves
        less between neighbours than the branches are apart.
    upper, lower : Body or RigidBody
    interface : InterfaceState

    Returns
    -------
    growth_rate : ndarray
        Complex, 1/s, shape ``(2, k.size)``. The first row is the branch that grows faster at the
        smallest ``|k|``.

    Raises
    ------
    ValueError
        If k is not one-dimensional, monotonic and of one sign.
    """
    k = as_wavenumber(np.atleast_1d(wavenumber))
    steps = np.diff(k)
    if k.ndim != 1 or not (np.all(steps > 0) or np.all(steps < 0)) or np.any(k * k[0] < 0):
        raise ValueError("the wavenumber k must be one-dimensional, monotonic and of one sign")
    rates = growth_rates(k, upper, lower, interface)
    straight = np.abs(np.diff(rates, axis=1)).sum(axis=0)
    crossed = np.abs(rates[::-1, 1:] - rates[:, :-1]).sum(axis=0)
    swaps = np.concatenate([[0], np.cumsum(crossed < straight)])
    smallest = np.argmin(np.abs(k))
    swapped = (swaps - swaps[smallest]) % 2 == 1
    return np.where(swapped, rates[::-1], rates)
