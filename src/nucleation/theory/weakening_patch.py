"""The smallest weakening patch that nucleates among surroundings that strengthen with slip rate.

A fault creeps at a uniform V. On a patch of width W friction weakens, ``zeta > 0``; outside it
strengthens, ``zeta < 0``. The linearisation about this creep is exact. With ``s = Lambda ell/V``
and the elastic load ``m(k) = g (1 - i rho)`` of a Fourier mode over sigma0/ell (:mod:`.spectrum`),

    m u + c(x, s) u = 0 ,      c = s (a s - zeta)/(1 + s) ,

with c_in on the patch and c_out outside. The surroundings are uniform, so that their slip is known
from that on the patch, and an equation for the slip on the patch alone is left,

    [1 - (c_out - c_in) G] u = 0 ,     G multiplies Fourier modes by 1/(m + c_out) .

In Legendre polynomials it is a small matrix, whose determinant is 1 for very
slow and positive for very fast modes. Where the surroundings alone are stable, the determinant has
no poles with ``Re s > 0``, and its phase along the imaginary axis counts the growing modes: all of
them, oscillating or not. The smallest W with a growing mode is found by bisection of that count.

Slip on ``|x| < h`` is ``sum_n u_n p_n(x/h)`` with orthonormal Legendre polynomials p_n, and zero
elsewhere. The Fourier transform of p_n is ``2 sqrt(n + 1/2) i^n j_n(q)``, ``q = k h``, with the
spherical Bessel functions j_n. So an operator that multiplies each Fourier mode by F(k) is, on the
patch, the matrix

    F_mn = (2/pi) N_mn i^(n - m) integral_0^inf [F(q) + (-1)^(m + n) F(-q)] j_m(q) j_n(q) dq ,

with ``N_mn = sqrt((m + 1/2)(n + 1/2))``. The line beyond the patch is infinite: there is no period.

F is smooth in log q, the Bessel functions oscillate. In each octave of q the polynomial through F
at OCTAVE_POINTS is integrated with the Bessel functions exactly; its weights don't depend on F.
Beyond the last octave, at Q, the products of Bessel functions are replaced by their mean over an
oscillation, which falls as ``1/q^2``. Its size is that which makes F = 1 the identity.
"""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np

from ..types import Array, ComplexArray
from .critical import largest_crossings, of_distinct
from .evaluation import evaluate, require_broadcast
from .pair import rounded
from .spectrum import FEWER_BITS, Systems
from .values import QUANTITIES, FaultLike, Values, checked, numbers_of

OCTAVES = -24, 12  # of q, as powers of 2
OCTAVE_POINTS = 10  # in an octave, at which F is evaluated
SPACING = 2.0  # of q, in which Bessel functions are integrated by GAUSS points
GAUSS = 12

WIDEST = 10.0  # patches up to this multiple of L_c are tried
NARROWEST = 0.05  # multiple of L_c at which the search begins
FACTOR = 1.25  # between the widths that are tried
PRECISION = 1e-5  # relative, of the width
POLYNOMIALS = 16  # as many for each L_c of the width, at least
SLOWEST = 1e-5  # of the frequencies, over V/D
FASTEST = 1e3  # likewise, over 1 + zeta/a + the stiffest polynomial's load/a
FREQUENCIES = 80  # at first
TURN = 0.7  # rad, by which the phase changes between neighbouring frequencies at most
HALVINGS = 40  # of the steps between frequencies


class _PatchBasis(NamedTuple):
    """Legendre polynomials on a patch and the weights of the integral over q."""

    wavenumber: Array  # q, (points,)
    even: Array  # weights of F(q) + F(-q), (points, number^2)
    odd: Array  # weights of i [F(q) - F(-q)], (points, number^2)


