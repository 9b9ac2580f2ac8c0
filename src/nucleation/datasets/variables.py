"""What a variable of a dataset is: its unit, long name and paper symbol.

They are declared beside the code that computes the variable, as a mapping of names to
:class:`Variable`: in a table, the columns in their order. A dataset that lacks them is not written.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

if TYPE_CHECKING:
    import xarray as xr


class DatasetError(ValueError):
    """A dataset's variable is not declared, or a file is damaged, incomplete or foreign."""


class Variable(NamedTuple):
    """Metadata of one variable: unit ("1" if dimensionless, "" for text), name, paper symbol."""

    units: str
    long_name: str
    symbol: str = ""

    @property
    def attributes(self) -> dict[str, str]:
        """What the variable carries in a dataset."""
        return {name: text for name, text in self._asdict().items() if text}


def some(columns: Mapping[str, Variable], *names: str) -> dict[str, Variable]:
    """Some of the declared variables, in the order of the names."""
    return {name: columns[name] for name in names}


def annotate(dataset: xr.Dataset, columns: Mapping[str, Variable]) -> xr.Dataset:
    """A copy of the dataset, in which the variables that are declared carry their metadata."""
    annotated = dataset.copy()
    for name in columns.keys() & dataset.variables.keys():
        annotated[name].attrs.update(columns[name].attributes)
    return annotated


def table(
    rows: Iterable[Mapping[str, Any]], columns: Mapping[str, Variable], dim: str = "run"
) -> xr.Dataset:
    """A table of rows, one value by name for each of the declared columns, on one dimension.

    Raises
    ------
    DatasetError
        If a column is declared and not computed.
    """
    import xarray as xr

    listed = list(rows)
    missing = sorted({name for row in listed for name in columns.keys() - row.keys()})
    if missing:
        raise DatasetError(f"columns that are declared and not computed: {missing}")
    return xr.Dataset(
        {name: (dim, [row[name] for row in listed], c.attributes) for name, c in columns.items()}
    )


def is_table(dataset: xr.Dataset) -> bool:
    """Whether all of a dataset's variables are columns, on one dimension."""
    return len(dataset.dims) == 1 and all(v.ndim == 1 for v in dataset.data_vars.values())


def to_csv(table: xr.Dataset) -> str:
    """A table as comma-separated text, in the order of its columns."""
    return table.to_dataframe()[list(table.data_vars)].to_csv(index=False)


def require_annotated(dataset: xr.Dataset) -> None:
    """Make sure that every variable says what it is: long name, and the unit of numbers.

    An empty column of a table is of no type.

    Raises
    ------
    DatasetError
        If one does not.
    """
    bare = sorted(
        str(name)
        for name, variable in dataset.variables.items()
        if not variable.attrs.get("long_name")
        or (variable.size and variable.dtype.kind in "fiubc" and not variable.attrs.get("units"))
    )
    if bare:
        raise DatasetError(f"variables without unit or long name: {bare}: declare them where the "
                           "dataset is made, as nucleation.datasets.variables says")  # fmt: skip
