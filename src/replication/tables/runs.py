"""Measured lengths of the runs of one job, which runs them one after another: a table of rows."""

import sys
from collections.abc import Callable, Iterable, Sequence
from typing import Any, Protocol

import xarray as xr

from nucleation.datasets.variables import some
from nucleation.extraction.definitions import ExtractionSettings
from nucleation.extraction.growth import FITTED, follow_patch

from . import lengths
from .rows import Row

STABILITY = some(FITTED, "stability_length stability_length_error")
"""The length at which the patch turns unstable, and its standard error."""


class _Records(Protocol):
    """The records of some runs, one after another."""

    def map(self, function: Callable[[int, xr.Dataset], xr.Dataset]) -> list[xr.Dataset]:
        """The results of a function of the number and the record of each run that has one."""


def measured_runs(
    runs: Sequence[Row], records: _Records, settings: ExtractionSettings, measure: str
) -> xr.Dataset:
    """The rows of a batch's runs, without those that have no record."""
    rows = records.map(
        lambda i, record: _measured(
            runs[i],
            record,
            settings,
            measure,
        )
    )
    return lengths.join(rows) if rows else xr.Dataset()  # an empty one is not kept


def _measured(
    run: Row, record: xr.Dataset, settings: ExtractionSettings, measure: str
) -> xr.Dataset:
    """The row of one run, which is also printed in the job's log."""
    row = lengths.lengths_table([run], [record], settings)
    if measure == "stability":
        patch = follow_patch(record, settings)
        for name, column in STABILITY.items():
            row[name] = ("run", patch[name].values[None], column.attributes)
    onset, length, steps, seconds = (
        row[name].values[0] for name in ("onset_time", "length", "steps", "wall_seconds")
    )
    print(
        f"{run['id']}: onset {onset:.4f} s, length {length:.5g} m, "
        f"{steps} steps in {seconds:.1f} s",
        file=sys.stderr,
    )
    return row


def study_table(tables: Iterable[xr.Dataset], ids: Sequence[str]) -> dict[str, Any]:
    """The table of a study that was run in several batches, as files."""
    joined = lengths.join(tables)
    places = {name: i for i, name in enumerate(joined["id"].values.tolist())}
    return lengths.files(joined.isel(run=[places[name] for name in ids]))
