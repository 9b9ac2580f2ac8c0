"""Compiled loops of the separable solver: block-tridiagonal elimination for all modes at once.

Every array is laid out ``[level, component, mode]`` with the mode fastest, so that each inner
loop runs over the independent modes, along rows that the compiler knows to be contiguous, and
becomes vector instructions. Levels count from the interface (0) to the top (n_y). Elimination runs
from the top down: the last pivot is the body's dynamic stiffness condensed on its interface.

For each mode the equations are ``A[j,j-1] u[j-1] + A[j,j] u[j] + A[j,j+1] u[j+1] = r[j]`` with
2x2 blocks. The factors kept are the inverse pivots ``Q[j] = P[j]^-1`` (symmetric: xx, xy, yy)
and ``T[j] = A[j,j+1] Q[j+1]`` (xx, xy, yx, yy).
"""

from functools import partial

import numpy as np

from . import compiling

compiled = partial(compiling.compiled, fastmath={"contract", "reassoc", "nsz"})


@compiled
def factorise(
    kxx, mxx, kyy, myy, cxy, mass, stiff, deriv, lame, shear, held, pivot, inverse, lower
):
    """Eliminate from the top down; fill `pivot` (level 0), `inverse` and `lower`.

    `held` says which components, x and y, are zero on the top: none, both, or one of them. What
    is held has no compliance, zeros in `inverse`.

    The blocks are ``A_xx = kxx M + mxx K``, ``A_yy = kyy M + myy K`` and
    ``A_xy = cxy (lame C - shear C^T)`` with the y-matrices `mass`, `stiff`, `deriv`, each of
    shape (3, n_y + 1): lower, diagonal, upper. The coefficients have one value per mode.
    """
    top = mass.shape[1] - 1
    n = kxx.size
    for j in range(top, -1, -1):
        md, kd, cd = mass[1, j], stiff[1, j], (lame - shear) * deriv[1, j]
        if j == top:
            for m in range(n):
                pivot[0, m] = kxx[m] * md + mxx[m] * kd
                pivot[1, m] = cxy[m] * cd
                pivot[2, m] = kyy[m] * md + myy[m] * kd
        else:
            mu, ku = mass[2, j], stiff[2, j]
            # A[j, j+1]: C^T[j, j+1] = C[j+1, j]
            cu = lame * deriv[2, j] - shear * deriv[0, j + 1]
            # A_yx[j, j+1] = A_xy[j+1, j]
            cl = lame * deriv[0, j + 1] - shear * deriv[2, j]
            for m in range(n):
                uxx = kxx[m] * mu + mxx[m] * ku
                uxy = cxy[m] * cu
                uyx = cxy[m] * cl
                uyy = kyy[m] * mu + myy[m] * ku
                qxx, qxy, qyy = inverse[j + 1, 0, m], inverse[j + 1, 1, m], inverse[j + 1, 2, m]
                txx = uxx * qxx + uxy * qxy
                txy = uxx * qxy + uxy * qyy
                tyx = uyx * qxx + uyy * qxy
                tyy = uyx * qxy + uyy * qyy
                lower[j, 0, m], lower[j, 1, m] = txx, txy
                lower[j, 2, m], lower[j, 3, m] = tyx, tyy
                pivot[0, m] = kxx[m] * md + mxx[m] * kd - (txx * uxx + txy * uxy)
                pivot[1, m] = cxy[m] * cd - (txx * uyx + txy * uyy)
                pivot[2, m] = kyy[m] * md + myy[m] * kd - (tyx * uyx + tyy * uyy)
        if j > 0:
            for m in range(n):
                det = 1.0 / (pivot[0, m] * pivot[2, m] - pivot[1, m] * pivot[1, m])
                inverse[j, 0, m] = pivot[2, m] * det
                inverse[j, 1, m] = -pivot[1, m] * det
                inverse[j, 2, m] = pivot[0, m] * det
            if j == top and (held[0] or held[1]):
                for m in range(n):
                    inverse[j, 0, m] = 0.0 if held[0] else 1.0 / pivot[0, m]
                    inverse[j, 1, m] = 0.0
                    inverse[j, 2, m] = 0.0 if held[1] else 1.0 / pivot[2, m]


