"""Realisations of a smooth Gaussian process in time, along x, or in both.

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

from collections import OrderedDict

import numpy as np
from scipy.special import ndtri

from ..model.settings import MEAN_SQUARE
from ..types import Array

BLOCK = 256  # coefficients drawn at a time
ROWS_KEPT = 8  # of a sheet; four are in use at one time
PHASE, SERIES, PROFILE, SHEET = range(4)  # independent streams of one seed


def normals(
    seed: int,
    stream: int,
    row: int,
    number: int,
) -> Array:
    """The first standard normal numbers in a row of a stream.

    A larger number of them begins with the same ones. They are made from the raw integers of the
    generator, since NumPy does not guarantee equal normal numbers in all its versions.
    """
    return ndtri(_uniform(seed, stream, row, number))


def _uniform(
    seed: int,
    stream: int,
    row: int,
    number: int,
) -> Array:
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


def _spline_slope(u: float) -> Array:
    """Derivatives of the four splines, shape (4,)."""
    values = [
        -((1.0 - u) ** 2),
        u * (3.0 * u - 4.0),
        1.0 + u * (2.0 - 3.0 * u),
        u * u,
    ]
    return np.array(values) / 2


def _spline_integral(u: float) -> Array:
    """Integrals of the four splines from far left up to u, shape (4,)."""

    def middle(z: float) -> float:
        return 0.5 + z * (4.0 + z * z * (0.75 * z - 2.0)) / 6.0

    values = [
        1.0 - (1.0 - u) ** 4 / 24.0,
        middle(u),
        1.0 - middle(1.0 - u),
        u**4 / 24.0,
    ]
    return np.array(values)


def _place(position: float) -> tuple[int, float]:
    """Index of the first of the four splines that are not zero at a position, and place in them."""
    first = int(position)
    return first, position - first


class Series:
    """A realisation in time, from time zero on, of a correlation time (s)."""

    def __init__(
        self,
        seed: int,
        correlation: float,
    ) -> None:
        self.spacing = MEAN_SQUARE * correlation
        self.phase = float(_uniform(seed, PHASE, SERIES, 1)[0])
        self._seed = seed
        self._coefficients = np.empty(0)
        self._before = np.zeros(1)  # sums of the coefficients before each

    def value(self, time: float) -> float:
        """``xi`` at a time (s)."""
        first, u = _place(self._position(time))
        return float(spline(u) @ self._used(first)) / MEAN_SQUARE**0.5

    def slope(self, time: float) -> float:
        """``d xi / dt`` (1/s) at a time (s)."""
        first, u = _place(self._position(time))
        slope = float(_spline_slope(u) @ self._used(first))
        return slope / (MEAN_SQUARE**0.5 * self.spacing)

    def integral(self, time: float) -> float:
        """``int xi dt`` (s) from zero to a time (s)."""
        difference = self._primitive(time) - self._primitive(0.0)
        return difference * self.spacing / MEAN_SQUARE**0.5

    def coefficients(self, until: float) -> Array:
        """Coefficients ``a_i`` of the values up to a time (s), shape (i, 1)."""
        first, _ = _place(self._position(until))
        self._used(first)
        return self._coefficients[: first + 4, None]

    def _position(self, time: float) -> float:
        return time / self.spacing + self.phase

    def _primitive(self, time: float) -> float:
        first, u = _place(self._position(time))
        own = _spline_integral(u) @ self._used(first)
        return float(own + self._before[first])

    def _used(self, first: int) -> Array:
        """The four coefficients from an index on."""
        while first + 4 > self._coefficients.size:
            row = self._coefficients.size // BLOCK
            more = normals(self._seed, SERIES, row, BLOCK)
            self._coefficients = np.append(self._coefficients, more)
            self._before = np.append(0.0, np.cumsum(self._coefficients))
        return self._coefficients[first : first + 4]


class _Positions:
    """Splines along x at given positions (m): the part of profiles and sheets that is constant."""

    def __init__(
        self,
        seed: int,
        correlation: float,
        x: Array,
        stream: int,
    ) -> None:
        phase = _uniform(seed, PHASE, stream, 2)[1]
        s = x / (MEAN_SQUARE * correlation) + phase
        self._first = np.floor(s).astype(int)
        self._weights = spline(s - self._first) / MEAN_SQUARE**0.5
        self.number = int(self._first.max()) + 4

    def values(self, coefficients: Array) -> Array:
        """The series at all positions, for :attr:`number` coefficients."""
        indices = self._first[None] + np.arange(4)[:, None]
        used = coefficients[indices]
        return (self._weights * used).sum(axis=0)


def profile(
    seed: int,
    correlation: float,
    x: Array,
) -> Array:
    """``xi`` along x at positions (m), at least zero, of a correlation length (m)."""
    positions = _Positions(seed, correlation, x, PROFILE)
    return positions.values(normals(seed, PROFILE, 0, positions.number))


class Sheet:
    """A realisation in time and along x: its correlation is the product of both correlations."""

    def __init__(
        self,
        seed: int,
        correlation_time: float,
        correlation_length: float,
        x: Array,
    ) -> None:
        self.spacing = MEAN_SQUARE * correlation_time
        self.phase = float(_uniform(seed, PHASE, SHEET, 1)[0])
        self._seed = seed
        self._positions = _Positions(seed, correlation_length, x, SHEET)
        self._rows: OrderedDict[int, Array] = OrderedDict()

    def values(self, time: float) -> Array:
        """``xi`` at a time (s) at all positions, shape (n,)."""
        first, u = _place(time / self.spacing + self.phase)
        rows = np.array([self._row(first + i) for i in range(4)])
        return spline(u) @ rows / MEAN_SQUARE**0.5

    def coefficients(self, until: float) -> Array:
        """Coefficients ``a_i(x)`` of the values up to a time (s), shape (i, n)."""
        first, _ = _place(until / self.spacing + self.phase)
        return np.array([self._row(i) for i in range(first + 4)])

    def _row(self, index: int) -> Array:
        """Coefficients ``a_i(x)`` of one index, shape (n,)."""
        if index not in self._rows:
            drawn = normals(self._seed, SHEET, index, self._positions.number)
            self._rows[index] = self._positions.values(drawn)
            while len(self._rows) > ROWS_KEPT:
                self._rows.popitem(last=False)
        return self._rows[index]
