"""Rows of tables, and why a run has no length."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

from nucleation.simulation.event import NEAR

if TYPE_CHECKING:
    import xarray as xr

Row = dict[str, Any]
"""A row of a table: values by column."""

NEARLY = 0.98
"""Part of the searched half of the block at which the patch counts as having filled it."""


def rows_of(table: xr.Dataset) -> list[Row]:
    """Rows of a table as dictionaries of plain Python values."""
    columns = {str(name): column.values.tolist() for name, column in table.data_vars.items()}
    rows = zip(*columns.values(), strict=True)
    return [dict(zip(columns, row, strict=True)) for row in rows]


def groups(table: xr.Dataset, *names: str) -> list[list[int]]:
    """The rows that agree in some columns, group by group, in the order of the table."""
    columns = [table[name].values.tolist() for name in names]
    rows: dict[Any, list[int]] = {}
    for i, key in enumerate(zip(*columns, strict=True)):
        rows.setdefault(key, []).append(i)
    return list(rows.values())


def without_event(rows: Iterable[Row]) -> list[str]:
    """Count the runs without an event, and give the reason for each in a line."""
    rows = list(rows)
    quiet = [row for row in rows if not math.isfinite(row["onset_time"])]
    if not quiet:
        return []
    head = f"{len(quiet)} of {len(rows)} runs had no event, and so give no length:"
    return [head, *(f"{row['id']}: {why(row)}" for row in quiet)]


def remarked(rows: Iterable[Row]) -> list[str]:
    """A line for each run with remarks in its status: reasons to doubt its event."""
    lines = []
    for row in rows:
        ended, *remarks = str(row["status"]).split("; ")
        if ended.startswith("completed") and remarks:
            lines.append(f"{row['id']}: {'; '.join(remarks)}")
    return lines


def why(row: Row) -> str:
    """Why a run had no event, as far as its row shows."""
    status = str(row["status"])
    if not status.startswith("completed"):
        return status
    theory = row["critical_length"]
    reached = row["reached_length"]
    patch = f"after {row['simulated_time']:.4g} s its patch was {reached:.3g} m long"
    if not math.isfinite(theory):
        zeta = row["zeta"]
        return f"its sliding is stable by the theory (zeta = {zeta:.3g}); {patch}"
    patch += f", {reached / theory:.2g} of the theory's critical length"
    searched = NEAR * row["block_length"]
    if row["loading"] == "edge" and reached > NEARLY * searched:
        return f"{patch}, and filled the half of the block in which it is followed"
    if reached < theory:
        return f"{patch}: a longer end_time may show it"
    return f"{patch}, and the force has not dropped"
