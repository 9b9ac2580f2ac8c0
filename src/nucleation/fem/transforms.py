"""Compiled transforms between the modes of a block and the nodes of its interface.

An interface has some hundred nodes, and a transform of SciPy's costs three times as much to call as
to do. rocket-fft lets numba call the same transforms, so that not a bit is different.
"""

import numpy as np
import rocket_fft  # noqa: F401 - lets numba compile scipy.fft
from scipy import fft

from .compiling import compiled


@compiled
def sine_amplitudes(nodal):
    """Amplitudes of nodal values at i = 1..n (last axis) in the sine basis.

    The inverse transform weighs the last node by one half, and type 3 counts it once.
    """
    return fft.dst(nodal, 3) / nodal.shape[-1]


@compiled
def nodal_forces(stiffness, amplitudes, reduced, alternating):
    """Nodal forces of ``stiffness * amplitudes - reduced`` per mode, times n/2.

    Along x at i = 1..n and along y at i = 0..n, of which the last one is not the modes' and zero.
    Both transforms are done in one: with alternating signs, the cosines in reversed order are the
    sines. Half of an element belongs to the last node along x, and to the first one along y.
    """
    n = amplitudes.size
    modal = np.empty((2, n))
    for m in range(n):
        modal[0, m] = (stiffness[0, m] * amplitudes[m] - reduced[0, m]) * alternating[m]
        modal[1, m] = stiffness[1, m] * amplitudes[m] - reduced[1, m]
    forces = fft.dct(modal, 2)
    tangential, normal = np.empty(n), np.empty(n + 1)
    for i in range(n):
        tangential[i], normal[i] = 0.5 * forces[0, n - 1 - i], 0.5 * forces[1, i]
    tangential[n - 1] *= 0.5
    normal[0] *= 0.5
    normal[n] = 0.0
    return tangential, normal


@compiled
def add_edge_in_balance(w, felt, response, schur, tangential, normal):
    """Add what the edge does that follows w: `felt` and its `response`, both of the last nodes.

    The last normal force is the corner's, from the edge's row `schur`.
    """
    near = w[w.size - response.shape[1] :]
    edge = response @ near
    add_edge(edge, felt, tangential, normal)
    normal[-1] = felt[0, 0] @ near + schur @ edge


@compiled
def add_edge(edge, by_edge, tangential, normal):
    """Add what edge values do to the interface's last nodes, ``by_edge`` of each along x and y."""
    near = tangential.size - by_edge.shape[2]
    for j in range(edge.size):
        for i in range(by_edge.shape[2]):
            tangential[near + i] += edge[j] * by_edge[0, j, i]
            normal[near + i] += edge[j] * by_edge[1, j, i]
