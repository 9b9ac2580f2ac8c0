"""The length at the drop under a declared perturbation, from theory and without a fit.

At L_s the creeping patch turns unstable, in a slow passage through a Hopf bifurcation. The drop
follows once its oscillating mode has grown to the size of the loading: the amplitude A of
:mod:`.mode_history`, driven by a perturbation of relative strength eps, reaches one. Where the
fluctuations near the mode's own frequency have the spectral density S, its mean square is

    sigma(t)^2 = eps^2 int_0^t abs(g)^2 S(Im Lambda) exp(2 int_s^t Re Lambda) ds.

At late times A is a complex Gaussian number times a growing exponential, and so ``|A| / sigma`` is
Rayleigh distributed: in a part ``P = exp(-1/sigma^2)`` of the realisations it has reached one. The
force falls in one phase of the oscillation, once in a period, while the patch goes on growing, by
``(dL/dt) 2 pi/Im Lambda``; over realisations the phase is even. So the part that has dropped by a
length is P, averaged over one period's growth about it. With Re Lambda linear in L and a steady
front the median is, in one line,

    L = L_s + sqrt(2 (dL/dt) log(1/eps_eff) / (d Re Lambda/dL)),
    eps_eff = eps sqrt(abs(g)^2 S log 2) [pi / ((d Re Lambda/dL) dL/dt)]^(1/4)      (the median).

The law ends where its own assumption does: a burst of slip at a rate of a few V may come to rest
again, the more often the shorter the patch. The drop is then one or more bursts late.
"""

import dataclasses
from typing import NamedTuple

import numpy as np
from scipy.integrate import cumulative_trapezoid

from ..model.perturbation import Perturbation
from ..simulation.realisation import correlation, spectral_density
from ..types import Array
from .continued import Path, continued, exponent_of, roughness_weights, trend
from .mode_history import ModeHistory

NEAR = 1.3  # lengths over L_s through which the closed form lays its straight lines
SAMPLED = 8.0  # points of a roughness in its correlation length
TINY = 1e-300  # in place of zero, of which there is no logarithm
MEDIAN, EARLY, LATE = 0.5, 0.16, 0.84  # parts of the realisations that have dropped by then


class Drop(NamedTuple):
    """The drop to be expected: its median, and what 16 and 84 % of the realisations are below."""

    length: float  # m
    low: float
    high: float
    time: float  # s
    time_low: float
    time_high: float


class ClosedForm(NamedTuple):
    """The drop in one line: median length (m) from three numbers, and where growth begins.

    With its advancing front the patch begins to grow its mode at ``front_length``, within a few
    per cent of L_s, which is that of steady creep.
    """

    front_length: float  # m
    length: float  # m
    front_speed: float  # dL/dt, m/s
    growth_slope: float  # d Re Lambda/dL, 1/(m s)
    effective: float  # eps_eff


@dataclasses.dataclass(frozen=True)
class Growth:
    """Amplitude of the mode per strength, over the patch's length and time."""

    time: Array  # s
    length: Array  # m
    log_amplitude: Array  # log(sigma / eps)
    exponent: Array  # int Re Lambda dt
    per_period: Array  # growth of the patch in a period of the mode (m)

    def at(self, amplitude: float) -> tuple[float, float]:
        """Length (m) and time (s) where the amplitude per strength last passes a value, or NaN."""
        above = self.log_amplitude >= np.log(amplitude)
        if not above[-1] or above.all():
            return float("nan"), float("nan")
        i = int(np.flatnonzero(~above)[-1])
        ends = self.log_amplitude[i : i + 2]
        length, time = (
            float(np.interp(np.log(amplitude), ends, values[i : i + 2]))
            for values in (self.length, self.time)
        )
        return length, time

    def drop(self, strength: float) -> Drop:
        """The drop to be expected at a relative strength; NaN where the law does not reach."""
        if not np.isfinite(self.at(1.0 / (strength * np.sqrt(np.log(2.0))))[0]):
            return Drop(*6 * (float("nan"),))
        parts = self._dropped(strength)
        lengths = np.interp((MEDIAN, EARLY, LATE), parts, self.length)
        return Drop(*lengths.tolist(), *np.interp(lengths, self.length, self.time).tolist())

    def _dropped(self, strength: float) -> Array:
        """The part of the realisations that have dropped by each length; it never falls."""
        late = np.maximum.accumulate(self.log_amplitude) + np.log(strength)
        reached = np.exp(-np.exp(np.minimum(-2.0 * late, 700.0)))
        area = cumulative_trapezoid(reached, self.length, initial=0)
        ends = [self.length + side * 0.5 * self.per_period for side in (-1.0, 1.0)]
        below, above = (
            np.interp(end, self.length, area) + np.maximum(end - self.length[-1], 0.0)
            for end in ends
        )
        return np.maximum.accumulate((above - below) / self.per_period)

    def strength_at(self, length: float) -> float:
        """The strength at which the median drops at a length (m); NaN beyond the law's reach."""
        if not self.length[0] < length < self.length[-1]:
            return float("nan")
        at = np.interp(length, self.length, self.log_amplitude)
        return float(np.exp(-at) / np.sqrt(np.log(2.0)))

    def closed_form(self, history: ModeHistory, strength: float) -> ClosedForm:
        """The median drop at a relative strength in one line."""
        i = int(np.argmin(self.exponent))  # where growth begins
        start = float(self.length[i])
        near = (self.length >= start) & (self.length <= NEAR * start)
        rate = trend(history, history.rate.real)(self.length[near])
        slope = float(np.polyfit(self.length[near], rate, 1)[0])
        speed = float(np.polyfit(self.time[near], self.length[near], 1)[0])
        at = np.flatnonzero(near)[-1]
        seed = self.log_amplitude[at] - (self.exponent[at] - self.exponent[i])
        effective = float(strength * np.sqrt(np.log(2.0)) * np.exp(seed))
        delay = np.sqrt(max(2.0 * speed * np.log(1.0 / effective) / slope, 0.0))
        return ClosedForm(start, start + float(delay), speed, slope, effective)


