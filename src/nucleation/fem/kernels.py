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
def eliminate(
    lower: Array,
    load: Array,
    profiles: Array,
    weights: Array,
    scale: float,
    out: Array,
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
                load_x = rx[m]
                edge_x = a * wa[m] + b * wb[m]
                above_x = t[0, m] * ux + t[1, m] * uy
                x[m] = (load_x - edge_x) - above_x
                load_y = ry[m]
                edge_y = c * wc[m]
                above_y = t[2, m] * ux + t[3, m] * uy
                y[m] = (load_y - edge_y) - above_y


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
            own_x = q[0, m] * rx + q[1, m] * ry
            below_x = t[0, m] * px[m] + t[2, m] * py[m]
            x[m] = own_x - below_x
            own_y = q[1, m] * rx + q[2, m] * ry
            below_y = t[1, m] * px[m] + t[3, m] * py[m]
            y[m] = own_y - below_y


@compiled_loop
def load_couple(
    compliance: Array,
    forces: Array,
    upper: Array,
    lower: Array,
    held: Array,
    start: Array,
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
        upper_x = forces[4, m] * x1 + forces[5, m] * y1
        lower_x = forces[0, m] * x2 + forces[1, m] * y2
        held[0, m] = upper_x - lower_x
        upper_y = forces[6, m] * x1 + forces[7, m] * y1
        lower_y = forces[2, m] * x2 + forces[3, m] * y2
        held[1, m] = upper_y - lower_y
        x = x1 + x2
        y = y1 + y2
        start[0, m] = compliance[0, m] * x + compliance[1, m] * y
        start[1, m] = compliance[1, m] * x + compliance[2, m] * y
