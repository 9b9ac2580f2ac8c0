"""Rows of a table of runs as points with bars, marked by evolution law and initial state.

The paper's two laws have the marks of its Figure 3; other laws take the next free mark.
"""

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

import numpy as np
import xarray as xr
from matplotlib.axes import Axes
from numpy.typing import ArrayLike, NDArray

from nucleation.model.friction import USUAL_EVOLUTION
from nucleation.pictures import style
from nucleation.types import Array

USUAL_AGE = 1.0  # s: the initial state of all simulations that declare no other

Kind = tuple[str, bool]
"""Evolution law, and whether the initial state differs from :data:`USUAL_AGE`."""


class Look(NamedTuple):
    """The marks of one kind of simulation, and the name of its law in the legend."""

    marker: str
    size: float  # points; the usual kind is the smallest, as it is drawn over the others
    colour: str
    label: str
    aside: float = 0.0  # points (1/72 inch) by which Figure 3 moves it to the right
    old: bool = False

    @property
    def name(self) -> str:
        """The law, and whether the interface is older than usual."""
        return self.label + (", older interface" if self.old else "")


PAPERS = {
    ("aging", False): Look("o", 4.6, style.AGING, "aging law"),
    ("slip", False): Look(
        "^",
        7.2,
        style.SLIP,
        "slip law",
        -4.0,
    ),
    ("aging", True): Look(
        "s",
        6.6,
        style.OLD_AGE,
        "aging law",
        4.0,
        True,
    ),
    ("slip", True): Look(
        "v",
        7.2,
        style.SLIP,
        "slip law",
        8.0,
        True,
    ),
}

_OTHERS = (("D", style.GREEN), ("P", style.PURPLE), ("X", style.SKY_BLUE), ("<", style.ORANGE))


def looks(laws: Iterable[str]) -> dict[Kind, Look]:
    """The marks of some laws: those of the paper first, then the others by name."""
    given = set(laws)
    found = {kind: look for kind, look in PAPERS.items() if kind[0] in given}
    others = sorted(given - {law for law, _ in PAPERS})
    for old in (False, True):
        for i, law in enumerate(others):
            marker, colour = _OTHERS[i % len(_OTHERS)]
            name = f"{law.replace('_', ' ')} law"
            found[law, old] = Look(
                marker,
                6.6,
                style.OLD_AGE if old else colour,
                name,
                old=old,
            )
    return found


def kinds(table: xr.Dataset) -> Iterator[tuple[Look, xr.Dataset]]:
    """The marks and the rows of each kind of simulation."""
    laws = _laws(table)
    for (law, old), look in looks(laws).items():
        yield look, where(table, (laws == law) & (aged(table) == old))


def _laws(table: xr.Dataset) -> NDArray[np.str_]:
    return table["evolution"].values.astype(str)


def aged(table: xr.Dataset) -> NDArray[np.bool_]:
    """The rows with another initial state than :data:`USUAL_AGE`."""
    return ~np.isclose(table["initial_state"].values, USUAL_AGE)


def usual_law(table: xr.Dataset) -> str:
    """The law for figures of a single law: the usual one, or else that of the first row."""
    laws = _laws(table)
    if USUAL_EVOLUTION in laws or not laws.size:
        return USUAL_EVOLUTION
    return str(laws[0])


def usual(table: xr.Dataset) -> NDArray[np.bool_]:
    """The rows with :func:`usual_law` and the usual initial state, or any state if none has it."""
    law = _laws(table) == usual_law(table)
    young = law & ~aged(table)
    return young if young.any() else law


def where(table: xr.Dataset, chosen: ArrayLike = True, **labels: object) -> xr.Dataset:
    """The chosen rows of a table, those whose columns have the values of `labels`."""
    found = np.broadcast_to(np.asarray(chosen, dtype=bool), table.sizes["run"])
    for name, value in labels.items():
        found = found & (table[name].values == value)
    return table.isel(run=np.flatnonzero(found))


def groups(table: xr.Dataset, *names: str) -> Iterator[xr.Dataset]:
    """The rows that agree in some columns, group by group, in the order of the table."""
    columns = [table[name].values.tolist() for name in names]
    keys = list(zip(*columns, strict=True))
    for key in dict.fromkeys(keys):
        yield table.isel(run=[i for i, own in enumerate(keys) if own == key])


def draw(axes: Axes, x: str, table: xr.Dataset, name: str, **look: Any) -> None:
    """Draw a column over another as points, with bars from its ``_low`` to its ``_high``.

    A bar is left out if an end is NaN or not in the table.
    """
    middle = table[name].values
    low = table.get(f"{name}_low", table[name]).values
    high = table.get(f"{name}_high", table[name]).values
    bars = np.clip(
        np.nan_to_num([middle - low, high - middle]),
        0.0,
        None,
    )
    usual: style.Options = {"elinewidth": 0.9, "linestyle": "none"}
    axes.errorbar(table[x].values, middle, bars, **usual | look)


def draw_range(axes: Axes, x: float, values: Array, **look: Any) -> None:
    """Draw the mean of realisations as a point, with a bar from the least to the largest."""
    mean = values.mean()
    axes.errorbar(
        x,
        mean,
        [[mean - values.min()], [values.max() - mean]],
        **look,
    )
