"""Which runs are made by both solvers, and on which meshes and steps."""

import dataclasses
from typing import Any

from ...model.checked import Checked
from ...model.linearised import InterfaceState
from ...model.parameters import Parameters
from ...model.perturbation import IN_TIME
from ...model.quantities import quantity
from ...model.second_body import SecondBody
from ...theory.critical import run_length

FIXED = {
    "friction.law": "product", "friction.evolution": "aging", "mesh.grading": 1.0,
    "loading.initial_stress": "no_slip", "heterogeneity.varies": "none",
}  # fmt: skip
"""Parameters for which the script has this one value, by full name."""

KINDS = ("none", *IN_TIME)
"""Perturbations that the script has."""

LOADINGS = ("edge", "top")
"""Loadings that the script has."""

TWO_BLOCKS: dict[str, tuple[dict[str, Any], SecondBody]] = {
    "pair": (
        {"geometry.height": 0.02, "mesh.n_x": 300, "mesh.n_y": 6},
        SecondBody(kind="deformable", bottom="clamped", shear_modulus=6.2e9),
    ),
    "top": (  # up to the event: then a corner lifts off; its load has no sharp maximum
        {
            "geometry.height": 0.1, "geometry.length": 1.5, "mesh.n_x": 240, "mesh.n_y": 12,
            "loading.kind": "top", "stepping.longest_step": 0.02, "stepping.time_after_event": 0.0,
        },
        SecondBody(kind="deformable", bottom="clamped"),
    ),
}  # fmt: skip
"""Runs of two blocks, both as high: what else they have than the others, and the lower block."""


@dataclasses.dataclass(frozen=True)
class CrosscheckSettings(Checked):
    """The runs made with the independent solver as well, and its steps in the event."""

    heights: tuple[float, ...] = quantity(
        "block heights of the runs made with both solvers", unit="m", low=0.0, high=1e6,
        symbol="H", default=(0.005, 0.05),
    )  # fmt: skip
    length_over_critical: float = quantity(
        "block length over the theory's critical length", low=1.0, high=1000.0, symbol="L/L_c",
        default=2.0,
    )  # fmt: skip
    perturbation: str = quantity(
        "what is perturbed in the runs of both solvers, in one and the same realisation",
        choices=KINDS, default="normal_load",
    )  # fmt: skip
    strength: float = quantity(
        "relative strength of that perturbation", low=0.0, high=0.1, closed="both", symbol="eps",
        default=1e-4,
    )  # fmt: skip
    seed: int = quantity(
        "seed of that realisation", low=0, high=2**63 - 1, closed="both", default=1
    )
    n_x: int = quantity("number of elements along x of both solvers", low=8, high=100000,
                        closed="both", symbol="N_x", default=400)  # fmt: skip
    n_y: int = quantity("number of elements along y of both solvers", low=2, high=10000,
                        closed="both", symbol="N_y", default=8)  # fmt: skip
    slip_per_step: float = quantity(
        "largest slip within a step of the independent solver over D", low=0.0, high=1.0,
        closed="high", default=0.2,
    )  # fmt: skip
    time_after_event: float = quantity(
        "time simulated by both solvers after the onset of the event", unit="s", low=0.0,
        high=1e12, closed="low", default=0.05,
    )  # fmt: skip


def runs(
    base: Parameters, settings: CrosscheckSettings, interface: InterfaceState
) -> dict[str, Parameters]:
    """The simulations to make with both solvers, by name.

    Parameters
    ----------
    base : material, friction, loading and stepping.
    settings : heights, meshes and time after the event.
    interface : of the linear theory, in whose critical length the block's length is measured.
    """
    base = dataclasses.replace(base, second_body=SecondBody())  # but for the run of two
    declared = {
        "perturbation.kind": settings.perturbation, "perturbation.strength": settings.strength,
        "perturbation.seed": settings.seed,
    }  # fmt: skip
    edge = {"stepping.time_after_event": settings.time_after_event, "loading.kind": "edge"}
    common = base.replaced(FIXED | declared | edge)
    found = {}
    for height in settings.heights:
        mesh = {"mesh.n_x": settings.n_x, "mesh.n_y": settings.n_y}
        block = common.replaced({"geometry.height": height} | mesh)
        found[f"H{height:g}"] = _long(block, settings, interface)
    for name, (changes, below) in TWO_BLOCKS.items():
        both = dataclasses.replace(common, second_body=below).replaced(changes)
        found[name] = both if "geometry.length" in changes else _long(both, settings, interface)
    return found


def _long(run: Parameters, settings: CrosscheckSettings, interface: InterfaceState) -> Parameters:
    """A run whose blocks are as long as the settings say."""
    length = settings.length_over_critical * run_length(run, interface)
    return run.replaced({"geometry.length": float(f"{length:.4g}")})
