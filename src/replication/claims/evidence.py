"""The evidence that claims are judged by: the workflow's datasets, and rows by role and label."""

import dataclasses
import math
from collections.abc import Callable, Iterable, Mapping
from functools import cached_property
from typing import Any

import xarray as xr

from nucleation.fault import Fault
from nucleation.model.friction import Expansion, Friction
from nucleation.model.material import Material
from nucleation.run.derived import fault
from nucleation.run.run import Run

from ..configuration.roles import JUDGED, PAPERS
from ..tables.curves import main_text
from ..tables.lengths import over_realisations, realisations
from ..tables.rows import Row, rows_of
from .verdicts import Computation, Found, Missing, Result

PAPERS_MESH = "the paper's mesh"
_ELEMENTS = (400, 150)  # of the paper, along x and y
MEASURED_STABILITY = "measured_stability_length"
"""Column of a fault's row: the length (m) at which its simulated patch becomes unstable."""

_ROUND_OFF = 1e-9  # relative difference of numbers that are equal


@dataclasses.dataclass(frozen=True)
class Evidence:
    """Datasets and settings of one configuration.

    `base` has the configuration's own values, `theory` the theory's curves, `dispersion`
    single modes integrated in time. `lengths` are tables of lengths, one for each study with a role
    of the paper's or :data:`~replication.configuration.roles.LONGER`. `patches` are the stability
    of the patches with the role JUDGED, by the id of each fault's first realisation.
    """

    base: Run
    theory: xr.Dataset
    dispersion: xr.Dataset
    lengths: tuple[xr.Dataset, ...]
    patches: dict[str, xr.Dataset]

    @property
    def velocity(self) -> float:
        """V (m/s)."""
        return self.base.fault.velocity

    @property
    def friction(self) -> Friction:
        """The configuration's friction law."""
        return self.base.law

    @property
    def at_v(self) -> Expansion:
        """``f0``, ``a`` and ``zeta`` of that law at V."""
        return self.friction.expansion(self.velocity)

    @property
    def interface(self) -> Fault:
        """The fault with the main text's rounded friction."""
        return main_text(self.base.fault)

    @property
    def material(self) -> Material:
        """The material of the configuration's block."""
        return self.base.upper.material

    @property
    def nu(self) -> float:
        """Poisson's ratio in the plane."""
        return self.material.in_plane_ratio

    def rows(self, role: str, **labels: str | float) -> list[Row]:
        """The faults of a role by height, means of their realisations; Missing if there are none.

        Labels select by column, such as ``evolution="aging"``. The realisations' own rows are the
        ``members`` of a row. Only faults with the configuration's material and loads are there.
        """
        wanted = {"role": role, **labels}
        found = self._own
        for name, value in wanted.items():
            tolerance = 0.0 if isinstance(value, str) else _ROUND_OFF * value
            found = [
                row
                for row in found
                if row[name] == value or (tolerance and abs(row[name] - value) <= tolerance)
            ]
        if not found:
            which = ", ".join(f"{name} {value}" for name, value in wanted.items())
            raise Missing(f"The configuration has no such run: {which}")
        return sorted(found, key=lambda row: row["height"])

    def row(self, role: str, law: str, height: float, age: float = 1.0) -> Row:
        """The fault of a role with an evolution law, height (m) and initial age (s)."""
        found = self.rows(role, evolution=law, height=height, initial_state=age)
        return found[0]

    def series(self, role: str) -> list[Row]:
        """The rows with the aging law and an initial age of 1 s, at all heights."""
        return self.rows(role, evolution="aging", initial_state=1.0)

    def each(self, role: str, **labels: str | float) -> list[Row]:
        """The rows of all realisations of the faults that :meth:`rows` gives."""
        return [run for row in self.rows(role, **labels) for run in row["members"]]

    def stability_length(self, row: Row) -> float:
        """The length (m) at which the patch of a fault becomes unstable; Missing without it."""
        if MEASURED_STABILITY not in row:
            raise Missing(f"The stability of the patch of {row['id']} was not computed")
        return float(row[MEASURED_STABILITY])

    def with_rows(self, change: Callable[[Row], Row]) -> "Evidence":
        """The same evidence with other rows; a change gets each row, and each realisation's."""

        def changed(row: Row) -> Row:
            return _LengthsRow(change(row), members=[change(run) for run in row["members"]])

        other = dataclasses.replace(self)
        vars(other)["_own"] = [changed(row) for row in self._own]  # in the place of the cached ones
        return other

    @cached_property
    def _own(self) -> list[Row]:
        """The faults of all roles with the configuration's material, friction and loads.

        Cached because every claim on runs uses them.
        """
        found: list[Row] = []
        for table in self.lengths:
            runs = [_LengthsRow(row) for row in rows_of(table)]
            faults = rows_of(over_realisations(table))
            for row, members in zip(faults, realisations(table), strict=True):
                names = "evolution", "initial_state", "height"
                own = self.base.replaced(**{name: row[name] for name in names})
                if row["id"] in self.patches:
                    patch = self.patches[row["id"]]
                    row[MEASURED_STABILITY] = float(patch["stability_length"])
                if row["fault"] == fault(own):
                    found.append(_LengthsRow(row, members=[runs[i] for i in members]))
        return found


class _LengthsRow(Row):
    """A row of a table of lengths; columns that were not recorded are missing results."""

    def __missing__(self, column: str) -> Any:
        raise Missing(f"The table of the runs' lengths has no {column}")


def on_both(numbers: Callable[[Evidence, str], Found]) -> Computation:
    """The function of numbers by role: of the converged runs, and of those on the paper's mesh."""

    def of_both(evidence: Evidence) -> Result:
        found = numbers(evidence, JUDGED)
        try:
            papers = numbers(evidence, PAPERS)
        except Missing:
            return Result(found)
        return Result(found, papers=papers, mesh=mesh(evidence.each(PAPERS)))

    return of_both


def of_runs(
    column: str, unit: Callable[[Evidence], float] = lambda evidence: 1.0, **labels: str
) -> Computation:
    """The claim's function for a column of every run with some labels, over a unit."""
    return on_both(lambda e, role: [run[column] / unit(e) for run in e.each(role, **labels)])


def mesh(rows: Iterable[Mapping[str, Any]]) -> str:
    """The mesh of runs in words: the paper's, or its numbers of elements."""
    elements = sorted({(int(row["n_x"]), int(row["n_y"])) for row in rows})
    if elements in ([], [_ELEMENTS]):
        return PAPERS_MESH
    first, last = (f"{along} x {across}" for along, across in (elements[0], elements[-1]))
    if first == last:
        return f"a mesh of {first} elements"
    return f"meshes of {first} to {last} elements"


def caution(rows: Iterable[Mapping[str, Any]]) -> str:
    """Why numbers of coarse runs are no results; empty where none is coarser than the paper's."""
    own = list(rows)
    along, across = _ELEMENTS
    if all(row["n_x"] >= along and row["n_y"] >= across for row in own):
        return ""
    return (
        f"The runs that stand for the paper's have {mesh(own)}, the paper's {along} x {across}. "
        "They test the workflow: their numbers are no results."
    )


def span(values: Iterable[float], form: Callable[[float], str]) -> str:
    """The smallest and the largest finite number, or one if both look the same.

    `form` formats each. Empty without a finite number.
    """
    known = [value for value in values if math.isfinite(value)]
    if not known:
        return ""
    low, high = form(min(known)), form(max(known))
    return low if low == high else f"{low} to {high}"