@lru_cache(maxsize=8)
def patch_basis(number: int) -> _PatchBasis:
    """The basis of a number of polynomials."""
    octaves = [_octave(number, power) for power in range(*OCTAVES)]
    wavenumber = np.concatenate([points for points, _ in octaves])
    weights = np.concatenate([own for _, own in octaves])
    nodes, share = np.polynomial.legendre.leggauss(OCTAVE_POINTS)
    beyond = 2.0 ** OCTAVES[1] / (0.5 * (nodes + 1.0))  # in Q integral_Q^inf F dq/q^2
    share = 0.5 * share
    n = np.arange(number)
    power = np.subtract.outer(n, n).T  # n - m
    missing = 0.5 * np.eye(number).ravel() - weights.sum(axis=0)
    missing[power.ravel() % 2 == 1] = 0.0  # the mean of a sine times a cosine
    wavenumber = np.concatenate([wavenumber, beyond])
    weights = np.concatenate([weights, share[:, None] * missing])
    # i^(n - m) is real where n - m is even, and i times a real number where it is odd
    sign = (-1.0) ** (power // 2)
    even = np.where(power % 2 == 0, sign, 0.0)
    odd = np.where(power % 2 == 1, sign, 0.0)
    return _PatchBasis(wavenumber, weights * even.ravel(), weights * odd.ravel())


def _octave(number: int, power: int) -> tuple[Array, Array]:
    """The points of an octave of q and their weights, (points,) and (points, number^2)."""
    from scipy.special import spherical_jn

    begin, end = 2.0**power, 2.0 ** (power + 1)
    nodes, _ = np.polynomial.legendre.leggauss(OCTAVE_POINTS)
    intervals = round((end - begin) / SPACING)
    edges = np.linspace(begin, end, 1 + max(1, intervals))
    half = 0.5 * np.diff(edges)[:, None]
    middle = 0.5 * (edges[1:] + edges[:-1])[:, None]
    gauss, share = np.polynomial.legendre.leggauss(GAUSS)  # dense enough for Bessel functions
    q = (middle + half * gauss).ravel()
    weight = (half * share).ravel()
    polynomials = np.polynomial.legendre.legvander
    position = 2.0 * (np.log2(q) - power) - 1.0
    interpolation = polynomials(position, OCTAVE_POINTS - 1) @ np.linalg.inv(
        polynomials(nodes, OCTAVE_POINTS - 1)
    )
    n = np.arange(number)[:, None]
    bessel = np.sqrt(n + 0.5) * spherical_jn(n, q)
    products = bessel[:, None] * bessel[None]
    weights = products.reshape(-1, q.size) @ (weight[:, None] * interpolation)
    places = 2.0 ** (power + 0.5 * (nodes + 1.0))
    return places, 2.0 / np.pi * weights.T


class WeakeningPatch(NamedTuple):
    """A patch in creep, of any width; both systems have fields of shape (1,) and one pair."""

    inside: Systems
    outside: Systems

    def growing_modes(self, width: float, number: int) -> int:
        """The number of growing modes of a patch of a width (m), by a number of polynomials.

        A mode that oscillates counts twice, as its frequency has either sign.
        """
        turned = self._turn(width, number, 1.0)
        if np.any(self.inside.friction):
            turned += self._turn(width, number, -1.0)
        else:
            turned += turned  # both signs are alike
        return round(turned / (2.0 * math.pi))

    def factors(self, elastic: tuple[Array, Array], number: int, frequency: Array) -> ComplexArray:
        """Factors of the determinant, (frequencies, number + 1), at frequencies over V/D.

        Load and coupling are those at the wavenumbers of the basis.
        They are its diagonal entries, and the determinant of the matrix with rows divided by these:
        none of them turns much between neighbouring frequencies, while the product of many does.
        """
        basis = patch_basis(number)
        load, coupling = elastic
        rate: ComplexArray = 1j * frequency[:, None].astype(complex)
        within, around = (
            rate * (systems.a * rate - systems.zeta) / (1.0 + rate) for systems in self
        )
        forward = 1.0 / (load * (1.0 - 1j * coupling) + around)
        backward = 1.0 / (load * (1.0 + 1j * coupling) + around)
        response = _integrated(forward + backward, basis.even)
        if np.any(coupling):
            response = response + 1j * _integrated(forward - backward, basis.odd)
        response = response.reshape(-1, number, number)
        matrix = np.eye(number) - (around - within)[:, :, None] * response
        diagonal = np.diagonal(matrix, axis1=1, axis2=2)
        rest = np.linalg.det(matrix / diagonal[:, :, None])
        return np.concatenate([diagonal, rest[:, None]], axis=1)

    def _turn(self, width: float, number: int, sign: float) -> float:
        """By how much (rad) the phase falls from a frequency of zero to those of one sign."""
        shortest = np.array([2.0 * number / width])
        stiffest = self.inside.load_and_coupling(shortest)[0]
        least = np.minimum(self.inside.a, self.outside.a)
        scale = 1.0 + float(np.max(stiffest / least))
        for systems in self:
            scale += float(np.max(np.abs(systems.zeta / systems.a)))
        frequency = np.geomspace(SLOWEST, FASTEST * scale, FREQUENCIES)
        elastic = self.inside.load_and_coupling(2.0 * patch_basis(number).wavenumber / width)
        found = self.factors(elastic, number, sign * frequency)
        for _ in range(HALVINGS):
            turns = np.angle(found[1:] / found[:-1])
            coarse = np.flatnonzero(np.abs(turns).max(axis=1) > TURN)
            if not coarse.size:
                break
            middle = np.sqrt(frequency[coarse] * frequency[coarse + 1])
            between = self.factors(elastic, number, sign * middle)
            frequency = np.insert(frequency, coarse + 1, middle)
            found = np.insert(found, coarse + 1, between, axis=0)
        turned = np.angle(found[1:] / found[:-1])
        return -sign * float(turned.sum())


def _integrated(values: ComplexArray, weights: Array) -> ComplexArray:
    """Their product, without a complex copy of the weights."""
    real, imaginary = np.stack([values.real, values.imag]) @ weights
    return real + 1j * imaginary


def smallest_width(patch: WeakeningPatch, critical: float) -> float:
    """W_c (m), the smallest width of a patch with a growing mode; NaN above ``WIDEST L_c``.

    L_c (m) is that of the friction within.
    """

    def grows(width: float) -> bool:
        longer = max(1.0, 0.5 * (1.0 + width / critical))
        polynomials = POLYNOMIALS * math.ceil(longer)
        return patch.growing_modes(width, polynomials) > 0

    low = NARROWEST * critical
    while grows(low):
        low /= FACTOR
    high = low * FACTOR
    while not grows(high):
        low, high = high, high * FACTOR
        if low > WIDEST * critical:
            return math.nan
    while high > low * (1.0 + PRECISION):
        middle = math.sqrt(low * high)
        if grows(middle):
            high = middle
        else:
            low = middle
    return math.sqrt(low * high)


def weakening_patch_values(
    fault: FaultLike, outside_zeta: Values, outside_a: Values | None = None
) -> Any:
    """W_c (m); plain, in SI units."""
    zeta = checked("outside_zeta", outside_zeta, QUANTITIES["zeta"])
    a = fault.a if outside_a is None else checked("outside_a", outside_a, QUANTITIES["a"])
    require_broadcast(numbers_of(fault) | {"outside_zeta": zeta, "outside_a": a})

    def ratios(systems: Systems, *outside: Array) -> list[Array]:
        return [rounded(of / systems.a, FEWER_BITS) for of in outside]

    def width(one: Systems, critical: float, *outside: float) -> tuple[float]:
        other_zeta, other_a = (np.array([of]) for of in outside)
        around = one._replace(zeta=other_zeta, a=other_a)
        if not math.isfinite(critical) or not np.isnan(largest_crossings(around)).all():
            return (math.nan,)
        return (smallest_width(WeakeningPatch(one, around), critical),)

    outside = evaluate(fault, ratios, zeta, a, rows=2)
    found = of_distinct(fault, width, *outside, rows=1, problem=Systems.of_constants)
    return found.astype(float)[0]
