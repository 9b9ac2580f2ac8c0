"""The stress due to slip of a patch between given bodies, in modes that fit the patch's two ends.

With ``x = L cos(theta)`` and U the displacement of an edge that is pushed, slip is expanded as

    odd       u(x) = U phi_0 + sum_n c_n sin(2 n theta),    phi_0 = 2 theta/pi,    u - U odd in x,
    even      u(x) = sum_n c_n sin((2 n - 1) theta),                               u even in x,

n = 1 ... N. Odd slip is that of an edge that is pushed. Under a remote load it is the sum of both
without U, with L half the patch. Each mode vanishes at the front (theta = 0) as a square root. At x
= 0 is the edge, which has no shear stress, or the middle of the patch; beyond it fields continue as
their mirror image, and beyond the front ``u = 0``. The Fourier transform of ``sin(m theta)'`` is
then a sum of ``-pi m (-i)^m J_m(k L)`` (DLMF 10.9), that of ``phi_0'`` has ``2/pi`` for m and J_0.
With the transfer functions of :mod:`nucleation.theory.stiffness` and ``kappa = k L > 0``

    shear stress lost:     mu int G1 s_m m J_m(kappa) sin(kappa x/L) dkappa/L ,    m even,
    compression gained:    mu int G2 s_m m J_m(kappa) cos(kappa x/L) dkappa/L ,

``s_m = -(-1)^(m/2)``; for odd m with cos and -sin, ``s_m = (-1)^((m-1)/2)``. For half-spaces G1 and
G2 are constant and the integrals known, ``mu G1 m sin(m theta)/(L sin theta)`` and ``mu G2 u'``.
The difference between layers and half-spaces is integrated up to ``kH = CUT``, where it vanishes.
There is no box and no mesh.
"""

import dataclasses
from collections.abc import Sequence
from functools import cache, cached_property, lru_cache
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from ...types import Array
from ..pair import LayerPair
from ..spectrum import Systems

SHORT = np.array([np.inf])  # wavenumber (1/m) at which layers are half-spaces
CUT = 14.0  # kH beyond which layers are half-spaces: q^2 exp(-2 q) is 1e-10
WIDTH = 6.0  # of the panels of kappa: J_2n(kappa) oscillates with 2 pi
POINTS = 10  # Gauss points of a panel
FINEST = 1e-3  # the first panel, of thick layers
NEGLIGIBLE = 1e-100  # of J_m at small kappa, whose products underflow
GRADED = 14  # ends of panels that grow from the finest to the full width

MODES = 16  # of slip: enough for an error of L_s of some 1e-4
MORE_MODES = 32
"""Number of modes where the stiffer body is above: pushed that way, slip increases the compression
behind the front (:func:`modes_for`)."""

STIFFER_ABOVE = -0.05  # f G2/G1 of the half-spaces below which there are more modes
REACHES = (5.0, 25.0, 250.0)
"""Patch lengths over height for which there are tables: thicker layers need shorter ones; those
thinner than the last are extrapolated."""

SLIMMEST = REACHES[-1]
EXTRAPOLATED = 1e-3  # error of L_s of the slimmest layers, against the limit in tests
ROUNDING = 1.0 + 1e-9  # of a ratio that is compared with REACHES

SlimLayers: TypeAlias = dict[tuple[int, float, bool], tuple[Array, Array, Array, Array]]
"""Shear and normal response of a patch of length 1 between layers of one slimness, and G1 and G2 at
its wavenumber pi, by the number of modes, the length over the height, and the symmetry."""


@dataclasses.dataclass(frozen=True)
class Modes:
    """The modes at `theta`, for any fault; column 0 is the imposed displacement."""

    theta: Array  # (N,), from the front to the edge, or on to the other front
    values: Array  # phi_0, or zero, and the sines at theta, (N, N + 1)
    smoothing: Array  # factors that damp the last sines, (N + 1,)

    @cached_property
    def inverse(self) -> Array:
        """From values at theta to the sines' coefficients, (N, N)."""
        return np.asarray(np.linalg.inv(self.values[:, 1:]), dtype=float)


@dataclasses.dataclass(frozen=True)
class MirrorModes(Modes):
    """Modes that are even or odd about x = 0."""

    orders: NDArray  # m, (N + 1,)
    weights: Array  # m, or 2/pi of phi_0, (N + 1,)
    gradients: Array  # L u', (N, N + 1)
    half_space: Array  # L/(mu G1) times the shear stress lost in half-spaces, (N, N + 1)

    def at(self, theta: Array) -> Array:
        """phi_0 and the sines of a pushed edge at other angles, (angle, N + 1)."""
        values = np.sin(np.outer(theta, self.orders))
        values[:, 0] = 2.0 * theta / np.pi
        return values