@compiled
def edge_sums(weights, field, first, out):
    """Sums over the modes that the right edge sees, at the levels >= `first`.

    ``out[0] = sum_m weights[0] u_x``, ``out[1] = sum_m weights[1] u_x`` and
    ``out[2] = sum_m weights[2] u_y``, each of shape (n_y + 1,).
    """
    wa, wb, wc = weights[0], weights[1], weights[2]
    for j in range(first, field.shape[0]):
        x, y, a, b, c = field[j, 0], field[j, 1], 0.0, 0.0, 0.0
        for m in range(x.size):
            a += wa[m] * x[m]
            b += wb[m] * x[m]
            c += wc[m] * y[m]
        out[0, j], out[1, j], out[2, j] = a, b, c


@compiled
def eliminate(lower, load, profiles, weights, scale, out):
    """Forward sweep from the top to the interface, ``out[j] = r[j] - T[j] out[j+1]``.

    The right-hand side is the load with the edge's values moved to it, ``r = load - scale G^T e``,
    from the profiles (3, n_y + 1) of ``G^T e`` along y.
    """
    top = lower.shape[0]
    wa, wb, wc = weights[0], weights[1], weights[2]
    for j in range(top, -1, -1):
        a, b, c = scale * profiles[0, j], scale * profiles[1, j], scale * profiles[2, j]
        rx, ry, x, y = load[j, 0], load[j, 1], out[j, 0], out[j, 1]
        if j == top:
            for m in range(x.size):
                x[m] = rx[m] - (a * wa[m] + b * wb[m])
                y[m] = ry[m] - c * wc[m]
        else:
            ux, uy = out[j + 1, 0], out[j + 1, 1]
            txx, txy, tyx, tyy = lower[j, 0], lower[j, 1], lower[j, 2], lower[j, 3]
            for m in range(x.size):
                x[m] = (rx[m] - (a * wa[m] + b * wb[m])) - (txx[m] * ux[m] + txy[m] * uy[m])
                y[m] = (ry[m] - c * wc[m]) - (tyx[m] * ux[m] + tyy[m] * uy[m])


@compiled
def substitute(inverse, lower, rhs):
    """Backward sweep in place, from the interface (known, in ``rhs[0]``) to the top."""
    for j in range(1, rhs.shape[0]):
        x, y, px, py = rhs[j, 0], rhs[j, 1], rhs[j - 1, 0], rhs[j - 1, 1]
        txx, txy, tyx, tyy = lower[j - 1, 0], lower[j - 1, 1], lower[j - 1, 2], lower[j - 1, 3]
        qxx, qxy, qyy = inverse[j, 0], inverse[j, 1], inverse[j, 2]
        for m in range(x.size):
            rx, ry = x[m], y[m]
            x[m] = qxx[m] * rx + qxy[m] * ry - (txx[m] * px[m] + tyx[m] * py[m])
            y[m] = qxy[m] * rx + qyy[m] * ry - (txy[m] * px[m] + tyy[m] * py[m])


@compiled
def products(matrices, vector):
    """``A_k vector`` for tridiagonal matrices, (number, 3, length): (number, length)."""
    out, last = np.empty((matrices.shape[0], vector.size)), vector.size - 1
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


