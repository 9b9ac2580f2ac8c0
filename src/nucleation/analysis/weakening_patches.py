"""Patches that weaken among surroundings that strengthen: simulations beside the theory's W_c.

A fault that is periodic along x creeps at V under a far shear stress that is constant, as good as.
A patch narrower than W_c goes on to creep; on a wider one slip slows and quickens in a limit cycle,
or it ends in an event.
"""

from collections.abc import Iterable, Iterator
from typing import Any

import numpy as np
import xarray as xr

from ..datasets.shared import SHARED
from ..datasets.variables import Variable, some, table
from ..model.linearised import linearised
from ..model.parameters import Parameters
from ..model.quantities import ParameterError
from ..theory.critical import systems_of
from ..theory.crossings import largest_crossings
from ..theory.transfer import bodies_of
from ..theory.weakening_patch import WeakeningPatch, smallest_width
from .rows import Row

UNSTEADY = 2.0  # largest slip rate over V below which a patch creeps
SEISMIC = 1e4  # likewise, below which its slip is slow: 0.1 m/s in the study

CREEP, SLOW, EVENT, THEORY = "creep", "slow slip", "event", "theory"
"""Outcomes of a run; the last one marks rows without a run, for the theory's curve."""

CURVE = np.geomspace(0.05, 5.0, 21)
"""The -zeta of the surroundings over zeta of the patch, of the theory's curve."""

COLUMNS = {
    "id": SHARED["id"],
    "outcome": Variable("", "creep, slow slip or event; theory: a point of the curve, no run"),
    **some(SHARED, "height", "direct_effect", "velocity_weakening"),
    "outside_weakening": Variable("1", "velocity weakening of the surroundings", "zeta_out"),
    "zeta_over_a": SHARED["zeta_over_a"],
    "strengthening": Variable("1", "-zeta of the surroundings over zeta of the patch", "r"),
    "width": Variable("m", "width of the patch", "W"),
    "critical_length": Variable("m", "critical length of a fault that is all patch", "L_c"),
    "smallest_width": Variable("m", "smallest width that nucleates, by theory", "W_c"),
    "width_ratio": Variable("1", "width over the smallest one that nucleates", "W/W_c"),
    "fastest": Variable("1", "largest slip rate over V"),
    "n_x": SHARED["n_x"],
    "period": Variable("1", "period of the fault over the width of the patch"),
}


def patch_of(parameters: Parameters) -> WeakeningPatch:
    """The patch of a run, with the friction law expanded at V.

    Raises
    ------
    ParameterError
        If another property than zeta varies along the interface, or not by a step.
    """
    own = parameters.heterogeneity
    if (own.varies, own.shape) != ("zeta", "step"):
        raise ParameterError(
            f"heterogeneity.varies = {own.varies} with heterogeneity.shape = {own.shape} is not "
            "allowed with role = weakening_patches: it must be zeta with a step"
        )
    interface = linearised(parameters.friction, parameters.loading)
    outside = systems_of([(*bodies_of(parameters), interface)])
    return WeakeningPatch(outside._replace(zeta=outside.zeta * (1.0 + own.change)), outside)


def outcome(fastest: float) -> str:
    """Whether a patch with a largest slip rate over V creeps, slips slowly or has an event."""
    if fastest < UNSTEADY:
        return CREEP
    return SLOW if fastest < SEISMIC else EVENT


def gather(runs: Iterable[dict[str, Any]], simulations: Iterable[xr.Dataset]) -> xr.Dataset:
    """:data:`COLUMNS` on ``run``: one row for each run, then those of the theory's curves.

    Parameters
    ----------
    runs : iterable of dict
        From :meth:`nucleation.configuration.runs.Run.to_dict`.
    simulations : iterable of Dataset
        Theirs, in the same order.
    """
    rows: list[Row] = []
    patches: dict[float, WeakeningPatch] = {}
    for run, simulation in zip(runs, simulations, strict=True):
        parameters = Parameters.from_dict(run["parameters"])
        patch = patch_of(parameters)
        fastest = float(np.abs(simulation["slip_rate"]).max()) / parameters.loading.velocity
        row = _of_patch(patch, parameters.geometry.height, parameters.heterogeneity.width)
        row |= {
            "id": run["id"],
            "outcome": outcome(fastest),
            "fastest": fastest,
            "n_x": parameters.mesh.n_x,
            "period": parameters.geometry.length / parameters.heterogeneity.width,
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
        around = patch.outside._replace(zeta=-strengthening * patch.inside.zeta)
        own = WeakeningPatch(patch.inside, around)
        yield _of_patch(own, height, np.nan) | empty


def _of_patch(patch: WeakeningPatch, height: float, width: float) -> Row:
    """The columns about one patch and its theory."""
    critical = 2.0 * np.pi / float(largest_crossings(patch.inside)[0])
    smallest = smallest_width(patch, critical)
    a, zeta, around = (float(x[0]) for x in (*patch.inside[2:4], patch.outside.zeta))
    return {
        "height": height,
        "direct_effect": a,
        "velocity_weakening": zeta,
        "outside_weakening": around,
        "zeta_over_a": zeta / a,
        "strengthening": -around / zeta,
        "width": width,
        "critical_length": critical,
        "smallest_width": smallest,
        "width_ratio": width / smallest,
    }
