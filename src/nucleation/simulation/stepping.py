"""Time integration: variable-step BDF2, L-stable, with an error estimate; BDF3; and their steps.

For ``dy/dt = g`` the BDF2 step from t to t + h, after a step h', reads (r = h/h')

    y = c1 y_n + c2 y_{n-1} + beta g,   beta = h (1 + r)/(1 + 2 r),
    c1 = (1 + r)^2/(1 + 2 r),           c2 = -r^2/(1 + 2 r).

The body's operator depends on beta alone. Its values are taken from a geometric ladder, so that few
operators serve a whole run; the step h follows from beta and h'.

A step solves ``y = sum_i past_i y_{n-i} + beta dy/dt`` for the body, twice for its second time
derivative, and for slip and state at the interface. Another linear multistep formula is another
:class:`Scheme`.
"""

from __future__ import annotations

import dataclasses
import math
from abc import ABC, abstractmethod
from typing import ClassVar, TypeVar

import numpy as np

from ..types import Array

LARGEST_GROWTH = 2.0  # BDF2 is zero-stable up to a growth of 1 + sqrt(2) per step,
LARGEST_GROWTH_OF_BDF3 = 1.5  # BDF3 up to (1 + sqrt(5)) / 2
RUNGS_PER_OCTAVE = 4
QUASI_STATIC = 10.0  # crossings of the body by shear waves within a step,
WITHOUT_WAVES = 25.0  # and within each of three steps, after which no waves are left


Values = TypeVar("Values", float, Array)


@dataclasses.dataclass(frozen=True)
class _Formula:
    """Coefficients of one step: ``y = sum_i past_i y_{n-i} + beta dy/dt``, newest value first."""

    step: float  # s
    beta: float  # s
    past: tuple[float, ...]

    def rate(self, value: Values, newest: Values, oldest: Values) -> Values:
        """Rate (1/s) at the end of a BDF2 step."""
        c1, c2 = self.past
        return (value - c1 * newest - c2 * oldest) / self.beta

    def straight(
        self, newest: Array, newest_rate: Array, oldest: Array, oldest_rate: Array
    ) -> Array:
        """The value at the end of a BDF2 step without acceleration."""
        c1, c2 = self.past
        return c1 * (newest + self.beta * newest_rate) + c2 * (oldest + self.beta * oldest_rate)

    @classmethod
    def bdf2(cls, beta: float, previous_step: float) -> _Formula:
        """The BDF2 step of a leading coefficient (s), after a step of some length (s)."""
        half = beta - 0.5 * previous_step
        step = half + math.sqrt(half * half + beta * previous_step)
        r = step / previous_step
        c1 = (1 + r) ** 2 / (1 + 2 * r)
        c2 = -(r**2) / (1 + 2 * r)
        return cls(step, beta, (c1, c2))

    @classmethod
    def bdf3(cls, step: float, past_times: Array) -> _Formula:
        """The BDF3 step (s): by the cubic through the new value and three past ones."""
        a, b, c = (step + past_times[0] - past_times).tolist()  # from each past time to the new one
        beta = 1.0 / (1.0 / a + 1.0 / b + 1.0 / c)
        past = (
            beta * b * c / ((b - a) * (c - a) * a),
            beta * a * c / ((a - b) * (c - b) * b),
            beta * a * b / ((a - c) * (b - c) * c),
        )
        return cls(step, beta, past)


def extrapolation_weights(time: float, past: Array) -> Array:
    """Lagrange weights that extrapolate values at past times (s) to a time (s)."""
    times = past.tolist()
    weights = [1.0] * past.size
    for i, own in enumerate(times):
        for j, other in enumerate(times):
            if i != j:
                weights[i] *= (time - other) / (own - other)
    return np.array(weights)


def error_factor(formula: _Formula, past: Array) -> float:
    """Local error of the BDF2 step over the difference of step and quadratic extrapolation.
    The local error is ``B y'''`` with ``B = h^3 (1 + r)^2 / (6 r (1 + 2 r))``. The extrapolation's
    is ``A y'''`` with ``A = h (h + h') (h + h' + h'') / 6``, of opposite sign.
    """
    h = formula.step
    now, before, earlier = past.tolist()
    first = now - before
    second = now - earlier
    r = h / first
    scheme = h**3 * (1 + r) ** 2 / (6 * r * (1 + 2 * r))
    extrapolation = h * (h + first) * (h + second) / 6
    return scheme / (scheme + extrapolation)


