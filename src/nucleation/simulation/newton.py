"""Compiled passes over the interface's nodes, for Newton's method.

The interface has some hundred nodes: an operation of NumPy on them costs little more than its call,
and an iteration had some seventy. These do the same arithmetic in the same order, without
`fastmath`, so that not a bit is different. What calls a friction law or a transform is not here.
"""

import numpy as np
from numba import njit

compiled = njit(cache=True, error_model="numpy")


@compiled
def slip_speed(v, v0, distance):
    """The regularised slip speed ``sqrt(v^2 + v0^2)`` (m/s), and that over the slip distance."""
    speed = np.sqrt(v * v + v0 * v0)
    return speed, speed / distance


@compiled
def total_slope(by_rate, by_log_state, psi_by_rate, v, speed, distance):
    """``df/dv`` (s/m) with the state at the end of the step, which follows the slip speed."""
    return by_rate + by_log_state * psi_by_rate * v / (speed * distance)


@compiled
def balance(tangential, normal, coefficient, slope, elastic, resolved, tolerance, rounding):
    """Residual ``p + f R`` and damping ``R df/dv`` at the free nodes, and the largest error.

    `normal`, `coefficient` and `slope` are given at the nodes 0..n_x. The error is in units of what
    is tolerated: a relative change of the slip rate, `resolved`, and what displacements are rounded
    by; NaN if it is so anywhere.
    """
    n = elastic.size
    first = normal.size - n
    residual, damping = np.empty(n), np.empty(n)
    largest, undefined = 0.0, False
    for i in range(n):
        r = tangential[i] + coefficient[i + first] * normal[i + first]
        d = slope[i + first] * normal[i + first]
        residual[i], damping[i] = r, d
        scale = (elastic[i] + abs(d)) * (tolerance * resolved[i]) + elastic[i] * rounding
        error = abs(r) / scale
        undefined |= error != error
        if error > largest:
            largest = error
    return residual, damping, np.nan if undefined else largest


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
def change_of_slope(active, factorised, elastic, damping, ratio):
    """Largest relative change of a coupled node's slope since its damping was `factorised`.

    Infinite if other nodes are coupled now.
    """
    number, largest = 0, 0.0
    for i in range(elastic.size):
        if elastic[i] > ratio * abs(damping[i]):
            if number == active.size or active[number] != i:
                return np.inf
            change = abs(damping[i] - factorised[number])
            change /= elastic[i] + abs(factorised[number])
            largest = max(largest, change)
            number += 1
    return largest if number == active.size else np.inf


@compiled
def newton_matrix(stiffness, coupling, coefficient, damping, active, beta):
    """``beta (D + f N) + R df/dv`` among the active nodes into `stiffness`, in single precision."""
    step = np.float32(beta)
    for a in range(active.size):
        f = np.float32(coefficient[active[a]])
        for b in range(active.size):
            stiffness[a, b] = (stiffness[a, b] + coupling[a, b] * f) * step
        stiffness[a, a] = stiffness[a, a] + damping[active[a]]


@compiled
def uncoupled(residual, elastic, damping):
    """Newton's direction of nodes that are alone."""
    change = np.empty(residual.size)
    for i in range(residual.size):
        change[i] = residual[i] / -(elastic[i] + damping[i])
    return change


@compiled
def updated(v, change, v0):
    """``v + change`` (m/s), and the nodes where the slip rate shrinks by half or more."""
    new, shrinking, number = np.empty(v.size), np.empty(v.size, dtype=np.intp), 0
    for i in range(v.size):
        new[i] = v[i] + change[i]
        ratio = change[i] / np.sqrt(v[i] * v[i] + v0 * v0)
        if abs(ratio) > 0.5 and v[i] * change[i] < 0.0:
            shrinking[number] = i
            number += 1
    return new, shrinking[:number].copy()


@compiled
def moved(v, velocity, beta, past, start):
    """The displacement ``w = past + beta (v - V)`` (m), and by how much it is not `start`."""
    w, change = np.empty(v.size), np.empty(v.size)
    for i in range(v.size):
        w[i] = past[i] + beta * (v[i] - velocity)
        change[i] = w[i] - start[i]
    return w, change
