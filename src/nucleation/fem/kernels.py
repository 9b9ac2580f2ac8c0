"""Compiled loops of the separable solver: block-tridiagonal elimination for all modes at once.

Every array is laid out ``[level, component, mode]`` with the mode fastest. Each inner loop runs
over the independent modes, along rows that the compiler knows to be contiguous, and becomes vector
instructions. Levels count from the interface (0) to the top (n_y). Elimination runs from the top
down: the last pivot is the body's dynamic stiffness condensed on its interface.

For each mode the equations are ``A[j,j-1] u[j-1] + A[j,j] u[j] + A[j,j+1] u[j+1] = r[j]`` with
2x2 blocks. The factors are the inverse pivots ``Q[j] = P[j]^-1`` (symmetric: xx, xy, yy) and
``T[j] = A[j,j+1] Q[j+1]`` (xx, xy, yx, yy).
"""

from ..types import Array
from .compiling import compiled_loop


@compiled_loop
def factorise(
    kxx: Array,
    mxx: Array,
    kyy: Array,
    myy: Array,
    cxy: Array,
    mass: Array,
    stiff: Array,
    deriv: Array,
    lame: float,
    shear: float,
    held: tuple[bool, bool],
    pivot: Array,
    inverse: Array,
    lower: Array,
) -> None:
    """Eliminate from the top down.

    The blocks are ``A_xx = kxx M + mxx K``, ``A_yy = kyy M + myy K`` and
    ``A_xy = cxy (lame C - shear C^T)`` with the y-matrices M, K and C.

    Parameters
    ----------
    kxx, mxx, kyy, myy, cxy : ndarray
        Coefficients of each mode, shape (modes,).
    mass, stiff, deriv : ndarray
        The matrices M, K and C (:mod:`.matrices`), shape (3, n_y + 1).
    lame, shear : float
        Moduli of the coupling (Pa).
    held : (bool, bool)
        Whether x and y are zero on the top: a component held fixed has zeros in `inverse`.
    pivot : ndarray
        Filled with P[0]: xx, xy, yy, shape (3, modes).
    inverse : ndarray
        Filled with Q in the levels 1..n_y, shape (n_y + 1, 3, modes).
    lower : ndarray
        Filled with T, shape (n_y, 4, modes).
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
                pivot[0, m] = kx * md + mx * kd - (txx * uxx + txy * uxy)
                pivot[1, m] = c * cd - (txx * uyx + txy * uyy)
                pivot[2, m] = ky * md + my * kd - (tyx * uyx + tyy * uyy)
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
def eliminate(
    lower: Array, load: Array, profiles: Array, weights: Array, scale: float, out: Array
) -> None:
    """Sweep a load from the top to the interface, ``out[j] = r[j] - T[j] out[j+1]``.

    The right-hand side has the forces of the edge values, ``r = load - scale G^T e``.

    Parameters
    ----------
    lower : ndarray
        T of :func:`factorise`.
    load : ndarray
        The load (N/m), shape (n_y + 1, 2, modes).
    profiles : ndarray
        Profiles of ``G^T e`` along y, shape (3, n_y + 1).
    weights : ndarray
        Weight of each mode in the edge's forces, shape (3, modes).
    scale : float
        Scale of the loads.
    out : ndarray
        Filled with the swept load, shape (n_y + 1, 2, modes).
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
                x[m] = (rx[m] - (a * wa[m] + b * wb[m])) - (t[0, m] * ux + t[1, m] * uy)
                y[m] = (ry[m] - c * wc[m]) - (t[2, m] * ux + t[3, m] * uy)


@compiled_loop
def substitute(inverse: Array, lower: Array, rhs: Array) -> None:
    """Sweep back from the interface to the top, in place.

    Parameters
    ----------
    inverse, lower : ndarray
        Q and T of :func:`factorise`.
    rhs : ndarray
        The swept load (N/m) with the interface's displacement (m) in level 0, (levels, 2, modes).
    """
    for j in range(1, rhs.shape[0]):
        x = rhs[j, 0]
        y = rhs[j, 1]
        px = rhs[j - 1, 0]
        py = rhs[j - 1, 1]
        t = lower[j - 1]
        q = inverse[j]
        for m in range(x.size):
            rx = x[m]
            ry = y[m]
            x[m] = q[0, m] * rx + q[1, m] * ry - (t[0, m] * px[m] + t[2, m] * py[m])
            y[m] = q[1, m] * rx + q[2, m] * ry - (t[1, m] * px[m] + t[3, m] * py[m])


