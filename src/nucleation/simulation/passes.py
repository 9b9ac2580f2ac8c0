"""Compiled passes over the interface's nodes, for Newton's method and the control of steps.

The interface has some hundred nodes. On so few an operation of NumPy costs little more than its
call, and a step had some two hundred of them. Arrays are over the nodes 0..n_x or 1..n_x.
"""

import numpy as np
from numba.extending import overload

from ..fem.compiling import compiled
from ..model.friction import evolutions

LARGEST_RATE_EXPONENT = 40.0  # of asinh(v / scale) in a first guess
SLOW_IN_EVENT = 1e-3  # slip rates below this part of the fastest one need no relative accuracy
LARGEST_SHIFT = 2.0  # of asinh(v / v0) in one Newton step
LARGEST_ASINH = 709.0  # whose hyperbolic sine is finite
SETTLED = 1e-8  # change of asinh(v / s), relative, after which the next one is round-off
HALVED = 1e-16  # by halving


@compiled
def balance(
    tangential, normal, coefficient, slope, v, elastic, least, tolerance, rounding, strength, ratio
):
    """The interface's equations: residual, damping, error, friction, and the coupled nodes.

    ``p + f R`` (N/m) and ``R df/dv`` (N/m per m/s) at the nodes 1..n_x; the largest residual over
    its tolerance, a relative change of the slip rate or the round-off of displacements (NaN if it
    is NaN at any node); ``strength f`` at 0..n_x; and the nodes at which elasticity is above a
    ratio to the damping, node 1 as 0.
    """
    n = elastic.size
    residual = np.empty(n)
    damping = np.empty(n)
    friction = np.empty(n + 1)
    nodes = np.empty(n, dtype=np.intp)
    number = 0
    largest = 0.0
    undefined = False
    friction[0] = strength[0] * coefficient[0]
    for i in range(n):
        j = i + 1
        friction[j] = strength[j] * coefficient[j]
        residual[i] = tangential[i] + friction[j] * normal[j]
        damping[i] = strength[j] * slope[j] * normal[j]
        total_slope = elastic[i] + abs(damping[i])
        resolved = tolerance * (abs(v[j]) + least[j])
        scale = total_slope * resolved + elastic[i] * rounding
        error = abs(residual[i]) / scale
        undefined |= error != error
        if error > largest:
            largest = error
        if elastic[i] > ratio * abs(damping[i]):
            nodes[number] = i
            number += 1
    error = np.nan if undefined else largest
    return residual, damping, error, friction, nodes[:number].copy()


@compiled
def newton_matrix(stiffness, coupling, coefficient, damping, active, beta):
    """``beta (D + f N) + R df/dv`` between the active nodes, transposed, in single precision."""
    step = np.float32(beta)
    matrix = np.empty_like(stiffness)
    for a in range(active.size):
        f = np.float32(coefficient[active[a]])
        for b in range(active.size):
            matrix[b, a] = (stiffness[a, b] + coupling[a, b] * f) * step
        matrix[a, a] = matrix[a, a] + damping[active[a]]
    return matrix


@compiled
def direction(residual, elastic, damping, active, solved):
    """Newton's direction (m/s): of the coupled system at active nodes, node by node elsewhere."""
    change = np.empty(residual.size)
    for i in range(residual.size):
        change[i] = residual[i] / -(elastic[i] + damping[i])
    for i in range(active.size):
        change[active[i]] = solved[i]
    return change


@compiled
def updated(before, residual, elastic, damping, active, solved, v0):
    """Slip rates (m/s) after a step of Newton's method, at the nodes 1..n_x.

    A slip rate that shrinks does so in asinh(v / v0). Friction is concave in v > 0: from above,
    Newton's method overshoots the root by far. Both forms agree to first order in the change, so
    that convergence stays quadratic.
    """
    new = direction(residual, elastic, damping, active, solved)
    for i in range(new.size):
        v = before[i + 1]
        change = new[i]
        ratio = change / np.sqrt(v * v + v0 * v0)
        if abs(ratio) > 0.5 and v * change < 0.0:
            shift = min(max(ratio, -LARGEST_SHIFT), LARGEST_SHIFT)
            new[i] = v0 * np.sinh(np.arcsinh(v / v0) + shift)
        else:
            new[i] = v + change
    return new


@compiled
def updated_by_asinh(before, residual, elastic, damping, active, solved, scale, step):
    """The same to first order, for friction ``c (asinh(v/s) + step v/hypot(v, s))``.

    Stuck nodes slip more slowly than their neighbours by tens of orders of magnitude. There a
    tangent does not show where the root is, from below as little as from above. So each node solves
    its own balance of ``E v`` and friction with Newton's slope: ``E`` plus the damping. Where
    friction weakens within the step it moves along the tangent.
    """
    new = direction(residual, elastic, damping, active, solved)
    for i in range(new.size):
        v, s, e = before[i + 1], scale[i + 1], elastic[i]
        size = np.hypot(v, s)
        c = damping[i] * size / (1.0 + step[i + 1] * (s / size) ** 2)
        if c > 0.0:
            friction = c * (np.arcsinh(v / s) + step[i + 1] * (v / size))
            wanted = e * v + friction + (e + damping[i]) * new[i]
            z = balanced_asinh(abs(wanted), e * s, c, step[i + 1])
            new[i] = np.copysign(s * np.sinh(z), wanted)
        else:
            new[i] = v + new[i]
    return new


