"""The length at the drop under a declared perturbation, from theory and without a fit.

At L_s the creeping patch turns unstable, in a slow passage through a Hopf bifurcation. The drop
follows once its oscillating mode has grown to the size of the loading: the amplitude A of
:mod:`.mode_history`, driven by a perturbation of relative strength eps, reaches one. Where the
fluctuations near the mode's own frequency have the spectral density S, its mean square is

    sigma(t)^2 = eps^2 int_0^t abs(g)^2 S(Im Lambda) exp(2 int_s^t Re Lambda) ds.

At late times A is a complex Gaussian number times a growing exponential, and so ``|A| / sigma`` is
Rayleigh distributed: in a part ``P = exp(-1/sigma^2)`` of the realisations it has reached one. The
force drops in one phase of the oscillation, once in a period. In a period the patch grows by
``(dL/dt) 2 pi/Im Lambda``; over realisations the phase is uniform. So the part that has dropped by
a length is P, averaged over one period's growth about it. With Re Lambda linear in L and a steady
front the median is, in one line,

    L = L_s + sqrt(2 (dL/dt) log(1/eps_eff) / (d Re Lambda/dL)),
    eps_eff = eps sqrt(abs(g)^2 S log 2) [pi / ((d Re Lambda/dL) dL/dt)]^(1/4)      (the median).

The law assumes that the first burst of slip drops the force. A burst at a rate of a few V may come
to rest again, more often in shorter patches. The drop then comes one or more bursts later.
"""

import dataclasses
from typing import NamedTuple

import numpy as np

from ..model.perturbations import KINDS
from ..model.realisations import correlation
from ..model.settings import Perturbation
from ..types import Array
from .continued import CreepPath, continued, exponent_of, roughness_weights, trend
from .mode_history import ModeHistory

NEAR = 1.3  # lengths over L_s to which the closed form fits its straight lines
SAMPLED = 8.0  # points of a roughness in its correlation length
TINY = 1e-300  # in place of zero, which has no logarithm
LARGEST = 700.0  # exponent without overflow of its exponential
MEDIAN, EARLY, LATE = 0.5, 0.16, 0.84  # parts of the realisations that have dropped by then
ROOT_OF_MEDIAN = np.sqrt(np.log(2.0))  # sigma times this is 1 where half have reached one


class Drop(NamedTuple):
    """Length (m) at the drop: its median, and what 16 and 84 % of realisations are below."""

    length: float
    low: float
    high: float


class ClosedForm(NamedTuple):
    """The drop in one line: median length (m), and where growth begins.

    With its advancing front the patch begins to grow its mode at ``front_length``, within a few
    per cent of the L_s of steady creep.
    """

    front_length: float  # m
    length: float  # m
    effective: float  # eps_eff


