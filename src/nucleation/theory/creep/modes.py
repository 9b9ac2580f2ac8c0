"""The stress due to slip of a patch, in modes that fit the patch's two ends.

With ``x = L cos(theta)`` and U the displacement of an edge that is pushed, slip is expanded as

    edge      u(x) = U phi_0 + sum_n c_n sin(2 n theta),    phi_0 = 2 theta/pi,    u - U odd in x,
    top       u(x) = sum_n c_n sin((2 n - 1) theta),                               u even in x,

n = 1 ... N. Under a remote load it is the sum of both without U, with L half the patch. Each mode
vanishes at the front (theta = 0) as a square root. At x = 0 is the edge that is pushed and has no
shear stress, or a side that is free; beyond it fields continue as their mirror image, and beyond
the front ``u = 0``. The Fourier transform of ``sin(m theta)'`` is then a sum of
``-pi m (-i)^m J_m(k L)`` (DLMF 10.9), that of ``phi_0'`` has ``2/pi`` for m and J_0. With the
transfer functions of :mod:`nucleation.theory.transfer` and ``kappa = k L > 0``

    shear stress lost:     mu int G1 s_m m J_m(kappa) sin(kappa x/L) dkappa/L ,    m even,
    compression gained:    mu int G2 s_m m J_m(kappa) cos(kappa x/L) dkappa/L ,

``s_m = -(-1)^(m/2)``; for odd m with cos and -sin, ``s_m = (-1)^((m-1)/2)``. For half-spaces G1 and
G2 are constant and the integrals known, ``mu G1 m sin(m theta)/(L sin theta)`` and ``mu G2 u'``.
The difference between layers and half-spaces is integrated up to ``kH = CUT``, where it vanishes.
There is no box and no mesh.
"""

import dataclasses
from functools import lru_cache
from typing import NamedTuple

import numpy as np
from scipy.special import jv

from ...types import Array
from ..spectrum import Systems

MODES = 16  # of slip: enough for an error of L_s of some 1e-4
MORE_MODES = 32
"""Number of modes where the stiffer body is above: pushed that way, slip increases the compression
behind the front (:func:`modes_for`)."""

STIFFER_ABOVE = -0.05  # f G2/G1 of the half-spaces below which there are more modes
CUT = 14.0  # kH beyond which layers are half-spaces: q^2 exp(-2 q) is 1e-10
REACHES = (5.0, 25.0, 250.0)
"""Patch lengths over height for which there are tables: thicker layers need shorter ones; those
thinner than the last are extrapolated."""

SLIMMEST = REACHES[-1]
EXTRAPOLATED = 1e-3  # error of L_s of the slimmest layers, against their limit (:mod:`.thin`)
WIDTH = 6.0  # of the panels of kappa: J_2n(kappa) oscillates with 2 pi
POINTS = 10  # Gauss points of a panel
FINEST = 1e-3  # the first panel, of thick layers
GRADED = 14  # ends of panels that grow from the finest to the full width
ROUNDING = 1.0 + 1e-9  # of a ratio that is compared with REACHES

SLOWEST = 1e-6  # least slip rate over V: friction's logarithm diverges at rest
NEAR = 2  # places next to the front that determine the share of the singularity


@dataclasses.dataclass(frozen=True)
class Modes:
    """The modes at `theta`, for any fault; column 0 is the imposed displacement."""

    theta: Array  # (N,), from the front to the edge, or on to the other front
    values: Array  # phi_0, or zero, and the sines at theta, (N, N + 1)
    smoothing: Array  # factors that damp the last sines, (N + 1,)

    @property
    def inverse(self) -> Array:
        """From values at theta to the sines' coefficients, (N, N)."""
        sines: Array = self.values[:, 1:]
        return np.asarray(np.linalg.inv(sines), dtype=float)

    def at(self, theta: Array) -> Array:
        """phi_0 and the sines of a pushed edge at other angles, (angle, N + 1)."""
        n = np.arange(self.theta.size + 1)
        values = np.sin(2.0 * np.outer(theta, n))
        values[:, 0] = 2.0 * theta / np.pi
        return values


@dataclasses.dataclass(frozen=True)
class _MirrorModes(Modes):
    """Modes that are even or odd about x = 0, and their tables on a grid of `kappa`."""

    gradients: Array  # L u', (N, N + 1)
    half_space: Array  # L/(mu G1) times the shear stress lost in half-spaces, (N, N + 1)
    kappa: Array
    shear: Array  # sin(kappa x/L) at theta, or cos, (kappa, N)
    normal: Array  # cos(kappa x/L), or -sin
    slip: Array  # weight of the quadrature times s_m m J_m(kappa), (kappa, N + 1)