@compiled
def add_inertia(
    mass, weight, edge_mass, edge_weight, scale, coefficients, fields, edges, load, edge_load
):
    """``load + M f`` with ``f = sum_i c_i f_i`` of four fields and their edges: modes and edge.

    The mass is `weight` per mode times the matrix `mass` in y; that of an edge value is twice
    `edge_mass`, and once between it and the modes, by their `edge_weight`, which `scale` loads.
    """
    top, n = mass.shape[1] - 1, load.shape[2]
    c0, c1, c2, c3 = coefficients
    out, near = np.empty_like(load), np.empty(top + 1)
    edge = (c0 * edges[0] + c1 * edges[1]) + (c2 * edges[2] + c3 * edges[3])
    stacked = mass.reshape(1, 3, top + 1)
    edge_inertia = (edge_mass * scale) * products(stacked, edge)[0]
    rows = np.zeros((3, 2, n))  # f at the levels j - 1, j, j + 1, each at its level modulo 3
    for level in range(top + 2):
        if level <= top:
            for c in range(2):
                row = rows[level % 3, c]
                f0, f1 = fields[0][level, c], fields[1][level, c]
                f2, f3 = fields[2][level, c], fields[3][level, c]
                for m in range(n):
                    row[m] = (c0 * f0[m] + c1 * f1[m]) + (c2 * f2[m] + c3 * f3[m])
            total = 0.0
            for m in range(n):
                total += edge_weight[m] * row[m]
            near[level] = total
        if level == 0:
            continue
        j = level - 1
        lo, di, up = mass[0, j], mass[1, j], mass[2, j]  # zero where there is no neighbour
        for c in range(2):
            below, here, above = rows[(j + 2) % 3, c], rows[j % 3, c], rows[(j + 1) % 3, c]
            r, to, by_edge = load[j, c], out[j, c], edge_inertia[j] * c  # which acts along y
            for m in range(n):
                inertia = weight[m] * (lo * below[m] + di * here[m] + up * above[m])
                to[m] = r[m] + (inertia + by_edge * edge_weight[m])
    return out, edge_load + edge_mass * products(stacked, near + 2.0 * edge)[0]


@compiled
def diagonal_inverse(inverse, lower, out):
    """Diagonal blocks (xx, xy, yy) of the inverse of the levels 1..n_y, interface held fixed.

    ``out[j] = Q[j] + T[j-1]^T out[j-1] T[j-1]``, with ``out[0] = 0``.
    """
    n = inverse.shape[2]
    for m in range(n):
        out[0, 0, m] = out[0, 1, m] = out[0, 2, m] = 0.0
    for j in range(1, inverse.shape[0]):
        for m in range(n):
            sxx, sxy, syy = out[j - 1, 0, m], out[j - 1, 1, m], out[j - 1, 2, m]
            txx, txy = lower[j - 1, 0, m], lower[j - 1, 1, m]
            tyx, tyy = lower[j - 1, 2, m], lower[j - 1, 3, m]
            ax, ay = sxx * txx + sxy * tyx, sxy * txx + syy * tyx  # S T, first column
            bx, by = sxx * txy + sxy * tyy, sxy * txy + syy * tyy  # second column
            out[j, 0, m] = inverse[j, 0, m] + txx * ax + tyx * ay
            out[j, 1, m] = inverse[j, 1, m] + txx * bx + tyx * by
            out[j, 2, m] = inverse[j, 2, m] + txy * bx + tyy * by


@compiled
def respond(inverse, lower, diagonal, profiles, weights, scale, first, solution):
    """Response of the levels >= first - 1 to an edge load on the levels first-1 .. first+1.

    `profiles` (3, up to 3) are the load's profiles at those levels, `diagonal` comes from
    :func:`diagonal_inverse`; the interface (level 0) is held fixed. `solution` is filled from
    level first - 1 on; below, it would follow by symmetry and is not needed.
    """
    top = inverse.shape[0] - 1
    for m in range(inverse.shape[2]):
        lx = ly = 0.0  # the loads of the upper levels, eliminated down to level first - 1
        for row in range(profiles.shape[1] - 1, -1, -1):
            j = first - 1 + row
            x = scale * (profiles[0, row] * weights[0, m] + profiles[1, row] * weights[1, m])
            y = scale * profiles[2, row] * weights[2, m]
            if row + 1 < profiles.shape[1]:
                x -= lower[j, 0, m] * lx + lower[j, 1, m] * ly
                y -= lower[j, 2, m] * lx + lower[j, 3, m] * ly
            lx, ly = x, y
            solution[j, 0, m], solution[j, 1, m] = x, y
        x, y, j = lx, ly, first - 1
        solution[j, 0, m] = diagonal[j, 0, m] * x + diagonal[j, 1, m] * y
        solution[j, 1, m] = diagonal[j, 1, m] * x + diagonal[j, 2, m] * y
    for j in range(first, top + 1):
        loaded = j <= first - 2 + profiles.shape[1]
        for m in range(inverse.shape[2]):
            px, py = solution[j - 1, 0, m], solution[j - 1, 1, m]
            ax = -(lower[j - 1, 0, m] * px + lower[j - 1, 2, m] * py)
            ay = -(lower[j - 1, 1, m] * px + lower[j - 1, 3, m] * py)
            if loaded:
                x, y = solution[j, 0, m], solution[j, 1, m]
                ax += inverse[j, 0, m] * x + inverse[j, 1, m] * y
                ay += inverse[j, 1, m] * x + inverse[j, 2, m] * y
            solution[j, 0, m], solution[j, 1, m] = ax, ay


