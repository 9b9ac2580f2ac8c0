"""The static field at the start of a simulation, and the rate of a far stress that rises."""

import dataclasses

from .checked import Checked
from .quantities import quantity


@dataclasses.dataclass(frozen=True)
class Start(Checked):
    """The stress at the start, and the rate of a remote load."""

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
    stress_rate: float = quantity(
        "rate at which the far shear stress rises, with loading remote",
        "[0.0, 1e15) Pa/s",
        symbol="dtau/dt",
        default=0.0,
    )
