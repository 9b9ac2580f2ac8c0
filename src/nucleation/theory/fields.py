"""Displacement field of one Fourier mode in a block on a rigid base (Eq. S-sol_inf)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray


def block_displacement(
    wavenumber: float, y: ArrayLike, height: float, poisson_ratio: float, amplitude: complex = 1.0
) -> NDArray[np.complex128]:
    """Field of a block on a rigid base, stress-free far side (Eq. S-sol_inf).

    Parameters
    ----------
    wavenumber : float
        k > 0 (1/m); the field of -k is the complex conjugate.
    y : array_like
        Height above the interface (m), ``0 <= y <= height``.
    height : float
        H (m), finite.
    poisson_ratio : float
    amplitude : complex
        A (m) of the paper.

    Returns
    -------
    displacement : ndarray
        ``(u_x, u_y)`` (m) without ``exp(Lambda t - i k x)``, shape ``(2,) + y.shape``.

    Raises
    ------
    ValueError
        Unless ``k > 0``: the paper's normalisation vanishes at a negative k.

    Notes
    -----
    Numerator and denominator are multiplied by ``exp(-2q)``; finite for every Hk.
    """
    if not wavenumber > 0.0:
        raise ValueError(f"wavenumber = {wavenumber!r} 1/m is not allowed: it must be positive")
    nu, q, t = poisson_ratio, height * wavenumber, np.asarray(y, dtype=float) / height
    near = [0.5 * np.exp(q * (t - 2.0)), 0.5 * np.exp(-q * (t + 2.0))]
    cosh, sinh = near[0] + near[1], near[0] - near[1]  # of q t
    far = [0.5 * np.exp(q * (t - 4.0)), 0.5 * np.exp(-q * t)]
    cosh_far, sinh_far = far[0] + far[1], far[0] - far[1]  # of q (t - 2)
    kappa = 3.0 - 4.0 * nu
    u_x = 2.0 * (
        2.0 * q**2 * (t - 1.0) * cosh
        - q * (kappa * (t - 2.0) * sinh + t * sinh_far)
        - kappa * cosh_far
        + (4.0 * (3.0 - 2.0 * nu) * nu - 5.0) * cosh
    )
    u_y = 1j * (
        4.0 * (q**2 * (t - 1.0) + 4.0 * nu**2 - 6.0 * nu + 2.0) * sinh
        - 2.0 * q * t * (kappa * cosh + cosh_far)
    )
    decay = np.exp(-2.0 * q)
    return amplitude * np.stack([u_x, u_y]) / (1.0 + (2.0 * q + kappa) * decay)