@compiled
def rate_of_change(c1, c2, beta, new, u, u_past, out):
    """``out = (new - c1 u - c2 u_past) / beta``: the time derivative by the step's formula."""
    scale = 1.0 / beta
    for j in range(u.shape[0]):
        for c in range(2):
            x, u1, u2, rate = new[j, c], u[j, c], u_past[j, c], out[j, c]
            for m in range(x.size):
                rate[m] = scale * (x[m] - c1 * u1[m] - c2 * u2[m])


@compiled
def edge_residual(matrices, weights, field, edge, load, levels):
    """``load - sum_k A_k s_k``, with the :func:`edge_sums` s_0 to s_2 of a field, and s_3 the edge.

    At the lowest levels, for which the field must be given one level further up.
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


@compiled
def interface_blocks(d, h, n, nodes, stiffness, coupling):
    """``D_ij = d(i-j) - d(i+j)`` and ``N_ij = h(i+j) - h(i-j)`` between interface nodes.

    Half of the interface length, and of its force, belongs to the last node n; its normal force
    is not the modes' but the edge's.
    """
    for a in range(nodes.size):
        i = nodes[a]
        for b in range(a + 1):
            j = nodes[b]  # not above i: N_ji has the opposite sign of h(i-j)
            half = (0.5 if i == n else 1.0) * (0.5 if j == n else 1.0)
            stiffness[a, b] = stiffness[b, a] = half * (d[i - j] - d[i + j])
            coupling[a, b] = 0.0 if i == n else half * (h[i + j] - h[i - j])
            coupling[b, a] = half * (h[i + j] + h[i - j]) if j < n else 0.0


@compiled
def load_couple(compliance, forces, upper, lower, held, start):
    """What two bodies' reduced loads (2, n), the lower one's mirrored, do at zero slip, per mode.

    `held` is what they take from the forces on the upper body, ``S2 T^-1 r1 - S1 T^-1 r2``, and
    `start` the interface's displacement ``T^-1 (r1 + r2)``; `compliance` is T^-1 (xx, xy, yy) and
    `forces` holds S1 T^-1 and S2 T^-1 (xx, xy, yx, yy each).
    """
    for m in range(upper.shape[1]):
        x1, y1, x2, y2 = upper[0, m], upper[1, m], lower[0, m], -lower[1, m]
        held[0, m] = (forces[4, m] * x1 + forces[5, m] * y1) - (
            forces[0, m] * x2 + forces[1, m] * y2
        )
        held[1, m] = (forces[6, m] * x1 + forces[7, m] * y1) - (
            forces[2, m] * x2 + forces[3, m] * y2
        )
        x, y = x1 + x2, y1 + y2
        start[0, m] = compliance[0, m] * x + compliance[1, m] * y
        start[1, m] = compliance[1, m] * x + compliance[2, m] * y


@compiled
def relative_error(found, first, second):
    """Largest error of two guesses over the largest value found; infinite if all are zero."""
    largest = error = 0.0
    for j in range(found.size):
        largest = max(largest, abs(found[j]))
        error = max(error, abs(first[j] - found[j]), abs(second[j] - found[j]))
    return error / largest if largest > 0.0 else np.inf
