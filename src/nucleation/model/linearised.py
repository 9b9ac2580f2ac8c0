"""Friction linearised about steady sliding at one velocity: what the linear theory knows of it."""

import dataclasses
from functools import lru_cache

from .checked import Checked
from .friction.law import Friction
from .parameters import Loading, Parameters
from .quantities import quantity


@dataclasses.dataclass(frozen=True)
class InterfaceState(Checked):
    """Rate-and-state friction linearised about steady sliding at one velocity (SI units).

    ``a = v df/dv`` at fixed state, ``zeta = -df_ss/dlog v``, ``ell = -D/g'(1)``.
    """

    friction: float = quantity(
        "friction coefficient of steady sliding", low=0.0, high=10.0, closed="low", symbol="f",
        default=0.41,
    )  # fmt: skip
    a: float = quantity(
        "direct-effect coefficient a", low=0.0, high=10.0, symbol="a", default=0.0068
    )
    zeta: float = quantity(
        "velocity weakening zeta (negative: strengthening)", low=-10.0, high=10.0, symbol="zeta",
        default=0.016,
    )  # fmt: skip
    slip_length: float = quantity(
        "slip length ell over which the state evolves", unit="m", low=0.0, high=1e3, symbol="ell",
        default=5.0e-7,
    )  # fmt: skip
    velocity: float = quantity(
        "sliding velocity", unit="m/s", low=0.0, high=1e3, symbol="V", default=1.0e-5
    )
    normal_stress: float = quantity(
        "compressive normal stress", unit="Pa", low=0.0, high=1e13, symbol="sigma0", default=1.0e6
    )


def interface_state(parameters: Parameters) -> InterfaceState:
    """The full friction law expanded about sliding at the imposed velocity."""
    return linearised(parameters.friction, parameters.loading)


@lru_cache(maxsize=4096)
def linearised(friction: Friction, loading: Loading) -> InterfaceState:
    """The friction law of a run, expanded about steady sliding at the imposed velocity."""
    f0, a, zeta = friction.expansion(loading.velocity)
    return loaded(InterfaceState(f0, a, zeta, friction.characteristic_slip_distance), loading)


def loaded(interface: InterfaceState, loading: Loading) -> InterfaceState:
    """The interface with the velocity and the normal stress of a loading."""
    return dataclasses.replace(
        interface, velocity=loading.velocity, normal_stress=loading.normal_stress
    )
