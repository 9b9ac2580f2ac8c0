"""What loads a fault, and how its interface starts (docs/loading.md).

A kind of loading says what is imposed and where, what is measured as the load, and where a patch
begins and ends. What follows from it stands where it acts: the body in
:mod:`nucleation.fem.bodies`, the drive in :mod:`nucleation.simulation.drive`, the patch in
:mod:`nucleation.analysis.definitions`, the far side of the theory in
:func:`nucleation.theory.transfer.bodies_of`.
"""

import dataclasses

from .checked import Checked
from .quantities import ParameterError, quantity

LOADINGS = ("edge", "top", "remote")
"""Kinds of loading: docs/loading.md."""


@dataclasses.dataclass(frozen=True)
class Loading(Checked):
    """The external loading and the initial state of the interface.

    Raises
    ------
    ParameterError
        Also if the shear stress rises with a loading that moves an edge, or not with a remote one.
    """

    normal_stress: float = quantity(
        "applied compressive normal stress",
        unit="Pa", low=0.0, high=1e10, symbol="sigma0", default=1.0e6,
    )  # fmt: skip
    velocity: float = quantity(
        "imposed velocity of the edge or the top that moves; with kind remote none does, and slip "
        "rates count in it", unit="m/s", low=0.0, high=1.0, symbol="V",
        default=1.0e-5,
    )  # fmt: skip
    initial_state: float = quantity(
        "initial state variable (age) of the interface", unit="s", low=0.0, high=1e12,
        symbol="phi0", default=1.0,
    )  # fmt: skip
    initial_stress: str = quantity(
        "static field at the start: that of an interface that has not slipped, or of one that has "
        "slipped to the uniform shear stress initial_shear_stress",
        choices=("no_slip", "uniform_shear"), default="no_slip",
    )  # fmt: skip
    initial_shear_stress: float = quantity(
        "shear stress at the interface at the start, if initial_stress is uniform_shear",
        unit="Pa", low=0.0, high=1e10, closed="low", symbol="tau0", default=0.0,
    )  # fmt: skip
    kind: str = quantity(
        "what loads the fault: edge, the left edge moves; top, the top moves and the side edges "
        "are free; remote, a far shear stress rises on a fault that is periodic along x",
        choices=LOADINGS, default="edge",
    )  # fmt: skip
    stress_rate: float = quantity(
        "rate at which the far shear stress rises, with kind remote",
        unit="Pa/s", low=0.0, high=1e15, closed="low", symbol="dtau/dt", default=0.0,
    )  # fmt: skip

    def __post_init__(self) -> None:
        super().__post_init__()
        if (self.kind == "remote") != (self.stress_rate > 0.0):
            rule = "more than 0" if self.kind == "remote" else "0"
            raise ParameterError(
                f"loading.stress_rate = {self.stress_rate:g} Pa/s is not allowed with loading.kind "
                f"= {self.kind}: it must be {rule} Pa/s"
            )
