"""Metadata of variables: unit, long name and the paper's symbol.

The code that computes a variable declares it, in a mapping from names to :class:`Variable`. For a
table this mapping also gives the columns in their order. A dataset with an undeclared variable is
not written.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from . import DatasetError

if TYPE_CHECKING:
    import xarray as xr


class Variable(NamedTuple):
    """Metadata of one variable: unit ("1" if dimensionless, "" for text), name, paper's symbol."""

    units: str
    long_name: str
    symbol: str = ""

    @property
    def attributes(self) -> dict[str, str]:
        """Attributes of the variable in a dataset."""
        return {name: text for name, text in self._asdict().items() if text}


def some(columns: Mapping[str, Variable], names: str) -> dict[str, Variable]:
    """Select declared variables, in the order of their names, which blanks separate."""
    return {name: columns[name] for name in names.split()}


def annotate(dataset: xr.Dataset, columns: Mapping[str, Variable]) -> xr.Dataset:
    """Add the declared metadata to a copy of a dataset.

    Parameters
    ----------
    dataset : Dataset
        Its variables without a declaration stay as they are.
    columns : mapping
        Declarations by variable.

    Returns
    -------
    Dataset
        The copy.
    """
    annotated = dataset.copy()
    for name in columns.keys() & dataset.variables.keys():
        annotated[name].attrs.update(columns[name].attributes)
    return annotated


def table(
    rows: Iterable[Mapping[str, Any]],
    columns: Mapping[str, Variable],
    dim: str = "run",
) -> xr.Dataset:
    """Make a table with one variable for each declared column.

    Parameters
    ----------
    rows : iterable of mapping
        A value for each column; further values are ignored.
    columns : mapping
        Declarations of the columns, in their order.
    dim : str
        Name of the dimension of the rows.

    Returns
    -------
    Dataset
        The table.

    Raises
    ------
    DatasetError
        If a row lacks a declared column.
    """
    import xarray as xr

    listed = list(rows)
    missing = sorted({name for row in listed for name in columns.keys() - row.keys()})
    if missing:
        raise DatasetError(f"columns that are declared and not computed: {missing}")
    variables = {}
    for name, column in columns.items():
        values = [row[name] for row in listed]
        variables[name] = (dim, values, column.attributes)
    return xr.Dataset(variables)


def is_table(dataset: xr.Dataset) -> bool:
    """Whether all variables of a dataset are columns on one dimension."""
    if len(dataset.dims) != 1:
        return False
    return all(variable.ndim == 1 for variable in dataset.data_vars.values())


def to_csv(table: xr.Dataset) -> str:
    """Write a table as comma-separated text, in the order of its columns."""
    columns = list(table.data_vars)
    return table.to_dataframe()[columns].to_csv(index=False)


def require_annotated(dataset: xr.Dataset) -> None:
    """Check that every variable has a long name, and a unit if it holds numbers.

    An empty column needs no unit, since its type is unknown.

    Raises
    ------
    DatasetError
        If one lacks them.
    """
    bare = [str(name) for name in dataset.variables if not _is_annotated(dataset, name)]
    if bare:
        raise DatasetError(
            f"variables without unit or long name: {sorted(bare)}: declare them where the "
            "dataset is made, see nucleation.datasets.variables"
        )


def _is_annotated(dataset: xr.Dataset, name: Hashable) -> bool:
    variable = dataset.variables[name]
    has_numbers = variable.size > 0 and variable.dtype.kind in "fiubc"
    if has_numbers and not variable.attrs.get("units"):
        return False
    return bool(variable.attrs.get("long_name"))
