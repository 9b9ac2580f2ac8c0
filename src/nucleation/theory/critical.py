"""The critical wavenumber and the critical nucleation length (Secs. 3-5, Text S1.4).

The critical wavenumber k_c is the largest one with ``Re Lambda = 0``. The module :mod:`.crossings`
finds it, for one system or for thousands.
"""

import dataclasses
import math
from collections.abc import Iterable, Sequence
from functools import cache

import numpy as np
from numpy.typing import ArrayLike

from ..model.linearised import InterfaceState
from ..model.material import Material
from ..model.parameters import Parameters
from .crossings import largest_crossings, marginal_frequencies
from .spectrum import Systems, system
from .status import STABLE
from .stiffness import Array, LayerPair, Layers
from .transfer import RIGID, Body, RigidBody, bodies_of

_Case = tuple[Body | RigidBody, Body | RigidBody, InterfaceState]
"""A system of the theory: the upper body, the lower body and their interface."""


class NoInstability(ValueError):
    """Homogeneous sliding is stable at every wavenumber: there is no critical length."""

    status = STABLE


@dataclasses.dataclass(frozen=True)
class CriticalPoint:
    """The largest wavenumber with ``Re Lambda = 0``.

    Its mode ``exp(i omega t - i k_c x)`` travels along +x if omega is positive. If ``G2 = 0`` both
    signs are marginal; the positive one is given.
    """

    wavenumber: float  # k_c > 0 (1/m)
    angular_frequency: float  # omega (rad/s)

    @property
    def length(self) -> float:
        """The critical nucleation length ``L_c = 2 pi / k_c`` (m)."""
        return 2.0 * math.pi / self.wavenumber


def critical_wavenumber(
    upper: Body | RigidBody,
    lower: Body | RigidBody,
    interface: InterfaceState,
) -> CriticalPoint:
    """The largest ``k > 0`` with ``Re Lambda = 0`` on either branch of Eq. (5).

    Parameters
    ----------
    upper, lower : Body or RigidBody
        The two bodies, at most one of them rigid.
    interface : InterfaceState
        Friction linearised about steady sliding.

    Returns
    -------
    CriticalPoint
        k_c and the frequency of its mode.

    Raises
    ------
    NoInstability
        If sliding is stable at every wavenumber.
    """
    one = systems_of([(upper, lower, interface)])
    k = largest_crossings(one)
    if np.isnan(k[0]):
        raise NoInstability(stability_reason(one))
    omega = marginal_frequencies(one, k)
    return CriticalPoint(float(k[0]), float(omega[0]))


def systems_of(cases: Sequence[_Case]) -> Systems:
    """Systems as arrays; their bodies have the same far sides, and the same one is rigid."""
    single = [system(*case) for case in cases]
    pair = LayerPair(
        _stacked(one.pair.upper for one in single),
        _stacked(one.pair.lower for one in single),
    )
    fields = np.array([one[1:] for one in single], dtype=float).T
    return Systems(pair, *fields)


def _stacked(bodies: Iterable[Layers | None]) -> Layers | None:
    """Many layers as one with arrays; None if they are rigid."""
    present = [body for body in bodies if body is not None]
    if not present:
        return None
    first = present[0]
    fields = np.array([body[:3] for body in present], dtype=float)
    modulus, ratio, height = fields.T
    return Layers(modulus, ratio, height, first.far_side, first.antiplane)


def critical_lengths(cases: Iterable[_Case]) -> Array:
    """The linear theory's critical lengths (m) of many systems, in few vectorised calls.

    The systems may differ in far sides and rigid bodies; equal ones are computed once. NaN where
    sliding is stable (:func:`critical_wavenumber` gives the reason).
    """
    cases = list(cases)
    groups: dict[tuple[str, str], dict[_Case, None]] = {}
    for case in cases:
        kinds = _kind(case[0]), _kind(case[1])
        groups.setdefault(kinds, {})[case] = None
    lengths: dict[_Case, float] = {}
    for group in groups.values():
        k = largest_crossings(systems_of(list(group)))
        found = 2.0 * math.pi / k
        lengths |= zip(group, found.tolist(), strict=True)
    return np.array([lengths[case] for case in cases], dtype=float)


def _kind(body: Body | RigidBody) -> str:
    """The properties that bodies in one vectorised call have in common."""
    if isinstance(body, RigidBody):
        return "rigid"
    return f"{body.far_side}, {body.material.plane}"


def stability_reason(one: Systems) -> str:
    """Why homogeneous sliding of one stable system is stable at every wavelength."""
    fields = one.friction, one.a, one.zeta, one.b
    friction, a, zeta, b = (_number(field) for field in fields)
    if b <= 0.0:
        return f"a + zeta = {b:g} is not positive: friction grows with slip rate at every frequency"
    facts = f"sliding is stable at every wavenumber for zeta = {zeta:g}, a = {a:g}"
    if zeta <= 0.0:
        reason = f"{facts}: friction does not weaken with slip rate"
        if friction:
            reason += f", and with f = {friction:g} slip changes the normal stress too little"
        return reason
    bodies = one.pair.deformable
    held = " and ".join(f"{body.far_side} (H = {_number(body.height):g} m)" for body in bodies)
    return (
        f"{facts}, although friction weakens: with the far side {held} the layer is stiffer than "
        "friction's critical stiffness at every wavelength; a higher or softer layer, a larger "
        "normal stress or a far side under traction make it unstable"
    )


def _number(value: Array) -> float:
    """The number in an array of one entry."""
    return float(np.ravel(value)[0])


def critical_length(
    height: ArrayLike,
    material: Material,
    interface: InterfaceState,
) -> Array:
    """``L_c = 2 pi/k_c`` of a block on a rigid base (Fig. 3), Eq. (5) with Eq. (10).

    Parameters
    ----------
    height : array_like
        Height H (m) of the block, inf for a half-space.
    material : Material
        Of the block.
    interface : InterfaceState
        Friction linearised about steady sliding.

    Returns
    -------
    ndarray
        L_c (m), shape of the height.

    Raises
    ------
    NoInstability
        If sliding is stable at one of the heights.
    """
    height = np.asarray(height, dtype=float)
    bodies = [Body(material, h, "traction") for h in height.ravel().tolist()]
    cases: list[_Case] = [(body, RIGID, interface) for body in bodies]
    lengths = critical_lengths(cases)
    stable = np.isnan(lengths)
    if stable.any():
        first = cases[int(np.argmax(stable))]
        raise NoInstability(stability_reason(system(*first)))
    return lengths.reshape(height.shape)


@cache
def run_length(
    parameters: Parameters,
    interface: InterfaceState,
) -> float:
    """L_c of a run with its own bodies and far sides.

    Parameters
    ----------
    parameters : Parameters
        Of the run.
    interface : InterfaceState
        Friction linearised about steady sliding.

    Returns
    -------
    float
        L_c (m).

    Raises
    ------
    NoInstability
        If sliding is stable at every wavenumber.
    """
    return critical_wavenumber(*bodies_of(parameters), interface).length


@cache
def critical_length(
    height: float,
    material: Material,
    interface: InterfaceState,
) -> float:
    """L_c of a block on a rigid base.

    Parameters
    ----------
    height : float
        Height H (m) of the block.
    material : Material
        Of the block.
    interface : InterfaceState
        Friction linearised about steady sliding.

    Returns
    -------
    float
        L_c (m).

    Raises
    ------
    NoInstability
        If sliding is stable at every wavenumber.
    """
    return float(critical_length(height, material, interface))