@compiled_loop
def diagonal_inverse(inverse: Array, lower: Array, out: Array) -> None:
    """Find the diagonal blocks of the inverse of the levels 1..n_y, interface held fixed.

    ``out[j] = Q[j] + T[j-1]^T out[j-1] T[j-1]``, with ``out[0] = 0``.

    Parameters
    ----------
    inverse, lower : ndarray
        Q and T of :func:`factorise`.
    out : ndarray
        Filled with the blocks: xx, xy, yy, shape (n_y + 1, 3, modes).
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
def respond(
    inverse: Array,
    lower: Array,
    diagonal: Array,
    profiles: Array,
    weights: Array,
    scale: float,
    first: int,
    solution: Array,
) -> None:
    """Find the displacement under the force of one edge value, interface held fixed.

    The force acts on the levels first-1 .. first+1.

    Parameters
    ----------
    inverse, lower : ndarray
        Q and T of :func:`factorise`.
    diagonal : ndarray
        The result of :func:`diagonal_inverse`.
    profiles : ndarray
        Profiles of the force at those levels, shape (3, up to 3).
    weights : ndarray
        Weight of each mode in the edge's forces, shape (3, modes).
    scale : float
        Scale of the loads.
    first : int
        A level from 1 on.
    solution : ndarray
        Filled from level first - 1 on, shape (n_y + 1, 2, modes); lower levels are not needed.
    """
    top = inverse.shape[0] - 1
    modes = inverse.shape[2]
    loaded = profiles.shape[1]
    base = first - 1
    for m in range(modes):
        lx = 0.0  # loads of the upper levels, eliminated down to the base
        ly = 0.0
        for row in range(loaded - 1, -1, -1):
            j = base + row
            x = scale * (profiles[0, row] * weights[0, m] + profiles[1, row] * weights[1, m])
            y = scale * profiles[2, row] * weights[2, m]
            if row + 1 < loaded:
                t = lower[j]
                x -= t[0, m] * lx + t[1, m] * ly
                y -= t[2, m] * lx + t[3, m] * ly
            lx = x
            ly = y
            solution[j, 0, m] = x
            solution[j, 1, m] = y
        s = diagonal[base]
        solution[base, 0, m] = s[0, m] * lx + s[1, m] * ly
        solution[base, 1, m] = s[1, m] * lx + s[2, m] * ly
    for j in range(first, top + 1):
        below = solution[j - 1]
        here = solution[j]
        t = lower[j - 1]
        q = inverse[j]
        for m in range(modes):
            px = below[0, m]
            py = below[1, m]
            ax = -(t[0, m] * px + t[2, m] * py)
            ay = -(t[1, m] * px + t[3, m] * py)
            if j < base + loaded:
                x = here[0, m]
                y = here[1, m]
                ax += q[0, m] * x + q[1, m] * y
                ay += q[1, m] * x + q[2, m] * y
            here[0, m] = ax
            here[1, m] = ay


@compiled_loop
def load_couple(
    compliance: Array, forces: Array, upper: Array, lower: Array, held: Array, start: Array
) -> None:
    """Find the effect of two bodies' reduced loads at zero slip, per mode.

    Parameters
    ----------
    compliance : ndarray
        T^-1: xx, xy, yy (m per N/m), shape (3, modes).
    forces : ndarray
        S1 T^-1 and S2 T^-1: xx, xy, yx, yy of each, shape (8, modes).
    upper, lower : ndarray
        The reduced loads r1 and r2 (N/m), the lower body's mirrored, shape (2, modes).
    held : ndarray
        Filled with ``S2 T^-1 r1 - S1 T^-1 r2`` (N/m), shape (2, modes).
    start : ndarray
        Filled with the interface's displacement ``T^-1 (r1 + r2)`` (m), shape (2, modes).
    """
    for m in range(upper.shape[1]):
        x1 = upper[0, m]
        y1 = upper[1, m]
        x2 = lower[0, m]
        y2 = -lower[1, m]
        held[0, m] = (forces[4, m] * x1 + forces[5, m] * y1) - (
            forces[0, m] * x2 + forces[1, m] * y2
        )
        held[1, m] = (forces[6, m] * x1 + forces[7, m] * y1) - (
            forces[2, m] * x2 + forces[3, m] * y2
        )
        x = x1 + x2
        y = y1 + y2
        start[0, m] = compliance[0, m] * x + compliance[1, m] * y
        start[1, m] = compliance[1, m] * x + compliance[2, m] * y
