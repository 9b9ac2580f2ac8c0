"""Weakening patches in a strengthening fault: simulations beside the theory's width W_c.

A fault that is periodic along x creeps at V under a far shear stress that hardly changes. A patch
narrower than W_c keeps creeping. On a wider one the slip rate oscillates in a limit cycle, or the
patch nucleates an event.
"""

from collections.abc import Iterable, Iterator

import numpy as np
import xarray as xr

from nucleation.datasets.shared import SHARED
from nucleation.datasets.variables import Variable, some, table
from nucleation.model.quantities import ParameterError
from nucleation.run.run import Run
from nucleation.theory.crossings import largest_crossings
from nucleation.theory.evaluation import single_system
from nucleation.theory.weakening_patch import WeakeningPatch, smallest_width

from .curves import CURVES
from .rows import Row

UNSTEADY = 2.0  # largest slip rate over V below which a patch creeps
SEISMIC = 1e4  # largest slip rate over V of slow slip: 0.1 m/s in the study

CREEP = "creep"
SLOW = "slow slip"
EVENT = "event"
THEORY = "theory"  # in place of an outcome, in the rows of the theory's curve

CURVE = np.geomspace(0.05, 5.0, 21)
"""-zeta of the surroundings over zeta of the patch, along the theory's curve."""

COLUMNS = {
    "id": SHARED["id"],
    "outcome": Variable("", "creep, slow slip or event; theory: a point of the curve, no run"),
    **some(SHARED, "height a zeta"),
    "outside_weakening": Variable("1", "velocity weakening of the surroundings", "zeta_out"),
    "zeta_over_a": SHARED["zeta_over_a"],
    "strengthening": Variable("1", "-zeta of the surroundings over zeta of the patch", "r"),
    "width": SHARED["width"],
    "critical_length": CURVES["critical_length"],  # of a fault with the patch's friction
    "smallest_width": Variable("m", "smallest width that nucleates, by theory", "W_c"),
    "width_ratio": Variable("1", "width over the smallest one that nucleates", "W/W_c"),
    "fastest": Variable("1", "largest slip rate over V"),
    "n_x": SHARED["n_x"],
    "period": Variable("1", "period of the fault over the width of the patch"),
}


def patch_of(parameters: Run) -> WeakeningPatch:
    """The patch of a run, with the friction law expanded at V."""
    own = parameters.heterogeneity
    if (own.varies, own.shape) != ("zeta", "step"):
        raise ParameterError(
            f"heterogeneity = {own.varies} with shape = {own.shape} is not "
            "allowed with role = weakening_patches: it must be zeta with a step"
        )
    outside = single_system(parameters.fault)
    inside = outside._replace(zeta=outside.zeta * (1.0 + own.change))
    return WeakeningPatch(inside, outside)


def outcome(fastest: float) -> str:
    """Outcome of a run by its largest slip rate over V: creep, slow slip or an event."""
    if fastest < UNSTEADY:
        return CREEP
    return SLOW if fastest < SEISMIC else EVENT


def weakening_patches_table(runs: Iterable[Row], simulations: Iterable[xr.Dataset]) -> xr.Dataset:
    """Simulated patches beside theory, and the theory's curves."""
    rows: list[Row] = []
    patches: dict[float, WeakeningPatch] = {}
    for run, simulation in zip(runs, simulations, strict=True):
        parameters = Run.from_dict(run["parameters"])
        width = parameters.heterogeneity.width
        patch = patch_of(parameters)
        largest_rate = float(np.abs(simulation["slip_rate"]).max())
        fastest = largest_rate / parameters.fault.velocity
        row = {
            **_of_patch(patch, parameters.fault.height, width),
            "id": run["id"],
            "outcome": outcome(fastest),
            "fastest": fastest,
            "n_x": parameters.block.n_x,
            "period": parameters.block.length / width,
        }
        rows.append(row)
        patches.setdefault(round(row["zeta_over_a"], 6), patch)
    for patch in patches.values():
        rows += _curve(patch, max(row["height"] for row in rows))
    return table(rows, COLUMNS)


def _curve(patch: WeakeningPatch, height: float) -> Iterator[Row]:
    """Rows of the theory's curve for the friction of one patch."""
    empty = {"id": "", "outcome": THEORY, "fastest": np.nan, "n_x": 0, "period": np.nan}
    for strengthening in CURVE:
        zeta = -strengthening * patch.inside.zeta
        outside = patch.outside._replace(zeta=zeta)
        own = WeakeningPatch(patch.inside, outside)
        yield _of_patch(own, height, np.nan) | empty


def _of_patch(patch: WeakeningPatch, height: float, width: float) -> Row:
    """The columns about one patch and its theory."""
    wavenumber = float(largest_crossings(patch.inside)[0])
    critical = 2.0 * np.pi / wavenumber
    smallest = smallest_width(patch, critical)
    a = float(patch.inside.a[0])
    zeta = float(patch.inside.zeta[0])
    outside_zeta = float(patch.outside.zeta[0])
    return {
        "height": height,
        "a": a,
        "zeta": zeta,
        "outside_weakening": outside_zeta,
        "zeta_over_a": zeta / a,
        "strengthening": -outside_zeta / zeta,
        "width": width,
        "critical_length": critical,
        "smallest_width": smallest,
        "width_ratio": width / smallest,
    }
