"""The evidence that claims are judged by: the workflow's datasets, and rows by role and label."""

import dataclasses
from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np
import xarray as xr

from nucleation.model.friction.law import Friction
from nucleation.model.identity import fault
from nucleation.model.linearised import InterfaceState
from nucleation.model.material import Material
from nucleation.model.parameters import Geometry, Loading, Parameters

from ..configuration.roles import JUDGED, PAPERS
from ..tables.lengths import over_realisations, realisations
from ..tables.rows import rows_of
from . import phrases
from .claim import Result, Row
from .expected import Estimates, Missing

MESH = "A coarse mesh lets the force drop early"
"""Section of docs/results.md on the difference between the paper's mesh and the converged one."""


@dataclasses.dataclass(frozen=True)
class Evidence:
    """Datasets and settings of one configuration.

    Attributes
    ----------
    material, friction, loading : Material, Friction, Loading
        Those of the configuration.
    interface : InterfaceState
        The main text's rounded friction.
    theory : Dataset
        The theory's curves.
    dispersion : Dataset
        Single modes integrated in time.
    lengths : tuple of Dataset
        Tables of lengths, one for each study with a role of the paper's, and of the role
        :data:`~replication.configuration.roles.LONGER`.
    patches : dict
        Stability of the patches with the role :data:`JUDGED`, by the id of each fault's first
        realisation.
    """

    material: Material
    friction: Friction
    loading: Loading
    interface: InterfaceState
    theory: xr.Dataset
    dispersion: xr.Dataset
    lengths: tuple[xr.Dataset, ...]
    patches: dict[str, xr.Dataset]

    @property
    def nu(self) -> float:
        """Poisson's ratio in the plane."""
        return self.material.in_plane_ratio

    def rows(self, role: str, **labels: str | float) -> list[Row]:
        """The faults of a study, sorted by height, with the configuration's material and loads.

        Parameters
        ----------
        role : str
            The study's role.
        **labels
            Values of columns that select rows, such as ``evolution="aging"``; SI units.

        Returns
        -------
        list of dict
            Rows of the table of lengths, one for each fault: the mean of its realisations. The
            realisations' own rows are its ``members``.

        Raises
        ------
        Missing
            If there is no such row.
        """
        wanted = {"role": role, **labels}
        found = [row for row in self._own if _matches(row, wanted)]
        if not found:
            which = ", ".join(f"{name} {value}" for name, value in wanted.items())
            raise Missing(f"The configuration has no such run: {which}")
        return sorted(found, key=lambda row: row["height"])

    def row(
        self,
        role: str,
        law: str,
        height: float,
        initial_state: float = 1.0,
    ) -> Row:
        """One fault of a study.

        Parameters
        ----------
        role : str
            The study's role.
        law : str
            Name of the evolution law.
        height : float
            Height of the block (m).
        initial_state : float
            Initial age of the interface (s).

        Returns
        -------
        dict
            Its row, as in :meth:`rows`.

        Raises
        ------
        Missing
            If there is no such row.
        """
        rows = self.rows(role, evolution=law, height=height, initial_state=initial_state)
        return rows[0]

    def series(self, role: str) -> list[Row]:
        """The rows with the aging law and an initial age of 1 s, at all heights."""
        return self.rows(role, evolution="aging", initial_state=1.0)

    def each(self, role: str, **labels: str | float) -> list[Row]:
        """The rows of all realisations of the faults that :meth:`rows` returns.

        Parameters
        ----------
        role, **labels
            As in :meth:`rows`.

        Raises
        ------
        Missing
            If there is no such row.
        """
        return [run for row in self.rows(role, **labels) for run in row["members"]]

    @property
    def papers_mesh(self) -> str:
        """Mesh of the runs with the role :data:`PAPERS`, in words."""
        return phrases.mesh(self.each(PAPERS))

    def patch(self, row: Row) -> xr.Dataset:
        """The stability of the patch of a fault's first realisation; raises Missing without it."""
        if row["id"] not in self.patches:
            raise Missing(f"The stability of the patch of {row['id']} was not computed")
        return self.patches[row["id"]]

    @cached_property
    def _own(self) -> list[Row]:
        """The rows of all roles; cached because every claim on runs uses them."""
        return [row for table in self.lengths for row in _faults(table) if self._is_own(row)]

    def _is_own(self, row: Row) -> bool:
        """Whether a row has the configuration's material, friction and loads, on a rigid base."""
        age = float(row["initial_state"])
        height = float(row["height"])
        law = {"evolution": row["evolution"]}
        own = Parameters(
            material=self.material,
            friction=self.friction.changed(law),
            loading=dataclasses.replace(self.loading, initial_state=age),
            geometry=Geometry(height=height),
        )
        return bool(row["fault"] == fault(own))


def on_both(numbers: Callable[[Evidence, str], Estimates]) -> Callable[[Evidence], Result]:
    """Judge numbers of the runs with a role by the converged, perturbed runs.

    If the statement holds on the mesh of the study ``paper`` only, the mesh is the cause.

    Parameters
    ----------
    numbers : callable
        Our number, or several, from the evidence and a role.

    Returns
    -------
    callable
        The claim's function.
    """

    def of_both(evidence: Evidence) -> Result:
        judged = numbers(evidence, JUDGED)
        try:
            papers = numbers(evidence, PAPERS)
        except Missing:
            return Result(judged)
        mesh = evidence.papers_mesh
        return Result(
            judged,
            on_papers_mesh=papers,
            mesh=mesh,
            without_cause=papers,
            cause=f"On {mesh} our number is",
            finding=MESH,
        )

    return of_both


def of_runs(
    column: str,
    unit: Callable[[Evidence], float] = lambda evidence: 1.0,
) -> Callable[[Evidence], Result]:
    """The claim's function for a column of every run, judged as :func:`on_both` does.

    Parameters
    ----------
    column : str
        Column of the table of lengths.
    unit : callable
        Unit of the number, from the evidence and in the column's unit; by default one.

    Returns
    -------
    callable
        The claim's function.
    """

    @on_both
    def numbers(
        evidence: Evidence,
        role: str,
    ) -> list[float]:
        runs = evidence.each(role)
        return [run[column] / unit(evidence) for run in runs]

    return numbers


class _LengthsRow(dict[str, Any]):
    """A row of a table of lengths; columns that were not recorded are missing results."""

    def __missing__(self, column: str) -> Any:
        raise Missing(f"The table of the runs' lengths has no {column}")


def _faults(table: xr.Dataset) -> list[Row]:
    """The rows of a table of lengths, one for each fault, with the rows of its realisations."""
    runs = [_LengthsRow(row) for row in rows_of(table)]
    means = rows_of(over_realisations(table))
    faults: list[Row] = []
    for row, members in zip(means, realisations(table), strict=True):
        own = [runs[i] for i in members]
        faults.append(_LengthsRow(row, members=own))
    return faults


def _matches(row: Row, wanted: dict[str, str | float]) -> bool:
    return all(_same(row[column], value) for column, value in wanted.items())


def _same(one: str | float, other: str | float) -> bool:
    if isinstance(other, str):
        return bool(one == other)
    return bool(np.isclose(one, other, rtol=1e-9))
