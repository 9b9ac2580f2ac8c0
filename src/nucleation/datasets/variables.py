"""Metadata of variables: unit, long name and the paper's symbol.

The code that computes a variable declares it, in a mapping from names to :class:`Column`. For a
table this mapping also gives the columns in their order. A dataset with an undeclared variable is
not written.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from . import DatasetError

if TYPE_CHECKING:
    import xarray as xr

    from ..types import Array


Rule: TypeAlias = "Callable[[Array], Any]"
"""The value of a column for one fault, from those of its realisations."""


class Column(NamedTuple):
    """Metadata of a column of a table, or of another variable of a dataset."""

    name: str
    units: str
    """``"1"`` if dimensionless, empty for text."""
    long_name: str
    symbol: str = ""
    """The paper's."""
    realisations: Rule | None = None
    """Rule for the mean over realisations of one fault; None if there is no such mean."""

    @property
    def attributes(self) -> dict[str, str]:
        """Attributes of the variable in a dataset."""
        given = {"units": self.units, "long_name": self.long_name, "symbol": self.symbol}
        return {name: text for name, text in given.items() if text}


def first(values: Array) -> Any:
    """The first realisation's value: all have the same, or it describes one run, as its id does."""
    return values[0]


def columns(*given: Column) -> dict[str, Column]:
    """Columns by name, in their order."""
    found: dict[str, Column] = {}
    for column in given:
        if column.name in found:
            raise DatasetError(f"column {column.name} is declared twice")
        found[column.name] = column
    return found


def rules(columns: Mapping[str, Column]) -> dict[str, Rule]:
    """The rules for realisations, by column; a DatasetError names the columns that have none."""
    found = {}
    for name, column in columns.items():
        if column.realisations is None:
            raise DatasetError(
                f"column {name} has no rule for the realisations of one fault: "
                "declare it with realisations=np.mean, np.min, np.max or first"
            )
        found[name] = column.realisations
    return found


def annotate(dataset: xr.Dataset, columns: Mapping[str, Column]) -> xr.Dataset:
    """A copy of a dataset with the declared metadata; other variables stay as they are."""
    annotated = dataset.copy()
    for name in columns.keys() & dataset.variables.keys():
        annotated[name].attrs.update(columns[name].attributes)
    return annotated


def table(rows: Iterable[Mapping[str, Any]], columns: Mapping[str, Column]) -> xr.Dataset:
    """A table with one variable for each declared column, in their order; ``run`` is of its rows.

    Each row has a value for each column, else a DatasetError is raised; further values are ignored.
    """
    import xarray as xr

    listed = list(rows)
    missing = sorted({name for row in listed for name in columns.keys() - row.keys()})
    if missing:
        raise DatasetError(f"columns that are declared and not computed: {missing}")
    variables = {}
    for name, column in columns.items():
        variables[name] = ("run", [row[name] for row in listed], column.attributes)
    return xr.Dataset(variables)


def to_csv(table: xr.Dataset) -> str:
    """Write a table as comma-separated text, in the order of its columns."""
    columns = list(table.data_vars)
    return table.to_dataframe()[columns].to_csv(index=False)


def require_annotated(dataset: xr.Dataset) -> None:
    """Raise a DatasetError unless all variables have a long name, and numbers a unit.

    An empty column needs no unit, since its type is unknown.
    """
    bare = []
    for name, variable in dataset.variables.items():
        has_numbers = variable.size > 0 and variable.dtype.kind in "fiubc"
        needed = ("long_name", "units") if has_numbers else ("long_name",)
        if not all(variable.attrs.get(key) for key in needed):
            bare.append(str(name))
    if bare:
        raise DatasetError(
            f"variables without unit or long name: {sorted(bare)}: declare them where the "
            "dataset is made, see nucleation.datasets.variables"
        )
