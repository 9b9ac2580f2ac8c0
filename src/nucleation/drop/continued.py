"""Continuation of the creep beyond the patches that were followed, by trends over patch length.

Lambda and L(t) are polynomials in the patch's length. Beyond the last length followed they continue
as straight lines where the amplitude's exponent depends on them.
"""

from collections.abc import Callable, Iterator
from typing import NamedTuple

import numpy as np

from ..types import Array, ComplexArray
from .mode_history import ModeHistory

DEGREE = 3  # of the polynomials in the patch's length
LENGTHS = 2000  # at which the trends are evaluated
FINE = 2400  # times between which the amplitude is integrated
COARSE = 4  # of them in a step of the sum over positions
BEYOND = 1.6  # longest length of the continuation, over the last one followed
RISE = 0.9  # part of the time up to L_s during which roughness is turned on


class CreepPath(NamedTuple):
    """The continued creep: times (s), lengths (m) and Lambda (1/s), evenly in time."""

    time: Array
    length: Array
    rate: ComplexArray


def trend(history: ModeHistory, values: Array) -> Callable[[Array], Array]:
    """Real values as a function of patch length (m): a polynomial, continued as a straight line."""
    last = history.length[-1]
    fit = np.polynomial.Polynomial.fit(history.length, values, DEGREE)
    slope = fit.deriv()(last)

    def at(lengths: Array) -> Array:
        within = np.minimum(lengths, last)
        beyond = np.maximum(lengths - last, 0.0)
        return fit(within) + slope * beyond

    return at


def complex_trend(
    history: ModeHistory, values: ComplexArray
) -> Callable[[Array | float], ComplexArray]:
    """Complex values as a function of patch length (m): a polynomial, continued as a constant."""
    last = history.length[-1]
    powers = np.vander(history.length / last - 1.0, DEGREE + 1)
    fitted, *_ = np.linalg.lstsq(powers.astype(complex), values, rcond=None)

    def at(lengths: Array | float) -> ComplexArray:
        within = np.atleast_1d(np.minimum(lengths, last))
        powers = np.vander(within / last - 1.0, DEGREE + 1)
        return np.squeeze(powers @ fitted)

    return at


def continued(history: ModeHistory) -> CreepPath:
    """The trend over the lengths followed and beyond, evenly in time."""
    longest = BEYOND * history.length[-1]
    lengths = np.linspace(history.length[0], longest, LENGTHS)
    times = trend(history, history.time)(lengths)
    growth = trend(history, history.rate.real)(lengths)
    frequency = trend(history, history.rate.imag)(lengths)
    rates = (growth + 1j * frequency).astype(complex)
    even = np.linspace(times[0], times[-1], FINE)
    return CreepPath(
        time=even, length=np.interp(even, times, lengths), rate=np.interp(even, times, rates)
    )


def exponent_of(path: CreepPath) -> ComplexArray:
    """``int Lambda dt`` from the first time on."""
    from scipy.integrate import cumulative_trapezoid  # slow to load, and few processes need it

    return np.asarray(cumulative_trapezoid(path.rate, path.time, initial=0))


def roughness_weights(
    history: ModeHistory, path: CreepPath, x: Array
) -> Iterator[tuple[float, ComplexArray]]:
    """Weights of the roughness at positions x (m) in the amplitude A, as time advances."""
    exponent = exponent_of(path)
    moving = _moving_weights(history)
    times = path.time.size
    steps = np.linspace(0, times - 1, times // COARSE)
    spacing = x[1] - x[0]
    node_spacing = history.x[1] - history.x[0]
    share = spacing / node_spacing  # of a node's force
    start = path.time[0]
    first_growing = int(np.argmax(path.rate.real > 0.0))
    unstable = path.time[first_growing]
    rise = RISE * (unstable - start)
    added = np.zeros(x.size, dtype=complex)
    before = 0
    for at in steps.round().astype(int):
        duration = path.time[at] - path.time[before]
        # from 0 to 1, all derivatives continuous: a sudden start would itself excite the mode
        u = (path.time[at] - start) / rise
        begun = float(u >= 1.0)
        if 0.0 < u < 1.0:
            begun = 0.5 * (1.0 + np.tanh((u - 0.5) / (u * (1.0 - u))))
        weights = duration * share * begun * moving(path.length[at], x)
        added = added + weights * np.exp(-exponent[at])
        before = at
        yield exponent[at].real, added


def _moving_weights(history: ModeHistory) -> Callable[[float, Array], ComplexArray]:
    """Weights of the strength at positions (m) for a front at some length (m).

    They move with the front. At each distance from it they are a polynomial in the patch's length,
    fitted to all instants.
    """
    dx = history.x[1] - history.x[0]
    longest = history.length[-1] * BEYOND
    behind = np.arange(-longest, 4.0 * dx, 0.5 * dx)
    rows = [
        np.interp(behind + length, history.x, weights, left=0.0, right=0.0)
        for length, weights in zip(history.length, history.strength, strict=True)
    ]
    fitted = complex_trend(history, np.array(rows))

    def at(length: float, x: Array) -> ComplexArray:
        weights = fitted(length)
        return np.interp(x - length, behind, weights, left=0.0, right=0.0)

    return at
