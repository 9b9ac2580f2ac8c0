"""The creep carried on beyond the patches that were followed: its trends over the patch's length.

Lambda and L(t) are polynomials in the patch's length, and go on as straight lines where the
amplitude's exponent depends on them.
"""

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np
from scipy.integrate import cumulative_trapezoid

from ..types import Array, ComplexArray
from .mode_history import ModeHistory

DEGREE = 3  # of the polynomials in the patch's length
FINE = 2400  # times between which the amplitude is integrated
COARSE = 4  # of them within a step where the sum over positions is taken
BEYOND = 1.6  # lengths are continued up to so many of the last one followed
RISE = 0.9  # part of the time up to L_s within which roughness is turned on


def trend(history: ModeHistory, values: Array) -> Callable[[Array], Array]:
    """Values at the instants as a polynomial in length (m), continued in a straight line."""
    last = history.length[-1]
    fit = np.polynomial.Polynomial.fit(history.length, values, DEGREE)
    slope = fit.deriv()(last)

    def at(lengths: Array) -> Array:
        return fit(np.minimum(lengths, last)) + slope * np.maximum(lengths - last, 0.0)

    return at


def complex_trend(history: ModeHistory, values: ComplexArray) -> Callable[..., ComplexArray]:
    """Trend of complex values, (instant,) or (instant, x), over the length; steady beyond."""
    last = history.length[-1]
    powers = np.vander(history.length / last - 1.0, DEGREE + 1)
    fitted, *_ = np.linalg.lstsq(powers.astype(complex), values, rcond=None)

    def at(lengths: Array | float) -> ComplexArray:
        own = np.atleast_1d(np.minimum(lengths, last)) / last - 1.0
        return np.squeeze(np.vander(own, DEGREE + 1) @ fitted)

    return at


class Path(NamedTuple):
    """The creep carried on: times (s), lengths (m) and Lambda (1/s), evenly in time."""

    time: Array
    length: Array
    rate: ComplexArray


def continued(history: ModeHistory) -> Path:
    """The trend over the lengths followed and beyond, evenly in time."""
    lengths = np.linspace(history.length[0], BEYOND * history.length[-1], 2000)
    time = trend(history, history.time)(lengths)
    real, imaginary = (trend(history, part) for part in (history.rate.real, history.rate.imag))
    rate = real(lengths) + 1j * imaginary(lengths)
    fine = np.linspace(time[0], time[-1], FINE)
    return Path(fine, np.interp(fine, time, lengths), np.interp(fine, time, rate.astype(complex)))


def exponent_of(path: Path) -> ComplexArray:
    """``int Lambda dt`` from the first time on."""
    return np.asarray(cumulative_trapezoid(path.rate, path.time, initial=0))


def roughness_weights(
    history: ModeHistory, path: Path, x: Array
) -> Iterator[tuple[float, ComplexArray]]:
    """Weights in A of the roughness at positions x (m), evenly spaced, as time goes on.

    Each with the logarithm of a factor, without which they would overflow.
    """
    exponent, moving = exponent_of(path), _moving_weights(history)
    steps = np.linspace(0, path.time.size - 1, path.time.size // COARSE).round().astype(int)
    share = (x[1] - x[0]) / (history.x[1] - history.x[0])  # of a node's force
    unstable = path.time[int(np.argmax(path.rate.real > 0.0))]
    rise = RISE * (unstable - path.time[0])
    added, before = np.zeros(x.size, dtype=complex), 0
    for at in steps:
        duration = path.time[at] - path.time[before]
        # a sudden start would itself stir the mode
        begun = _smooth_step((path.time[at] - path.time[0]) / rise)
        weights = duration * share * begun * moving(path.length[at], x)
        added = added + weights * np.exp(-exponent[at])
        before = at
        yield exponent[at].real, added


def _smooth_step(u: float) -> float:
    """From 0 at u = 0 to 1 at u = 1, all of its derivatives continuous."""
    if not 0.0 < u < 1.0:
        return float(u >= 1.0)
    return float(0.5 * (1.0 + np.tanh((u - 0.5) / (u * (1.0 - u)))))


def _moving_weights(history: ModeHistory) -> Callable[[float, Array], ComplexArray]:
    """Weights of the strength at positions (m) for a front at some length (m).

    They move with the front: at each distance from it they are a polynomial in the patch's length,
    fitted to all instants.
    """
    dx = history.x[1] - history.x[0]
    behind = np.arange(-history.length[-1] * BEYOND, 4.0 * dx, 0.5 * dx)
    seen = np.array(
        [
            np.interp(behind + own, history.x, weights, left=0.0, right=0.0)
            for own, weights in zip(history.length, history.strength, strict=True)
        ]
    )
    fitted = complex_trend(history, seen)

    def at(length: float, x: Array) -> ComplexArray:
        return np.interp(x - length, behind, fitted(length), left=0.0, right=0.0)

    return at
