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