def rung_below(beta: float) -> int:
    """The largest rung of the ladder ``2^(n / RUNGS_PER_OCTAVE)`` seconds not above `beta`."""
    return math.floor(RUNGS_PER_OCTAVE * math.log2(beta) + 1e-9)


def rung_value(rung: int) -> float:
    """The value of beta (s) of a rung."""
    return 2.0 ** (rung / RUNGS_PER_OCTAVE)


@dataclasses.dataclass(frozen=True)
class Step:
    """The formulas of one step."""

    body: _Formula
    interface: _Formula
    extrapolation: Array  # weights of the interface's past values, newest first, for a first guess
    error_share: float  # local error over the distance between step and guess
    first: bool  # whether the step starts from rest
    without_waves: bool  # whether the body follows its interface and the loads

    @property
    def length(self) -> float:
        """Length of the step (s)."""
        return self.body.step

    def error(self, distance: float) -> float:
        """Local error, given the distance between step and guess; infinite without an estimate."""
        return np.inf if self.first else self.error_share * distance

    @property
    def s(self) -> float:
        """Weight (1/s^2) of inertia in the body's operator ``K + s M``."""
        return 1.0 / self.body.beta**2


class Scheme(ABC):
    """A linear multistep scheme: what a simulation asks of it."""

    levels: ClassVar[int]
    """Past motions of the body that a step uses."""
    instants: ClassVar[int]
    """Past values of the interface's fields that a step uses."""
    error_order: ClassVar[int]
    """Power of the step's length in its local error."""
    largest_growth: ClassVar[float]
    """Largest length of a step over that of the step before."""

    @abstractmethod
    def step(self, rung: int, past_times: Array) -> Step:
        """The step of a rung after past times (s), newest first: one, or up to `instants`."""

    @abstractmethod
    def leading_coefficient(self, step: float, previous_step: float) -> float:
        """Leading coefficient (s) of the body's step of some length, after another (s)."""

    @abstractmethod
    def steady_step(self, rung: int) -> float:
        """Length (s) of the steps that stay on a rung."""

    def steady_rung(self, step: float) -> int:
        """The largest rung on which steps of one length are no longer than `step` (s)."""
        return rung_below(self.leading_coefficient(step, step))


@dataclasses.dataclass(frozen=True)
class BDF(Scheme):
    """BDF2 for the body, and BDF3 for slip and state while the body is quasi-static.

    BDF3 is not stable for undamped waves that a step resolves. Where waves cross the body many
    times within a step, inertia (kept at second order) is a small correction, and with the third
    order longer steps follow the nucleating mode.

    The leading coefficients of BDF2 are taken from the ladder; its steps follow from them.
    """

    crossing_time: float = np.inf  # s, of the body by shear waves

    levels = 2
    instants = 3
    error_order = 3
    largest_growth = LARGEST_GROWTH

    def step(self, rung: int, past_times: Array) -> Step:
        """A step of backward Euler after one past time, BDF2 or BDF3 after two or three."""
        beta = rung_value(rung)
        known = past_times.size
        if known == 1:
            formula = _Formula(beta, beta, (1.0, 0.0))  # backward Euler
        else:
            formula = _Formula.bdf2(beta, float(past_times[0] - past_times[1]))
        # the second step's guess is too poor for an error estimate
        share = error_factor(formula, past_times) if known == self.instants else 0.0
        weights = extrapolation_weights(float(past_times[0]) + formula.step, past_times)
        interface = formula
        without_waves = False
        if known == 3 and formula.step >= QUASI_STATIC * self.crossing_time:
            now, before, earlier = past_times.tolist()
            last, second_last = now - before, before - earlier
            if max(formula.step / last, last / second_last) <= LARGEST_GROWTH_OF_BDF3:
                interface = _Formula.bdf3(formula.step, past_times)
            shortest = min(formula.step, last, second_last)
            without_waves = shortest >= WITHOUT_WAVES * self.crossing_time
        return Step(formula, interface, weights, share, known == 1, without_waves)

    def leading_coefficient(self, step: float, previous_step: float) -> float:
        """That of BDF2, ``h (1 + r)/(1 + 2 r)``."""
        r = step / previous_step
        return step * (1 + r) / (1 + 2 * r)

    def steady_step(self, rung: int) -> float:
        """3/2 of the rung's beta."""
        return 1.5 * rung_value(rung)
