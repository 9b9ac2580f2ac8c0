"""The table of a batch: the lengths of its simulations, measured as they finish."""

from collections.abc import Sequence
from typing import Any

import xarray as xr

from nucleation.extraction.definitions import ExtractionSettings
from nucleation.extraction.growth import follow_patch

from .lengths import join, lengths_table
from .rows import Row


def measured_runs(
    runs: Sequence[Row], records: Any, settings: ExtractionSettings, measure: str
) -> xr.Dataset:
    """The rows of a job's runs; without those that have no record.

    `records` has the results of a function of the number and the record of each run.
    """

    def measured(i: int, record: xr.Dataset) -> xr.Dataset:
        row = lengths_table([runs[i]], [record], settings)
        if measure == "stability":
            found = follow_patch(record, settings)["stability_length"]
            row["stability_length"] = ("run", found.values[None], found.attrs)
        return row

    rows = records(measured)
    return join(rows) if rows else xr.Dataset()  # an empty one is not kept
