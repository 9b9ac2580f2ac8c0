"""Settings beside the simulations' parameters: what is measured, drawn and allowed."""

import dataclasses

from ..model.checked import Checked
from ..model.parameters import Parameters
from ..model.quantities import quantity


@dataclasses.dataclass(frozen=True)
class FigureSettings(Checked):
    """Which simulations with the role ``paper`` the figures show."""

    inset_height: float = quantity(
        "height of the simulation in the inset of Figure 3", unit="m", low=0.0, high=1e6,
        symbol="H", default=0.1,
    )  # fmt: skip
    space_time_height: float = quantity(
        "height of the simulation in Figure S2", unit="m", low=0.0, high=1e6, symbol="H",
        default=0.005,
    )  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Limits(Checked):
    """What one simulation may use; larger ones are refused before they start."""

    memory: float = quantity(
        "memory of one simulation", unit="MB", low=100.0, high=1e7, default=2000.0
    )
    runtime: float = quantity(
        "time after which a cluster may end a simulation", unit="min", low=1.0, high=1e5,
        closed="both", default=60.0,
    )  # fmt: skip


def estimated_megabytes(parameters: Parameters) -> float:
    """Memory (MB) that a simulation needs, rounded up from measured runs.

    Libraries, some hundred vectors of the bodies (mostly the factors kept for step sizes in use)
    and some dense matrices of the interface: two in each factor if the top is moved.
    """
    mesh, below = parameters.mesh, parameters.below
    vector = 8e-6 * 2 * mesh.n_x * (mesh.n_y + (below.mesh.n_y if below else 0))
    matrix = 8e-6 * mesh.n_x**2
    matrices = 32.0 if parameters.loading.kind == "top" else 8.0
    return 250.0 + 400.0 * vector + matrices * matrix
