"""Realisations of a smooth Gaussian process in time, along x, or in both.

A realisation lives on its own grid of spacing ``d``, as a series of cubic B-splines with
independent standard normal coefficients ``a_i`` and a random phase,

    xi(s) = sum_i a_i B(s / d + phase - i) / sqrt(m),     m = int B(u)^2 du = 151/315.

It has two continuous derivatives, so that the time stepping keeps its order. Over all seeds it is
stationary, with zero mean, unit variance, and with the septic B-spline as its correlation:

    <xi(s) xi(s + r)> = B_7(r / d) / m,     int B_7(r / d) / m dr = d / m,
    S(omega) = int <xi xi> exp(-i omega r) dr = (d / m) sinc(omega d / 2)^8.

The correlation time (or length) is the integral above, so ``d = m`` correlation times.

Every coefficient is a pure function of the seed and its index, by the counter-based generator
Philox and the inverse of the normal distribution: any part of a realisation can be computed without
the parts before it, the same on every mesh, with every step and after every restart.
"""

from collections import OrderedDict

import numpy as np
from numpy.typing import ArrayLike
from scipy.special import ndtri

from ..types import Array

MEAN_SQUARE = 151.0 / 315.0  # int B(u)^2 du of the cubic B-spline
BLOCK = 256  # coefficients drawn at a time
ROWS_KEPT = 8  # of a sheet; four are in use at one time
PHASE, SERIES, PROFILE, SHEET = range(4)  # independent streams of one seed


def normals(seed: int, stream: int, row: int, number: int) -> Array:
    """The first standard normal numbers of a row of a stream, shape (number,).

    More of them begin with the same ones. Made from the generator's raw integers, as numpy does
    not promise its normal numbers to stay the same from version to version.
    """
    return ndtri(_uniform(seed, stream, row, number))


def _uniform(seed: int, stream: int, row: int, number: int) -> Array:
    """Numbers in (0, 1), one for each 64 random bits."""
    generator = np.random.Philox(counter=[0, row, stream, 0], key=[seed, 0])
    bits = generator.random_raw(number) >> np.uint64(12)  # 52 bits, so that 1 is not reached
    return (bits.astype(np.float64) + 0.5) * 2.0**-52


def spline(u: float | Array) -> Array:
    """Values at ``0 <= u < 1`` of the four cubic B-splines about -1, 0, 1, 2; shape (4, ...)."""
    return np.array(
        [
            (1.0 - u) ** 3,
            4.0 + u * u * (3.0 * u - 6.0),
            1.0 + u * (3.0 + u * (3.0 - 3.0 * u)),
            u**3,
        ]
    ) / 6.0  # fmt: skip


def spline_slope(u: float) -> Array:
    """Their derivatives, shape (4,)."""
    return np.array([-((1.0 - u) ** 2), u * (3.0 * u - 4.0), 1.0 + u * (2.0 - 3.0 * u), u * u]) / 2


def spline_integral(u: float) -> Array:
    """Their integrals from far left up to u, shape (4,)."""

    def middle(z: float) -> float:
        return 0.5 + z * (4.0 + z * z * (0.75 * z - 2.0)) / 6.0

    return np.array([1.0 - (1.0 - u) ** 4 / 24.0, middle(u), 1.0 - middle(1.0 - u), u**4 / 24.0])


def correlation(lag: ArrayLike, scale: float) -> Array:
    """``<xi(s) xi(s + lag)>`` for a correlation time or length `scale`, in the unit of `lag`."""
    u = np.abs(np.asarray(lag, dtype=float)) / (MEAN_SQUARE * scale)
    binomial = (1.0, -8.0, 28.0, -56.0, 70.0, -56.0, 28.0, -8.0)
    septic = sum(c * np.maximum(4.0 - u - k, 0.0) ** 7 for k, c in enumerate(binomial))
    return np.asarray(septic) / (5040.0 * MEAN_SQUARE)


def spectral_density(omega: ArrayLike, correlation: float) -> Array:
    """S(omega) (s, or m) at an angular frequency (or wavenumber) for a correlation time (length).

    Of unit variance: ``int S d omega / (2 pi) = 1``.
    """
    half = 0.5 * MEAN_SQUARE * correlation * np.asarray(omega, dtype=float)
    return correlation * np.sinc(half / np.pi) ** 8