@lru_cache(maxsize=16)
def mirror_modes(number: int, even: bool = False) -> MirrorModes:
    """The modes of one symmetry about x = 0, at as many angles."""
    n = np.arange(number + 1)
    theta = 0.5 * np.pi * (np.arange(number) + 0.5) / number
    sine_of_theta = np.sin(theta)[:, None]
    orders = np.abs(2 * n - 1) if even else 2 * n
    angles = np.outer(theta, orders)
    values = np.sin(angles)
    values[:, 0] = 0.0 if even else 2.0 * theta / np.pi
    weights = np.where(n == 0, 0.0 if even else 2.0 / np.pi, orders)
    return MirrorModes(
        theta=theta,
        values=values,
        smoothing=np.exp(-36.0 * (n / (number + 1)) ** 6),
        orders=orders,
        weights=weights,
        gradients=-weights * np.cos(angles) / sine_of_theta,
        half_space=orders * (n > 0) * np.sin(angles) / sine_of_theta,
    )


@cache
def _points(reach: float) -> tuple[Array, Array]:
    """kappa and the weights of its Gauss points."""
    graded = np.geomspace(FINEST, WIDTH, GRADED)
    even = np.arange(2.0 * WIDTH, CUT * reach + WIDTH, WIDTH)
    edges = np.concatenate([[0.0], graded, even])
    points, shares = np.polynomial.legendre.leggauss(POINTS)
    half = 0.5 * np.diff(edges)[:, None]
    kappa = edges[:-1, None] + half * (1.0 + points)
    return kappa.ravel(), (half * shares).ravel()


@lru_cache(maxsize=512)  # most of the time of the tables, which those of fewer modes share
def _bessel(order: int, reach: float) -> Array:
    """Weighted ``J_m(kappa)``."""
    from scipy.special import jv

    kappa, weights = _points(reach)
    found = jv(order, kappa) * weights
    found[np.abs(found) < NEGLIGIBLE] = 0.0
    return found


@lru_cache(maxsize=16)
def _tables(number: int, reach: float, even: bool) -> tuple[Array, Array, Array, Array]:
    """kappa; sin(kappa x/L) at theta, or cos; cos, or -sin; weighted ``s_m m J_m(kappa)``."""
    modes = mirror_modes(number, even)
    kappa = _points(reach)[0]
    functions = [_bessel(order, reach) for order in modes.orders.tolist()]
    bessel = np.stack(functions, axis=1)
    phase = np.outer(kappa, np.cos(modes.theta))
    sine, cosine = np.sin(phase), np.cos(phase)
    slip = -bessel * modes.weights * (-1.0) ** np.arange(number + 1)
    if even:
        return kappa, cosine, -sine, slip
    return kappa, sine, cosine, slip


@dataclasses.dataclass(frozen=True)
class PatchResponse:
    """Stress over sigma0 at theta by slip over D in each mode, (N, N + 1)."""

    modes: Modes
    length: float  # L (m)
    shear: Array  # shear stress that the interface loses
    normal: Array  # compression that it gains

    def coupled(self, friction: Array | float) -> Array:
        """Shear stress lost plus friction that is gained: ``K1 + f S2``."""
        return self.shear + np.expand_dims(friction, -1) * self.normal


def joined(responses: Sequence[PatchResponse]) -> PatchResponse:
    """The responses of patches of several lengths, which are the arrays' first dimension."""
    shear, normal = (
        np.array([getattr(one, name) for one in responses]) for name in ("shear", "normal")
    )
    return dataclasses.replace(responses[0], shear=shear, normal=normal)


def modes_for(one: Systems) -> int:
    """Number of modes that one fault needs."""
    g1, g2 = one.pair.transfer_functions(SHORT)
    return MORE_MODES if one.friction * g2 / g1 < STIFFER_ABOVE else MODES


def response(
    one: Systems,
    length: float,
    number: int = MODES,
    loading: str = "edge",
    slim: SlimLayers | None = None,
) -> PatchResponse:
    """The response of one fault's bodies to slip of a patch (m), which `slim` makes cheaper.

    Column 0 is for the imposed quantity: the edge's displacement, or under a remote load a shear
    stress of sigma0 on all of the interface.
    """
    known: SlimLayers = {} if slim is None else slim
    if loading == "edge":
        odd, normal = _mirror_response(one, length, number, False, known)
        return PatchResponse(mirror_modes(number), length, odd, normal)
    odd, odd_normal = _mirror_response(one, 0.5 * length, number, False, known)
    even, even_normal = _mirror_response(one, 0.5 * length, number, True, known)
    return PatchResponse(
        modes=_modes_of_both(number),
        length=length,
        shear=_on_both_sides(odd, even, 1.0, imposed=-1.0),
        normal=_on_both_sides(odd_normal, even_normal, -1.0),
    )


