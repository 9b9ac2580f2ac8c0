"""The critical wavenumber and the critical nucleation length (Secs. 3-5, Text S1.4).

At a marginal point ``Lambda = i omega``. With ``w = omega ell / V``, ``b = a + zeta`` and

    g(k) = mu |k| ell |G1| / sigma0,    rho(k) = f G2 / |G1| ,

the real and imaginary parts of Eq. (5), Eq. (S-ReIm), read ``g = b w^2/(1 + w^2)`` and
``rho g = w (a w^2 - zeta)/(1 + w^2)``. Their quotient ``a w^2 - rho b w - zeta = 0`` gives w, and
eliminating w leaves a quadratic in g,

    (g - zeta)^2 = rho^2 g (b - g) ,    0 < g < b ,

with roots ``h_minus(rho) <= h_plus(rho)``, one for either sign of omega when ``zeta > 0``.
Sliding is stable for ``g > h_plus``; for velocity strengthening, ``zeta < 0``, also for
``g < h_minus`` and wherever the roots are not real, ``rho^2 b^2 < -4 a zeta``.
"""

from __future__ import annotations

import dataclasses
import math
from functools import cache

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from ..model.linearised import (
    InterfaceState,
)
from ..model.material import Material
from .bounds import transfer_bounds
from .spectrum import elastic_load
from .transfer import (
    RIGID,
    SATURATION,
    Array,
    Body,
    RigidBody,
    reference_modulus,
    transfer_functions,
)

RESOLUTION = 1e-4
"""An unstable band narrower than this in ``log k`` may be overlooked; it ends the search."""


class NoInstability(ValueError):
    """Homogeneous sliding is stable at every wavenumber: there is no critical length."""


@dataclasses.dataclass(frozen=True)
class CriticalPoint:
    """The largest wavenumber with ``Re Lambda = 0``.

    Attributes
    ----------
    wavenumber : float
        k_c > 0 (1/m).
    angular_frequency : float
        omega (rad/s) of the mode ``exp(i omega t - i k_c x)``, which travels along +x if
        positive. If ``G2 = 0`` both signs are marginal; the positive one is given.
    """

    wavenumber: float
    angular_frequency: float

    @property
    def length(self) -> float:
        """The critical nucleation length ``L_c = 2 pi / k_c`` (m)."""
        return 2.0 * math.pi / self.wavenumber


def marginal_stiffness(rho: ArrayLike, a: float, zeta: float) -> tuple[Array, Array]:
    """The roots ``h_minus <= h_plus`` of ``(g - zeta)^2 = rho^2 g (a + zeta - g)``.

    NaN where they are not real or ``a + zeta <= 0``; even in rho, h_plus grows with ``|rho|``.
    """
    rho = np.abs(np.asarray(rho, dtype=float))
    b = a + zeta
    discriminant = (rho * b) ** 2 + 4.0 * a * zeta
    real = (discriminant >= 0.0) & (b > 0.0)
    root = np.sqrt(np.where(real, discriminant, np.nan))
    plus = (2.0 * zeta + rho**2 * b + rho * root) / (2.0 * (1.0 + rho**2))
    with np.errstate(divide="ignore", invalid="ignore"):
        minus = np.where(plus > 0.0, zeta**2 / ((1.0 + rho**2) * plus), plus)
    return minus, plus


def _load_and_coupling(
    k: ArrayLike, upper: Body | RigidBody, lower: Body | RigidBody, interface: InterfaceState
) -> tuple[Array, Array]:
    """``g(k)`` and ``rho(k)`` of the module's text."""
    gamma = elastic_load(k, upper, lower, interface)
    return gamma.real, -gamma.imag / gamma.real


def _stability_margin(g: Array, rho: Array, interface: InterfaceState) -> Array:
    """Negative where a mode grows, positive where none does, continuous in g and rho."""
    a, zeta, b = interface.a, interface.zeta, interface.state_coefficient
    if zeta < 0.0:
        return (g - zeta) ** 2 - rho**2 * g * (b - g)
    return g - marginal_stiffness(rho, a, zeta)[1]