@dataclasses.dataclass(frozen=True)
class Growth:
    """Amplitude of the mode per strength, over the patch's length and time."""

    time: Array  # s
    length: Array  # m
    log_amplitude: Array  # log(sigma / eps)
    exponent: Array  # int Re Lambda dt
    per_period: Array  # growth of the patch in a period of the mode (m)

    def drop(self, strength: float) -> Drop:
        """The expected drop at a relative strength; NaN where the law does not apply."""
        return Drop(*self.dropped_at(strength, MEDIAN, EARLY, LATE))

    def dropped_at(self, strength: float, *parts: float) -> list[float]:
        """Lengths (m) by which parts of the realisations have dropped at a relative strength."""
        reached = self.log_amplitude >= np.log(1.0 / (strength * ROOT_OF_MEDIAN))
        if reached.all() or not reached[-1]:
            return [np.nan] * len(parts)
        lengths: list[float] = np.interp(parts, self._dropped(strength), self.length).tolist()
        return lengths

    def _dropped(self, strength: float) -> Array:
        """The part of the realisations that have dropped by each length; it never decreases."""
        from scipy.integrate import cumulative_trapezoid

        log_sigma = np.maximum.accumulate(self.log_amplitude) + np.log(strength)
        inverse_square = np.exp(np.minimum(-2.0 * log_sigma, LARGEST))
        reached = np.exp(-inverse_square)
        area = cumulative_trapezoid(reached, self.length, initial=0)
        last = self.length[-1]

        def area_up_to(length: Array) -> Array:
            beyond = np.maximum(length - last, 0.0)
            return np.interp(length, self.length, area) + beyond

        above = area_up_to(self.length + 0.5 * self.per_period)
        below = area_up_to(self.length + -0.5 * self.per_period)
        return np.maximum.accumulate((above - below) / self.per_period)

    def strength_at(self, length: float) -> float:
        """The strength at which the median drops at a length (m); NaN outside the lengths."""
        if not self.length[0] < length < self.length[-1]:
            return float("nan")
        at = np.interp(length, self.length, self.log_amplitude)
        return float(np.exp(-at) / ROOT_OF_MEDIAN)

    def closed_form(self, history: ModeHistory, strength: float) -> ClosedForm:
        """The median drop in one line.

        Returns: The median length at the drop, and the numbers that it depends on.
        """
        first = int(np.argmin(self.exponent))  # where growth begins
        start = float(self.length[first])
        near = (self.length >= start) & (self.length <= NEAR * start)
        last = np.flatnonzero(near)[-1]
        lengths = self.length[near]
        if lengths.size < 2:  # a single length has no slope
            return ClosedForm(start, np.nan, np.nan)
        times = self.time[near]
        rates = trend(history, history.rate.real)(lengths)
        slope = float(np.polyfit(lengths, rates, 1)[0])
        speed = float(np.polyfit(times, lengths, 1)[0])
        grown = self.exponent[last] - self.exponent[first]
        initial = self.log_amplitude[last] - grown
        effective = float(strength * ROOT_OF_MEDIAN * np.exp(initial))
        square = 2.0 * speed * np.log(1.0 / effective) / slope
        delay = np.sqrt(max(square, 0.0))
        return ClosedForm(start, start + float(delay), effective)


def growth(history: ModeHistory, declared: Perturbation) -> Growth:
    """Growth of the mode along the creep under a declared forcing, in the mean square.

    The creep is continued by the trends of L(t) and Lambda(L).

    Returns: The amplitude per strength.
    """
    path = continued(history)
    if declared.kind == "none":
        raise ValueError("kind = 'none' perturbs nothing: there is no drop to expect")
    if not declared.in_time:
        return grown(path, _log_amplitude_of_roughness(history, path, declared))
    power = KINDS[declared.kind].power(history, declared)
    log_power = trend(history, np.log(power))(path.length)
    # log int exp(log_power + 2 int_s^t Re Lambda) ds, without overflow
    exponent = 2.0 * exponent_of(path).real
    step = path.time[1] - path.time[0]
    terms = log_power - exponent + np.log(step)
    return grown(path, 0.5 * (exponent + np.logaddexp.accumulate(terms)))


def _log_amplitude_of_roughness(
    history: ModeHistory, path: CreepPath, declared: Perturbation
) -> Array:
    """log(sigma / eps) under roughness of the strength, as the front passes over it."""
    x = np.arange(0.0, path.length[-1], declared.correlation_length / SAMPLED)
    covariance = correlation(x[:, None] - x, declared.correlation_length)
    log_factors = []
    rows = []
    for log_factor, row in roughness_weights(history, path, x):
        log_factors.append(log_factor)
        rows.append(row)
    weights = np.array(rows)

    # all times at once, and no complex copy of the covariance
    def variance(part: Array) -> Array:
        return ((part @ covariance) * part).sum(axis=1)

    squares = variance(weights.real) + variance(weights.imag)
    return np.array(log_factors) + 0.5 * np.log(np.maximum(squares, TINY))


def grown(path: CreepPath, log_amplitude: Array) -> Growth:
    """The growth along a path.

    Returns: At all times of the path.
    """
    count = path.time.size
    at = np.linspace(0, count - 1, log_amplitude.size)
    speed = np.gradient(path.length, path.time)
    return Growth(
        time=path.time,
        length=path.length,
        log_amplitude=np.interp(np.arange(count), at, log_amplitude),
        exponent=exponent_of(path).real,
        per_period=speed * 2.0 * np.pi / path.rate.imag,
    )
