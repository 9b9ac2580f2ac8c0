"""The friction law that has given constants of the conventional, logarithmic law.

Faults are described by a coefficient f, the direct effect a and the weakening zeta = b - a at a
slip rate V. The simulations need a full, regularised law of :mod:`nucleation.model.friction.laws`;
each of them finds its own parameters from these constants.
"""

from typing import Any

from ..quantities import ParameterError, Quantity
from .law import Friction

CONSTANTS: dict[str, Quantity] = {
    "friction_coefficient": Quantity(
        "friction coefficient of steady sliding at the imposed velocity", low=0.0, high=10.0,
        symbol="f",
    ),
    "direct_effect": Quantity(
        "direct effect of the slip rate at the imposed velocity", low=0.0, high=1.0, symbol="a"
    ),
    "zeta_over_a": Quantity(
        "velocity weakening over direct effect at the imposed velocity", low=-1.0, high=1000.0,
        symbol="zeta/a",
    ),
    "velocity_weakening": Quantity(
        "velocity weakening at the imposed velocity, b - a; in place of zeta_over_a", low=-1.0,
        high=1.0, symbol="zeta",
    ),
    "evolution_effect": Quantity(
        "coefficient b = a + zeta of the log of the state at the imposed velocity; in place of "
        "zeta_over_a", low=0.0, high=1.0, closed="low", symbol="b",
    ),
}  # fmt: skip
"""Constants of the logarithmic law, by their names in studies."""


def constants(friction: Friction, velocity: float) -> dict[str, float]:
    """The :data:`CONSTANTS` of a law at a slip rate (m/s)."""
    f, a, zeta = friction.expansion(velocity)
    return dict(zip(CONSTANTS, (f, a, zeta / a, zeta, a + zeta), strict=True))


def with_constants(friction: Friction, velocity: float, values: dict[str, Any]) -> Friction:
    """The law with those :data:`CONSTANTS` that are among some values, and its own otherwise.

    Of zeta and zeta/a the law keeps the latter where only a is given.

    Raises
    ------
    ParameterError
        If there is no such law, or the values also set what is to be found, or more than one of
        zeta, zeta/a and b.
    """
    given = {name: float(values[name]) for name in CONSTANTS if name in values}
    if not given:
        return friction
    clash = [name for name in friction.set_by_expansion if name in values]
    if clash:
        raise ParameterError(
            f"{', '.join(clash)} is not allowed together with {', '.join(given)}, which sets it"
        )
    weakening = [name for name in list(CONSTANTS)[2:] if name in given]
    if len(weakening) > 1:
        raise ParameterError(f"{weakening[0]} is not allowed together with {weakening[1]}")
    f, a, ratio, zeta, b = (constants(friction, velocity) | given).values()
    if "evolution_effect" in given:
        zeta = b - a
    elif "velocity_weakening" not in given:
        zeta = ratio * a
    return full_law(friction, velocity, f, a, zeta)


def full_law(friction: Friction, velocity: float, f: float, a: float, zeta: float) -> Friction:
    """The law with these constants about steady sliding at one slip rate.

    Parameters
    ----------
    friction : Friction
        Gives the law, its evolution and all parameters that are not found.
    velocity : float
        Slip rate V of steady sliding (m/s).
    f : float
        Friction coefficient there.
    a, zeta : float
        Direct effect ``v df/dv`` and velocity weakening ``-v df_ss/dv`` there (Eq. S-log).

    Returns
    -------
    Friction
        With other values of :attr:`Friction.set_by_expansion`, so that :meth:`Friction.expansion`
        gives f, a and zeta.

    Raises
    ------
    ParameterError
        If no allowed values of them do.
    """
    try:
        return friction.with_expansion(velocity, f, a, zeta)
    except ParameterError as error:
        wanted = f"f = {f:g}, a = {a:g}, zeta = {zeta:g} at {velocity:g} m/s"
        v0 = friction.regularisation_slip_rate
        slow = velocity < 10.0 * v0
        cure = f"; v0 = {v0:g} m/s, regularisation_slip_rate, must be far below V" if slow else ""
        raise ParameterError(f"no friction law has {wanted}{cure}: {error}") from None
