"""Rows of a table of runs as points with bars, marked by evolution law and by where they start.

The paper's two laws look as in its Figure 3; every other law of a table takes the next free marker.
"""

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from numpy.typing import NDArray

from ..model.friction.registry import USUAL_EVOLUTION
from . import style

USUAL_AGE = 1.0  # s: the initial state of all simulations that name no other


class Look(NamedTuple):
    """How one kind of simulation is drawn, and how the legend calls its law."""

    marker: str
    size: float  # points; other kinds are wider than the usual one, which is drawn upon them
    colour: str
    label: str


PAPERS = {
    ("aging", False): Look("o", 4.6, style.AGING, "aging law"),
    ("slip", False): Look("^", 7.2, style.SLIP, "slip law"),
    ("aging", True): Look("s", 6.6, style.OLD_AGE, "aging law"),
    ("slip", True): Look("v", 7.2, style.SLIP, "slip law"),
}
"""By evolution law, and by whether the initial state differs from :data:`USUAL_AGE`."""

OTHERS = (("D", style.GREEN), ("P", style.PURPLE), ("X", style.SKY_BLUE), ("<", style.ORANGE))


def looks(laws: Iterable[str]) -> dict[tuple[str, bool], Look]:
    """The looks of some laws, keys as of :data:`PAPERS`: the paper's first, the others by name."""
    given = set(laws)
    found = {key: look for key, look in PAPERS.items() if key[0] in given}
    others = sorted(given - {law for law, _ in PAPERS})
    for aged in (False, True):
        for i, law in enumerate(others):
            marker, colour = OTHERS[i % len(OTHERS)]
            label = f"{law.replace('_', ' ')} law"
            found[law, aged] = Look(marker, 6.6, style.OLD_AGE if aged else colour, label)
    return found


def kinds(table: xr.Dataset) -> Iterator[tuple[tuple[str, bool], Look, xr.Dataset]]:
    """Law and whether the initial state differs, the look, and the rows of each kind."""
    names = table["evolution"].values.astype(str)
    for (law, old), look in looks(names).items():
        yield (law, old), look, where(table, (names == law) & (aged(table) == old))


def aged(table: xr.Dataset) -> NDArray[np.bool_]:
    """The rows whose initial state is not :data:`USUAL_AGE`."""
    return ~np.isclose(table["phi0"].values, USUAL_AGE)


def usual_law(table: xr.Dataset) -> str:
    """The law of a table that is shown where one is: the usual one, or else that of its first row.

    A table without rows has the usual one.
    """
    laws = table["evolution"].values.astype(str)
    return USUAL_EVOLUTION if USUAL_EVOLUTION in laws or not laws.size else str(laws[0])


def usual(table: xr.Dataset) -> NDArray[np.bool_]:
    """The rows with :func:`usual_law` and the usual initial state, or any state if none has it."""
    law = table["evolution"].values.astype(str) == usual_law(table)
    young = law & ~aged(table)
    return young if young.any() else law


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
