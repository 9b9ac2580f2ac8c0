"""The scheme of time integration: what a step makes of the past, behind one small door.

A step solves ``y = sum_i past_i y_{n-i} + beta dy/dt`` for the body, twice for its second time
derivative, and for slip and state at the interface. A scheme says with which coefficients; another
linear multistep formula is another class with the attributes and methods of :class:`BDF`.
"""

import dataclasses

import numpy as np

from ...types import Array
from .bdf import (
    LARGEST_GROWTH,
    LARGEST_GROWTH_OF_BDF3,
    Formula,
    beta_of_step,
    error_factor,
    extrapolation_weights,
)
from .ladder import rung_below, rung_nearest, rung_value

QUASI_STATIC = 10.0  # crossings of the body by shear waves within a step


@dataclasses.dataclass(frozen=True)
class Step:
    """The formulas of one step."""

    body: Formula
    interface: Formula
    extrapolation: Array  # weights of the interface's past values, newest first, for a first guess
    error_share: float  # local error over the distance between step and guess
    first: bool  # whether the step starts from rest

    @property
    def length(self) -> float:
        """The time (s) that it covers."""
        return self.body.step

    def error(self, distance: float) -> float:
        """Local error, given the distance between step and guess; infinite without an estimate."""
        return np.inf if self.first else self.error_share * distance

    @property
    def s(self) -> float:
        """The weight (1/s^2) of inertia in the body's operator ``K + s M``."""
        return 1.0 / self.body.beta**2


@dataclasses.dataclass(frozen=True)
class BDF:
    """BDF2 for the body, and BDF3 for slip and state while the body is quasi-static.

    BDF3 is not stable for undamped waves that a step resolves. Where waves cross the body many
    times within a step, inertia (kept at second order) is a small correction, and the third order
    follows the nucleating mode with longer steps.

    The leading coefficients of BDF2 are taken from the ladder; its steps follow from them.
    """

    crossing_time: float = np.inf  # s, of the body by shear waves

    levels = 2  # motions of the body that a step takes from the past,
    instants = 3  # and values of the interface's fields
    error_order = 3  # power of the step's length in its local error
    largest_growth = LARGEST_GROWTH  # of the length from one step to the next

    def step(self, rung: int, past_times: Array) -> Step:
        """The step with the leading coefficient of a rung, after past times (s), newest first."""
        beta, known = rung_value(rung), past_times.size
        if known == 1:
            formula = Formula.backward_euler(beta)
        else:
            formula = Formula.bdf2(beta, float(past_times[0] - past_times[1]))
        # the second step's guess is too poor to tell an error from
        share = error_factor(formula, past_times) if known == self.instants else 0.0
        weights = extrapolation_weights(float(past_times[0]) + formula.step, past_times)
        interface = self._on_interface(formula, past_times)
        return Step(formula, interface, weights, share, known == 1)

    def _on_interface(self, formula: Formula, past_times: Array) -> Formula:
        """The formula for slip and state."""
        if past_times.size < 3 or formula.step < QUASI_STATIC * self.crossing_time:
            return formula
        now, before, earlier = past_times.tolist()
        last, last_but_one = now - before, before - earlier
        if formula.step > LARGEST_GROWTH_OF_BDF3 * last or (
            last > LARGEST_GROWTH_OF_BDF3 * last_but_one
        ):
            return formula
        return Formula.bdf3(formula.step, past_times)

    def coefficient(self, step: float, previous_step: float) -> float:
        """The leading coefficient (s) of a step after a previous one (both in s)."""
        return beta_of_step(step, previous_step)

    def rung(self, step: float, previous_step: float) -> int:
        """The rung of a step that has been taken, from its length and the previous one's (s)."""
        return rung_nearest(beta_of_step(step, previous_step))

    def steady_rung(self, step: float) -> int:
        """The largest rung on which steps of one length are no longer than `step` (s)."""
        return rung_below(beta_of_step(step, step))

    def steady_step(self, rung: int) -> float:
        """The length (s) of the steps that stay on a rung: at a constant beta, 3/2 of it."""
        return 1.5 * rung_value(rung)
