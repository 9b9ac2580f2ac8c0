"""Friction linearised about steady sliding at one velocity: the input of the linear theory."""

import dataclasses
from decimal import Decimal
from functools import lru_cache

from .checked import Checked
from .friction.law import Friction
from .loading import Loading
from .parameters import Parameters
from .quantities import quantity


@dataclasses.dataclass(frozen=True)
class InterfaceState(Checked):
    """Rate-and-state friction linearised about steady sliding at one velocity (SI units).

    ``a = v df/dv`` at fixed state, ``zeta = -df_ss/dlog v``, ``ell = -D/g'(1)``.
    """

    friction: float = quantity(
        "friction coefficient of steady sliding", "[0.0, 10.0)", symbol="f", default=0.41
    )
    a: float = quantity("direct-effect coefficient a", "(0.0, 10.0)", symbol="a", default=0.0068)
    zeta: float = quantity(
        "velocity weakening zeta (negative: strengthening)",
        "(-10.0, 10.0)",
        symbol="zeta",
        default=0.016,
    )
    slip_length: float = quantity(
        "slip length ell over which the state evolves", "(0.0, 1e3) m", symbol="ell", default=5.0e-7
    )
    velocity: float = quantity("sliding velocity", "(0.0, 1e3) m/s", symbol="V", default=1.0e-5)
    normal_stress: float = quantity(
        "compressive normal stress", "(0.0, 1e13) Pa", symbol="sigma0", default=1.0e6
    )


def interface_state(parameters: Parameters) -> InterfaceState:
    """The full friction law expanded about sliding at the imposed velocity."""
    return linearised(parameters.friction, parameters.loading)


@lru_cache(maxsize=4096)
def linearised(friction: Friction, loading: Loading) -> InterfaceState:
    """The friction law of a run, expanded about steady sliding at the imposed velocity.

    Parameters
    ----------
    friction : Friction
        The full friction law.
    loading : Loading
        Imposed velocity (m/s) and normal stress (Pa).

    Returns
    -------
    InterfaceState
    """
    f0, a, zeta = friction.expansion(loading.velocity)
    interface = InterfaceState(f0, a, zeta, friction.slip_distance)
    return loaded(interface, loading)


_FEWEST_DIGITS, _MOST_DIGITS = 2, 6
"""Limits of the significant digits in the comparison of a rounded value with the exact one."""


def not_rounded_from(rounded: InterfaceState, exact: InterfaceState) -> str:
    """Find the first value that is not a rounding of the exact one.

    Parameters
    ----------
    rounded : InterfaceState
        Rounded values, such as those of the paper's main text.
    exact : InterfaceState
        Values of the friction law.

    Returns
    -------
    str
        Both values as text; empty if all values are roundings.

    Notes
    -----
    A value is a rounding if both agree in all significant digits of the rounded one: 0.41 is a
    rounding of 0.4143.
    """
    for field in ("slip_length", "a", "zeta", "friction"):
        value = getattr(rounded, field)
        of_law = getattr(exact, field)
        given = len(Decimal(repr(float(value))).normalize().as_tuple().digits)
        digits = min(max(given, _FEWEST_DIGITS), _MOST_DIGITS)
        if float(f"{value:.{digits}g}") != float(f"{of_law:.{digits}g}"):
            unit = " m" if field == "slip_length" else ""
            return (
                f"main_text_interface.{field} = {value:g}{unit} is no rounding of the friction "
                f"law's own value, {of_law:.6g}{unit}"
            )
    return ""


def loaded(interface: InterfaceState, loading: Loading) -> InterfaceState:
    """The interface under another loading.

    Parameters
    ----------
    interface : InterfaceState
        Friction coefficients and slip length.
    loading : Loading
        Velocity (m/s) and normal stress (Pa).

    Returns
    -------
    InterfaceState
        `interface` with the velocity and the normal stress of `loading`.
    """
    return dataclasses.replace(
        interface,
        velocity=loading.velocity,
        normal_stress=loading.normal_stress,
    )
