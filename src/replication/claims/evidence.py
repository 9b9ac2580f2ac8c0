"""The evidence that claims are judged by: the workflow's datasets, and rows by role and label."""

import dataclasses
from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np
import xarray as xr

from nucleation.fault import Fault
from nucleation.model.friction import Friction
from nucleation.model.material import Material
from nucleation.run.identity import fault
from nucleation.run.run import Run

from ..configuration.roles import JUDGED, PAPERS
from ..tables.lengths import over_realisations, realisations
from ..tables.main_text import main_text
from ..tables.rows import rows_of
from . import phrases
from .expected import Found, Missing, Result

Row = dict[str, Any]
"""A row of a table: values by column."""


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
    def fault(self) -> Fault:
        """The configuration's fault."""
        return self.base.fault

    @property
    def friction(self) -> Friction:
        """The configuration's friction law."""
        return self.base.law

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
        found = [
            row
            for row in self._own
            if all(_same(row[column], value) for column, value in wanted.items())
        ]
        if not found:
            which = ", ".join(f"{name} {value}" for name, value in wanted.items())
            raise Missing(f"The configuration has no such run: {which}")
        return sorted(found, key=lambda row: row["height"])

    def row(
        self,
        role: str,
        law: str,
        height: float,
        age: float = 1.0,
    ) -> Row:
        """The fault of a role with an evolution law, height (m) and initial age (s)."""
        return self.rows(
            role,
            evolution=law,
            height=height,
            initial_state=age,
        )[0]

    def series(self, role: str) -> list[Row]:
        """The rows with the aging law and an initial age of 1 s, at all heights."""
        return self.rows(role, evolution="aging", initial_state=1.0)

    def each(self, role: str, **labels: str | float) -> list[Row]:
        """The rows of all realisations of the faults that :meth:`rows` gives."""
        return [run for row in self.rows(role, **labels) for run in row["members"]]

    @property
    def papers_mesh(self) -> str:
        """Mesh of the runs with the role :data:`PAPERS`, in words."""
        return phrases.mesh(self.each(PAPERS))

    def stability_length(self, row: Row) -> float:
        """The length (m) at which the patch of a fault becomes unstable; Missing without it."""
        if row["id"] not in self.patches:
            raise Missing(f"The stability of the patch of {row['id']} was not computed")
        return float(self.patches[row["id"]]["stability_length"])

    @cached_property
    def _own(self) -> list[Row]:
        """The rows of all roles; cached because every claim on runs uses them."""
        return [row for table in self.lengths for row in _faults(table) if self._is_own(row)]

    def _is_own(self, row: Row) -> bool:
        """Whether a row has the configuration's material, friction and loads, on a rigid base."""
        names = ("initial_state", "height")
        labels = {name: float(row[name]) for name in names}
        own = self.base.replaced(evolution=row["evolution"], **labels)
        return bool(row["fault"] == fault(own))


def on_both(numbers: Callable[[Evidence, str], Found]) -> Callable[[Evidence], Result]:
    """The function of numbers by role: of the converged runs, and of those on the paper's mesh."""

    def of_both(evidence: Evidence) -> Result:
        found = numbers(evidence, JUDGED)
        try:
            return Result(found, papers=numbers(evidence, PAPERS), mesh=evidence.papers_mesh)
        except Missing:
            return Result(found)

    return of_both


def of_runs(
    column: str,
    unit: Callable[[Evidence], float] = lambda evidence: 1.0,
    **labels: str,
) -> Callable[[Evidence], Result]:
    """The claim's function for a column of every run with some labels, over a unit."""
    return on_both(lambda e, role: [run[column] / unit(e) for run in e.each(role, **labels)])


class _LengthsRow(Row):
    """A row of a table of lengths; columns that were not recorded are missing results."""

    def __missing__(self, column: str) -> Any:
        raise Missing(f"The table of the runs' lengths has no {column}")


def _faults(table: xr.Dataset) -> list[Row]:
    """The rows of a table of lengths, one for each fault, with the rows of its realisations."""
    runs = [_LengthsRow(row) for row in rows_of(table)]
    groups = zip(rows_of(over_realisations(table)), realisations(table), strict=True)
    return [_LengthsRow(row, members=[runs[i] for i in members]) for row, members in groups]


def _same(one: str | float, other: str | float) -> bool:
    if isinstance(other, str):
        return bool(one == other)
    return bool(np.isclose(one, other, rtol=1e-9))
