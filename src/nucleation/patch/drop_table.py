"""Simulated drops beside what the law says of them, one row for each run.

A quiet run drops where mesh, steps and round-off let it. Its row has the strength at which a
fluctuating load, or state, would make the law's median drop there: the noise of that mesh with
those steps, in the units of a declared perturbation.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from functools import cache
from typing import Any

import numpy as np
import xarray as xr

from ..analysis.lengths import Files, with_csv
from ..analysis.record import parameters_of
from ..analysis.rows import Row, rows_of
from ..model.perturbation import Perturbation
from .delay import Growth, growth, realised
from .mode_history import ModeHistory, from_dataset

MEASURED = (
    "study", "role", "id", "law", "height", "kind", "strength", "seed", "correlation_length", "n_x",
    "n_y", "longest_step", "onset_time", "length", "theory_length",
)  # fmt: skip

PREDICTED = (
    "stability_length", "predicted_length", "predicted_low", "predicted_high", "realised_length",
    "closed_form_length", "effective_strength", "floor_normal_load", "floor_state",
)  # fmt: skip

COLUMNS = (*MEASURED, *PREDICTED)

FLOORS = (
    "study", "role", "id", "law", "height", "n_x", "n_y", "longest_step", "onset_time", "length",
    "theory_length", "stability_length", "floor_normal_load", "floor_state",
)  # fmt: skip
"""Columns that say something of a quiet run."""


class Law:
    """The law of the drop for one fault, from the mode of its quiet run."""

    def __init__(self, history: ModeHistory) -> None:
        self._history = history
        self._growth = cache(self._uncached)

    def _uncached(self, kind: str, correlation_length: float) -> Growth:
        usual = self._history.parameters.perturbation
        length = correlation_length or usual.correlation_length
        declared = Perturbation(
            kind=kind, correlation_time=usual.correlation_time, correlation_length=length
        )
        return growth(self._history, declared)

    def row(self, run: Row) -> Row:
        """The columns :data:`PREDICTED` for one run; NaN where there is nothing to say."""
        row = dict.fromkeys(PREDICTED, float("nan"))
        if run["kind"] == "none":
            row["stability_length"] = self._closed("normal_load", 0.0, 1e-5).stability_length
            for kind in ("normal_load", "state"):
                found = self._growth(kind, 0.0).strength_at(run["length"])
                row[f"floor_{kind}"] = found
            return row
        kind, strength, scale = run["kind"], run["strength"], run["correlation_length"]
        drop, closed = self._growth(kind, scale).drop(strength), self._closed(kind, scale, strength)
        declared = Perturbation(kind=kind, correlation_length=scale, seed=int(run["seed"]))
        own, _ = realised(self._history, declared).at(1.0 / strength)
        return row | {
            "stability_length": closed.stability_length,
            "predicted_length": drop.length,
            "predicted_low": drop.low,
            "predicted_high": drop.high,
            "realised_length": own,
            "closed_form_length": closed.length,
            "effective_strength": closed.effective,
        }

    def _closed(self, kind: str, scale: float, strength: float) -> Any:
        return self._growth(kind, scale).closed_form(self._history, strength)


def gather(drops: Iterable[xr.Dataset], modes: Iterable[xr.Dataset]) -> xr.Dataset:
    """:data:`COLUMNS` on ``run``, for the runs of faults whose mode is known.

    Parameters
    ----------
    drops : tables of runs with at least :data:`MEASURED`, and ``phi0`` (s).
    modes : of :func:`nucleation.patch.mode_history.to_dataset`.
    """
    laws = {_fault(parameters_of(mode)): Law(from_dataset(mode)) for mode in modes}
    rows = [
        {name: run[name] for name in MEASURED} | laws[fault].row(run)
        for run in _runs(drops)
        if (fault := (run["law"], run["height"], run["phi0"])) in laws
    ]
    return xr.Dataset({name: ("run", np.array([row[name] for row in rows])) for name in COLUMNS})


def floors(quiet: Iterable[xr.Dataset], modes: Iterable[xr.Dataset]) -> xr.Dataset:
    """:data:`FLOORS` on ``run``: how noisy the meshes of quiet runs are with their steps.

    Parameters
    ----------
    quiet : tables of lengths, of which the unperturbed runs count.
    modes : of :func:`nucleation.patch.mode_history.to_dataset`.
    """
    table = gather(quiet, modes)
    return table[list(FLOORS)].isel(run=np.flatnonzero(table["kind"].values == "none"))


def _fault(parameters: Any) -> tuple[str, float, float]:
    loading, geometry = parameters.loading, parameters.geometry
    return parameters.friction.evolution, geometry.height, loading.initial_state


def _runs(tables: Iterable[xr.Dataset]) -> Iterator[Row]:
    for table in tables:
        names = [name for name in (*MEASURED, "phi0") if name in table]
        for row in rows_of(table, names=names):
            yield {"correlation_length": float("nan")} | row


def table(
    drops: Iterable[xr.Dataset], quiet: Iterable[xr.Dataset], modes: Iterable[xr.Dataset]
) -> Files:
    """The step ``drop``: :func:`gather` with its CSV."""
    return with_csv(gather([*drops, *quiet], modes), COLUMNS)


def floors_table(quiet: Iterable[xr.Dataset], modes: Iterable[xr.Dataset]) -> Files:
    """The step ``noise``: :func:`floors` with its CSV."""
    return with_csv(floors(quiet, modes), FLOORS)
