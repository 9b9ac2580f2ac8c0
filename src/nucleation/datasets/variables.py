"""Metadata of variables: unit, long name and the paper's symbol.

The code that computes a variable declares it, in a mapping from names to :class:`Variable`. For a
table this mapping also gives the columns in their order. A dataset with an undeclared variable is
not written.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
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


def declared(text: str, known: Mapping[str, Variable] | None = None) -> dict[str, Variable]:
    """Columns of a table by lines of name, unit, long name and symbol, which bars separate.

    A line without a bar has names, between blanks, of columns that are known already.
    """
    found: dict[str, Variable] = {}
    for line in text.strip().splitlines():
        name, *entry = (cell.strip() for cell in line.split("|"))
        if entry:
            found[name] = Variable(*entry)
            continue
        for one in name.split():
            found[one] = (known or {})[one]
    return found


def annotate(dataset: xr.Dataset, columns: Mapping[str, Variable]) -> xr.Dataset:
    """A copy of a dataset with the declared metadata; other variables stay as they are."""
    annotated = dataset.copy()
    for name in columns.keys() & dataset.variables.keys():
        annotated[name].attrs.update(columns[name].attributes)
    return annotated


def table(rows: Iterable[Mapping[str, Any]], columns: Mapping[str, Variable]) -> xr.Dataset:
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
