"""Simulated drops beside what the law says of them, one row for each run.

The law is of the theory's patches (:mod:`.mode_history`). A quiet run drops where mesh, steps and
round-off let it. Its row has the strength at which a fluctuating load, or state, would make the
law's median drop there: the noise of that mesh with those steps, in the units of a declared
perturbation.
"""

import contextlib
import dataclasses
from collections.abc import Callable, Iterable
from functools import cache
from typing import Any

import numpy as np
import xarray as xr

from ..analysis.lengths import COLUMNS as LENGTHS
from ..analysis.rows import Row, rows_of
from ..datasets.variables import Variable, some, table
from ..model.identity import fault
from ..model.parameters import Parameters
from ..model.perturbation import Perturbation
from ..theory.creep.lengths import NoPatch
from .delay import Growth, growth
from .growth import FITTED
from .mode_history import ModeHistory, mode_history

MEASURED = some(
    LENGTHS, "study", "role", "id", "evolution", "height", "kind", "strength", "seed",
    "correlation_length", "n_x", "n_y", "block_length", "longest_step", "onset_time", "length",
    "theory_length",
)  # fmt: skip

PREDICTED = {
    "stability_length": FITTED["stability_length"],
    "predicted_length": Variable("m", "length at the drop by the law, median", "L"),
    "predicted_low": Variable("m", "length by which 16 % have dropped by the law", "L"),
    "predicted_high": Variable("m", "length by which 84 % have dropped by the law", "L"),
    "closed_form_length": Variable("m", "length at the drop by the law in one line", "L"),
    "effective_strength": Variable("1", "strength in the law's one line", "eps_eff"),
    "floor_normal_load": Variable("1", "strength of the load at which the law drops there"),
    "floor_state": Variable("1", "strength of the state at which the law drops there"),
}

COLUMNS = {**MEASURED, **PREDICTED, "fault": LENGTHS["fault"]}

FLOORS = some(
    COLUMNS, "study", "role", "id", "evolution", "height", "n_x", "n_y", "longest_step",
    "onset_time", "length", "theory_length", "stability_length", "floor_normal_load",
    "floor_state", "fault",
)  # fmt: skip
"""Columns that say something of a quiet run."""


def law_of(history: ModeHistory) -> Callable[[Row], Row]:
    """The law of the drop for one fault, from the mode along its creep.

    It gives the columns :data:`PREDICTED` for one run; NaN where there is nothing to say.
    """

    @cache
    def known(kind: str, length: float) -> Growth:
        usual = Perturbation(kind=kind)
        declared = dataclasses.replace(usual, correlation_length=length) if length else usual
        return growth(history, declared)

    def row_of(run: Row) -> Row:
        row = dict.fromkeys(PREDICTED, float("nan"))
        if run["kind"] == "none":
            closed = known("normal_load", 0.0).closed_form(history, 1e-5)
            row["stability_length"] = closed.front_length
            for kind in ("normal_load", "state"):
                row[f"floor_{kind}"] = known(kind, 0.0).strength_at(run["length"])
            return row
        kind, strength, scale = run["kind"], run["strength"], run["correlation_length"]
        law = known(kind, scale)
        drop, closed = law.drop(strength), law.closed_form(history, strength)
        return row | {
            "stability_length": closed.front_length,
            "predicted_length": drop.length,
            "predicted_low": drop.low,
            "predicted_high": drop.high,
            "closed_form_length": closed.length,
            "effective_strength": closed.effective,
        }

    return row_of


def gather(
    drops: Iterable[xr.Dataset], runs: Iterable[dict[str, Any]], quiet: Iterable[xr.Dataset] = ()
) -> xr.Dataset:
    """:data:`COLUMNS` on ``run``, for all runs of the faults that some `runs` have.

    `drops` and `quiet` are tables with :data:`MEASURED` and ``fault``. Faults whose patches no
    theory follows are left out.
    """
    laws = {}
    for run in runs:
        parameters = Parameters.from_dict(run["parameters"])
        with contextlib.suppress(NoPatch):
            laws[fault(parameters)] = law_of(mode_history(parameters, run["theory_length"]))
    rows = [row for own in (*drops, *quiet) for row in rows_of(own, names=(*MEASURED, "fault"))]
    return table([row | laws[row["fault"]](row) for row in rows if row["fault"] in laws], COLUMNS)


def floors(quiet: Iterable[xr.Dataset], runs: Iterable[dict[str, Any]]) -> xr.Dataset:
    """:data:`FLOORS` on ``run``: how noisy the meshes of quiet runs are with their steps."""
    found = gather(quiet, runs)
    return found[list(FLOORS)].isel(run=np.flatnonzero(found["kind"].values == "none"))
