"""Compiled loops over the bulk: block-tridiagonal elimination for all modes at once, and inertia.

Every array is laid out ``[level, component, mode]`` with the mode fastest. Each inner loop runs
over the independent modes, along rows that the compiler knows to be contiguous, and becomes vector
instructions. Levels count from the interface (0) to the top (n_y). Elimination runs from the top
down: the last pivot is the body's dynamic stiffness condensed on its interface.

For each mode the equations are ``A[j,j-1] u[j-1] + A[j,j] u[j] + A[j,j+1] u[j+1] = r[j]`` with
2x2 blocks. The factors are the inverse pivots ``Q[j] = P[j]^-1`` (`inverse`; symmetric: xx, xy, yy)
and ``T[j] = A[j,j+1] Q[j+1]`` (`lower`; xx, xy, yx, yy).
"""

import numpy as np

from .compiling import compiled_loop


@compiled_loop
def factorise(
    kxx, mxx, kyy, myy, cxy, mass, stiff, deriv, lame, shear, held, pivot, inverse, lower
):
    """Eliminate from the top down; fill P[0] (xx, xy, yy), Q in the levels 1..n_y, and T.

    The blocks are ``A_xx = kxx M + mxx K``, ``A_yy = kyy M + myy K`` and ``A_xy = cxy (lame C -
    shear C^T)`` with the matrices M, K, C along y. A component held on the top has zeros in Q.
    """
    top = mass.shape[1] - 1
    for j in range(top, -1, -1):
        md = mass[1, j]
        kd = stiff[1, j]
        cd = (lame - shear) * deriv[1, j]
        if j == top:
            for m in range(kxx.size):
                pivot[0, m] = kxx[m] * md + mxx[m] * kd
                pivot[1, m] = cxy[m] * cd
                pivot[2, m] = kyy[m] * md + myy[m] * kd
        else:
            mu = mass[2, j]
            ku = stiff[2, j]
            # A[j, j+1]: C^T[j, j+1] = C[j+1, j]
            cu = lame * deriv[2, j] - shear * deriv[0, j + 1]
            # A_yx[j, j+1] = A_xy[j+1, j]
            cl = lame * deriv[0, j + 1] - shear * deriv[2, j]
            q = inverse[j + 1]
            t = lower[j]
            for m in range(kxx.size):
                kx = kxx[m]
                mx = mxx[m]
                ky = kyy[m]
                my = myy[m]
                c = cxy[m]
                uxx = kx * mu + mx * ku
                uxy = c * cu
                uyx = c * cl
                uyy = ky * mu + my * ku
                qxx = q[0, m]
                qxy = q[1, m]
                qyy = q[2, m]
                txx = uxx * qxx + uxy * qxy
                txy = uxx * qxy + uxy * qyy
                tyx = uyx * qxx + uyy * qxy
                tyy = uyx * qxy + uyy * qyy
                t[0, m] = txx
                t[1, m] = txy
                t[2, m] = tyx
                t[3, m] = tyy
                own_xx = kx * md + mx * kd
                pivot[0, m] = own_xx - (txx * uxx + txy * uxy)
                own_xy = c * cd
                pivot[1, m] = own_xy - (txx * uyx + txy * uyy)
                own_yy = ky * md + my * kd
                pivot[2, m] = own_yy - (tyx * uyx + tyy * uyy)
        if j > 0:
            q = inverse[j]
            for m in range(kxx.size):
                pxx = pivot[0, m]
                pxy = pivot[1, m]
                pyy = pivot[2, m]
                factor = 1.0 / (pxx * pyy - pxy * pxy)
                q[0, m] = pyy * factor
                q[1, m] = -pxy * factor
                q[2, m] = pxx * factor
            if j == top and (held[0] or held[1]):
                for m in range(kxx.size):
                    q[0, m] = 0.0 if held[0] else 1.0 / pivot[0, m]
                    q[1, m] = 0.0
                    q[2, m] = 0.0 if held[1] else 1.0 / pivot[2, m]