@lru_cache(maxsize=16)
def mirror_modes(
    number: int,
    slimmest: float = 0.0,
    even: bool = False,
) -> _MirrorModes:
    """The modes of one symmetry about x = 0.

    Parameters
    ----------
    number : int
        N, the number of sines.
    slimmest : float
        Patch length over layer height up to which the tables reach.
    even : bool
        Whether u is even in x; by default u - U is odd.

    Returns
    -------
    _MirrorModes
        The modes at N angles, and their tables.
    """
    n = np.arange(number + 1)
    theta = 0.5 * np.pi * (np.arange(number) + 0.5) / number
    sine_of_theta = np.sin(theta)[:, None]
    if even:
        orders = np.abs(2 * n - 1)
        angles = np.outer(theta, orders)
        imposed: Array | float = 0.0
        weight_imposed = 0.0
    else:
        orders = 2 * n
        angles = 2.0 * np.outer(theta, n)
        imposed = 2.0 * theta / np.pi
        weight_imposed = 2.0 / np.pi
    values = np.sin(angles)
    values[:, 0] = imposed
    weights = np.where(n == 0, weight_imposed, orders)
    kappa, shares = _quadrature(CUT * slimmest)
    bessel = jv(orders, kappa[:, None]) * shares[:, None]
    phase = np.outer(kappa, np.cos(theta))
    sine, cosine = np.sin(phase), np.cos(phase)
    return _MirrorModes(
        theta=theta,
        values=values,
        smoothing=np.exp(-36.0 * (n / (number + 1)) ** 6),
        gradients=-weights * np.cos(angles) / sine_of_theta,
        half_space=orders * (n > 0) * np.sin(angles) / sine_of_theta,
        kappa=kappa,
        shear=cosine if even else sine,
        normal=-sine if even else cosine,
        slip=-bessel * weights * (-1.0) ** n,
    )


def _quadrature(largest: float) -> tuple[Array, Array]:
    """Points and weights of integrals over kappa, up to a panel beyond the `largest`."""
    graded = np.geomspace(FINEST, WIDTH, GRADED)
    edges = np.append(0.0, graded)
    even = np.arange(edges[-1] + WIDTH, largest + WIDTH, WIDTH)
    edges = np.append(edges, even)
    points, shares = np.polynomial.legendre.leggauss(POINTS)
    half = 0.5 * np.diff(edges)[:, None]
    kappa = edges[:-1, None] + half * (1.0 + points)
    return kappa.ravel(), (half * shares).ravel()


@dataclasses.dataclass(frozen=True)
class _PatchResponse:
    """Stress over sigma0 at theta by slip over D in each mode, (N, N + 1)."""

    modes: Modes
    length: float  # L (m)
    shear: Array  # shear stress that the interface loses
    normal: Array  # compression that it gains

    def coupled(self, friction: Array | float) -> Array:
        """Shear stress lost plus friction that is gained: ``K1 + f S2``."""
        return self.shear + np.reshape(friction, (-1, 1)) * self.normal

    def scaled(
        self,
        shear: float,
        normal: float,
    ) -> "_PatchResponse":
        """The response with both stresses multiplied."""
        return dataclasses.replace(self, shear=shear * self.shear, normal=normal * self.normal)


def modes_for(one: Systems) -> int:
    """Number of modes that one fault needs."""
    g1, g2 = _half_space_functions(one)
    coupling = float(one.friction[0]) * float(g2[0] / g1[0])
    return MORE_MODES if coupling < STIFFER_ABOVE else MODES


