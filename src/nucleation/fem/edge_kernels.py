"""Compiled loops over the right edge's values and the interface; arrays as in :mod:`.kernels`."""

import numpy as np

from .compiling import compiled, compiled_loop


@compiled_loop
def diagonal_inverse(inverse, lower, out):
    """Diagonal blocks (xx, xy, yy) of the inverse of the levels 1..n_y, interface held fixed.

    ``out[j] = Q[j] + T[j-1]^T out[j-1] T[j-1]``, with ``out[0] = 0``.
    """
    modes = inverse.shape[2]
    for m in range(modes):
        out[0, 0, m] = 0.0
        out[0, 1, m] = 0.0
        out[0, 2, m] = 0.0
    for j in range(1, inverse.shape[0]):
        s = out[j - 1]
        t = lower[j - 1]
        q = inverse[j]
        to = out[j]
        for m in range(modes):
            sxx = s[0, m]
            sxy = s[1, m]
            syy = s[2, m]
            txx = t[0, m]
            txy = t[1, m]
            tyx = t[2, m]
            tyy = t[3, m]
            # S T, first and second column
            ax = sxx * txx + sxy * tyx
            ay = sxy * txx + syy * tyx
            bx = sxx * txy + sxy * tyy
            by = sxy * txy + syy * tyy
            to[0, m] = q[0, m] + txx * ax + tyx * ay
            to[1, m] = q[1, m] + txx * bx + tyx * by
            to[2, m] = q[2, m] + txy * bx + tyy * by


@compiled_loop
def response_sums(inverse, lower, diagonal, matrices, weights, scale, out):
    """The :func:`edge_sums` of the displacement under the force of each edge value.

    The interface is held fixed; `matrices` are the rows of the edge values, and `diagonal` is that
    of :func:`diagonal_inverse`. Fills `out` from one level below each value on; the rest is zero.
    """
    levels = inverse.shape[0]
    modes = inverse.shape[2]
    loads = np.zeros((3, 2, modes))
    here = np.zeros((2, modes))  # the displacement of one level
    wa = weights[0]
    wb = weights[1]
    wc = weights[2]
    for i in range(levels):
        base = max(i - 1, 0)
        loaded = min(3, levels - base)  # levels on which the force of the value acts
        for row in range(loaded - 1, -1, -1):  # eliminated down to the base
            j = base + row
            beside = 1 + j - i
            acts = j > 0 and beside < 3
            a = scale * matrices[0, beside, i] if acts else 0.0
            b = scale * matrices[1, beside, i] if acts else 0.0
            c = scale * matrices[2, beside, i] if acts else 0.0
            t = lower[min(j, levels - 2)]
            above = loads[min(row + 1, 2)]
            coupled = 1.0 if row + 1 < loaded else 0.0
            for m in range(modes):
                x = a * wa[m] + b * wb[m]
                y = c * wc[m]
                above_x = t[0, m] * above[0, m] + t[1, m] * above[1, m]
                above_y = t[2, m] * above[0, m] + t[3, m] * above[1, m]
                loads[row, 0, m] = x - coupled * above_x
                loads[row, 1, m] = y - coupled * above_y
        here[:] = 0.0
        for j in range(base, levels):
            row = j - base
            t = lower[max(j - 1, 0)]
            q = diagonal[j] if row == 0 else inverse[j]
            load = loads[min(row, 2)]
            a = 0.0
            b = 0.0
            c = 0.0
            for m in range(modes):
                px = here[0, m]
                py = here[1, m]
                x = -(t[0, m] * px + t[2, m] * py)
                y = -(t[1, m] * px + t[3, m] * py)
                if row < loaded:
                    lx = load[0, m]
                    ly = load[1, m]
                    x += q[0, m] * lx + q[1, m] * ly
                    y += q[1, m] * lx + q[2, m] * ly
                here[0, m] = x
                here[1, m] = y
                a += wa[m] * x
                b += wb[m] * x
                c += wc[m] * y
            out[i, 0, j] = a
            out[i, 1, j] = b
            out[i, 2, j] = c


@compiled_loop
def edge_sums(weights, field, out):
    """Sums over the modes ``w_0 u_x``, ``w_1 u_x``, ``w_2 u_y`` of a field."""
    wa = weights[0]
    wb = weights[1]
    wc = weights[2]
    for j in range(field.shape[0]):
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
def edge_residual(matrices, weights, field, edge, load):
    """Unbalanced force (N/m) ``load - sum_k A_k s_k`` on the edge values.

    s_0 to s_2 are the :func:`edge_sums` of the field and s_3 the edge values (m).
    """
    levels = edge.size
    sums = np.empty((4, levels))
    edge_sums(weights, field, sums)
    for j in range(levels):
        sums[3, j] = edge[j]
    out = np.empty(levels)
    for j in range(levels):
        total = load[j]
        for k in range(4):
            total -= matrices[k, 1, j] * sums[k, j]
            if j > 0:
                total -= matrices[k, 0, j] * sums[k, j - 1]
            if j + 1 < levels:
                total -= matrices[k, 2, j] * sums[k, j + 1]
        out[j] = total
    return out


@compiled
def add_edge_in_balance(w, felt, response, schur, tangential, normal):
    """Add the forces of an edge in balance with w (m) to those on the interface (N/m)."""
    near = w[w.size - response.shape[1] :]
    edge = response @ near
    add_edge(edge, felt, tangential, normal)
    normal[-1] = felt[0, 0] @ near + schur @ edge


@compiled
def add_edge(edge, felt, tangential, normal):
    """Add the forces of given edge values (m) to those on the interface (N/m), in place.

    `felt` has the forces along x and y on the last nodes per edge value, (2, edge, nodes).
    """
    first = tangential.size - felt.shape[2]
    for j in range(edge.size):
        for i in range(felt.shape[2]):
            tangential[first + i] += edge[j] * felt[0, j, i]
            normal[first + i] += edge[j] * felt[1, j, i]


@compiled_loop
def interface_blocks(d, h, n, nodes, stiffness, coupling):
    """Fill ``D_ij = d(i-j) - d(i+j)`` and ``N_ij = h(i+j) - h(i-j)`` between sorted nodes.

    Half an element, and half of its force, belongs to the last node n; its normal force is the
    edge's, not the modes'. d and h hold the arguments 0..2 n.
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
