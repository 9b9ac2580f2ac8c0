"""Compiled loops over fields, edge values and interface nodes; layout as in :mod:`.kernels`."""

import numpy as np
from numpy.typing import NDArray

from ..types import Array
from .compiling import compiled_loop


@compiled_loop
def edge_sums(
    weights: Array,
    field: Array,
    first: int,
    out: Array,
) -> None:
    """Sum a field over the modes, with the weights of the right edge.

    ``out[0] = sum_m weights[0] u_x``, ``out[1] = sum_m weights[1] u_x`` and
    ``out[2] = sum_m weights[2] u_y``.

    Parameters
    ----------
    weights : ndarray
        Weight of each mode, shape (3, modes).
    field : ndarray
        Amplitudes, shape (levels, 2, modes).
    first : int
        The first level that is summed.
    out : ndarray
        Filled from that level on, shape (3, levels).
    """
    wa = weights[0]
    wb = weights[1]
    wc = weights[2]
    for j in range(first, field.shape[0]):
        x = field[j, 0]
        y = field[j, 1]
        a = 0.0
        b = 0.0
        c = 0.0
        for m in range(x.size):
            a += wa[m] * x[m]
            b += wb[m] * x[m]
            c += wc[m] * y[m]
        out[0, j] = a
        out[1, j] = b
        out[2, j] = c


@compiled_loop
def products(matrices: Array, vector: Array) -> Array:
    """Multiply tridiagonal matrices with a vector.

    Parameters
    ----------
    matrices : ndarray
        Their diagonals (:mod:`.matrices`), shape (number, 3, length).
    vector : ndarray
        Shape (length,).

    Returns
    -------
    ndarray
        Shape (number, length).
    """
    out = np.empty((matrices.shape[0], vector.size))
    last = vector.size - 1
    for k in range(matrices.shape[0]):
        lower, diagonal, upper = matrices[k]
        for j in range(last + 1):
            total = diagonal[j] * vector[j]
            if j > 0:
                total += lower[j] * vector[j - 1]
            if j < last:
                total += upper[j] * vector[j + 1]
            out[k, j] = total
    return out


@compiled_loop
def edge_residual(
    matrices: Array,
    weights: Array,
    field: Array,
    edge: Array,
    load: Array,
    levels: int,
) -> Array:
    """Return ``load - sum_k A_k s_k`` at the lowest levels.

    Parameters
    ----------
    matrices : ndarray
        Diagonals of the A_k, shape (4, 3, n_y + 1).
    weights, field : ndarray
        The :func:`edge_sums` of a field are s_0 to s_2. Unless all levels are wanted, the field is
        given one level further up than the result.
    edge : ndarray
        The edge values s_3 (m), shape (n_y + 1,).
    load : ndarray
        The load on the edge values (N/m), shape (n_y + 1,).
    levels : int
        Number of levels of the result.

    Returns
    -------
    ndarray
        The unbalanced force (N/m), shape (levels,).
    """
    given = min(field.shape[0], edge.size)
    sums = np.empty((4, given))
    edge_sums(weights, field, 0, sums)
    for j in range(given):
        sums[3, j] = edge[j]
    out = np.empty(levels)
    for j in range(levels):
        total = load[j]
        for k in range(4):
            total -= matrices[k, 1, j] * sums[k, j]
            if j > 0:
                total -= matrices[k, 0, j] * sums[k, j - 1]
            if j + 1 < given:
                total -= matrices[k, 2, j] * sums[k, j + 1]
        out[j] = total
    return out