class Series:
    """A realisation in time, from time zero on."""

    def __init__(self, seed: int, correlation: float) -> None:
        """`correlation` is the correlation time (s)."""
        self.spacing = MEAN_SQUARE * correlation
        self.phase = float(_uniform(seed, PHASE, SERIES, 1)[0])
        self._seed = seed
        self._coefficients = np.empty(0)
        self._before = np.zeros(1)  # sums of the coefficients before each

    def value(self, time: float) -> float:
        """``xi`` at a time (s)."""
        first, u = self._place(time)
        return float(spline(u) @ self._used(first)) / MEAN_SQUARE**0.5

    def slope(self, time: float) -> float:
        """``d xi / dt`` (1/s) at a time (s)."""
        first, u = self._place(time)
        return float(spline_slope(u) @ self._used(first)) / (MEAN_SQUARE**0.5 * self.spacing)

    def integral(self, time: float) -> float:
        """``int xi dt`` (s) from zero to a time (s)."""
        return (self._primitive(time) - self._primitive(0.0)) * self.spacing / MEAN_SQUARE**0.5

    def coefficients(self, until: float) -> Array:
        """``a_i``, (i, 1), of which the values up to a time (s) are made."""
        first, _ = self._place(until)
        self._used(first)
        return self._coefficients[: first + 4, None]

    def _primitive(self, time: float) -> float:
        first, u = self._place(time)
        return float(spline_integral(u) @ self._used(first) + self._before[first])

    def _place(self, time: float) -> tuple[int, float]:
        """Index of the first of the four splines that are not zero at a time, and place in them."""
        s = time / self.spacing + self.phase
        return int(s), s - int(s)

    def _used(self, first: int) -> Array:
        while first + 4 > self._coefficients.size:
            more = normals(self._seed, SERIES, self._coefficients.size // BLOCK, BLOCK)
            self._coefficients = np.append(self._coefficients, more)
            self._before = np.append(0.0, np.cumsum(self._coefficients))
        return self._coefficients[first : first + 4]


class _Positions:
    """Splines along x at given positions: the part of profiles and sheets that never changes."""

    def __init__(self, seed: int, correlation: float, x: Array, stream: int) -> None:
        s = x / (MEAN_SQUARE * correlation) + _uniform(seed, PHASE, stream, 2)[1]
        self._first = np.floor(s).astype(int)
        self._weights = spline(s - self._first) / MEAN_SQUARE**0.5
        self.number = int(self._first.max()) + 4

    def values(self, coefficients: Array) -> Array:
        """The series at all positions, for :attr:`number` coefficients."""
        used = coefficients[self._first[None] + np.arange(4)[:, None]]
        return (self._weights * used).sum(axis=0)


def profile(seed: int, correlation: float, x: Array) -> Array:
    """A realisation along x at positions (m) of at least zero, for a correlation length (m)."""
    positions = _Positions(seed, correlation, x, PROFILE)
    return positions.values(normals(seed, PROFILE, 0, positions.number))


class Sheet:
    """A realisation in time and along x, at fixed positions: the product of both correlations."""

    def __init__(self, seed: int, correlation_time: float, correlation_length: float, x: Array):
        """Correlation time (s) and length (m), and the positions (m)."""
        self.spacing = MEAN_SQUARE * correlation_time
        self.phase = float(_uniform(seed, PHASE, SHEET, 1)[0])
        self._seed = seed
        self._positions = _Positions(seed, correlation_length, x, SHEET)
        self._rows: OrderedDict[int, Array] = OrderedDict()

    def values(self, time: float) -> Array:
        """``xi`` at a time (s) at all positions."""
        s = time / self.spacing + self.phase
        first = int(s)
        rows = np.array([self._row(first + j) for j in range(4)])
        return spline(s - first) @ rows / MEAN_SQUARE**0.5

    def coefficients(self, until: float) -> Array:
        """``a_i(x)``, (i, x), at all positions, of which the values up to a time (s) are made."""
        number = int(until / self.spacing + self.phase) + 4
        return np.array([self._row(i) for i in range(number)])

    def _row(self, index: int) -> Array:
        if index not in self._rows:
            drawn = normals(self._seed, SHEET, index, self._positions.number)
            self._rows[index] = self._positions.values(drawn)
            while len(self._rows) > ROWS_KEPT:
                self._rows.popitem(last=False)
        return self._rows[index]
