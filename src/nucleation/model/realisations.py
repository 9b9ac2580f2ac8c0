"""Realisations of a smooth Gaussian process in time, along x, or in both, and their statistics.

A realisation has its own grid of spacing ``d``. On it, it is a series of cubic B-splines with
independent standard normal coefficients ``a_i`` and a random phase,

    xi(s) = sum_i a_i B(s / d + phase - i) / sqrt(m),     m = int B(u)^2 du = 151/315.

It has two continuous derivatives, so the time stepping keeps its order. Over all seeds it is
stationary with zero mean and unit variance. Its correlation is the septic B-spline:

    <xi(s) xi(s + r)> = B_7(r / d) / m,     int B_7(r / d) / m dr = d / m,
    S(omega) = int <xi xi> exp(-i omega r) dr = (d / m) sinc(omega d / 2)^8.

The correlation time (or length) is the integral above, so ``d = m`` correlation times.

Every coefficient is a pure function of the seed and of its index, by the counter-based generator
Philox and the inverse of the normal distribution. So any part of a realisation can be computed
without the parts before it, and it is the same on every mesh, with all steps and after a restart.
"""

from collections.abc import Callable
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from ..types import Array

MEAN_SQUARE = 151.0 / 315.0  # int B(u)^2 du of the cubic B-spline
BLOCK = 256  # coefficients drawn at a time
ROWS_KEPT = 8  # of a sheet; four are in use at one time
PHASE, SERIES, PROFILE, SHEET = range(4)  # independent streams of one seed


def normals(seed: int, stream: int, row: int, number: int) -> Array:
    """The first standard normal numbers in a row of a stream.

    A larger number of them begins with the same ones. They are made from the raw integers of the
    generator, since NumPy does not guarantee equal normal numbers in all its versions.
    """
    from scipy.special import ndtri  # which takes half a second to load; lengths do without

    return ndtri(_uniform(seed, stream, row, number))


def _uniform(seed: int, stream: int, row: int, number: int) -> Array:
    """Numbers in (0, 1), one for each 64 random bits."""
    counter = [0, row, stream, 0]
    generator = np.random.Philox(counter=counter, key=[seed, 0])
    bits = generator.random_raw(number) >> np.uint64(12)  # 52 bits, so that 1 is not reached
    return (bits.astype(np.float64) + 0.5) * 2.0**-52


def spline(u: float | Array) -> Array:
    """Values at ``0 <= u < 1`` of the four cubic B-splines about -1, 0, 1, 2; shape (4, ...)."""
    values = [
        (1.0 - u) ** 3,
        4.0 + u * u * (3.0 * u - 6.0),
        1.0 + u * (3.0 + u * (3.0 - 3.0 * u)),
        u**3,
    ]
    return np.array(values) / 6.0


class Series:
    """A realisation in time, from time zero on, of a correlation time (s)."""

    def __init__(self, seed: int, correlation: float) -> None:
        self.spacing = MEAN_SQUARE * correlation
        self.phase = float(_uniform(seed, PHASE, SERIES, 1)[0])
        self._seed = seed
        self._coefficients = np.empty(0)
        self._before = np.zeros(1)  # sums of the coefficients before each

    def value(self, time: float) -> float:
        """``xi`` at a time (s)."""
        u, used, _ = self._place(time)
        return float(spline(u) @ used) / MEAN_SQUARE**0.5

    def slope(self, time: float) -> float:
        """``d xi / dt`` (1/s) at a time (s)."""
        u, used, _ = self._place(time)
        slopes = [-((1.0 - u) ** 2), u * (3.0 * u - 4.0), 1.0 + u * (2.0 - 3.0 * u), u * u]
        return float(np.array(slopes) / 2 @ used) / (MEAN_SQUARE**0.5 * self.spacing)

    def integral(self, time: float) -> float:
        """``int xi dt`` (s) from zero to a time (s)."""
        difference = self._primitive(time) - self._primitive(0.0)
        return difference * self.spacing / MEAN_SQUARE**0.5

    def _primitive(self, time: float) -> float:
        """Sum of the splines' integrals from far left up to a time (s), per spacing."""

        def middle(z: float) -> float:
            return 0.5 + z * (4.0 + z * z * (0.75 * z - 2.0)) / 6.0

        u, used, before = self._place(time)
        integrals = [1.0 - (1.0 - u) ** 4 / 24.0, middle(u), 1.0 - middle(1.0 - u), u**4 / 24.0]
        return float(np.array(integrals) @ used + before)

    def _place(self, time: float) -> tuple[float, Array, float]:
        """Place in the spacing at a time (s), its four coefficients, and the sum before them."""
        position = time / self.spacing + self.phase
        first = int(position)
        while first + 4 > self._coefficients.size:
            row = self._coefficients.size // BLOCK
            more = normals(self._seed, SERIES, row, BLOCK)
            self._coefficients = np.append(self._coefficients, more)
            self._before = np.append(0.0, np.cumsum(self._coefficients))
        return position - first, self._coefficients[first : first + 4], self._before[first]


def _along_x(seed: int, correlation: float, x: Array, stream: int) -> Callable[[int], Array]:
    """The function that gives each row of a stream as a series at positions x (m), (n,)."""
    phase = _uniform(seed, PHASE, stream, 2)[1]
    s = x / (MEAN_SQUARE * correlation) + phase
    first = np.floor(s).astype(int)
    weights = spline(s - first) / MEAN_SQUARE**0.5
    indices = first[None] + np.arange(4)[:, None]
    number = int(first.max()) + 4

    def values(row: int) -> Array:
        used = normals(seed, stream, row, number)[indices]
        return (weights * used).sum(axis=0)

    return values


def profile(seed: int, correlation: float, x: Array) -> Array:
    """``xi`` along x at positions (m), at least zero, of a correlation length (m)."""
    return _along_x(seed, correlation, x, PROFILE)(0)


class Sheet:
    """A realisation in time and along x: its correlation is the product of both correlations."""

    def __init__(
        self, seed: int, correlation_time: float, correlation_length: float, x: Array
    ) -> None:
        self.spacing = MEAN_SQUARE * correlation_time
        self.phase = float(_uniform(seed, PHASE, SHEET, 1)[0])
        rows = _along_x(seed, correlation_length, x, SHEET)
        self.row = lru_cache(ROWS_KEPT)(rows)  # coefficients a_i(x) of one index

    def values(self, time: float) -> Array:
        """``xi`` at a time (s) at all positions, shape (n,)."""
        position = time / self.spacing + self.phase
        first = int(position)
        rows = np.array([self.row(first + i) for i in range(4)])
        return spline(position - first) @ rows / MEAN_SQUARE**0.5


def correlation(lag: ArrayLike, scale: float) -> Array:
    """Correlation ``<xi(s) xi(s + lag)>`` at a lag (s or m), by the correlation time or length."""
    spacing = MEAN_SQUARE * scale
    u = np.abs(np.asarray(lag, dtype=float)) / spacing
    septic = np.zeros_like(u)
    for k, binomial in enumerate((1.0, -8.0, 28.0, -56.0, 70.0, -56.0, 28.0, -8.0)):
        septic = septic + binomial * np.maximum(4.0 - u - k, 0.0) ** 7
    return septic / (5040.0 * MEAN_SQUARE)


def spectral_density(omega: ArrayLike, correlation: float) -> Array:
    """Spectral density S (s or m) at omega (1/s or 1/m): ``int S d omega / (2 pi) = 1``."""
    half_spacing = 0.5 * MEAN_SQUARE * correlation
    half = half_spacing * np.asarray(omega, dtype=float)
    return correlation * np.sinc(half / np.pi) ** 8
