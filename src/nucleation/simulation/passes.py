"""Compiled passes over the interface's nodes, for Newton's method and the control of steps.

The interface has some hundred nodes: an operation of NumPy on them costs little more than its call,
and a step had some two hundred. What calls a friction law or a transform is not here.
"""

import numpy as np

from ..fem.compiling import compiled

LARGEST_SHIFT = 2.0  # of asinh(v / v0) in one Newton step


@compiled
def balance(
    tangential, normal, coefficient, slope, v, elastic, least, tolerance, rounding, strength
):
    """Residual ``p + f R`` and damping ``R df/dv`` at the free nodes, the error, and f at all.

    `normal`, `v` and what follows from it are given at the nodes 0..n_x, the first of which is not
    free if an edge is driven; f and its slope count `strength` times. The error is the largest, in
    units of what is tolerated: a relative change of the slip rate, from the `least` one on, and
    what displacements are rounded by; NaN if it is so anywhere.
    """
    n = elastic.size
    first = normal.size - n
    slope, friction = strength * slope, strength * coefficient
    resolved = tolerance * (np.abs(v) + least)
    residual, damping = np.empty(n), np.empty(n)
    largest, undefined = 0.0, False
    for i in range(n):
        j = i + first
        r, d = tangential[i] + friction[j] * normal[j], slope[j] * normal[j]
        residual[i], damping[i] = r, d
        scale = (elastic[i] + abs(d)) * resolved[j] + elastic[i] * rounding
        error = abs(r) / scale
        undefined |= error != error
        if error > largest:
            largest = error
    return residual, damping, np.nan if undefined else largest, friction


@compiled
def coupled(elastic, damping, ratio):
    """The nodes, from 0 for the interface's first, where ``elastic > ratio |damping|``."""
    nodes = np.empty(elastic.size, dtype=np.intp)
    number = 0
    for i in range(elastic.size):
        if elastic[i] > ratio * abs(damping[i]):
            nodes[number] = i
            number += 1
    return nodes[:number].copy()


@compiled
def newton_matrix(stiffness, coupling, coefficient, damping, active, beta):
    """``beta (D + f N) + R df/dv`` among the active nodes, in single precision, transposed."""
    step, matrix = np.float32(beta), np.empty_like(stiffness)
    for a in range(active.size):
        f = np.float32(coefficient[active[a]])
        for b in range(active.size):
            matrix[b, a] = (stiffness[a, b] + coupling[a, b] * f) * step
        matrix[a, a] = matrix[a, a] + damping[active[a]]
    return matrix


@compiled
def direction(residual, elastic, damping, active, solved):
    """Newton's direction: what has been solved for at the active nodes, the others are alone."""
    change = np.empty(residual.size)
    for i in range(residual.size):
        change[i] = residual[i] / -(elastic[i] + damping[i])
    for i in range(active.size):
        change[active[i]] = solved[i]
    return change


@compiled
def updated(v, change, v0):
    """``v + change`` (m/s), but a slip rate that shrinks does so in asinh(v / v0).

    Friction is concave in v > 0: from above, Newton's method goes far beyond the root. Both
    forms agree to first order in the change, so that convergence stays quadratic.
    """
    new = np.empty(v.size)
    for i in range(v.size):
        ratio = change[i] / np.sqrt(v[i] * v[i] + v0 * v0)
        if abs(ratio) > 0.5 and v[i] * change[i] < 0.0:
            shift = min(max(ratio, -LARGEST_SHIFT), LARGEST_SHIFT)
            new[i] = v0 * np.sinh(np.arcsinh(v[i] / v0) + shift)
        else:
            new[i] = v[i] + change[i]
    return new


@compiled
def moved(v, velocity, beta, past, start):
    """The displacement ``w = past + beta (v - V)`` (m), and by how much it is not `start`."""
    w, change = np.empty(v.size), np.empty(v.size)
    for i in range(v.size):
        w[i] = past[i] + beta * (v[i] - velocity)
        change[i] = w[i] - start[i]
    return w, change


@compiled
def reach(v, before, tolerated, least):
    """The number of nodes up to the last one whose slip rate is another by more than tolerated.

    That is `tolerated` times the slip rate, from `least` on.
    """
    slack = tolerated * (np.abs(before) + least)
    for i in range(v.size - 1, -1, -1):
        if not abs(v[i] - before[i]) <= slack[i]:
            return i + 1
    return 0


@compiled
def expected(rates, log_states, weights, scale, largest):
    """Slip rates and states extrapolated from past ones, (number, nodes), by their `weights`.

    Slip rates count as asinh(v / scale), at most as that of `largest`, and are given so, too.
    """
    past, n = rates.shape
    scaled, rate, log_state = np.empty(n), np.empty(n), np.empty(n)
    for i in range(n):
        z = psi = 0.0
        for k in range(past):
            z += weights[k] * np.arcsinh(rates[k, i] / scale)
            psi += weights[k] * log_states[k, i]
        scaled[i], log_state[i] = min(max(z, -largest), largest), psi
        rate[i] = scale * np.sinh(scaled[i])
    return scaled, rate, log_state


@compiled
def changed(rate, scaled, scale):
    """Largest distance of slip rates, as asinh(v / scale), from others."""
    largest = 0.0
    for i in range(scaled.size):
        largest = max(largest, abs(np.arcsinh(rate[i] / scale) - scaled[i]))
    return largest


@compiled
def distance(scaled, log_state, rate, psi, scale):
    """Largest distance of slip rates, as asinh(v / scale), and states from expected ones."""
    largest = changed(rate, scaled, scale)
    for i in range(psi.size):
        largest = max(largest, abs(psi[i] - log_state[i]))
    return largest


@compiled
def largest_size(values):
    """The largest absolute value."""
    largest = 0.0
    for i in range(values.size):
        largest = max(largest, abs(values[i]))
    return largest


@compiled
def largest_at(values):
    """Index of the largest absolute value, the first of several."""
    found = 0
    for i in range(1, values.size):
        if abs(values[i]) > abs(values[found]):
            found = i
    return found
