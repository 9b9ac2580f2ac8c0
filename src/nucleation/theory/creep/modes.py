"""The stress that slip of a patch makes, in modes that know the patch's two ends.

With ``x = L cos(theta)`` and U the displacement of an edge that is pushed, slip is expanded as

    edge      u(x) = U phi_0 + sum_n c_n sin(2 n theta),    phi_0 = 2 theta/pi,    u - U odd in x,
    top       u(x) = sum_n c_n sin((2 n - 1) theta),                               u even in x,

n = 1 ... N, and of a remote load as the sum of both without U, with L half the patch. Each mode
vanishes at the front (theta = 0), as its square root. At x = 0 is the edge that is pushed and has
no shear stress, or a side that is free; beyond it fields go on as their mirror image, and beyond
the front ``u = 0``. The Fourier transform of ``sin(m theta)'`` is then a sum of
``-pi m (-i)^m J_m(k L)`` (DLMF 10.9), that of ``phi_0'`` has ``2/pi`` for m and J_0. With the
transfer functions of :mod:`nucleation.theory.transfer` and ``kappa = k L > 0``

    shear stress lost:     mu int G1 s_m m J_m(kappa) sin(kappa x/L) dkappa/L ,    m even,
    compression gained:    mu int G2 s_m m J_m(kappa) cos(kappa x/L) dkappa/L ,

``s_m = -(-1)^(m/2)``; for odd m with cos and -sin, ``s_m = (-1)^((m-1)/2)``. For half-spaces G1 and
G2 are constant and the integrals known, ``mu G1 m sin(m theta)/(L sin theta)`` and ``mu G2 u'``;
what layers differ from half-spaces is integrated up to ``kH = CUT``, where nothing is left of it.
No box and no mesh is involved.
"""

import dataclasses
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.special import jv

from ...types import Array
from ..spectrum import Systems

MODES, MORE_MODES = 16, 32
"""Modes of slip: enough for an error of L_s of some 1e-4, and more where the stiffer body is
above: pushed that way, slip piles up compression behind the front (:func:`modes_for`)."""

STIFFER_ABOVE = -0.05  # f G2/G1 of the half-spaces below which there are more modes
CUT = 14.0  # kH beyond which layers are half-spaces: q^2 exp(-2 q) is 1e-10
# patch lengths over height for which there are tables: thicker layers need shorter ones; those
# thinner than the last are extrapolated
REACHES = (5.0, 25.0, 250.0)
SLIMMEST = REACHES[-1]
EXTRAPOLATED = 1e-3  # error of L_s of the slimmest layers, against their limit (:mod:`.thin`)
WIDTH, POINTS = 6.0, 10  # panels of kappa and their Gauss points: J_2n(kappa) turns with 2 pi
FINEST = 1e-3  # the first panel, of thick layers


@dataclasses.dataclass(frozen=True)
class Modes:
    """What of the modes does not depend on the fault, at `theta`; column 0 is what is imposed."""

    theta: Array  # (N,), from the front to the edge, or on to the other front
    values: Array  # phi_0, or zero, and the sines at theta, (N, N + 1)
    smoothing: Array  # factors that leave out the last sines, (N + 1,)

    @property
    def inverse(self) -> Array:
        """From values at theta to the sines' coefficients, (N, N)."""
        return np.linalg.inv(self.values[:, 1:])

    def at(self, theta: Array) -> Array:
        """phi_0 and the sines of a pushed edge at other angles, (angle, N + 1)."""
        values = np.sin(2.0 * np.outer(theta, np.arange(self.theta.size + 1)))
        values[:, 0] = 2.0 * theta / np.pi
        return values


@dataclasses.dataclass(frozen=True)
class Half(Modes):
    """Modes of which x = 0 is a mirror, and their tables on a grid of `kappa`."""

    gradients: Array  # L u', (N, N + 1)
    half_space: Array  # L/(mu G1) times the shear stress lost in half-spaces, (N, N + 1)
    kappa: Array
    shear: Array  # sin(kappa x/L) at theta, or cos, (kappa, N)
    normal: Array  # cos(kappa x/L), or -sin
    slip: Array  # weight of the quadrature times s_m m J_m(kappa), (kappa, N + 1)


