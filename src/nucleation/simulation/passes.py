"""Compiled passes over the interface's nodes, for Newton's method and the control of steps.

The interface has some hundred nodes. On so few an operation of NumPy costs little more than its
call, and a step had some two hundred of them. Functions that call a friction law or a transform are
elsewhere.

All arrays are over nodes: 0..n_x, or the free nodes, which are the last ones of the interface.
"""

import numpy as np

from ..fem.compiling import compiled

LARGEST_SHIFT = 2.0  # of asinh(v / v0) in one Newton step


@compiled
def balance(
    tangential,
    normal,
    coefficient,
    slope,
    v,
    elastic,
    least,
    tolerance,
    rounding,
    strength,
):
    """Residual of the interface's equations, and its error.

    The error is the largest residual over its tolerance. Tolerated are a relative change of the
    slip rate and the round-off of displacements.

    Parameters
    ----------
    tangential, elastic : ndarray, shape (free nodes,)
        Tangential force p (N/m), and its elastic slope (N/m per m/s).
    normal, coefficient, slope, v, least : ndarray, shape (n_x + 1,)
        Normal force R (N/m), friction coefficient f, df/dv (s/m), slip rate (m/s), and the slip
        rate (m/s) below which changes count as relative to it.
    tolerance, rounding : float
        Tolerated relative change of the slip rate, and slip rate (m/s) within round-off.
    strength : float or ndarray, shape (n_x + 1,)
        Factor on f and its slope.

    Returns
    -------
    residual, damping : ndarray, shape (free nodes,)
        ``p + f R`` (N/m) and ``R df/dv`` (N/m per m/s).
    error : float
        NaN if it is NaN at any node.
    friction : ndarray, shape (n_x + 1,)
        ``strength f``.
    """
    n = elastic.size
    first = normal.size - n
    slope = strength * slope
    friction = strength * coefficient
    resolved = tolerance * (np.abs(v) + least)
    residual = np.empty(n)
    damping = np.empty(n)
    largest = 0.0
    undefined = False
    for i in range(n):
        j = i + first
        residual[i] = tangential[i] + friction[j] * normal[j]
        damping[i] = slope[j] * normal[j]
        total_slope = elastic[i] + abs(damping[i])
        scale = total_slope * resolved[j] + elastic[i] * rounding
        error = abs(residual[i]) / scale
        undefined |= error != error
        if error > largest:
            largest = error
    return residual, damping, np.nan if undefined else largest, friction


@compiled
def coupled(
    elastic,
    damping,
    ratio,
):
    """Free nodes, counted from 0, that elasticity couples: ``elastic > ratio |damping|``.

    Parameters
    ----------
    elastic, damping : ndarray, shape (free nodes,)
        Slopes (N/m per m/s) by elasticity and by friction.
    ratio : float

    Returns
    -------
    ndarray of int, shape (coupled nodes,)
    """
    nodes = np.empty(elastic.size, dtype=np.intp)
    number = 0
    for i in range(elastic.size):
        if elastic[i] > ratio * abs(damping[i]):
            nodes[number] = i
            number += 1
    return nodes[:number].copy()


@compiled
def newton_matrix(
    stiffness,
    coupling,
    coefficient,
    damping,
    active,
    beta,
):
    """``beta (D + f N) + R df/dv`` between the active nodes, transposed, in single precision.

    Parameters
    ----------
    stiffness, coupling : ndarray, shape (active nodes, active nodes)
        D and N between the active nodes (N/m per m).
    coefficient, damping : ndarray, shape (free nodes,)
        f, and ``R df/dv`` (N/m per m/s).
    active : ndarray of int
        The active nodes.
    beta : float
        Leading coefficient of the step (s).

    Returns
    -------
    ndarray, shape (active nodes, active nodes)
    """
    step = np.float32(beta)
    matrix = np.empty_like(stiffness)
    for a in range(active.size):
        f = np.float32(coefficient[active[a]])
        for b in range(active.size):
            matrix[b, a] = (stiffness[a, b] + coupling[a, b] * f) * step
        matrix[a, a] = matrix[a, a] + damping[active[a]]
    return matrix