def _certainly_stable(
    k_low: Array,
    k_high: Array,
    upper: Body | RigidBody,
    lower: Body | RigidBody,
    interface: InterfaceState,
) -> Array:
    """Whether no mode in ``[k_low, k_high]`` grows, from rigorous bounds of g and rho."""
    bounds = transfer_bounds(k_low, k_high, upper, lower)
    scale = reference_modulus(upper, lower) * interface.slip_length / interface.normal_stress
    rho = interface.friction * bounds.g2_high / bounds.g1_low
    minus, plus = marginal_stiffness(rho, interface.a, interface.zeta)
    stable = scale * k_low * bounds.g1_low > plus
    if interface.zeta < 0.0:
        stable |= np.isnan(plus) | (scale * k_high * bounds.g1_high < minus)
    return stable


def _heights(*bodies: Body | RigidBody) -> list[float]:
    return [b.height for b in bodies if isinstance(b, Body) and math.isfinite(b.height)]


def _bracket(
    upper: Body | RigidBody, lower: Body | RigidBody, interface: InterfaceState, k_top: float
) -> tuple[float, float] | None:
    """Neighbouring wavenumbers, unstable and stable, around the largest crossing below k_top.

    Intervals of log k that are certainly stable are dropped, those below a point known to be
    unstable as well; the others are halved down to :data:`RESOLUTION`.
    """
    k_bottom = 1e-3 / max(_heights(upper, lower))
    edges = np.geomspace(k_bottom, k_top, 129)
    low, high = edges[:-1], edges[1:]
    unstable = 0.0
    while low.size:
        g, rho = _load_and_coupling(low, upper, lower, interface)
        growing = low[_stability_margin(g, rho, interface) < 0.0]
        unstable = max(unstable, growing.max(initial=0.0))
        undecided = (low > unstable) & ~_certainly_stable(low, high, upper, lower, interface)  # type: ignore[misc]
        undecided |= low == unstable
        low, high = low[undecided], high[undecided]
        if low.size and np.log(high[0] / low[0]) < RESOLUTION:
            break
        middle = np.sqrt(low * high)
        low, high = np.concatenate([low, middle]), np.concatenate([middle, high])
    if unstable > 0.0:
        return unstable, high[low == unstable][0]
    return _bracket_below(k_bottom, upper, lower, interface)


def _bracket_below(
    k_bottom: float, upper: Body | RigidBody, lower: Body | RigidBody, interface: InterfaceState
) -> tuple[float, float] | None:
    """The same where all ``Hk < 1e-3``: g is a power of k, rho proportional to k."""
    k = k_bottom * 0.5 ** np.arange(60)
    g, rho = _load_and_coupling(k, upper, lower, interface)
    growing = np.flatnonzero(_stability_margin(g, rho, interface) < 0.0)
    if growing.size == 0:
        return None
    first = growing[0]
    return k[first], k[first - 1] if first else k_bottom


