"""Default parameters for the user's own fault.

The scales of the paper's friction law, v*, v0 and phi*, and the age of its interface are those of
one experiment. For a fault with other constants the default is the regularised Dieterich-Ruina
law with the given a and b. Its scales have the paper's ratios to V and D/V.
"""

from .friction.constants import full_law
from .friction.law import Friction

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


def own_law(
    velocity: float,
    slip_distance: float,
    evolution: str,
    law: str = LAW,
) -> Friction:
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