@compiled_loop
def add_inertia(
    mass: Array,
    weight: Array,
    edge_mass: float,
    edge_weight: Array,
    scale: float,
    coefficients: tuple[float, ...],
    fields: tuple[Array, ...],
    edges: tuple[Array, ...],
    load: Array,
    edge_load: Array,
) -> tuple[Array, Array]:
    """Add the inertia ``M f`` of a sum of four fields, ``f = sum_i c_i f_i``, to a load.

    The mass of a mode is its `weight` times the matrix `mass`. That of an edge value is twice
    `edge_mass` times the matrix; between the edge and the modes it is once `edge_mass` times the
    modes' `edge_weight`.

    Parameters
    ----------
    mass : ndarray
        Mass matrix along y, shape (3, n_y + 1).
    weight, edge_weight : ndarray
        Weights of the modes, shape (modes,).
    edge_mass : float
        Mass of the edge (kg/m^2, times s).
    scale : float
        Scale of the loads on the modes.
    coefficients : tuple of float
        The four c_i.
    fields, edges : tuple of ndarray
        Modes and edge values of the four f_i (m).
    load, edge_load : ndarray
        The load on modes and edge values (N/m).

    Returns
    -------
    load, edge_load : ndarray
        The sum (N/m).
    """
    levels = mass.shape[1]
    modes = load.shape[2]
    c0, c1, c2, c3 = coefficients
    out = np.empty_like(load)
    near = np.empty(levels)
    edge = (c0 * edges[0] + c1 * edges[1]) + (c2 * edges[2] + c3 * edges[3])
    stacked = mass.reshape(1, 3, levels)
    edge_inertia = (edge_mass * scale) * products(stacked, edge)[0]
    rows = np.zeros((3, 2, modes))  # f at the levels j - 1, j, j + 1, each at its level modulo 3
    for level in range(levels + 1):
        if level < levels:
            for c in range(2):
                row = rows[level % 3, c]
                f0 = fields[0][level, c]
                f1 = fields[1][level, c]
                f2 = fields[2][level, c]
                f3 = fields[3][level, c]
                for m in range(modes):
                    row[m] = (c0 * f0[m] + c1 * f1[m]) + (c2 * f2[m] + c3 * f3[m])
            total = 0.0
            for m in range(modes):
                total += edge_weight[m] * row[m]
            near[level] = total
        if level == 0:
            continue
        j = level - 1
        lo = mass[0, j]  # zero where there is no neighbour
        di = mass[1, j]
        up = mass[2, j]
        for c in range(2):
            below = rows[(j + 2) % 3, c]
            here = rows[j % 3, c]
            above = rows[(j + 1) % 3, c]
            r = load[j, c]
            to = out[j, c]
            by_edge = edge_inertia[j] * c  # it acts along y
            for m in range(modes):
                inertia = weight[m] * (lo * below[m] + di * here[m] + up * above[m])
                to[m] = r[m] + (inertia + by_edge * edge_weight[m])
    edge_out = edge_load + edge_mass * products(stacked, near + 2.0 * edge)[0]
    return out, edge_out


@compiled_loop
def rate_of_change(
    c1: float,
    c2: float,
    beta: float,
    new: Array,
    u: Array,
    u_past: Array,
    out: Array,
) -> None:
    """Find the rate by ``new = c1 u + c2 u_past + beta rate``.

    Parameters
    ----------
    c1, c2, beta : float
        Coefficients of a step's formula; beta in s.
    new, u, u_past : ndarray
        Modes of displacements (m), shape (levels, 2, modes).
    out : ndarray
        Filled with the rate (m/s).
    """
    scale = 1.0 / beta
    for j in range(u.shape[0]):
        for c in range(2):
            x = new[j, c]
            u1 = u[j, c]
            u2 = u_past[j, c]
            rate = out[j, c]
            for m in range(x.size):
                rate[m] = scale * (x[m] - c1 * u1[m] - c2 * u2[m])


@compiled_loop
def interface_blocks(
    d: Array,
    h: Array,
    n: int,
    nodes: NDArray[np.intp],
    stiffness: NDArray,
    coupling: NDArray,
) -> None:
    """Fill ``D_ij = d(i-j) - d(i+j)`` and ``N_ij = h(i+j) - h(i-j)`` between interface nodes.

    Half an element, and half of its force, belongs to the last node n; its normal force is the
    edge's, not the modes'.

    Parameters
    ----------
    d, h : ndarray
        The functions at 0..2 n.
    n : int
        Number of the last node.
    nodes : ndarray of int
        Some nodes, sorted.
    stiffness, coupling : ndarray
        Filled with D and N, shape (nodes, nodes).
    """
    for a in range(nodes.size):
        i = nodes[a]
        half_i = 0.5 if i == n else 1.0
        for b in range(a + 1):
            j = nodes[b]  # not above i: N_ji has the opposite sign of h(i-j)
            half = half_i * (0.5 if j == n else 1.0)
            stiffness[a, b] = half * (d[i - j] - d[i + j])
            stiffness[b, a] = stiffness[a, b]
            coupling[a, b] = 0.0 if i == n else half * (h[i + j] - h[i - j])
            coupling[b, a] = half * (h[i + j] + h[i - j]) if j < n else 0.0


@compiled_loop
def relative_error(found: Array, first: Array, second: Array) -> float:
    """Return the largest error of two guesses over the largest value found.

    Parameters
    ----------
    found, first, second : ndarray
        The values and the two guesses, shape (n,).

    Returns
    -------
    float
        Infinite if all values are zero.
    """
    largest = 0.0
    error = 0.0
    for j in range(found.size):
        value = found[j]
        largest = max(largest, abs(value))
        error = max(error, abs(first[j] - value), abs(second[j] - value))
    return error / largest if largest > 0.0 else np.inf
