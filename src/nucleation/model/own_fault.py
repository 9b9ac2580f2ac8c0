"""What a fault of one's own has where nothing is given.

The scales of the paper's friction law, v*, v0 and phi*, and the age of its interface belong to one
experiment. A fault of other constants has the regularised Dieterich-Ruina law, whose a and b are
those that were given, and scales that are to its V and D/V as the paper's are to the paper's.
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
    LAW: {"regularisation_slip_rate": 1e-4, "reference_slip_rate": 1.0},
    PAPERS_LAW: {"regularisation_slip_rate": 1e-4, "slip_rate_scale": 1e-2},
}
"""Scales of each law, over V."""

STATE_SCALE = 6.6e-3  # phi* of the paper's law, over D/V
AGE = 20.0  # of the interface at the start, over D/V
ROUGHNESS = 0.2  # correlation length along x, over mu/(1 - nu) D/(b sigma0)

PAPERS = {
    "velocity": Loading().velocity,
    "normal_stress": Loading().normal_stress,
    "characteristic_slip_distance": Friction().characteristic_slip_distance,
    "shear_modulus": Material().shear_modulus,
    "poisson_ratio": Material().poisson_ratio,
}
"""The paper's values of what the scales follow from, in SI units."""


def follows_from(given: Mapping[str, Any]) -> dict[str, Any]:
    """What follows from those constants of a fault that are given.

    Parameters
    ----------
    given : mapping
        Values in SI units by their names in studies; what is left out has the paper's value.

    Returns
    -------
    dict
        Without what is given itself: the initial state, where D or V is given; and where constants
        of friction are, the friction law, its scales, and the correlation length of roughness.
    """
    known: dict[str, Any] = {**PAPERS, **given}
    velocity, distance = known["velocity"], known["characteristic_slip_distance"]
    found: dict[str, Any] = {}
    if {"velocity", "characteristic_slip_distance"} & given.keys():
        found["phi0"] = AGE * distance / velocity
    if CONSTANTS.keys() & given.keys():
        law = given.get("friction_law", _law_with(given))
        found["friction_law"] = law
        for name, ratio in OVER_VELOCITY.get(law, {}).items():
            found[name] = ratio * velocity
        if law == PAPERS_LAW:
            found["state_scale"] = STATE_SCALE * distance / velocity
        b = _state_coefficient(given)
        if b > 0.0:
            modulus = known["shear_modulus"] / (1.0 - known["poisson_ratio"])
            zone = modulus * distance / (b * known["normal_stress"])
            found["correlation_length"] = ROUGHNESS * zone
    return {name: value for name, value in found.items() if name not in given}


def _law_with(given: Mapping[str, Any]) -> str:
    """The usual law, or the paper's if a scale is given that the former does not have."""
    usual, papers = (declarations(law_class(name)).keys() for name in (LAW, PAPERS_LAW))
    return PAPERS_LAW if given.keys() & (papers - usual) else LAW


def _state_coefficient(given: Mapping[str, Any]) -> float:
    """The coefficient b of a fault; what is not given of it is the paper's."""
    _, a, zeta = Friction().expansion(PAPERS["velocity"])
    ratio = given.get("zeta_over_a", zeta / a)
    a = given.get("direct_effect", a)
    zeta = given.get("velocity_weakening", ratio * a)
    return float(given.get("evolution_effect", a + zeta))