def response(
    one: Systems,
    length: float,
    number: int = MODES,
    loading: str = "edge",
) -> _PatchResponse:
    """The response of one fault's bodies to slip of a patch.

    Parameters
    ----------
    one : Systems
        A single fault, all fields of shape (1,).
    length : float
        Patch length L (m), from end to end.
    number : int
        Number of modes; under a remote load there are as many of either symmetry.
    loading : {"edge", "top", "remote"}
        Kind of loading.

    Returns
    -------
    _PatchResponse
        Column 0 is for the imposed quantity: the edge's displacement, or under the other loadings a
        shear stress of sigma0 on all of the interface.
    """
    if loading == "edge":
        return _mirror_response(one, length, number, even=False)
    if loading == "top":
        found = _mirror_response(one, length, number, even=True)
        found.shear[:, 0] = -1.0
        return found
    odd = _mirror_response(one, 0.5 * length, number, even=False)
    even = _mirror_response(one, 0.5 * length, number, even=True)
    one_side = odd.modes.theta
    modes = Modes(
        theta=np.append(one_side, np.pi - one_side),
        values=_on_both_sides(odd.modes.values, even.modes.values, 1.0),
        smoothing=np.append(odd.modes.smoothing, even.modes.smoothing[1:]),
    )
    return _PatchResponse(
        modes=modes,
        length=length,
        shear=_on_both_sides(odd.shear, even.shear, 1.0, imposed=-1.0),
        normal=_on_both_sides(odd.normal, even.normal, -1.0),
    )


def _on_both_sides(
    odd: Array,
    even: Array,
    sign: float,
    imposed: float = 0.0,
) -> Array:
    """Columns of both symmetries at x > 0, continued to x < 0; `sign` is that of even columns."""
    odd, even = odd[:, 1:], even[:, 1:]
    columns = np.block([[odd, even], [-sign * odd, sign * even]])
    return np.insert(columns, 0, imposed, axis=1)


def _slimness(
    one: Systems,
    length: float,
) -> float:
    """Patch length (m) over the height of the lower of the layers."""
    return length / min(float(body.height[0]) for body in one.pair.deformable)


def _half_space_functions(one: Systems) -> tuple[Array, Array]:
    """G1 and G2 of half-spaces of the same materials, for k > 0."""
    return _with_heights_times(one, np.inf).pair.transfer_functions(np.ones(1))


def _mirror_response(
    one: Systems,
    length: float,
    number: int,
    even: bool,
) -> _PatchResponse:
    """The response in the modes of one symmetry about x = 0, at x > 0.

    A layer that is slimmer than the tables reach is extrapolated, linearly in H/L, from the
    slimmest one with tables and one twice as high.
    """
    slim = _slimness(one, length)
    if slim <= SLIMMEST:
        return _resolved(one, length, number, even)
    first = _thickened(one, length, number, even, slim / SLIMMEST)
    second = _thickened(one, length, number, even, slim / (0.5 * SLIMMEST))
    beyond = SLIMMEST / slim - 1.0
    return dataclasses.replace(
        first,
        shear=first.shear + beyond * (second.shear - first.shear),
        normal=first.normal + beyond * (second.normal - first.normal),
    )


def extrapolation_error(
    one: Systems,
    length: float,
) -> float:
    """Upper bound of the error of L_s due to layers slimmer than the tables reach.

    Parameters
    ----------
    one : Systems
        A single fault, all fields of shape (1,).
    length : float
        Patch length L (m).

    Returns
    -------
    float
        Relative error of L_s.
    """
    slim = _slimness(one, length)
    return EXTRAPOLATED * (1.0 - SLIMMEST / slim) if slim > SLIMMEST else 0.0


def _resolved(
    one: Systems,
    length: float,
    number: int,
    even: bool,
) -> _PatchResponse:
    """The same of layers that are not slimmer than the tables reach."""
    slim = _slimness(one, length)
    reach = min(reach for reach in REACHES if slim <= reach * ROUNDING)
    modes = mirror_modes(number, reach, even)
    used = np.searchsorted(modes.kappa, CUT * slim)
    far_g1, far_g2 = _half_space_functions(one)
    g1, g2 = one.pair.transfer_functions(modes.kappa[:used] / length)
    slip = modes.slip[:used]
    more_g1 = (g1 - far_g1)[:, None]
    more_g2 = (g2 - far_g2)[:, None]
    more_shear = modes.shear[:used].T @ (more_g1 * slip)
    more_normal = modes.normal[:used].T @ (more_g2 * slip)
    scale = float(one.softness[0]) / length
    return _PatchResponse(
        modes=modes,
        length=length,
        shear=scale * (far_g1 * modes.half_space + more_shear),
        normal=scale * (far_g2 * modes.gradients + more_normal),
    )


