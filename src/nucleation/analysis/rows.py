"""Rows of a table and the ratios in them, for whatever goes through a table run by run."""

from collections.abc import Iterable, Mapping
from typing import Any

import xarray as xr

from ..datasets.shared import SHARED
from ..datasets.variables import Variable

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
