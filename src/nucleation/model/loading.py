"""The loading of a fault, and the initial state of its interface (docs/loadings.md).

The kind of loading determines the boundary conditions, the measured load and the ends of a patch.
Each consequence is implemented in its own wing: the body in :mod:`nucleation.fem.body`, the
drive in :mod:`nucleation.simulation.drive`, the patch in :mod:`nucleation.simulation.patch`,
the far side of the theory in :func:`nucleation.theory.of_runs.far_sides`.
"""

import dataclasses

from .checked import Checked
from .quantities import ParameterError, quantity

LOADINGS = ("edge", "remote")
"""Kinds of loading: docs/loadings.md."""


@dataclasses.dataclass(frozen=True)
class Loading(Checked):
    """The external loading and the initial state of the interface.

    Raises
    ------
    ParameterError
        Also if the kind is remote and the stress rate is zero, or the kind is another one and the
        stress rate is not zero.

    Examples
    --------
    >>> Loading(velocity=1e-6).velocity
    1e-06
    """

    normal_stress: float = quantity(
        "applied compressive normal stress", "(0.0, 1e10) Pa", symbol="sigma0", default=1.0e6
    )
    velocity: float = quantity(
        "imposed velocity of the edge; with kind remote, where no edge moves, the unit of slip "
        "rates",
        "(0.0, 1.0) m/s",
        symbol="V",
        default=1.0e-5,
    )
    initial_state: float = quantity(
        "initial state variable (age) of the interface", "(0.0, 1e12) s", symbol="phi0", default=1.0
    )
    initial_stress: str = quantity(
        "initial static field: of an interface without slip, or of one that has slipped to the "
        "uniform shear stress initial_shear_stress",
        choices=("no_slip", "uniform_shear"),
        default="no_slip",
    )
    initial_shear_stress: float = quantity(
        "initial shear stress at the interface, if initial_stress is uniform_shear",
        "[0.0, 1e10) Pa",
        symbol="tau0",
        default=0.0,
    )
    kind: str = quantity(
        "kind of loading: edge, the left edge moves; remote, a far shear stress rises on a fault "
        "that is periodic along x",
        choices=LOADINGS,
        default="edge",
    )
    stress_rate: float = quantity(
        "rate at which the far shear stress rises, with kind remote",
        "[0.0, 1e15) Pa/s",
        symbol="dtau/dt",
        default=0.0,
    )

    def __post_init__(self) -> None:
        super().__post_init__()
        remote = self.kind == "remote"
        if remote != (self.stress_rate > 0.0):
            rule = "more than 0" if remote else "0"
            raise ParameterError(
                f"loading.stress_rate = {self.stress_rate:g} Pa/s is not allowed with loading.kind "
                f"= {self.kind}: it must be {rule} Pa/s"
            )
