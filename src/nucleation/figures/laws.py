"""How runs are marked by evolution law and by the state they start from, whatever laws there are.

The paper's two laws look as in its Figure 3; every other law of a table takes the next free marker.
"""

from collections.abc import Iterable, Iterator
from typing import NamedTuple

import numpy as np
import xarray as xr
from numpy.typing import NDArray

from ..model.friction.registry import USUAL_EVOLUTION
from . import points, style

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
        yield (law, old), look, points.where(table, (names == law) & (aged(table) == old))


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
