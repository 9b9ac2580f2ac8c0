"""Which runs are made by both solvers, and on which meshes and steps."""

import dataclasses

from ...model.checked import Checked
from ...model.linearised import InterfaceState
from ...model.parameters import Parameters
from ...model.perturbation import IN_TIME
from ...model.quantities import quantity
from ...model.second_body import BOTTOMS, SecondBody
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

PAIR = "pair"  # name of the run of two blocks
TOP = "top"  # name of the run of two blocks that is loaded at its top


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
    pair_height: float = quantity(
        "height of both blocks of the run of two", unit="m", low=0.0, high=1e6, default=0.02
    )
    pair_shear_modulus: float = quantity(
        "shear modulus of the lower block of that run", unit="Pa", low=0.0, high=1e13,
        default=6.2e9,
    )  # fmt: skip
    pair_bottom: str = quantity(
        "far side of the lower block of that run", choices=BOTTOMS, default="clamped"
    )
    pair_n_x: int = quantity("number of elements along x in that run", low=8, high=100000,
                             closed="both", default=300)  # fmt: skip
    pair_n_y: int = quantity("number of elements along y in either block of that run", low=2,
                             high=10000, closed="both", default=6)  # fmt: skip
    top_height: float = quantity(
        "height of both blocks of the run that is loaded at its top", unit="m", low=0.0, high=1e6,
        default=0.1,
    )  # fmt: skip
    top_length: float = quantity("length of those blocks", unit="m", low=0.0, high=1e9, default=1.5)
    top_n_x: int = quantity("number of elements along x in that run, an even number", low=8,
                            high=100000, closed="both", default=240)  # fmt: skip
    top_n_y: int = quantity("number of elements along y in either block of that run", low=2,
                            high=10000, closed="both", default=12)  # fmt: skip
    top_longest_step: float = quantity(
        "longest time step of both solvers in that run over the memory time D/V, as its load has "
        "no sharp maximum", low=0.0, high=1.0, closed="high", default=0.02,
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
    found[PAIR] = _pair(common, settings, interface)
    found[TOP] = _top(common, settings)
    return found


def _pair(
    common: Parameters, settings: CrosscheckSettings, interface: InterfaceState
) -> Parameters:
    """Two blocks of one height and different stiffness."""
    below = SecondBody(
        kind="deformable", bottom=settings.pair_bottom, shear_modulus=settings.pair_shear_modulus
    )
    mesh = {"mesh.n_x": settings.pair_n_x, "mesh.n_y": settings.pair_n_y}
    both = dataclasses.replace(common, second_body=below).replaced(
        mesh | {"geometry.height": settings.pair_height}
    )
    return _long(both, settings, interface)


def _top(common: Parameters, settings: CrosscheckSettings) -> Parameters:
    """Two blocks that are alike, up to the event: then a corner lifts off."""
    below = SecondBody(kind="deformable", bottom="clamped")
    changes = {
        "geometry.height": settings.top_height, "geometry.length": settings.top_length,
        "mesh.n_x": settings.top_n_x, "mesh.n_y": settings.top_n_y, "loading.kind": "top",
        "stepping.longest_step": settings.top_longest_step, "stepping.time_after_event": 0.0,
    }  # fmt: skip
    return dataclasses.replace(common, second_body=below).replaced(changes)


def _long(run: Parameters, settings: CrosscheckSettings, interface: InterfaceState) -> Parameters:
    """A run whose blocks are as long as the settings say."""
    length = settings.length_over_critical * run_length(run, interface)
    return run.replaced({"geometry.length": float(f"{length:.4g}")})
