"""How long the rest of many runs will take, from when those so far began and ended.

A run's duration is taken to be a number of seconds per unit of its predicted cost, and a gap that
is the same for all: starts of programs, queues. No number of cores is asked for: what a cluster
grants is seen from how many runs are at work at once.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ..configuration.advice import UNSTABLE
from ..model.parameters import Parameters
from ..theory.estimates import growth_time

LENGTH_EXPONENT, HEIGHT_EXPONENT = 0.72, 0.26
"""Of a step's time in the number of elements along x and y, measured by ``make bench``."""


def step_cost(parameters: Parameters) -> float:
    """The time of a step over that of others, from the mesh."""
    mesh = parameters.mesh
    below = parameters.below.mesh.n_y if parameters.below else 0
    return float(mesh.n_x**LENGTH_EXPONENT * (mesh.n_y + below) ** HEIGHT_EXPONENT)


def expected_steps(parameters: Parameters, theory_length: float) -> float:
    """The number of a run's steps, were each the longest: up to where its patch turns unstable.

    Parameters
    ----------
    parameters : of the run.
    theory_length : of its fault (m); NaN where sliding is stable.

    Notes
    -----
    Runs to their drop take 1.4 to 2 times as many, of one study mostly by the same factor to some
    15 %, those through a rupture up to 8 times. What the control of the steps' size adds is not
    known before.
    """
    stepping = parameters.stepping
    time = stepping.end_time
    if np.isfinite(theory_length):
        time = min(time, growth_time(parameters, UNSTABLE * theory_length))
    return time / (stepping.longest_step * parameters.memory_time)


def predicted_cost(parameters: Parameters, theory_length: float) -> float:
    """A run's cost over that of others, of :func:`step_cost` and :func:`expected_steps`."""
    return step_cost(parameters) * expected_steps(parameters, theory_length)


class TimeLeft:
    """Estimates when the last of many runs ends; times are in seconds of any clock.

    Parameters
    ----------
    costs : of all runs by name, in any unit, such as :func:`predicted_cost`.
    """

    def __init__(self, costs: Mapping[str, float]) -> None:
        self._costs = dict(costs)
        self._waiting = dict(costs)
        self._begun: dict[str, float] = {}
        self._first: float | None = None
        self._ended: list[tuple[float, float]] = []  # cost, duration (s)
        self._at_once = 1

    @property
    def running(self) -> int:
        """Runs that have begun and not ended."""
        return len(self._begun)

    def begins(self, run: str, now: float) -> None:
        """A run has begun; said twice, the later time counts. What has ended stays so."""
        if run in self._waiting or run in self._begun:
            self._first = now if self._first is None else min(self._first, now)
            self._waiting.pop(run, None)
            self._begun[run] = now

    def begins_once(self, run: str, now: float) -> None:
        """A run is seen at work: it has begun, unless that is known already."""
        if run not in self._begun:
            self.begins(run, now)

    def ends(self, run: str, now: float) -> None:
        """A run has ended, well or not; one that was not seen to begin tells nothing of time."""
        self._waiting.pop(run, None)
        if run in self._begun:
            self._ended.append((self._costs[run], now - self._begun.pop(run)))

    def seconds(self, now: float) -> float | None:
        """Time until the last run ends; None before one has ended.

        What a run at work still needs is its expected duration less what it has had; one that takes
        longer than expected is taken to end at once. With few left the longest of them counts.
        """
        self._at_once = max(self._at_once, self.running)
        if self._first is None or not any(duration > 0.0 for _, duration in self._ended):
            return None
        costs = np.array([self._costs[run] for run in self._begun])
        had = now - np.array(list(self._begun.values()))
        pace = mean_of_censored(
            np.array([duration / cost for cost, duration in self._ended]),
            np.array([cost for cost, _ in self._ended]), had / costs, costs,
        )  # fmt: skip
        spent = sum(duration for _, duration in self._ended) + had.sum()
        idle = max(self._at_once * (now - self._first) - spent, 0.0)
        gap = idle / (len(self._ended) + self.running)
        rest = np.maximum(pace * costs - had, 0.0)
        ahead = sum(pace * cost + gap for cost in self._waiting.values()) + rest.sum()
        return float(max(ahead / self._at_once, rest.max(initial=0.0)))


def mean_of_censored(
    seen: np.ndarray, seen_weights: np.ndarray, above: np.ndarray, above_weights: np.ndarray
) -> float:
    """Weighted mean of values of which some are only known to be above a bound.

    Those that end first are the short ones: a mean of them alone would be too low. This is the mean
    of Kaplan and Meier's estimate (1958), in Efron's form: from small to large, the weight of a
    bound is handed to all that is larger, in proportion; the largest bound counts as a value.

    Parameters
    ----------
    seen, above : the values, and the bounds of the others.
    seen_weights, above_weights : of each.
    """
    values = np.concatenate([seen, above])
    weights = np.concatenate([seen_weights, above_weights])
    bound = np.arange(values.size) >= seen.size
    order = np.lexsort((bound, values))
    values, weights, bound = values[order], weights[order], bound[order]
    beyond = weights.sum() - np.cumsum(weights)  # the weight of all that is larger
    hands_on = bound & (beyond > 0.0)
    factors = np.where(hands_on, 1.0 + weights / np.where(hands_on, beyond, 1.0), 1.0)
    grown = weights * np.concatenate([[1.0], np.cumprod(factors)[:-1]])
    grown[hands_on] = 0.0
    return float((grown * values).sum() / grown.sum())
