"""Variable-step BDF2, L-stable, with an error estimate; and BDF3.

For ``dy/dt = g`` the BDF2 step from t to t + h, after a step h', reads (r = h/h')

    y = c1 y_n + c2 y_{n-1} + beta g,   beta = h (1 + r)/(1 + 2 r),
    c1 = (1 + r)^2/(1 + 2 r),           c2 = -r^2/(1 + 2 r).

The body's operator depends on beta alone. Its values are taken from a geometric ladder
(:mod:`.ladder`), so that few operators serve a whole run; the step h follows from beta and h'.
"""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from ...types import Array

LARGEST_GROWTH = 2.0  # BDF2 is zero-stable up to a growth of 1 + sqrt(2) per step,
LARGEST_GROWTH_OF_BDF3 = 1.5  # BDF3 up to (1 + sqrt(5)) / 2


@dataclasses.dataclass(frozen=True)
class Formula:
    """Coefficients of one step: ``y = sum_i past_i y_{n-i} + beta dy/dt``, newest value first."""

    step: float
    beta: float
    past: tuple[float, ...]

    @classmethod
    def bdf2(cls, beta: float, previous_step: float) -> Formula:
        """The BDF2 step with leading coefficient `beta` (s) after `previous_step` (s)."""
        half = beta - 0.5 * previous_step
        step = half + math.sqrt(half * half + beta * previous_step)
        r = step / previous_step
        return cls(step, beta, ((1 + r) ** 2 / (1 + 2 * r), -(r**2) / (1 + 2 * r)))

    @classmethod
    def backward_euler(cls, beta: float) -> Formula:
        """The first step, of first order."""
        return cls(beta, beta, (1.0, 0.0))

    @classmethod
    def bdf3(cls, step: float, past_times: Array) -> Formula:
        """The BDF3 step of length `step` (s) after three past times (s), newest first.

        It is the derivative of the cubic through the new and the past values.
        """
        a, b, c = (step + past_times[0] - past_times).tolist()  # from each past time to the new one
        beta = 1.0 / (1.0 / a + 1.0 / b + 1.0 / c)
        past = (
            beta * b * c / ((b - a) * (c - a) * a),
            beta * a * c / ((a - b) * (c - b) * b),
            beta * a * b / ((a - c) * (b - c) * c),
        )
        return cls(step, beta, past)

    def from_past(self, values: Array) -> Array:
        """What the step takes from past values, newest first along the first axis.

        Values that are not there yet count as zero: the first step has one past value.
        """
        used = min(len(self.past), values.shape[0])
        return np.asarray(self.past[:used]) @ values[:used]


def beta_of_step(step: float, previous_step: float) -> float:
    """The leading coefficient (s) of a BDF2 step."""
    r = step / previous_step
    return step * (1 + r) / (1 + 2 * r)


def extrapolation_weights(time: float, past: Array) -> Array:
    """Lagrange weights that extrapolate values at the `past` times (s) to `time` (s)."""
    times, weights = past.tolist(), [1.0] * past.size
    for i, own in enumerate(times):
        for j, other in enumerate(times):
            if i != j:
                weights[i] *= (time - other) / (own - other)
    return np.array(weights)


def error_factor(formula: Formula, past: Array) -> float:
    """Local error of the BDF2 step over the difference of step and quadratic extrapolation.

    `past` holds the three last times (s), newest first. The local error is ``B y'''`` with
    ``B = h^3 (1 + r)^2 / (6 r (1 + 2 r))`` and the extrapolation's is ``A y'''`` with
    ``A = h (h + h') (h + h' + h'') / 6``, of opposite sign.
    """
    h, (now, before, earlier) = formula.step, past.tolist()
    first, second = now - before, now - earlier
    r = h / first
    scheme = h**3 * (1 + r) ** 2 / (6 * r * (1 + 2 * r))
    extrapolation = h * (h + first) * (h + second) / 6
    return scheme / (scheme + extrapolation)
