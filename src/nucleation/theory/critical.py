"""The critical wavenumber and the critical nucleation length (Secs. 3-5, Text S1.4).

The critical wavenumber k_c is the largest one with ``Re Lambda = 0``. The module :mod:`.crossings`
finds it, for one system or for thousands.
"""

import dataclasses
import math
from collections.abc import Iterable
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..model.linearised import InterfaceState
from ..model.material import Material
from ..model.parameters import Parameters
from .crossings import largest_crossings, marginal_frequencies
from .of_runs import Case, block_on_rigid_base, far_sides, systems_of
from .spectrum import Systems
from .status import STABLE
from .stiffness import Array

_Distinct = tuple[Any, ...]
"""All parameters on which the system of a run depends."""


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


def critical_point(one: Systems) -> CriticalPoint:
    """The largest ``k > 0`` with ``Re Lambda = 0`` on either branch of Eq. (5).

    Parameters
    ----------
    one : Systems
        One system, with fields of shape (1,).

    Returns
    -------
    CriticalPoint
        k_c and the frequency of its mode.

    Raises
    ------
    NoInstability
        If sliding is stable at every wavenumber.
    """
    k = largest_crossings(one)
    if np.isnan(k[0]):
        raise NoInstability(stability_reason(one))
    omega = marginal_frequencies(one, k)
    return CriticalPoint(float(k[0]), float(omega[0]))


def critical_lengths(cases: Iterable[Case]) -> Array:
    """The linear theory's critical lengths (m) of many runs, in few vectorised calls.

    The runs may differ in far sides and planes; equal ones are computed once. NaN where sliding is
    stable (:func:`run_length` gives the reason).
    """
    cases = list(cases)
    groups: dict[tuple[str, ...], dict[_Distinct, Case]] = {}
    for run, interface in cases:
        kind = (*far_sides(run), run.material.plane)
        groups.setdefault(kind, {}).setdefault(_distinct(run, interface), (run, interface))
    lengths: dict[_Distinct, float] = {}
    for group in groups.values():
        k = largest_crossings(systems_of(list(group.values())))
        found = 2.0 * math.pi / k
        lengths |= zip(group, found.tolist(), strict=True)
    return np.array([lengths[_distinct(*case)] for case in cases], dtype=float)


def _distinct(
    run: Parameters,
    interface: InterfaceState,
) -> _Distinct:
    below = run.below
    second = None if below is None else (below.material, below.geometry.height)
    return far_sides(run), run.material, run.geometry.height, second, interface


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


def length_on_rigid_base(
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
    lengths = []
    for one in height.ravel().tolist():
        lengths.append(critical_point(block_on_rigid_base(material, one, interface)).length)
    return np.array(lengths).reshape(height.shape)


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
    return critical_point(systems_of([(parameters, interface)])).length