def growth(history: ModeHistory, declared: Perturbation) -> Growth:
    """How the mode grows along the creep under a declared forcing, in the mean square.

    The creep is carried on by the trends of L(t) and Lambda(L). Strength and seed
    are not used. ValueError if nothing is declared to be perturbed.
    """
    path = continued(history)
    if declared.kind == "strength":
        return grown(path, _log_gathered(history, path, declared))
    log_power = trend(history, np.log(_power(history, declared)))(path.length)
    return grown(path, 0.5 * _log_variance(path, log_power))


def _power(history: ModeHistory, declared: Perturbation) -> Array:
    """``|g|^2 S(Im Lambda)`` (1/s) at the instants of a history, for a forcing in time."""
    memory, omega = history.parameters.memory_time, history.rate.imag
    spectrum = spectral_density(omega, declared.correlation_time * memory)
    if declared.kind == "normal_load":
        return np.abs(history.normal_load) ** 2 * spectrum
    if declared.kind == "drive_velocity":
        # displacement follows velocity by 1/(i omega)
        velocity = history.parameters.loading.velocity
        return np.abs(history.drive * velocity / omega) ** 2 * spectrum
    if declared.kind == "state":
        covariance = correlation(history.x[:, None] - history.x, declared.correlation_length)
        shares = np.einsum("ix,xy,iy->i", history.state, covariance, history.state.conj()).real
        return shares / memory**2 * spectrum
    raise ValueError(f"kind = {declared.kind!r} perturbs nothing: there is no drop to expect")


def _log_gathered(history: ModeHistory, path: Path, declared: Perturbation) -> Array:
    """log(sigma / eps) under roughness of the strength, which the front runs over."""
    x = np.arange(0.0, path.length[-1], declared.correlation_length / SAMPLED)
    covariance = correlation(x[:, None] - x, declared.correlation_length)
    logs, weights = map(np.array, zip(*roughness_weights(history, path, x), strict=True))
    # all times at once, and no complex copy of the covariance
    squares = sum(((part @ covariance) * part).sum(axis=1) for part in (weights.real, weights.imag))
    return np.asarray(logs + 0.5 * np.log(np.maximum(squares, TINY)))


def grown(path: Path, log_amplitude: Array) -> Growth:
    """The growth along a path, from the logarithm of the amplitude at even times of it."""
    at = np.linspace(0, path.time.size - 1, log_amplitude.size)
    every = np.interp(np.arange(path.time.size), at, log_amplitude)
    speed = np.gradient(path.length, path.time)
    per_period = speed * 2.0 * np.pi / path.rate.imag
    return Growth(path.time, path.length, every, exponent_of(path).real, per_period)


def _log_variance(path: Path, log_power: Array) -> Array:
    """``log int exp(log_power + 2 int_s^t Re Lambda) ds``, without overflow."""
    exponent = 2.0 * exponent_of(path).real
    terms = log_power - exponent + np.log(path.time[1] - path.time[0])
    return exponent + np.logaddexp.accumulate(terms)