@compiled
def balanced_asinh(size, e, c, step):
    """The root z of ``e sinh z + c (z + step tanh z) = size``; not finite if `size` is not.

    Each term alone bounds the root from above. Without a step the left side is convex: from there
    Newton's method descends to the root, until it does not move any more. With one it may leave the
    bracket, which is then halved.
    """
    low, high = 0.0, min(size / c, np.arcsinh(size / e), LARGEST_ASINH)
    z = high
    while True:
        grown = np.exp(z)
        sinh, cosh = 0.5 * (grown - 1.0 / grown), 0.5 * (grown + 1.0 / grown)
        excess = e * sinh + c * (z + step * (sinh / cosh)) - size
        if excess > 0.0:
            high = z
        else:
            low = z
        change = excess / (e * cosh + c * (1.0 + step / (cosh * cosh)))
        settled = SETTLED
        if not low <= z - change <= high:
            change = z - 0.5 * (low + high)
            settled = HALVED  # half of a short bracket is no estimate of the error
        z -= change
        if not abs(change) > settled * (1.0 + z):
            return z


@compiled
def moved(v, before, velocity, periodic, beta, past, start, tolerated, least):
    """Slip rates at all nodes (m/s), ``w = past + beta (v - V)`` (m), and ``w - start``.

    Also the number of nodes up to the last one whose slip rate has changed by more than the part
    `tolerated`, of itself or of `least` (m/s).
    """
    n = v.size
    rates = np.empty(n + 1)
    w = np.empty(n)
    change = np.empty(n)
    for i in range(n):
        rates[i + 1] = v[i]
        w[i] = past[i] + beta * (v[i] - velocity)
        change[i] = w[i] - start[i]
    rates[0] = rates[n] if periodic else velocity
    reach = n + 1
    while reach > 0:
        old = before[reach - 1]
        if not abs(rates[reach - 1] - old) <= tolerated * (abs(old) + least[reach - 1]):
            break
        reach -= 1
    return rates, w, change, reach


@compiled
def predicted(
    past_rates, past_states, past_w, weights, formula, beta, velocity, periodic, forcing, least
):
    """A step's first guess, and the past part of its formula.

    Past values, newest first, are extrapolated by weights: slip rates as asinh(v / scale), above
    the scale by relative changes, and log(phi). Returned are the first, slip rates (m/s) with that
    of the driven edge, log(phi), the scale (m/s), the past part of w (m) and of log(phi), and w
    (m). The scale is the largest one of `least` (m/s) and a part of the fastest slip rate.
    """
    past, n = past_rates.shape
    fastest = largest(past_rates[0])
    scale = max(least, SLOW_IN_EVENT * fastest)
    bound = min(LARGEST_RATE_EXPONENT, np.arcsinh(10.0 * fastest / scale))
    scaled = np.empty(n)
    rate = np.empty(n)
    log_state = np.empty(n)
    past_log_state = np.empty(n)
    before = np.empty(n - 1)
    w = np.empty(n - 1)
    for i in range(n):
        z = psi = kept = 0.0
        for k in range(past):
            z += weights[k] * np.arcsinh(past_rates[k, i] / scale)
            psi += weights[k] * past_states[k, i]
            kept += formula[k] * past_states[k, i]
        scaled[i] = min(max(z, -bound), bound)
        rate[i] = scale * np.sinh(scaled[i])
        log_state[i] = psi
        past_log_state[i] = kept + beta * forcing[i]
        if i == 0:
            continue
        kept = 0.0
        for k in range(past):
            kept += formula[k] * past_w[k, i - 1]
        before[i - 1] = kept
        w[i - 1] = kept + beta * (rate[i] - velocity)
    rate[0] = rate[n - 1] if periodic else velocity
    return scaled, rate, log_state, scale, before, past_log_state, w


@compiled
def largest_change(rate, scaled, scale):
    """Largest distance of slip rates (m/s) from `scaled`, in asinh(v / scale)."""
    largest = 0.0
    for i in range(scaled.size):
        largest = max(largest, abs(np.arcsinh(rate[i] / scale) - scaled[i]))
    return largest


@compiled
def distance(scaled, log_state, rate, psi, scale):
    """Largest distance of slip rates, in asinh(v / scale), and log(phi) from expected ones."""
    largest = largest_change(rate, scaled, scale)
    for i in range(psi.size):
        largest = max(largest, abs(psi[i] - log_state[i]))
    return largest


@compiled
def largest(values):
    """The largest absolute value."""
    found = 0.0
    for i in range(values.size):
        found = max(found, abs(values[i]))
    return found


def wright_omega(z):
    """The positive solution of ``w + log(w) = z`` for real z >= -700, exp(z) below -36 or so.

    Fritsch, Shafer & Crowley's fourth-order iteration (Comm. ACM 16, 123, 1973) on whole arrays.
    It starts from a rational function of exp(z), continued by a straight line for z > 0. numba
    compiles this in place of the function of the same name that laws import.
    """
    z = np.maximum(z, -700.0)
    below = np.minimum(z, 0.0)
    e = np.exp(below)
    numerator = e * (1.0 + e * (4 / 3))
    denominator = 1.0 + e * (7 / 3 + e * (5 / 6))
    w = numerator / denominator + 0.8 * np.maximum(z, 0.0)
    while True:
        r = z - w - np.log(w)
        near = 1.0 + w
        t = near * (near + r * (2 / 3))
        correction = (t - 0.5 * r) / (t - r)
        w = w * (1.0 + r / near * correction)
        large = np.abs(r) > 1e-3  # false for NaN; after this step 1e-3 becomes 1e-3^4
        if not np.any(large):
            return w


@overload(evolutions.wright_omega)
def _compiled_wright_omega(z):
    return wright_omega
