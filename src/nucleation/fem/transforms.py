"""Compiled transforms between the modes of a block and the nodes of its interface.

An interface has some hundred nodes: calling a transform of SciPy takes three times as long as the
transform itself. With rocket-fft, compiled code calls the same transforms; the results are equal to
the last bit.
"""

import numpy as np
import rocket_fft  # noqa: F401 - lets numba compile scipy.fft
from scipy import fft

from ..types import Array
from .compiling import compiled


@compiled
def sine_amplitudes(nodal: Array) -> Array:
    """Return the amplitudes of nodal values at i = 1..n (last axis) in the sine basis."""
    # the inverse transform counts the last node half, and so does type 3
    return fft.dst(nodal, 3) / nodal.shape[-1]


@compiled
def nodal_forces(
    stiffness: Array,
    amplitudes: Array,
    reduced: Array,
    alternating: Array,
) -> tuple[Array, Array]:
    """Return the nodal forces of ``stiffness * amplitudes - reduced`` per mode, times n/2.

    With alternating signs, the cosines in reversed order are the sines: one call transforms both.

    Parameters
    ----------
    stiffness : ndarray
        Tangential and normal stiffness per mode (N/m per m), shape (2, n).
    amplitudes : ndarray
        Amplitudes of w (m), shape (n,).
    reduced : ndarray
        The load reduced to the interface (N/m), shape (2, n).
    alternating : ndarray
        1, -1, 1, ..., shape (n,).

    Returns
    -------
    tangential : ndarray
        Forces along x (N/m) at i = 1..n.
    normal : ndarray
        Forces along y at i = 0..n; the modes do not act on the last node, its force is zero.
    """
    n = amplitudes.size
    modal = np.empty((2, n))
    for m in range(n):
        along_x = stiffness[0, m] * amplitudes[m] - reduced[0, m]
        along_y = stiffness[1, m] * amplitudes[m] - reduced[1, m]
        modal[0, m] = along_x * alternating[m]
        modal[1, m] = along_y
    forces = fft.dct(modal, 2)
    tangential = np.empty(n)
    normal = np.empty(n + 1)
    for i in range(n):
        tangential[i] = 0.5 * forces[0, n - 1 - i]
        normal[i] = 0.5 * forces[1, i]
    tangential[n - 1] *= 0.5  # half of an element belongs to the last node
    normal[0] *= 0.5  # and to the first one
    normal[n] = 0.0
    return tangential, normal


@compiled
def add_edge_in_balance(
    w: Array,
    felt: Array,
    response: Array,
    schur: Array,
    tangential: Array,
    normal: Array,
) -> None:
    """Add the forces of an edge that is in balance with w to the forces on the interface.

    Parameters
    ----------
    w : ndarray
        Displacement of the interface (m), shape (n,).
    felt : ndarray
        Forces along x and y on the last nodes per edge value (N/m per m), (2, edge, nodes).
    response : ndarray
        Edge values per displacement of the last nodes, shape (edge, nodes).
    schur : ndarray
        Forces on the corner per edge value (N/m per m), shape (edge,).
    tangential, normal : ndarray
        Forces on the interface (N/m), shapes (n,) and (n + 1,), changed in place.
    """
    near = w[w.size - response.shape[1] :]
    edge = response @ near
    add_edge(edge, felt, tangential, normal)
    normal[-1] = felt[0, 0] @ near + schur @ edge


@compiled
def add_edge(
    edge: Array,
    felt: Array,
    tangential: Array,
    normal: Array,
) -> None:
    """Add the forces of given edge values (m) to the forces on the interface.

    Parameters
    ----------
    edge : ndarray
        Edge values (m), shape (edge,).
    felt, tangential, normal : ndarray
        As in :func:`add_edge_in_balance`.
    """
    first = tangential.size - felt.shape[2]
    for j in range(edge.size):
        for i in range(felt.shape[2]):
            tangential[first + i] += edge[j] * felt[0, j, i]
            normal[first + i] += edge[j] * felt[1, j, i]
