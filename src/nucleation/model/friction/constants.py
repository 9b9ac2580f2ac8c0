"""The friction law for given constants of the conventional, logarithmic law.

Faults are described by a coefficient f, the direct effect a and the weakening zeta = b - a at a
slip rate V. The simulations need a full, regularised law of :mod:`nucleation.model.friction.laws`;
each law determines its own parameters from these constants.
"""

from collections.abc import Mapping
from typing import Any

from ..quantities import ParameterError, Quantity, declared
from .law import Friction

CONSTANTS: dict[str, Quantity] = {
    "friction": declared(
        "friction coefficient of steady sliding at the imposed velocity", "(0.0, 10.0)", symbol="f"
    ),
    "a": declared(
        "direct effect of the slip rate at the imposed velocity", "(0.0, 1.0)", symbol="a"
    ),
    "zeta_over_a": declared(
        "velocity weakening over direct effect at the imposed velocity",
        "(-1.0, 1000.0)",
        symbol="zeta/a",
    ),
    "zeta": declared(
        "velocity weakening at the imposed velocity, b - a; in place of zeta_over_a",
        "(-1.0, 1.0)",
        symbol="zeta",
    ),
    "b": declared(
        "coefficient b = a + zeta of the log of the state at the imposed velocity; in place of "
        "zeta_over_a",
        "[0.0, 1.0)",
        symbol="b",
    ),
}
"""Constants of the logarithmic law, by their names in studies."""

_WEAKENINGS = ("zeta_over_a", "zeta", "b")
"""Alternative constants for the weakening."""


def constants(friction: Friction, velocity: float) -> dict[str, float]:
    """The :data:`CONSTANTS` of a law.

    Parameters
    ----------
    friction : Friction
        The full law.
    velocity : float
        Slip rate V of steady sliding (m/s).

    Returns
    -------
    dict of float
    """
    f, a, zeta = friction.expansion(velocity)
    return dict(
        zip(
            CONSTANTS,
            (f, a, zeta / a, zeta, a + zeta),
            strict=True,
        )
    )


def with_constants(friction: Friction, velocity: float, values: Mapping[str, Any]) -> Friction:
    """The law with given :data:`CONSTANTS`, and its own values of the others.

    Parameters
    ----------
    friction : Friction
        The full law. If only a is given, the result has the same zeta/a.
    velocity : float
        Slip rate V of steady sliding (m/s).
    values : mapping
        Values by name; only the constants among them are used.

    Returns
    -------
    Friction

    Raises
    ------
    ParameterError
        If the law has no allowed parameters for these constants, or the values also set one of
        these parameters, or more than one of zeta, zeta/a and b.
    """
    given = {name: float(values[name]) for name in CONSTANTS if name in values}
    if not given:
        return friction
    clash = [name for name in friction.set_by_expansion if name in values]
    if clash:
        raise ParameterError(
            f"{', '.join(clash)} is not allowed together with {', '.join(given)}, which sets it"
        )
    weakenings = [name for name in _WEAKENINGS if name in given]
    if len(weakenings) > 1:
        raise ParameterError(f"{weakenings[0]} is not allowed together with {weakenings[1]}")
    f, a, ratio, zeta, b = (constants(friction, velocity) | given).values()
    if "b" in given:
        zeta = b - a
    elif "zeta" not in given:
        zeta = ratio * a
    return full_law(friction, velocity, f, a, zeta)


def full_law(
    friction: Friction,
    velocity: float,
    f: float,
    a: float,
    zeta: float,
) -> Friction:
    """The law with these constants about steady sliding at one slip rate.

    Parameters
    ----------
    friction : Friction
        The law with its evolution; it keeps all parameters but :attr:`Friction.set_by_expansion`.
    velocity : float
        Slip rate V of steady sliding (m/s).
    f : float
        Friction coefficient at V.
    a, zeta : float
        Direct effect ``v df/dv`` and velocity weakening ``-v df_ss/dv`` at V (Eq. S-log).

    Returns
    -------
    Friction
        With other values of :attr:`Friction.set_by_expansion`, so that :meth:`Friction.expansion`
        gives f, a and zeta.

    Raises
    ------
    ParameterError
        If the law has no allowed parameters for these constants.
    """
    try:
        return friction.with_expansion(velocity, f, a, zeta)
    except ParameterError as error:
        wanted = f"f = {f:g}, a = {a:g}, zeta = {zeta:g} at {velocity:g} m/s"
        v0 = friction.regularisation_slip_rate
        slow = velocity < 10.0 * v0
        cure = f"; v0 = {v0:g} m/s, regularisation_slip_rate, must be far below V" if slow else ""
        raise ParameterError(f"no friction law has {wanted}{cure}: {error}") from None