@lru_cache(maxsize=16)
def _modes_of_both(number: int) -> Modes:
    """The modes of both symmetries, at x > 0 and at x < 0."""
    odd, even = mirror_modes(number), mirror_modes(number, even=True)
    return Modes(
        theta=np.append(odd.theta, np.pi - odd.theta),
        values=_on_both_sides(odd.values, even.values, 1.0),
        smoothing=np.append(odd.smoothing, even.smoothing[1:]),
    )


def _on_both_sides(odd: Array, even: Array, sign: float, imposed: float = 0.0) -> Array:
    """Columns of both symmetries at x > 0, continued to x < 0; `sign` is that of even columns."""
    odd, even = odd[:, 1:], even[:, 1:]
    columns = np.block([[odd, even], [-sign * odd, sign * even]])
    return np.insert(columns, 0, imposed, axis=1)


def _lowest(one: Systems) -> float:
    """The height (m) of the lower of the bodies."""
    return min(float(body.height[0]) for body in one.pair.deformable)


def extrapolation_error(one: Systems, length: float) -> float:
    """Upper bound of the relative error of L_s (m) due to layers slimmer than the tables reach."""
    slim = length / _lowest(one)
    return EXTRAPOLATED * (1.0 - SLIMMEST / slim) if slim > SLIMMEST else 0.0


def has_slim_zone(one: Systems, length: float) -> bool:
    """Whether a thicker zone replaces one beside the fault, for a patch of a length (m)."""
    zones = (body.zone for body in one.pair.deformable)
    return any(zone is not None and zone.height[0] * SLIMMEST < length for zone in zones)


def _mirror_response(
    one: Systems, length: float, number: int, even: bool, known: SlimLayers
) -> tuple[Array, Array]:
    """The shear and the normal response in the modes of one symmetry about x = 0, at x > 0.

    A layer that is slimmer than the tables reach is extrapolated, linearly in H/L, from the
    slimmest one with tables and one twice as high.
    """
    slim = length / _lowest(one)
    if slim <= SLIMMEST:
        return _resolved(one, length, number, even)
    first = _thickened(one, length, number, even, SLIMMEST, known)
    second = _thickened(one, length, number, even, 0.5 * SLIMMEST, known)
    beyond = SLIMMEST / slim - 1.0
    (shear, normal), (twice_shear, twice_normal) = first, second
    return shear + beyond * (twice_shear - shear), normal + beyond * (twice_normal - normal)


def _resolved(one: Systems, length: float, number: int, even: bool) -> tuple[Array, Array]:
    """The same of layers that are not slimmer than the tables reach.

    A slimmer zone beside the fault is replaced by a thicker one that resists long waves alike.
    """
    thickness = length / SLIMMEST
    bodies = (body and body.with_zone_at_least(thickness) for body in one.pair)
    pair = LayerPair(*bodies)
    thinnest = min(float(thickness[0]) for thickness in pair.thicknesses)
    slim = length / thinnest
    modes = mirror_modes(number, even)
    far_g1, far_g2 = pair.transfer_functions(SHORT)
    shear, normal = far_g1 * modes.half_space, far_g2 * modes.gradients
    if slim > 0.0:
        reach = min(reach for reach in REACHES if slim <= reach * ROUNDING)
        kappa, *waves, slip = _tables(number, reach, even)
        used = np.searchsorted(kappa, CUT * slim)
        g1, g2 = pair.transfer_functions(kappa[:used] / length)
        own = slip[:used]
        of_shear = (g1 - far_g1)[:, None] * own
        of_normal = (g2 - far_g2)[:, None] * own
        shear = shear + waves[0][:used].T @ of_shear
        normal = normal + waves[1][:used].T @ of_normal
    scale = float(one.softness[0]) / length
    return scale * shear, scale * normal


def _thickened(
    one: Systems, length: float, number: int, even: bool, reach: float, known: SlimLayers
) -> tuple[Array, Array]:
    """The response of layers made thicker, corrected by the ratio of G at ``kL = pi``.

    Where ``kH`` is small G1 and G2 are powers of k, and thickness only scales them. Over L, layers
    of one slimness are the same whatever L is.
    """
    key = number, reach, even
    if key not in known:
        factor = 1.0 / (reach * _lowest(one))
        pair = one.pair.with_heights(lambda height: factor * height)
        unit = _resolved(one._replace(pair=pair), 1.0, number, even)
        known[key] = *unit, *pair.transfer_functions(np.array([np.pi]))
    shear, normal, thick_g1, thick_g2 = known[key]
    g1, g2 = one.pair.transfer_functions(np.array([np.pi / length]))
    by_normal = g2 / thick_g2 if thick_g2 else 0.0
    return g1 / thick_g1 / length * shear, by_normal / length * normal
