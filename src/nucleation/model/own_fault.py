"""Default parameters for the user's own fault.

The scales of the paper's friction law, v*, v0 and phi*, and the age of its interface are those of
one experiment. For a fault with other constants the default is the regularised Dieterich-Ruina
law with the given a and b. Its scales have the paper's ratios to V and D/V.
"""

from collections.abc import Mapping
from typing import Any

from .friction.constants import CONSTANTS, full_law
from .friction.law import Friction
from .friction.registry import law_class
from .loading import Loading
from .material import Material
from .quantities import declarations

LAW = "dieterich_ruina"
PAPERS_LAW = "product"
OVER_VELOCITY = {
    LAW: {
        "regularisation_slip_rate": 1e-4,
        "reference_slip_rate": 1.0,
    },
    PAPERS_LAW: {
        "regularisation_slip_rate": 1e-4,
        "slip_rate_scale": 1e-2,
    },
}
"""Scales of each law, over V."""

STATE_SCALE = 6.6e-3
"""phi* of the paper's law over D/V."""

AGE = 20.0
"""Initial age of the interface over D/V."""

_ROUGHNESS = 0.2
"""Correlation length along x over mu/(1 - nu) D/(b sigma0)."""

_PAPERS = {
    "velocity": Loading().velocity,
    "normal_stress": Loading().normal_stress,
    "slip_distance": Friction().slip_distance,
    "shear_modulus": Material().shear_modulus,
    "poisson_ratio": Material().poisson_ratio,
}
"""The paper's values (SI units) of the parameters that determine the scales."""


def own_law(velocity: float, slip_distance: float, evolution: str, law: str = LAW) -> Friction:
    """The friction law of a fault of its own, with scales that follow from V (m/s) and D (m)."""
    scales = {name: ratio * velocity for name, ratio in OVER_VELOCITY.get(law, {}).items()}
    if law == PAPERS_LAW:
        scales["state_scale"] = STATE_SCALE * slip_distance / velocity
    return Friction(law=law, evolution=evolution, slip_distance=slip_distance, **scales)


def law_of(
    law: Friction | None,
    evolution: str,
    velocity: float,
    slip_distance: float,
    *constants: float,
) -> Friction:
    """The law, by default one of its own, with D (m) and the constants f, a and zeta at V (m/s)."""
    if law is None:
        law = own_law(velocity, slip_distance, evolution)
    elif (*law.expansion(velocity), law.slip_distance) == (*constants, slip_distance):
        return law  # unchanged in all digits
    return full_law(law.changed({"slip_distance": slip_distance}), velocity, *constants)


def roughness_length(modulus: float, slip_distance: float, strength: float) -> float:
    """Correlation length (m) of roughness: a fifth of L_b, by mu* (Pa), D (m), b sigma0 (Pa)."""
    return _ROUGHNESS * modulus * slip_distance / strength


def follows_from(given: Mapping[str, Any]) -> dict[str, Any]:
    """The parameters that follow from the given constants of a fault.

    Parameters
    ----------
    given : mapping
        Values in SI units by their names in studies; missing ones have the paper's value.

    Returns
    -------
    dict
        Values in SI units without the given ones: the initial state, if D or V is given; and the
        friction law, its scales and the correlation length of roughness, if constants of friction
        are given.
    """
    known: dict[str, Any] = {**_PAPERS, **given}
    velocity = known["velocity"]
    distance = known["slip_distance"]
    found: dict[str, Any] = {}
    if "velocity" in given or "slip_distance" in given:
        found["initial_state"] = AGE * distance / velocity
    if CONSTANTS.keys() & given.keys():
        default = _law_with(given)
        law = given.get("friction_law", default)
        found["friction_law"] = law
        for name, ratio in OVER_VELOCITY.get(law, {}).items():
            found[name] = ratio * velocity
        if law == PAPERS_LAW:
            found["state_scale"] = STATE_SCALE * distance / velocity
        b = _evolution_effect(given)
        if b > 0.0:
            modulus = known["shear_modulus"] / (1.0 - known["poisson_ratio"])
            strength = b * known["normal_stress"]
            found["correlation_length"] = roughness_length(modulus, distance, strength)
    return {name: value for name, value in found.items() if name not in given}


def _law_with(given: Mapping[str, Any]) -> str:
    """The default law, or the paper's if it alone has one of the given parameters."""
    usual = declarations(law_class(LAW)).keys()
    papers = declarations(law_class(PAPERS_LAW)).keys()
    return PAPERS_LAW if given.keys() & (papers - usual) else LAW


def _evolution_effect(given: Mapping[str, Any]) -> float:
    """The coefficient b of a fault; missing constants have the paper's value."""
    _, a, zeta = Friction().expansion(_PAPERS["velocity"])
    ratio = given.get("zeta_over_a", zeta / a)
    a = given.get("a", a)
    zeta = given.get("zeta", ratio * a)
    return float(given.get("b", a + zeta))
