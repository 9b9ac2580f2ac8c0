"""Default parameters for the user's own fault.

The scales of the paper's friction law, v*, v0 and phi*, and the age of its interface are those of
one experiment. For a fault with other constants the default is the regularised Dieterich-Ruina
law with the given a and b. Its scales have the paper's ratios to V and D/V.
"""

from collections.abc import Mapping
from typing import Any

from .friction.constants import CONSTANTS
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

_AGE = 20.0
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
        found["initial_state"] = _AGE * distance / velocity
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
            zone = modulus * distance / (b * known["normal_stress"])
            found["correlation_length"] = _ROUGHNESS * zone
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
