"""The critical wavenumber and the critical nucleation length (Secs. 3-5, Text S1.4).

The critical wavenumber k_c is the largest one with ``Re Lambda = 0``. The module :mod:`.crossings`
finds it, for one system or for thousands.
"""

from typing import Any, NamedTuple

import numpy as np

from .crossings import largest_crossings
from .marginal import marginal_frequencies
from .spectrum import Systems
from .status import STABLE, NoLength
from .stiffness import Array


class CriticalMode(NamedTuple):
    """The marginally stable mode with the largest wavenumber: numbers or arrays of any kind.

    Its ``exp(i omega t - i k_c x)`` propagates along +x if omega is positive. Where the bodies are
    mirror images both signs are marginal, and the positive one is given.

    Examples
    --------
    >>> from nucleation.api import PAPER
    >>> mode = PAPER.critical_mode()
    >>> round(float(mode.length), 3), round(float(mode.wavenumber), 3)
    (0.238, 26.395)
    """

    length: Any  # L_c = 2 pi/k_c (m)
    wavenumber: Any  # k_c (1/m)
    angular_frequency: Any  # omega (rad/s)


def critical_modes(systems: Systems) -> CriticalMode:
    """The largest ``k > 0`` with ``Re Lambda = 0`` on either branch of Eq. (5), of many systems.

    Parameters
    ----------
    systems : Systems
        Fields of shape (n,).

    Returns
    -------
    CriticalMode
        Fields of shape (n,); NaN where sliding is stable at every wavenumber.
    """
    k = largest_crossings(systems)
    return CriticalMode(2.0 * np.pi / k, k, marginal_frequencies(systems, k))


def unstable_modes(systems: Systems) -> CriticalMode:
    """The same; raises NoLength with the reason if one of the systems is stable."""
    found = critical_modes(systems)
    stable = np.flatnonzero(np.isnan(found.wavenumber))
    if stable.size:
        raise NoLength(stability_reason(systems.at(stable[:1])), STABLE)
    return found


def critical_length_of(one: Systems) -> float:
    """L_c (m) of a single system; a NoLength has the reason where there is none."""
    return float(unstable_modes(one).length[0])


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
