"""Boundary-value problem of an elastic layer, solved with 150 digits.

The four amplitudes of the general solution (Eq. S-full_sol) follow from two tractions at the
interface ``y = 0`` and two conditions at the far side, by Gaussian elimination. Nothing is
simplified by hand, so this shares no formula with the implementation. Real form:
``u = (U, i W)``, ``sigma_xy = T``, ``sigma_yy = i N``.
"""

from decimal import Decimal, getcontext

import numpy as np

getcontext().prec = 150


def solve(matrix, right):
    """Gaussian elimination with pivoting; `right` is a list of columns."""
    n = len(matrix)
    rows = [list(row) + [column[i] for column in right] for i, row in enumerate(matrix)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda r: abs(rows[r][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for r in range(n):
            if r != i:
                factor = rows[r][i] / rows[i][i]
                rows[r] = [x - factor * y for x, y in zip(rows[r], rows[i], strict=True)]
    return [[rows[i][n + j] / rows[i][i] for i in range(n)] for j in range(len(right))]


def mode_rows(k, y, mu, nu):
    """Coefficients of the four amplitudes in U, W, T and N at height y."""
    z, kappa = k * y, 3 - 4 * nu
    up, down = z.exp(), (-z).exp()
    u = [up, down, z * up, z * down]
    w = [up, -down, (z - kappa) * up, -(z + kappa) * down]
    du = [up, -down, (1 + z) * up, (1 - z) * down]
    dw = [up, down, (1 + z - kappa) * up, -(1 - z - kappa) * down]
    t = [mu * k * (a + b) for a, b in zip(du, w, strict=True)]
    modulus = 2 * mu * k / (1 - 2 * nu)
    n = [modulus * ((1 - nu) * a - nu * b) for a, b in zip(dw, u, strict=True)]
    return {"u": u, "w": w, "t": t, "n": n}


def compliance(k, height, mu, nu, far_side):
    """Real 2x2 matrix with ``(U, W) = C (T, N)`` at y = 0; height < 0 for a lower body."""
    k, height, mu, nu = (Decimal(float(x)) for x in (k, height, mu, nu))
    near, far = mode_rows(k, Decimal(0), mu, nu), mode_rows(k, height, mu, nu)
    conditions = {
        "velocity": ("u", "n"),
        "free": ("t", "n"),
        "clamped": ("u", "w"),
        "roller": ("w", "t"),
    }[far_side]
    matrix = [near["t"], near["n"], far[conditions[0]], far[conditions[1]]]
    columns = []
    for load in ((1, 0), (0, 1)):
        (amplitudes,) = solve(matrix, [[Decimal(x) for x in (*load, 0, 0)]])
        columns.append(
            [sum(a * c for a, c in zip(amplitudes, near[row], strict=True)) for row in "uw"]
        )
    return [[columns[j][i] for j in range(2)] for i in range(2)]


def reference_compliance(k, body, side):
    """The same for a `Body`; a half-space is a layer with ``|k| H = 120``."""
    height = body.height if np.isfinite(body.height) else 120.0 / abs(k)
    sign = 1.0 if side == "upper" else -1.0
    material = body.material
    return compliance(
        k, sign * height, material.shear_modulus, material.poisson_ratio, body.far_side
    )


def reference_stiffness(k, body):
    """``A_xx, A_xy, A_yy, det A``, ``(T, N) = -mu k A (U, W)``: the inverse of the compliance."""
    (xx, xy), (_, yy) = reference_compliance(k, body, "upper")
    det, scale = xx * yy - xy * xy, -1 / (Decimal(body.material.shear_modulus) * Decimal(k))
    entries = scale * yy / det, scale * xy / det, scale * xx / det, scale * scale / det
    return tuple(float(x) for x in entries)


def reference_transfer(k, upper, lower, mu):
    """G1 and G2 of a pair; None stands for a rigid body."""
    zero = [[Decimal(0)] * 2] * 2
    c1 = zero if upper is None else reference_compliance(k, upper, "upper")
    c2 = zero if lower is None else reference_compliance(k, lower, "lower")
    difference = [[c1[i][j] - c2[i][j] for j in range(2)] for i in range(2)]
    ((t, n),) = solve(difference, [[Decimal(1), Decimal(0)]])
    scale = Decimal(float(mu)) * Decimal(float(k))
    return float(-t / scale), float(n / scale)