@lru_cache(maxsize=16)
def modes(number: int, slimmest: float = 0.0, even: bool = False) -> Half:
    """The modes, u - U odd or u even, for patches up to `slimmest` times as long as high layers."""
    n = np.arange(number + 1)
    orders = np.abs(2 * n - 1) if even else 2 * n
    weights = np.where(n == 0, 0.0 if even else 2.0 / np.pi, orders)
    theta = 0.5 * np.pi * (np.arange(number) + 0.5) / number
    angles = np.outer(theta, orders) if even else 2.0 * np.outer(theta, n)
    values = np.sin(angles)
    values[:, 0] = 0.0 if even else 2.0 * theta / np.pi
    edges = np.append(0.0, np.geomspace(FINEST, WIDTH, 14))
    edges = np.append(edges, np.arange(edges[-1] + WIDTH, CUT * slimmest + WIDTH, WIDTH))
    points, shares = np.polynomial.legendre.leggauss(POINTS)
    half = 0.5 * np.diff(edges)[:, None]
    kappa = (edges[:-1, None] + half * (1.0 + points)).ravel()
    bessel = jv(orders, kappa[:, None]) * (half * shares).reshape(-1, 1)
    phase = np.outer(kappa, np.cos(theta))
    sine, cosine = np.sin(phase), np.cos(phase)
    return Half(
        theta, values, np.exp(-36.0 * (n / (number + 1)) ** 6),
        -weights * np.cos(angles) / np.sin(theta)[:, None],
        orders * (n > 0) * np.sin(angles) / np.sin(theta)[:, None], kappa,
        *((cosine, -sine) if even else (sine, cosine)), -bessel * weights * (-1.0) ** n,
    )  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Response:
    """Stress over sigma0 at theta by slip over D in each mode, (N, N + 1)."""

    modes: Modes
    length: float  # L (m)
    shear: Array  # shear stress that the interface loses
    normal: Array  # compression that it gains

    def coupled(self, friction: Array | float) -> Array:
        """Shear stress lost plus friction that is gained: ``K1 + f S2``."""
        return self.shear + np.reshape(friction, (-1, 1)) * self.normal


def modes_for(one: Systems) -> int:
    """How many modes one fault needs."""
    far = _over_heights(one, np.inf).pair.stiffness(np.ones(1))
    above = float(one.friction[0]) * float(far.xy[0] / far.xx[0]) < STIFFER_ABOVE
    return MORE_MODES if above else MODES


def response(one: Systems, length: float, number: int = MODES, loading: str = "edge") -> Response:
    """The response of one fault's bodies to slip of a patch of a length L (m), from end to end.

    There are `number` modes, under a remote load as many of either symmetry. Column 0 has what is
    imposed: the edge's displacement, or under the other loadings a shear stress of sigma0 on all of
    the interface.
    """
    if loading == "edge":
        return _half_response(one, length, number, False)
    if loading == "top":
        even = _half_response(one, length, number, True)
        even.shear[:, 0] = -1.0
        return even
    odd, even = (_half_response(one, 0.5 * length, number, kind) for kind in (False, True))

    def whole(first: Array, second: Array, sign: float, imposed: float = 0.0) -> Array:
        """From x > 0 to both sides: what is even of `first` is odd of `second`."""
        inner = np.block([[first, second], [-sign * first, sign * second]])
        return np.insert(inner, 0, imposed, axis=1)

    one_side = odd.modes.theta
    both = Modes(
        np.append(one_side, np.pi - one_side),
        whole(odd.modes.values[:, 1:], even.modes.values[:, 1:], 1.0),
        np.append(odd.modes.smoothing, even.modes.smoothing[1:]),
    )
    return Response(
        both, length, whole(odd.shear[:, 1:], even.shear[:, 1:], 1.0, -1.0),
        whole(odd.normal[:, 1:], even.normal[:, 1:], -1.0),
    )  # fmt: skip


def _half_response(one: Systems, length: float, number: int, even: bool) -> Response:
    """That of the modes of one symmetry about x = 0, at x > 0.

    A layer that is slimmer than the slimmest with tables is extrapolated, linearly in H/L, from
    that one and one twice as high.
    """
    slim = length / min(float(b.height[0]) for b in one.pair if b is not None)
    if slim <= SLIMMEST:
        return _resolved(one, length, number, even)
    first, second = (
        _thickened(one, length, number, even, slim / reach) for reach in (SLIMMEST, 0.5 * SLIMMEST)
    )
    beyond = SLIMMEST / slim - 1.0
    return dataclasses.replace(
        first,
        shear=first.shear + beyond * (second.shear - first.shear),
        normal=first.normal + beyond * (second.normal - first.normal),
    )


def extrapolation_error(one: Systems, length: float) -> float:
    """Relative error of L_s, at most, by which a layer is slimmer than the tables reach."""
    slim = length / min(float(b.height[0]) for b in one.pair if b is not None)
    return EXTRAPOLATED * (1.0 - SLIMMEST / slim) if slim > SLIMMEST else 0.0