def _thickened(
    one: Systems,
    length: float,
    number: int,
    even: bool,
    factor: float,
) -> _PatchResponse:
    """The response of layers made thicker by a factor, corrected by the ratio of G at ``kL = pi``.

    Where ``kH`` is small G1 and G2 are powers of k, and thickness only scales them.
    """
    thicker = _with_heights_times(one, factor)
    k = np.array([np.pi / length])
    g1, g2 = one.pair.transfer_functions(k)
    thick_g1, thick_g2 = thicker.pair.transfer_functions(k)
    with np.errstate(divide="ignore", invalid="ignore"):
        by_shear = float(g1[0] / thick_g1[0])
        by_normal = float(g2[0] / thick_g2[0])
    if not np.isfinite(by_normal):
        by_normal = 0.0
    return _resolved(thicker, length, number, even).scaled(by_shear, by_normal)


def _with_heights_times(
    one: Systems,
    factor: float,
) -> Systems:
    """The system with all heights multiplied."""
    return one._replace(pair=one.pair.with_heights(lambda height: factor * height))


class Creep(NamedTuple):
    """A creeping patch, at the angles of its modes.

    Slip rates are relative to `fastest`: V at an edge that is pushed, else the largest one.
    """

    response: _PatchResponse  # of the bodies, and L
    slip_rate: Array  # over `fastest`, (N,)
    normal_stress: Array  # compression over sigma0, (N,)
    loaded: float  # imposed at L: displacement of the edge over D, or shear stress over sigma0
    fastest: float = 1.0  # over V


def creep(
    response: _PatchResponse,
    friction: float,
    load_rate: float | None = None,
) -> Creep:
    """The creep of a patch under the loading of a response.

    Parameters
    ----------
    response : _PatchResponse
        Of the fault's bodies.
    friction : float
        f, the strength over the normal stress.
    load_rate : float, optional
        Rate of the shear stress that loads the patch, over ``sigma0 V/D``; by default an edge is
        pushed at V.

    Returns
    -------
    Creep
        Slip rate and normal stress at the angles of the modes.

    Notes
    -----
    Slip rate: the strength is constant. So ``(K1 + f S2) v = 0`` with ``v(0) = V``, or ``(K1 +
    f S2) v`` is the rate of the stress. Slip: the patch is loaded to its strength, ``-(K1 + f S2) u
    = f sigma0``, and the edge has the displacement for which the front has no singularity. That
    slip has changed the normal stress by ``S2 u``. A stress that loads a uniform interface evenly
    reaches the strength everywhere at once, and u = 0.
    """
    slip = edge_slip(response, friction, friction)
    rates = response.modes.values @ slip.rates
    fastest = 1.0
    if load_rate is not None:
        scale = float(rates.max())
        rates = rates / scale
        fastest = scale * load_rate
    return Creep(
        response=response,
        slip_rate=np.maximum(rates, SLOWEST),
        normal_stress=1.0 + response.normal @ slip.slip,
        loaded=slip.loaded,
        fastest=fastest,
    )


class EdgeSlip(NamedTuple):
    """Coefficients of slip rate and slip in the modes, and the edge's displacement."""

    rates: Array
    slip: Array
    loaded: float


def edge_slip(
    response: _PatchResponse,
    friction: Array | float,
    strength: Array | float,
) -> EdgeSlip:
    """The modes' coefficients of the slip rate over V and of the slip over D.

    Where slip changes the normal stress, the front's singularity is no square root, and the edge is
    not regular. An error of alternating sign at neighbouring places remains, which
    :attr:`~.modes.Modes.smoothing` removes from the result.

    Parameters
    ----------
    response : _PatchResponse
        Of the fault's bodies.
    friction : ndarray or float
        Friction coefficient f at the angles of the modes, (N,), or a uniform one.
    strength : ndarray or float
        Strength less the initial shear stress, over sigma0; the same shapes.

    Returns
    -------
    EdgeSlip
        Coefficients of shape (N + 1,).
    """
    matrix = response.coupled(friction)
    sines: Array = matrix[:, 1:]
    by_edge = matrix[:, 0]
    by_strength = np.broadcast_to(strength, by_edge.shape)
    loads = np.stack([by_edge, by_strength], axis=1)
    rates, held = -np.linalg.solve(sines, loads).T
    rates = np.append(1.0, rates)
    held = np.append(0.0, held)
    near = response.modes.values[:NEAR]
    squares = response.modes.theta[:NEAR] ** 2
    ratio = (near @ held) / (near @ rates)
    loaded = -float(np.polyfit(squares, ratio, NEAR - 1)[-1])
    smoothing = response.modes.smoothing
    return EdgeSlip(
        rates=smoothing * rates,
        slip=smoothing * (loaded * rates + held),
        loaded=loaded,
    )
