"""What is measured of runs that one job makes after another: their rows of a table."""

import sys
from collections.abc import Iterable, Sequence
from typing import Any

import xarray as xr

from ..analysis import lengths
from ..analysis.definitions import ExtractionSettings
from ..datasets.variables import some
from .growth import FITTED, follow_patch

STABILITY = some(FITTED, "stability_length", "stability_length_error")
"""The length at which the patch turns unstable, and its standard error."""


def measured(
    run: dict[str, Any], record: xr.Dataset, settings: ExtractionSettings, measure: str
) -> xr.Dataset:
    """The row of a run and its record: :data:`nucleation.analysis.lengths.COLUMNS`, on ``run``.

    If the measure is ``stability`` and not ``lengths``, :data:`STABILITY` stands beside them.
    """
    row = lengths.lengths_table([run], [record], settings)
    if measure == "stability":
        patch = follow_patch(record, settings)
        row = row.assign({name: ("run", patch[name].values[None], c.attributes)
                          for name, c in STABILITY.items()})  # fmt: skip
    said = {name: row[name].values[0] for name in ("onset_time", "length", "steps", "wall_seconds")}
    print(
        "{id}: onset {onset_time:.4f} s, length {length:.5g} m, {steps} steps in "
        "{wall_seconds:.1f} s".format(id=run["id"], **said),
        file=sys.stderr,
    )
    return row


def table(
    runs: Sequence[dict[str, Any]], records: Any, settings: ExtractionSettings, measure: str
) -> xr.Dataset:
    """The rows of a batch's runs, without those that have no record.

    Parameters
    ----------
    runs : from :meth:`nucleation.configuration.runs.Run.to_dict`.
    records : their records; ``map`` calls a function on the number and the record of each.
    settings : how lengths are read.
    measure : ``lengths`` or ``stability``, as of :func:`measured`.
    """
    rows = records.map(lambda i, record: measured(runs[i], record, settings, measure))
    return lengths.join(rows) if rows else xr.Dataset()  # which is not kept


def of_study(tables: Iterable[xr.Dataset], ids: Sequence[str]) -> xr.Dataset:
    """A study's table, its runs in their order."""
    joined = lengths.join(tables)
    places = {name: i for i, name in enumerate(joined["id"].values.tolist())}
    return joined.isel(run=[places[name] for name in ids])