@compiled_loop
def eliminate(lower, load, profiles, weights, scale, out):
    """Sweep a load from the top to the interface, ``out[j] = r[j] - T[j] out[j+1]``.

    The right-hand side has the forces of edge values too: ``r = load - scale G^T e``, by the
    profiles of ``G^T e`` along y, (3, n_y + 1), and the weights of the modes, (3, modes).
    """
    top = lower.shape[0]
    wa = weights[0]
    wb = weights[1]
    wc = weights[2]
    for j in range(top, -1, -1):
        a = scale * profiles[0, j]
        b = scale * profiles[1, j]
        c = scale * profiles[2, j]
        rx = load[j, 0]
        ry = load[j, 1]
        x = out[j, 0]
        y = out[j, 1]
        if j == top:
            for m in range(x.size):
                x[m] = rx[m] - (a * wa[m] + b * wb[m])
                y[m] = ry[m] - c * wc[m]
        else:
            above = out[j + 1]
            t = lower[j]
            for m in range(x.size):
                ux = above[0, m]
                uy = above[1, m]
                load_x = rx[m]
                edge_x = a * wa[m] + b * wb[m]
                above_x = t[0, m] * ux + t[1, m] * uy
                x[m] = (load_x - edge_x) - above_x
                load_y = ry[m]
                edge_y = c * wc[m]
                above_y = t[2, m] * ux + t[3, m] * uy
                y[m] = (load_y - edge_y) - above_y


@compiled_loop
def _up(q, t, below, here):
    """The displacement of one level from that of the level below, in place of the swept load."""
    x = here[0]
    y = here[1]
    px = below[0]
    py = below[1]
    for m in range(x.size):
        rx = x[m]
        ry = y[m]
        own_x = q[0, m] * rx + q[1, m] * ry
        below_x = t[0, m] * px[m] + t[2, m] * py[m]
        x[m] = own_x - below_x
        own_y = q[1, m] * rx + q[2, m] * ry
        below_y = t[1, m] * px[m] + t[3, m] * py[m]
        y[m] = own_y - below_y


@compiled_loop
def substitute(inverse, lower, rhs):
    """Sweep back from the interface, whose displacement (m) is in level 0, to the top, in place."""
    for j in range(1, rhs.shape[0]):
        _up(inverse[j], lower[j - 1], rhs[j - 1], rhs[j])


@compiled_loop
def move(inverse, lower, rhs, c1, c2, beta, u, u_past, rate):
    """As :func:`substitute`, and fill the rate (m/s) by ``rhs = c1 u + c2 u_past + beta rate``."""
    scale = 1.0 / beta
    for j in range(rhs.shape[0]):
        if j > 0:
            _up(inverse[j], lower[j - 1], rhs[j - 1], rhs[j])
        for c in range(2):
            x = rhs[j, c]
            u1 = u[j, c]
            u2 = u_past[j, c]
            out = rate[j, c]
            for m in range(x.size):
                out[m] = scale * (x[m] - c1 * u1[m] - c2 * u2[m])


@compiled_loop
def products(matrices, vector):
    """Products of tridiagonal matrices, (number, 3, n), with a vector, (number, n)."""
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
def add_inertia(
    mass,
    weight,
    edge_mass,
    edge_weight,
    scale,
    coefficients,
    fields,
    edges,
    load,
    edge_load,
    out,
    edge_out,
):
    """Fill `out` with ``load + M f``, ``f = sum_i c_i f_i`` of four fields with edge values.

    The mass of a mode is its `weight` times the matrix `mass` along y. That of an edge value is
    twice `edge_mass` times the matrix; between the edge and the modes it is once `edge_mass` times
    the modes' `edge_weight`.
    """
    levels = mass.shape[1]
    modes = load.shape[2]
    c0, c1, c2, c3 = coefficients
    near = np.empty(levels)
    e0, e1, e2, e3 = edges
    edge = np.empty(levels)
    for j in range(levels):
        edge[j] = (c0 * e0[j] + c1 * e1[j]) + (c2 * e2[j] + c3 * e3[j])
    stacked = mass.reshape(1, 3, levels)
    edge_inertia = products(stacked, edge)[0]
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
            by_edge = (edge_mass * scale) * edge_inertia[j] * c  # it acts along y
            for m in range(modes):
                inertia = weight[m] * (lo * below[m] + di * here[m] + up * above[m])
                to[m] = r[m] + (inertia + by_edge * edge_weight[m])
    for j in range(levels):
        near[j] += 2.0 * edge[j]
    inertia_of_edge = products(stacked, near)[0]
    for j in range(levels):
        edge_out[j] = edge_load[j] + edge_mass * inertia_of_edge[j]


@compiled_loop
def translate(modes, component, by_level, row):
    """Add ``by_level[j] row`` to the first modes of a component, in place."""
    for j in range(by_level.size):
        amount = by_level[j]
        here = modes[j, component]
        for m in range(row.size):
            here[m] += amount * row[m]
