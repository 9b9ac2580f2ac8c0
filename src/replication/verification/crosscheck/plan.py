"""The runs that both solvers make, with their meshes and steps."""

import dataclasses
from typing import Any

from nucleation.model.checked import Checked
from nucleation.model.linearised import InterfaceState
from nucleation.model.parameters import Parameters
from nucleation.model.perturbation import IN_TIME
from nucleation.model.quantities import quantity
from nucleation.model.second_body import SecondBody
from nucleation.theory.critical import run_length

FIXED = {
    "friction.law": "product",
    "friction.evolution": "aging",
    "mesh.grading": 1.0,
    "loading.kind": "edge",
    "loading.initial_stress": "no_slip",
    "heterogeneity.varies": "none",
}
"""Parameters for which the script has this one value, by full name."""

KINDS = ("none", *IN_TIME)
"""Perturbations that the script has."""

PAIR = {
    "geometry.height": 0.02,
    "mesh.n_x": 300,
    "mesh.n_y": 6,
}
LOWER_BLOCK = SecondBody(kind="deformable", far_side="clamped", shear_modulus=6.2e9)
"""The run of two blocks of the same height."""


@dataclasses.dataclass(frozen=True)
class CrosscheckSettings(Checked):
    """The runs made with the independent solver as well, and its steps in the event."""

    heights: tuple[float, ...] = quantity(
        "block heights of the runs made with both solvers",
        "(0.0, 1e6) m",
        symbol="H",
        default=(0.005, 0.05),
    )
    length_over_critical: float = quantity(
        "block length over the theory's critical length",
        "(1.0, 1000.0)",
        symbol="L/L_c",
        default=2.0,
    )
    perturbation: str = quantity(
        "kind of the perturbation in the runs of both solvers, with the same realisation",
        choices=KINDS,
        default="normal_load",
    )
    strength: float = quantity(
        "relative strength of that perturbation", "[0.0, 0.1]", symbol="eps", default=1e-4
    )
    seed: int = quantity("seed of that realisation", "[0, 9223372036854775807]", default=1)
    n_x: int = quantity(
        "number of elements along x of both solvers", "[8, 100000]", symbol="N_x", default=400
    )
    n_y: int = quantity(
        "number of elements along y of both solvers", "[2, 10000]", symbol="N_y", default=8
    )
    slip_per_step: float = quantity(
        "largest slip within a step of the independent solver over D", "(0.0, 1.0]", default=0.2
    )
    time_after_event: float = quantity(
        "time simulated by both solvers after the onset of the event", "[0.0, 1e12) s", default=0.05
    )


def runs(
    base: Parameters,
    settings: CrosscheckSettings,
    interface: InterfaceState,
) -> dict[str, Parameters]:
    """List the simulations to make with both solvers.

    Parameters
    ----------
    base : Parameters
        Material, friction, loading and stepping.
    settings : CrosscheckSettings
        Heights, meshes and time after the event.
    interface : InterfaceState
        That of the linear theory. The blocks are a multiple of its critical length long.

    Returns
    -------
    dict of Parameters
        By the names of the runs.
    """
    single = dataclasses.replace(base, second_body=SecondBody())
    common = single.replaced(FIXED | _common(settings))
    found = {}
    for height in settings.heights:
        changes = {
            "geometry.height": height,
            "mesh.n_x": settings.n_x,
            "mesh.n_y": settings.n_y,
        }
        block = common.replaced(changes)
        found[f"H{height:g}"] = _long(block, settings, interface)
    both = dataclasses.replace(common, second_body=LOWER_BLOCK).replaced(PAIR)
    return found | {"pair": _long(both, settings, interface)}


def _common(settings: CrosscheckSettings) -> dict[str, Any]:
    """Parameters of all runs of one block, by full name."""
    return {
        "perturbation.kind": settings.perturbation,
        "perturbation.strength": settings.strength,
        "perturbation.seed": settings.seed,
        "stepping.time_after_event": settings.time_after_event,
    }


def _long(run: Parameters, settings: CrosscheckSettings, interface: InterfaceState) -> Parameters:
    """A run with blocks of the length that the settings prescribe."""
    length = settings.length_over_critical * run_length(run, interface)
    return run.replaced({"geometry.length": float(f"{length:.4g}")})
