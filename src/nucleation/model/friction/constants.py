"""The friction law for given constants of the conventional, logarithmic law.

Faults are described by a coefficient f, the direct effect a and the weakening zeta = b - a at a
slip rate V. The simulations need a full, regularised law, which determines its own parameters from
these constants. Its default is the regularised Dieterich-Ruina law, whose scales have the ratios to
V and D/V of the paper's experiment.
"""

from collections.abc import Mapping
from typing import Any

from ..quantities import ParameterError, declared
from . import USUAL_LAW, Friction

CONSTANTS = ("friction", "a", "zeta_over_a", "zeta", "b")
"""Constants of the logarithmic law at the imposed velocity, by their names in studies."""

ZETA_OVER_A = declared(
    "velocity weakening over direct effect at the imposed velocity",
    "(-1.0, 1000.0)",
    symbol="zeta/a",
)

LAW = "dieterich_ruina"
OVER_VELOCITY = {
    LAW: {"regularisation_slip_rate": 1e-4, "reference_slip_rate": 1.0},
    USUAL_LAW: {"regularisation_slip_rate": 1e-4, "slip_rate_scale": 1e-2},
}
"""Scales of each law, over V."""

STATE_SCALE = 6.6e-3
"""phi* of the paper's law over D/V."""

AGE = 20.0
"""Initial age of the interface over D/V."""

ANY = 1e-6
"""V (m/s) and D (m) of a fault whose own law scales with both: time is in D/V."""

_ROUGHNESS = 0.2
"""Correlation length along x over mu/(1 - nu) D/(b sigma0)."""


def constants_of(friction: Friction, velocity: float) -> dict[str, float]:
    """The :data:`CONSTANTS` of a law at V (m/s), by name."""
    f, a, zeta = friction.expansion(velocity)
    return dict(zip(CONSTANTS, (f, a, zeta / a, zeta, a + zeta), strict=True))


def with_constants(friction: Friction, velocity: float, values: Mapping[str, Any]) -> Friction:
    """The law with those of the :data:`CONSTANTS` that are given, and its own values of the others.

    If only a is given, the result has the same zeta/a. A ParameterError refuses constants that set
    a parameter that is given, too, and more than one of zeta, zeta/a and b.
    """
    given = {name: float(values[name]) for name in CONSTANTS if name in values}
    if not given:
        return friction
    clash = [name for name in friction.set_by_expansion if name in values]
    if clash:
        raise ParameterError(
            f"{', '.join(clash)} is not allowed together with {', '.join(given)}, which sets it"
        )
    weakenings = [name for name in CONSTANTS[2:] if name in given]
    if len(weakenings) > 1:
        raise ParameterError(f"{weakenings[0]} is not allowed together with {weakenings[1]}")
    f, a, ratio, zeta, b = (constants_of(friction, velocity) | given).values()
    if "b" in given:
        zeta = b - a
    elif "zeta" not in given:
        zeta = ratio * a
    return full_law(friction, velocity, f, a, zeta)


def full_law(friction: Friction, velocity: float, f: float, a: float, zeta: float) -> Friction:
    """The law with f, a and zeta in steady sliding at V (m/s), which keeps its other parameters."""
    try:
        return friction.with_expansion(velocity, f, a, zeta)
    except ParameterError as error:
        wanted = f"f = {f:g}, a = {a:g}, zeta = {zeta:g}"
        v0 = friction.regularisation_slip_rate
        if velocity < 10.0 * v0:
            own = f"v0 = {v0:g} m/s, regularisation_slip_rate"
            wanted += f"; {own}, must be far below V = {velocity:g} m/s"
        raise ParameterError(f"no friction law has {wanted}: {error}") from None


def own_law(velocity: float, slip_distance: float, evolution: str, law: str = LAW) -> Friction:
    """The friction law of a fault of its own, with scales that follow from V (m/s) and D (m)."""
    scales = {name: ratio * velocity for name, ratio in OVER_VELOCITY.get(law, {}).items()}
    if law == USUAL_LAW:
        scales["state_scale"] = STATE_SCALE * slip_distance / velocity
    return Friction(law=law, evolution=evolution, slip_distance=slip_distance, **scales)


def law_of(
    law: Friction | None, evolution: str, velocity: float, slip_distance: float, *constants: float
) -> Friction:
    """The law, by default one of its own, with D (m) and the constants f, a and zeta at V (m/s)."""
    if law is None:
        law = own_law(velocity, slip_distance, evolution)
    elif (*law.expansion(velocity), law.slip_distance) == (*constants, slip_distance):
        return law  # unchanged in all digits
    return full_law(law.changed({"slip_distance": slip_distance}), velocity, *constants)


def roughness_length(fault: Any, b: float) -> float:
    """Correlation length (m) of roughness along a single fault: a fifth of L_b."""
    modulus = fault.single("shear_modulus") / (1.0 - fault.single("poisson_ratio"))
    strength = b * fault.single("normal_stress")
    return _ROUGHNESS * modulus * fault.single("slip_distance") / strength
