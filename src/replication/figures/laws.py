"""Rows of a table of runs as points with bars, marked by evolution law and initial state.

The paper's two laws have the marks of its Figure 3; other laws take the next free mark.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from numpy.typing import ArrayLike

from nucleation.pictures import style
from nucleation.types import Array

from ..tables.rows import groups as rows_that_agree

Marks = tuple[str, float, str, float]
"""Marker, size (points), colour, and points by which Figure 3 moves the marks to the right."""

USUAL_AGE = 1.0  # s: the initial state of all simulations that declare no other


PAPERS: dict[tuple[str, bool], Marks] = {
    ("aging", False): ("o", 4.6, style.AGING, 0.0),
    ("slip", False): ("^", 7.2, style.SLIP, -4.0),
    ("aging", True): ("s", 6.6, style.OLD_AGE, 4.0),
    ("slip", True): ("v", 7.2, style.SLIP, 8.0),
}
"""Marks by evolution law, and whether the initial state is another than :data:`USUAL_AGE`.

The usual kind is the smallest, as it is drawn over the others.
"""

_OTHERS = (("D", style.GREEN), ("P", style.PURPLE), ("X", style.SKY_BLUE), ("<", style.ORANGE))


def kinds(table: xr.Dataset) -> Iterator[tuple[str, bool, Marks, xr.Dataset]]:
    """The kinds of simulation in a table: those of the paper first, then the others by name.

    Each has its name, whether the initial state is not the usual one, its marks and its runs.
    """
    laws = table["evolution"].values.astype(str)
    aged = ~np.isclose(table["initial_state"].values, USUAL_AGE)
    looks = dict(PAPERS)
    for i, law in enumerate(sorted(set(laws) - {law for law, _ in PAPERS})):
        marker, colour = _OTHERS[i % len(_OTHERS)]
        looks[law, False] = (marker, 6.6, colour, 0.0)
        looks[law, True] = (marker, 6.6, style.OLD_AGE, 0.0)
    for (law, old), look in looks.items():
        runs = where(table, (laws == law) & (aged == old))
        if runs.sizes["run"]:
            yield f"{law.replace('_', ' ')} law", old, look, runs


def where(table: xr.Dataset, chosen: ArrayLike = True, **labels: object) -> xr.Dataset:
    """The chosen rows of a table, those whose columns have the values of `labels`."""
    found = np.broadcast_to(np.asarray(chosen, dtype=bool), table.sizes["run"])
    for name, value in labels.items():
        found = found & (table[name].values == value)
    return table.isel(run=np.flatnonzero(found))


def groups(table: xr.Dataset, *names: str) -> Iterator[xr.Dataset]:
    """The rows that agree in some columns, group by group, in the order of the table."""
    for rows in rows_that_agree(table, *names):
        yield table.isel(run=rows)


def draw(axes: Axes, x: str, table: xr.Dataset, name: str, **look: Any) -> None:
    """Draw a column over another as points, with bars from its ``_low`` to its ``_high``.

    A bar is left out if an end is NaN or not in the table.
    """
    middle = table[name].values
    low, high = (table.get(f"{name}_{end}", table[name]).values for end in ("low", "high"))
    bars = np.nan_to_num([middle - low, high - middle]).clip(0.0)
    usual: style.Options = {"elinewidth": 0.9, "linestyle": "none"}
    axes.errorbar(table[x].values, middle, bars, **usual | look)


def draw_range(axes: Axes, x: float, values: Array, **look: Any) -> None:
    """Draw the mean of realisations as a point, with a bar from the least to the largest."""
    mean = values.mean()
    axes.errorbar(x, mean, [[mean - values.min()], [values.max() - mean]], **look)