def critical_wavenumber(
    upper: Body | RigidBody, lower: Body | RigidBody, interface: InterfaceState
) -> CriticalPoint:
    """The largest ``k > 0`` with ``Re Lambda = 0`` on either branch of Eq. (5).

    Parameters
    ----------
    upper, lower : Body or RigidBody
    interface : InterfaceState

    Raises
    ------
    NoInstability
        If sliding is stable at every wavenumber.

    Notes
    -----
    The largest crossing is not missed:

    - ``g >= b`` is stable, whatever rho. Above ``k = SATURATION/H`` every layer is a half-space, G1
      and G2 are constant and g is proportional to k; the larger of that k and of the one where the
      half-spaces have ``g = b`` bounds k_c from above.
    - Below, an interval of log k is dismissed only if bounds of G1 and G2 over all of it
      (:mod:`.bounds`) prove it stable; the others are halved until an unstable point and a stable
      one right above it are closer than :data:`RESOLUTION`, which is thus the narrowest unstable
      band that is certainly found. Brent's method does the rest.
    - Where all ``Hk < 1e-3``, the transfer functions are powers of k.
    """
    modulus = reference_modulus(upper, lower)
    b = interface.state_coefficient
    if b <= 0.0:
        raise NoInstability(
            f"a + zeta = {b:g} is not positive: friction grows with slip rate at every frequency"
        )
    scale = modulus * interface.slip_length / interface.normal_stress
    stiff = [dataclasses.replace(x, height=math.inf) if isinstance(x, Body) else x
             for x in (upper, lower)]  # fmt: skip
    g1, g2 = transfer_functions(1.0, *stiff)
    heights = _heights(upper, lower)
    if not heights:
        k = float(marginal_stiffness(interface.friction * g2 / g1, interface.a, interface.zeta)[1]
                  / (scale * g1))  # fmt: skip
        if not k > 0.0:
            raise NoInstability(_stable_message(interface))
        return CriticalPoint(k, _angular_frequency(k, upper, lower, interface))
    bracket = _bracket(
        upper, lower, interface, float(max(SATURATION / min(heights), b / (scale * g1)))
    )
    if bracket is None:
        raise NoInstability(_stable_message(interface))

    def margin(log_k: float) -> float:
        g, rho = _load_and_coupling(math.exp(log_k), upper, lower, interface)
        return float(_stability_margin(g, rho, interface))

    k = math.exp(brentq(margin, *np.log(bracket), xtol=1e-14, rtol=1e-14))
    return CriticalPoint(k, _angular_frequency(k, upper, lower, interface))


def _stable_message(interface: InterfaceState) -> str:
    return (
        f"sliding is stable at every wavenumber for zeta = {interface.zeta:g}, "
        f"a = {interface.a:g}, f = {interface.friction:g} and these bodies"
    )


def _angular_frequency(
    k: float, upper: Body | RigidBody, lower: Body | RigidBody, interface: InterfaceState
) -> float:
    """omega (rad/s) at a marginal k: the root of ``a w^2 - rho b w - zeta = 0`` that fits g."""
    a, zeta, b = interface.a, interface.zeta, interface.state_coefficient
    g, rho = (float(x) for x in _load_and_coupling(k, upper, lower, interface))
    root = math.sqrt(max((rho * b) ** 2 + 4.0 * a * zeta, 0.0))
    large = math.copysign((abs(rho) * b + root) / (2.0 * a), rho if rho else 1.0)
    small = -zeta / (a * large)
    w = min((large, small), key=lambda w: abs(b * w**2 / (1.0 + w**2) - g))
    return w * interface.velocity / interface.slip_length


def critical_length(height: ArrayLike, material: Material, interface: InterfaceState) -> Array:
    """Critical nucleation length of a block on a rigid base (the solid line of Fig. 3).

    Parameters
    ----------
    height : array_like
        Block height H (m), any shape; inf for a half-space.
    material : Material
    interface : InterfaceState

    Returns
    -------
    length : ndarray
        ``L_c = 2 pi / k_c`` (m), shape of the height.

    Raises
    ------
    NoInstability
        If sliding is stable.

    Notes
    -----
    Eq. (5) with the transfer functions of Eq. (10): constant stress on the block's far side.
    """
    height = np.asarray(height, dtype=float)
    lengths = [
        critical_wavenumber(Body(material, float(h), "traction"), RIGID, interface).length
        for h in height.flat
    ]
    return np.reshape(lengths, height.shape)


@cache
def theory_length(height: float, material: Material, interface: InterfaceState) -> float:
    """The linear theory's critical length (m); raises NoInstability if there is none."""
    return float(critical_length(height, material, interface))
