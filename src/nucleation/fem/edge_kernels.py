"""Compiled loops for the stiffness of the right edge; arrays as in :mod:`.kernels`."""

from ..types import Array
from .compiling import compiled_loop


@compiled_loop
def diagonal_inverse(inverse: Array, lower: Array, out: Array) -> None:
    """Find the diagonal blocks of the inverse of the levels 1..n_y, interface held fixed.

    ``out[j] = Q[j] + T[j-1]^T out[j-1] T[j-1]``, with ``out[0] = 0``.

    Parameters
    ----------
    inverse, lower : ndarray
        Q and T of :func:`.kernels.factorise`.
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
        Q and T of :func:`.kernels.factorise`.
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
            along_x = profiles[0, row] * weights[0, m]
            across_x = profiles[1, row] * weights[1, m]
            x = scale * (along_x + across_x)
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
