"""Rows of a table of runs, and how they become points with bars."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes


def where(table: xr.Dataset, chosen: Any = True, **labels: object) -> xr.Dataset:
    """The rows with these labels in columns of their names, of those that are `chosen`."""
    found = np.broadcast_to(np.asarray(chosen, dtype=bool), table.sizes["run"])
    for name, value in labels.items():
        found = found & (table[name].values == value)
    return table.isel(run=np.flatnonzero(found))


def groups(table: xr.Dataset, *names: str) -> Iterator[xr.Dataset]:
    """The rows that agree in some columns, set by set, in the order of the table."""
    keys = list(zip(*(table[name].values.tolist() for name in names), strict=True))
    for key in dict.fromkeys(keys):
        yield table.isel(run=[i for i, own in enumerate(keys) if own == key])


def draw(axes: Axes, x: Any, table: xr.Dataset, name: str, scale: Any = 1.0, **look: Any) -> None:
    """Draw a column over `scale`, with bars from that ``_low`` to that ``_high``, where known."""
    middle, low, high = (table[name + end].values / scale for end in ("", "_low", "_high"))
    bars = np.clip(np.nan_to_num([middle - low, high - middle]), 0.0, None)
    usual: Any = {"elinewidth": 0.9, "linestyle": "none"}
    axes.errorbar(x, middle, bars, **usual | look)
