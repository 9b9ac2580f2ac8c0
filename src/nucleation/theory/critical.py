"""The critical wavenumber and the critical nucleation length (Secs. 3-5, Text S1.4).

The critical wavenumber k_c is the largest one with ``Re Lambda = 0``; how it is found, of one
system or of thousands, says :mod:`.crossings`.
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
from .stiffness import Array, Layers, Pair
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
    upper: Body | RigidBody, lower: Body | RigidBody, interface: InterfaceState
) -> CriticalPoint:
    """The largest ``k > 0`` with ``Re Lambda = 0`` on either branch of Eq. (5).

    Raises
    ------
    NoInstability
        If sliding is stable at every wavenumber.
    """
    one = systems_of([(upper, lower, interface)])
    k = largest_crossings(one)
    if np.isnan(k[0]):
        raise NoInstability(stability_reason(one))
    return CriticalPoint(float(k[0]), float(marginal_frequencies(one, k)[0]))


def systems_of(cases: Sequence[_Case]) -> Systems:
    """Systems as arrays; their bodies have the same far sides, and the same one is rigid."""
    single = [system(*case) for case in cases]

    def stacked(bodies: Iterable[Layers | None]) -> Layers | None:
        present = [body for body in bodies if body is not None]
        if not present:
            return None
        modulus, ratio, height = np.array([body[:3] for body in present], dtype=float).T
        return Layers(modulus, ratio, height, present[0].far_side, present[0].antiplane)

    pair = Pair(stacked(s.pair.upper for s in single), stacked(s.pair.lower for s in single))
    return Systems(pair, *np.array([s[1:] for s in single], dtype=float).T)


def theory_lengths(cases: Iterable[_Case]) -> Array:
    """The linear theory's critical lengths of many systems, in few vectorised calls.

    They may be in any mixture of far sides and rigid bodies; equal ones are computed once. NaN
    where sliding is stable (:func:`critical_wavenumber` says why).
    """
    cases = list(cases)
    groups: dict[tuple[str, ...], dict[_Case, None]] = {}
    for case in cases:
        kind = tuple(_kind(body) for body in case[:2])
        groups.setdefault(kind, {})[case] = None
    lengths: dict[_Case, float] = {}
    for group in groups.values():
        k = largest_crossings(systems_of(list(group)))
        lengths |= zip(group, (2.0 * math.pi / k).tolist(), strict=True)
    return np.array([lengths[case] for case in cases], dtype=float)


def _kind(body: Body | RigidBody) -> str:
    """What bodies that are computed together have in common."""
    if isinstance(body, RigidBody):
        return "rigid"
    return f"{body.far_side}, {body.material.plane}"


def stability_reason(one: Systems) -> str:
    """Why homogeneous sliding of one system is stable at every wavenumber, where it is."""
    friction, a, zeta, b = (float(np.ravel(x)[0]) for x in (*one[1:4], one.b))
    if b <= 0.0:
        return f"a + zeta = {b:g} is not positive: friction grows with slip rate at every frequency"
    facts = f"sliding is stable at every wavenumber for zeta = {zeta:g}, a = {a:g}"
    if zeta <= 0.0:
        normal = f", and with f = {friction:g} slip changes the normal stress too little to help"
        return f"{facts}: friction does not weaken with slip rate{normal if friction else ''}"
    bodies = [body for body in one.pair if body is not None]
    held = " and ".join(f"{x.far_side} (H = {float(np.ravel(x.height)[0]):g} m)" for x in bodies)
    return (
        f"{facts}, although friction weakens: with the far side {held} the layer is stiffer than "
        "friction's critical stiffness, however long the wave; a higher or softer layer, a larger "
        "normal stress or a far side under traction make it unstable"
    )


def critical_length(height: ArrayLike, material: Material, interface: InterfaceState) -> Array:
    """``L_c = 2 pi/k_c`` (m) of a block on a rigid base (Fig. 3), Eq. (5) with Eq. (10).

    For heights (m) of any shape, inf for a half-space; raises NoInstability if sliding is stable.
    """
    height = np.asarray(height, dtype=float)
    cases: list[_Case] = [
        (Body(material, h, "traction"), RIGID, interface) for h in height.ravel().tolist()
    ]
    lengths = theory_lengths(cases)
    for case in np.flatnonzero(np.isnan(lengths))[:1]:
        raise NoInstability(stability_reason(system(*cases[case])))
    return lengths.reshape(height.shape)


@cache
def run_length(parameters: Parameters, interface: InterfaceState) -> float:
    """L_c (m) of a run's own bodies and far sides; raises NoInstability if there is none."""
    return critical_wavenumber(*bodies_of(parameters), interface).length


@cache
def theory_length(height: float, material: Material, interface: InterfaceState) -> float:
    """L_c (m) of a block on a rigid base; raises NoInstability if there is none."""
    return float(critical_length(height, material, interface))
