"""The full friction law that has given constants of the conventional, logarithmic law.

Faults are described by a coefficient f, the direct effect a and the weakening zeta = b - a at a
slip rate V. The simulations need the full regularised law of :mod:`nucleation.model.friction.law`.
"""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np

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
}  # fmt: skip
"""Constants of the logarithmic law, by their names in studies."""

SET_BY_CONSTANTS = ("base_friction", "rate_coefficient", "aging_coefficient")


def constants(friction: Friction, velocity: float) -> dict[str, float]:
    """The :data:`CONSTANTS` of a law at a slip rate (m/s)."""
    f, a, zeta = friction.expansion(velocity)
    return dict(zip(CONSTANTS, (f, a, zeta / a), strict=True))


def with_constants(friction: Friction, velocity: float, values: dict[str, Any]) -> Friction:
    """The law with those :data:`CONSTANTS` that are among some values, and its own otherwise.

    Raises
    ------
    ParameterError
        If there is no such law, or the values also set what is to be found.
    """
    given = {name: float(values[name]) for name in CONSTANTS if name in values}
    if not given:
        return friction
    clash = [name for name in SET_BY_CONSTANTS if name in values]
    if clash:
        raise ParameterError(
            f"{', '.join(clash)} is not allowed together with {', '.join(given)}, which sets it"
        )
    f, a, ratio = (constants(friction, velocity) | given).values()
    return full_law(friction, velocity, f, a, ratio * a)


def full_law(friction: Friction, velocity: float, f: float, a: float, zeta: float) -> Friction:
    """The law with these constants about steady sliding at one slip rate.

    Parameters
    ----------
    friction : Friction
        Gives D, phi*, v*, v0 and the state evolution law.
    velocity : float
        Slip rate V of steady sliding (m/s).
    f : float
        Friction coefficient there.
    a, zeta : float
        Direct effect ``v df/dv`` and velocity weakening ``-v df_ss/dv`` there (Eq. S-log).

    Returns
    -------
    Friction
        With other theta, xi and b, so that :meth:`Friction.expansion` gives f, a and zeta.

    Raises
    ------
    ParameterError
        If no allowed theta, xi, b do.

    Notes
    -----
    With ``A = 1 + b log(1 + phi/phi*)``, ``w = sqrt(V^2 + v0^2)`` and the rate factor ``R(v)`` of
    the law, ``f = A R``, ``a = A V R'`` and ``a + zeta = b R (V/w)^2 / (1 + phi*/phi)``. The last
    gives b, with R = f/A; the others are linear in theta and xi.
    """
    v, v0, scale = velocity, friction.regularisation_slip_rate, friction.slip_rate_scale
    speed = float(friction.slip_speed(v))
    age = float(friction.steady_state(v)) / friction.state_scale
    per_aging = (a + zeta) / f * (speed / v) ** 2 * (1.0 + 1.0 / age)  # b / (1 + b l)
    growth = per_aging * np.log1p(age)
    wanted = f"f = {f:g}, a = {a:g}, zeta = {zeta:g} at {v:g} m/s"
    if not 0.0 <= growth < 1.0:
        raise ParameterError(
            f"no friction law has {wanted}: (a + zeta)/f log(1 + phi/phi*) = {growth:.3g} must lie "
            f"in [0, 1), with phi = D/V; phi* = {friction.state_scale:g} s is state_scale"
        )
    aging = per_aging / (1.0 - growth)
    factor = 1.0 + aging * np.log1p(age)
    rates = np.array(
        [[v / speed, np.log1p(v / scale)], [v * v0**2 / speed**3, v / (scale + v)]]
    )  # R and V R' by theta and xi
    base, rate = np.linalg.solve(rates, np.array([f, a]) / factor)
    try:
        return dataclasses.replace(
            friction,
            base_friction=float(base),
            rate_coefficient=float(rate),
            aging_coefficient=float(aging),
        )
    except ParameterError as error:
        raise ParameterError(f"no friction law has {wanted}: {error}") from None
