"""Simulated drops beside what the law says of them, one row for each run.

A quiet run drops where mesh, steps and round-off let it. Its row has the strength at which a
fluctuating load, or state, would make the law's median drop there: the noise of that mesh with
those steps, in the units of a declared perturbation.
"""

from collections.abc import Callable, Iterable
from functools import cache

import numpy as np
import xarray as xr

from ..analysis.lengths import COLUMNS as LENGTHS
from ..analysis.record import parameters_of
from ..analysis.rows import Row, rows_of
from ..datasets.variables import Variable, some, table
from ..model.identity import fault
from ..model.perturbation import Perturbation
from .delay import Growth, growth, realised
from .growth import FITTED
from .mode_history import ModeHistory, from_dataset

MEASURED = some(
    LENGTHS, "study", "role", "id", "evolution", "height", "kind", "strength", "seed",
    "correlation_length", "n_x", "n_y", "block_length", "longest_step", "onset_time", "length",
    "theory_length",
)  # fmt: skip

PREDICTED = {
    "stability_length": FITTED["stability_length"],
    "predicted_length": Variable("m", "length at the drop by the law, median", "L_d"),
    "predicted_low": Variable("m", "length by which 16 % have dropped by the law", "L_d"),
    "predicted_high": Variable("m", "length by which 84 % have dropped by the law", "L_d"),
    "realised_length": Variable("m", "length at the drop by the law for its own seed", "L_d"),
    "closed_form_length": Variable("m", "length at the drop by the law in one line", "L_d"),
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
    """The law of the drop for one fault, from the mode of its quiet run.

    It gives the columns :data:`PREDICTED` for one run; NaN where there is nothing to say.
    """
    usual = history.parameters.perturbation

    @cache
    def known(kind: str, length: float) -> Growth:
        scale, time = length or usual.correlation_length, usual.correlation_time
        declared = Perturbation(kind=kind, correlation_time=time, correlation_length=scale)
        return growth(history, declared)

    def row_of(run: Row) -> Row:
        row = dict.fromkeys(PREDICTED, float("nan"))
        if run["kind"] == "none":
            closed = known("normal_load", 0.0).closed_form(history, 1e-5)
            row["stability_length"] = closed.stability_length
            for kind in ("normal_load", "state"):
                row[f"floor_{kind}"] = known(kind, 0.0).strength_at(run["length"])
            return row
        kind, strength, scale = run["kind"], run["strength"], run["correlation_length"]
        law = known(kind, scale)
        drop, closed = law.drop(strength), law.closed_form(history, strength)
        declared = Perturbation(kind=kind, correlation_length=scale, seed=int(run["seed"]))
        own, _ = realised(history, declared).at(1.0 / strength)
        return row | {
            "stability_length": closed.stability_length,
            "predicted_length": drop.length,
            "predicted_low": drop.low,
            "predicted_high": drop.high,
            "realised_length": own,
            "closed_form_length": closed.length,
            "effective_strength": closed.effective,
        }

    return row_of


def gather(
    drops: Iterable[xr.Dataset], modes: Iterable[xr.Dataset], quiet: Iterable[xr.Dataset] = ()
) -> xr.Dataset:
    """:data:`COLUMNS` on ``run``, for the runs of faults whose mode is known.

    `drops` and `quiet` are tables with :data:`MEASURED` and ``fault``, `modes` histories as
    datasets.
    """
    laws = {fault(parameters_of(mode)): law_of(from_dataset(mode)) for mode in modes}
    runs = [run for own in (*drops, *quiet) for run in rows_of(own, names=(*MEASURED, "fault"))]
    return table([run | laws[run["fault"]](run) for run in runs if run["fault"] in laws], COLUMNS)


def floors(quiet: Iterable[xr.Dataset], modes: Iterable[xr.Dataset]) -> xr.Dataset:
    """:data:`FLOORS` on ``run``: how noisy the meshes of quiet runs are with their steps."""
    found = gather(quiet, modes)
    return found[list(FLOORS)].isel(run=np.flatnonzero(found["kind"].values == "none"))
