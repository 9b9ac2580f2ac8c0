"""What the claims stand on: the workflow's datasets, each asked for by what it is about."""

import dataclasses
from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np
import xarray as xr

from ..analysis.lengths import over_realisations, realisations
from ..configuration.roles import JUDGED, PAPERS
from ..model.friction.law import Friction
from ..model.identity import fault
from ..model.linearised import InterfaceState
from ..model.material import Material
from ..model.parameters import Geometry, Loading, Parameters
from .claim import Cause, Result
from .said import Found, Missing

MESH = "A coarse mesh lets the force drop early"
"""Section of docs/results.md on the difference of the two."""


@dataclasses.dataclass(frozen=True)
class Evidence:
    """Datasets and settings of one configuration.

    Attributes
    ----------
    material, friction, loading : of the configuration.
    interface : the main text's rounded friction.
    theory : dataset of the theory's curves.
    dispersion : dataset of single modes integrated in time.
    lengths : tables of lengths, one for each study judged, and of the role
        :data:`~nucleation.configuration.roles.LONGER`.
    patches : stability of the patches with the role :data:`JUDGED`, by id of each fault's first
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

    def rows(self, role: str, **labels: Any) -> list[dict[str, Any]]:
        """Rows of the table of lengths, sorted by height (m); raises Missing if there is none.

        One for each fault of the configuration's material, friction and loads: the mean of its
        realisations, whose own rows are its ``members``.
        """
        wanted = {"role": role, **labels}
        found = [row for row in self._own if all(_same(row[k], v) for k, v in wanted.items())]
        if not found:
            which = "".join(f", {name} {value}" for name, value in labels.items())
            raise Missing(f"The configuration has no such run: role {role}{which}")
        return sorted(found, key=lambda row: row["height"])

    @cached_property
    def _own(self) -> list[dict[str, Any]]:
        """The rows of all roles, which every claim asks for."""
        return [row for table in self.lengths for row in _faults(table) if self._is_own(row)]

    def row(self, role: str, law: str, height: float, phi0: float = 1.0) -> dict[str, Any]:
        """The one row with these labels; raises Missing if there is none."""
        return self.rows(role, evolution=law, height=height, phi0=phi0)[0]

    def series(self, role: str) -> list[dict[str, Any]]:
        """The aging law's rows with a role over all heights, age 1 s."""
        return self.rows(role, evolution="aging", phi0=1.0)

    def _is_own(self, row: dict[str, Any]) -> bool:
        """Whether a row is of the configuration's material, friction and loads, on a rigid base."""
        own = Parameters(
            self.material,
            self.friction.changed({"evolution": row["evolution"]}),
            dataclasses.replace(self.loading, initial_state=float(row["phi0"])),
            Geometry(height=float(row["height"])),
        )
        return bool(row["fault"] == fault(own))

    def each(self, role: str, **labels: Any) -> list[dict[str, Any]]:
        """The rows of all realisations of some faults; raises Missing without one."""
        return [one for row in self.rows(role, **labels) for one in row["members"]]

    def patch(self, row: dict[str, Any]) -> xr.Dataset:
        """The stability of the patch of a row's first realisation; raises Missing without it."""
        if row["id"] not in self.patches:
            raise Missing(f"The stability of the patch of {row['id']} was not computed")
        return self.patches[row["id"]]


def on_both(numbers: Callable[[Evidence, str], Found]) -> Callable[[Evidence], Result]:
    """For numbers of the runs with a role: the verdict stands on the converged, perturbed ones.

    If the statement holds on the paper's own mesh only, the mesh is the cause.
    """

    def of_either(evidence: Evidence) -> Result:
        judged = numbers(evidence, JUDGED)
        try:
            papers = numbers(evidence, PAPERS)
        except Missing:
            return Result(judged)
        cause = Cause(MESH, "On the paper's own mesh ours is", papers)
        return Result(judged, on_papers_mesh=papers, cause=cause)

    return of_either


def of_runs(
    column: str, over: Callable[[Evidence], float] = lambda evidence: 1.0
) -> Callable[[Evidence], Result]:
    """The same for a column of every run, over a unit."""
    return on_both(
        lambda evidence, role: [run[column] / over(evidence) for run in evidence.each(role)]
    )


class Row(dict[str, Any]):
    """A row of a table of lengths, which may lack what was not recorded."""

    def __missing__(self, column: str) -> Any:
        raise Missing(f"The table of the runs' lengths has no {column}")


def _faults(table: xr.Dataset) -> list[dict[str, Any]]:
    """The rows of a table of lengths, one for each fault, with those of its realisations."""
    own = table.to_dataframe().to_dict("records")
    rows = over_realisations(table).to_dataframe().to_dict("records")
    return [
        Row(row | {"members": [Row(own[i]) for i in members]})
        for row, members in zip(rows, realisations(table), strict=True)
    ]


def _same(one: Any, other: Any) -> bool:
    return bool(one == other if isinstance(other, str) else np.isclose(one, other, rtol=1e-9))