@compiled
def direction(
    residual,
    elastic,
    damping,
    active,
    solved,
):
    """Newton's direction: that of the coupled system at active nodes, node by node elsewhere.

    Parameters
    ----------
    residual, elastic, damping : ndarray, shape (free nodes,)
        Residual (N/m), and its slopes by elasticity and by friction (N/m per m/s).
    active : ndarray of int
        The active nodes.
    solved : ndarray, shape (active nodes,)
        Solution of the coupled system (m/s).

    Returns
    -------
    ndarray, shape (free nodes,)
        Change of the slip rates (m/s).
    """
    change = np.empty(residual.size)
    for i in range(residual.size):
        change[i] = residual[i] / -(elastic[i] + damping[i])
    for i in range(active.size):
        change[active[i]] = solved[i]
    return change


@compiled
def updated(
    v,
    change,
    v0,
):
    """``v + change`` (m/s), but a slip rate that shrinks does so in asinh(v / v0).

    Friction is concave in v > 0: from above, Newton's method overshoots the root by far. Both
    forms agree to first order in the change, so that convergence stays quadratic.

    Parameters
    ----------
    v, change : ndarray, shape (free nodes,)
        Slip rates and their change (m/s).
    v0 : float
        Regularisation slip rate (m/s).

    Returns
    -------
    ndarray, shape (free nodes,)
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
def moved(
    v,
    velocity,
    beta,
    past,
    start,
):
    """The displacement ``w = past + beta (v - V)`` and its difference from another one.

    Parameters
    ----------
    v, past, start : ndarray, shape (free nodes,)
        Slip rates (m/s), the past part of w, and the other displacement (m).
    velocity, beta : float
        V (m/s), and leading coefficient of the step (s).

    Returns
    -------
    w, change : ndarray, shape (free nodes,)
        In m.
    """
    w = np.empty(v.size)
    change = np.empty(v.size)
    for i in range(v.size):
        w[i] = past[i] + beta * (v[i] - velocity)
        change[i] = w[i] - start[i]
    return w, change


@compiled
def reach(
    v,
    before,
    tolerated,
    least,
):
    """Number of nodes up to the last one at which the slip rate has changed.

    Parameters
    ----------
    v, before, least : ndarray, shape (n_x + 1,)
        Slip rates, those before, and the rates below which changes count as relative to them (m/s).
    tolerated : float
        Relative change that does not count.

    Returns
    -------
    int
    """
    slack = tolerated * (np.abs(before) + least)
    for i in range(v.size - 1, -1, -1):
        if not abs(v[i] - before[i]) <= slack[i]:
            return i + 1
    return 0


@compiled
def expected(
    rates,
    log_states,
    weights,
    scale,
    largest,
):
    """Extrapolate slip rates, as asinh(v / scale), and states.

    Parameters
    ----------
    rates, log_states : ndarray, shape (past, n_x + 1)
        Past slip rates (m/s) and log(phi), newest first.
    weights : ndarray, shape (past,)
        Weights of the past values.
    scale : float
        Slip rate (m/s).
    largest : float
        Bound on the extrapolated asinh(v / scale).

    Returns
    -------
    scaled, rate, log_state : ndarray, shape (n_x + 1,)
        asinh(v / scale), slip rates (m/s) and log(phi).
    """
    past, n = rates.shape
    scaled = np.empty(n)
    rate = np.empty(n)
    log_state = np.empty(n)
    for i in range(n):
        z = psi = 0.0
        for k in range(past):
            z += weights[k] * np.arcsinh(rates[k, i] / scale)
            psi += weights[k] * log_states[k, i]
        scaled[i] = min(max(z, -largest), largest)
        rate[i] = scale * np.sinh(scaled[i])
        log_state[i] = psi
    return scaled, rate, log_state


@compiled
def changed(
    rate,
    scaled,
    scale,
):
    """Largest distance of slip rates from others, in asinh(v / scale).

    Parameters
    ----------
    rate : ndarray, shape (n_x + 1,)
        Slip rates (m/s).
    scaled : ndarray, shape (n_x + 1,)
        The others, as asinh(v / scale).
    scale : float
        Slip rate (m/s).

    Returns
    -------
    float
    """
    largest = 0.0
    for i in range(scaled.size):
        largest = max(largest, abs(np.arcsinh(rate[i] / scale) - scaled[i]))
    return largest


@compiled
def distance(
    scaled,
    log_state,
    rate,
    psi,
    scale,
):
    """Largest distance of slip rates, in asinh(v / scale), and of log(phi) from expected ones.

    Parameters
    ----------
    scaled, log_state : ndarray, shape (n_x + 1,)
        Expected asinh(v / scale) and log(phi).
    rate, psi : ndarray, shape (n_x + 1,)
        Slip rates (m/s) and log(phi).
    scale : float
        Slip rate (m/s).

    Returns
    -------
    float
    """
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
