"""Rows of a table, the ratios in them, and why a run has no length."""

import math
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import xarray as xr

from ..datasets.shared import SHARED
from ..datasets.variables import Variable
from ..simulation.event import NEAR

Row = dict[str, Any]

RATIOS = {
    "length_ratio": ("length", "theory_length"),
    "stability_ratio": ("stability_length", "theory_length"),
    "zeta_over_a": ("velocity_weakening", "direct_effect"),
}
"""Ratios by name, of which columns."""

RATIO_COLUMNS = {
    "length_ratio": Variable("1", "length at the drop over that of the theory", "L/L_c"),
    "stability_ratio": Variable("1", "patch length where growth begins over theory", "L_s/L_c"),
    "zeta_over_a": SHARED["zeta_over_a"],
}


def rows_of(
    table: xr.Dataset, chosen: Iterable[int] | None = None, names: Iterable[str] | None = None
) -> list[Row]:
    """Rows of a table on ``run``, all or those of some numbers, as plain Python has them.

    Each has its values by `names`, those of all columns by default.
    """
    wanted = [str(name) for name in (table.data_vars if names is None else names)]
    columns = {name: table[name].values.tolist() for name in wanted}
    numbers = range(table.sizes["run"]) if chosen is None else chosen
    return [{name: values[i] for name, values in columns.items()} for i in numbers]


def ratios(columns: Mapping[Any, Any]) -> Row:
    """:data:`RATIOS` of one row or of a whole table."""
    return {name: columns[over] / columns[under] for name, (over, under) in RATIOS.items()}


NEARLY = 0.98
"""Part of the searched half of the block from which on the patch counts as having filled it."""


def without_event(rows: Iterable[Mapping[str, Any]]) -> list[str]:
    """How many of some runs had no event, and a line with the reason for each of these.

    `rows` are of a table of lengths (:data:`nucleation.analysis.lengths.COLUMNS`).
    """
    rows = list(rows)
    quiet = [row for row in rows if not math.isfinite(row["onset_time"])]
    if not quiet:
        return []
    head = f"{len(quiet)} of {len(rows)} runs had no event, and so give no length:"
    return [head, *(f"{row['id']}: {why(row)}" for row in quiet)]


def remarked(rows: Iterable[Mapping[str, Any]]) -> list[str]:
    """A line for each run whose status says what makes its event doubtful; rows as above."""
    lines = []
    for row in rows:
        ended, *remarks = str(row["status"]).split("; ")
        if ended.startswith("completed") and remarks:
            lines.append(f"{row['id']}: {'; '.join(remarks)}")
    return lines


def in_table(path: Path) -> list[str]:
    """The same from the CSV of a study's table."""
    import pandas as pd  # which takes a while

    return without_event(pd.read_csv(path).to_dict("records"))


def why(row: Mapping[str, Any]) -> str:
    """Why a run had no event, as far as its row of the table of lengths tells."""
    if not str(row["status"]).startswith("completed"):
        return str(row["status"])
    names = ("velocity_weakening", "theory_length", "reached_length", "simulated_time")
    zeta, theory, reached, end = (row[name] for name in names)
    patch = f"after {end:.4g} s its patch was {reached:.3g} m long"
    if not math.isfinite(theory):
        return f"its sliding is stable by the theory (zeta = {zeta:.3g}); {patch}"
    patch += f", {reached / theory:.2g} of the theory's critical length"
    edge = row["loading"] == "edge"
    if edge and reached > NEARLY * NEAR * row["block_length"]:
        return f"{patch}, and filled the half of the block in which it is followed"
    if reached < theory:
        return f"{patch}: a longer end_time may show it"
    return f"{patch}, and the force has not dropped"