def _resolved(one: Systems, length: float, number: int, even: bool) -> Response:
    """The same of layers that are not slimmer than the tables reach."""
    far = _over_heights(one, np.inf).pair.stiffness(np.ones(1))
    slim = length / min(float(b.height[0]) for b in one.pair if b is not None)
    own = modes(number, min(reach for reach in REACHES if slim <= reach * (1.0 + 1e-9)), even)
    used = np.searchsorted(own.kappa, CUT * slim)
    found = one.pair.stiffness(own.kappa[:used] / length)
    slip = own.slip[:used]
    shear = far.xx * own.half_space + own.shear[:used].T @ ((found.xx - far.xx)[:, None] * slip)
    normal = far.xy * own.gradients + own.normal[:used].T @ ((found.xy - far.xy)[:, None] * slip)
    scale = float(one.softness[0]) / length
    return Response(own, length, scale * shear, scale * normal)


def _thickened(one: Systems, length: float, number: int, even: bool, factor: float) -> Response:
    """The response of layers made thicker by a factor, which is undone for ``kL = pi``.

    Where ``kH`` is small G1 and G2 are powers of k, and thickness is but a factor.
    """
    thicker = _over_heights(one, factor)
    found = _resolved(thicker, length, number, even)
    k = np.array([np.pi / length])
    own, thick = (system.pair.stiffness(k) for system in (one, thicker))
    with np.errstate(divide="ignore", invalid="ignore"):
        by_shear, by_normal = float(own.xx[0] / thick.xx[0]), float(own.xy[0] / thick.xy[0])
    if not np.isfinite(by_normal):
        by_normal = 0.0
    return dataclasses.replace(found, shear=by_shear * found.shear, normal=by_normal * found.normal)


def _over_heights(one: Systems, factor: float) -> Systems:
    """The system with all heights multiplied."""
    bodies = (b and b._replace(height=factor * b.height) for b in one.pair)
    return one._replace(pair=type(one.pair)(*bodies))


SLOWEST = 1e-6  # slip rates below this part of V do not count: friction's logarithm has no end
NEAR = 2  # places next to the front from which the singularity's share is found


class Creep(NamedTuple):
    """A patch that creeps, at the angles of its modes.

    Slip rates count in `fastest`: V at an edge that is pushed, else that of the fastest place.
    """

    response: Response  # of the bodies, and L
    slip_rate: Array  # over `fastest`, (N,)
    normal_stress: Array  # compression over sigma0, (N,)
    loaded: float  # imposed at L: displacement of the edge over D, or shear stress over sigma0
    fastest: float = 1.0  # over V


def creep(response: Response, friction: float, load_rate: float | None = None) -> Creep:
    """The creep of a patch under the loading of a response.

    Parameters
    ----------
    friction : f, the strength over the normal stress.
    load_rate : rise of the shear stress that loads the patch, over ``sigma0 V/D``; by default it is
        an edge that is pushed at V.

    Notes
    -----
    Slip rate: the strength does not change. So ``(K1 + f S2) v = 0`` with ``v(0) = V``, or ``(K1 +
    f S2) v`` is the rate of the stress. Slip: the patch is loaded to its strength, ``-(K1 + f S2) u
    = f sigma0``, and the edge has moved as far as it takes for a front without a singularity. That
    slip has changed the normal stress by ``S2 u``. A stress that loads all of a uniform interface
    has reached the strength everywhere when it does so in the patch, and u = 0.
    """
    slip, fastest = edge_slip(response, friction, friction), 1.0
    rates, scale = response.modes.values @ slip.rates, 1.0
    if load_rate is not None:
        scale = float(rates.max())
        fastest = scale * load_rate
    rates, normal = np.maximum(rates / scale, SLOWEST), 1.0 + response.normal @ slip.slip
    return Creep(response, rates, normal, slip.loaded, fastest)


class EdgeSlip(NamedTuple):
    """Coefficients of slip rate and slip in the modes, and the edge's displacement."""

    rates: Array
    slip: Array
    loaded: float


def edge_slip(response: Response, friction: float, strength: Array | float) -> EdgeSlip:
    """The modes' coefficients, (N + 1,) of the slip rate over V and of the slip over D.

    Where slip changes the normal stress, the front's singularity is no square root, and neither is
    the edge regular: an error of alternating sign at neighbouring places is left, which is taken
    out of the result (:attr:`~.modes.Modes.smoothing`).
    """
    matrix = response.coupled(friction)
    loads = np.stack([matrix[:, 0], np.broadcast_to(strength, matrix.shape[:1])], axis=1)
    rates, held = -np.linalg.solve(matrix[:, 1:], loads).T
    rates, held = np.append(1.0, rates), np.append(0.0, held)
    near = response.modes.values[:NEAR]
    squares = response.modes.theta[:NEAR] ** 2
    ratio = (near @ held) / (near @ rates)
    loaded = -float(np.polyfit(squares, ratio, NEAR - 1)[-1])
    smoothing = response.modes.smoothing
    return EdgeSlip(smoothing * rates, smoothing * (loaded * rates + held), loaded)
