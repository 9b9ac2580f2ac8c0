"""Compiled loops of the separable solver: block-tridiagonal elimination for all modes at once.

Every array is laid out ``[level, component, mode]`` with the mode fastest, so that each inner
loop runs over the independent modes and the compiler turns it into vector instructions. Levels
count from the interface (0) to the top (n_y). Elimination runs from the top down, so that the
last pivot is the body's dynamic stiffness condensed on its interface.

For each mode the equations are ``A[j,j-1] u[j-1] + A[j,j] u[j] + A[j,j+1] u[j+1] = r[j]`` with
2x2 blocks. The factors kept are the inverse pivots ``Q[j] = P[j]^-1`` (symmetric: xx, xy, yy)
and ``T[j] = A[j,j+1] Q[j+1]`` (xx, xy, yx, yy).
"""

from __future__ import annotations

import numpy as np
from numba import njit

compiled = njit(cache=True, fastmath={"contract", "reassoc", "nsz"}, error_model="numpy")


@compiled
def factorise(kxx, mxx, kyy, myy, cxy, mass, stiff, deriv, lame, shear, pivot, inverse, lower):
    """Eliminate from the top down; fill `pivot` (level 0), `inverse` and `lower`.

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


@compiled
def eliminate(lower, load, profiles, weights, scale, out):
    """Forward sweep from the top to the interface, ``out[j] = r[j] - T[j] out[j+1]``.

    The right-hand side is the load with the edge's values moved to it, ``r = load - scale G^T e``,
    from the profiles (3, n_y + 1) of ``G^T e`` along y.
    """
    top, n = lower.shape[0], load.shape[2]
    for j in range(top, -1, -1):
        a, b, c = scale * profiles[0, j], scale * profiles[1, j], scale * profiles[2, j]
        if j == top:
            for m in range(n):
                out[j, 0, m] = load[j, 0, m] - (a * weights[0, m] + b * weights[1, m])
                out[j, 1, m] = load[j, 1, m] - c * weights[2, m]
        else:
            for m in range(n):
                x, y = out[j + 1, 0, m], out[j + 1, 1, m]
                out[j, 0, m] = (load[j, 0, m] - (a * weights[0, m] + b * weights[1, m])) - (
                    lower[j, 0, m] * x + lower[j, 1, m] * y
                )
                out[j, 1, m] = (load[j, 1, m] - c * weights[2, m]) - (
                    lower[j, 2, m] * x + lower[j, 3, m] * y
                )


@compiled
def substitute(inverse, lower, rhs):
    """Backward sweep in place, from the interface (known, in ``rhs[0]``) to the top."""
    n = rhs.shape[2]
    for j in range(1, rhs.shape[0]):
        for m in range(n):
            x, y = rhs[j, 0, m], rhs[j, 1, m]
            px, py = rhs[j - 1, 0, m], rhs[j - 1, 1, m]
            qxy = inverse[j, 1, m]
            rhs[j, 0, m] = (
                inverse[j, 0, m] * x + qxy * y - (lower[j - 1, 0, m] * px + lower[j - 1, 2, m] * py)
            )
            rhs[j, 1, m] = (
                qxy * x + inverse[j, 2, m] * y - (lower[j - 1, 1, m] * px + lower[j - 1, 3, m] * py)
            )


@compiled
def add_inertia(mass, weight, coefficients, fields, edge_load, edge_weight, load, near, out):
    """``out = load + weight[m] M f + edge_load[j] edge_weight[m]`` with ``f = sum_i c_i f_i``.

    M is the mass matrix in y, the last term acts along y only; ``near[j] = sum_m edge_weight f_y``.
    """
    top, n = mass.shape[1] - 1, load.shape[2]
    rows = np.zeros((3, 2, n))  # f at the levels j - 1, j, j + 1, each at its level modulo 3
    for level in range(top + 2):
        if level <= top:
            row = rows[level % 3]
            for c in range(2):
                for m in range(n):
                    row[c, m] = coefficients[0] * fields[0][level, c, m]
                for i in range(1, len(fields)):
                    for m in range(n):
                        row[c, m] += coefficients[i] * fields[i][level, c, m]
            total = 0.0
            for m in range(n):
                total += edge_weight[m] * row[1, m]
            near[level] = total
        if level == 0:
            continue
        j = level - 1
        lo, di, up = mass[0, j], mass[1, j], mass[2, j]  # zero where there is no neighbour
        below, here, above = rows[(j + 2) % 3], rows[j % 3], rows[(j + 1) % 3]
        for c in range(2):
            edge = edge_load[j] if c == 1 else 0.0
            for m in range(n):
                out[j, c, m] = load[j, c, m] + (
                    weight[m] * (lo * below[c, m] + di * here[c, m] + up * above[c, m])
                    + edge * edge_weight[m]
                )


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
def edge_sums(weights, field, first, out):
    """Sums over the modes that the right edge sees, at the levels >= `first`.

    ``out[0] = sum_m weights[0] u_x``, ``out[1] = sum_m weights[1] u_x`` and
    ``out[2] = sum_m weights[2] u_y``, each of shape (n_y + 1,).
    """
    n = field.shape[2]
    for j in range(first, field.shape[0]):
        a = b = c = 0.0
        for m in range(n):
            a += weights[0, m] * field[j, 0, m]
            b += weights[1, m] * field[j, 0, m]
            c += weights[2, m] * field[j, 1, m]
        out[0, j], out[1, j], out[2, j] = a, b, c


@compiled
def rate_of_change(c1, c2, beta, new, u, u_past, out):
    """``out = (new - c1 u - c2 u_past) / beta``: the time derivative by the step's formula."""
    scale = 1.0 / beta
    for j in range(u.shape[0]):
        for c in range(2):
            for m in range(u.shape[2]):
                out[j, c, m] = scale * (new[j, c, m] - c1 * u[j, c, m] - c2 * u_past[j, c, m])


@compiled
def tridiagonal_product(lower, diagonal, upper, vector, out):
    """``out = A vector`` for a tridiagonal matrix and a vector."""
    last = vector.size - 1
    for i in range(vector.size):
        total = diagonal[i] * vector[i]
        if i > 0:
            total += lower[i] * vector[i - 1]
        if i < last:
            total += upper[i] * vector[i + 1]
        out[i] = total


@compiled
def interface_blocks(d, h, n, nodes, stiffness, coupling):
    """``D_ij = d(i-j) - d(i+j)`` and ``N_ij = h(i+j) - h(i-j)`` between interface nodes.

    Half of the interface length, and of its force, belongs to the last node n; its normal force
    is not the modes' but the edge's.
    """
    for a in range(nodes.size):
        for b in range(nodes.size):
            i, j = nodes[a], nodes[b]
            away = abs(i - j)
            half = (0.5 if i == n else 1.0) * (0.5 if j == n else 1.0)
            stiffness[a, b] = half * (d[away] - d[i + j])
            signed = h[away] if i > j else -h[away]
            coupling[a, b] = 0.0 if i == n else half * (h[i + j] - signed)
