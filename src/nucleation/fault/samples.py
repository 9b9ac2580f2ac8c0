"""Samples of a fault's parameters from a text file, such as a posterior."""

import csv
import re
from pathlib import Path

import numpy as np

from ..datasets.files import refuse_pipe
from ..lengths.draws import SAMPLED
from ..model.hints import hint
from ..model.quantities import ParameterError
from ..model.units import rescaled
from ..types import Array

_HEADER = re.compile(r"\s*(\w+)\s*(?:\((.*)\)|\[(.*)\])?\s*")
_SEPARATORS = ";\t,"
_INDEX = ("", "index")
"""Names of a first column of row numbers, which is skipped."""


def read_samples(path: Path | str) -> dict[str, Array]:
    """Joint samples of parameters, one in each row.

    Parameters
    ----------
    path : Path or str
        UTF-8 text with a header of parameters and units, ``slip_distance (um),a,b``; the default
        are SI units. Columns are separated by commas, semicolons or tabs. Empty lines and lines
        that begin with ``#`` are skipped.

    Returns
    -------
    dict
        Samples in SI units by parameter, all of shape (number of rows,).

    Raises
    ------
    ParameterError
        If there is no row, a column is unknown or there twice, or a unit or a cell is wrong; the
        message has file, line and column.

    Examples
    --------
    >>> from tempfile import NamedTemporaryFile
    >>> with NamedTemporaryFile("w+", suffix=".csv") as file:
    ...     _ = file.write("slip_distance (um),a\\n5,0.010\\n6,0.011\\n")
    ...     _ = file.seek(0)
    ...     samples = read_samples(file.name)
    >>> samples["a"]
    array([0.01 , 0.011])
    """
    try:
        refuse_pipe(path)
        text = Path(path).read_text("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        raise ParameterError(f"{path} can't be read as UTF-8 text: {error}") from None
    numbered = [(i, line) for i, line in enumerate(text.splitlines(), 1) if line.strip()]
    table = [(i, line) for i, line in numbered if not line.lstrip().startswith("#")]
    if len(table) < 2:
        raise ParameterError(f"{path} is empty: no row of samples below a header of parameters")
    first, header = table[0]
    separator = next((sign for sign in _SEPARATORS if sign in header), ",")
    labels = _cells(header, separator)
    skipped = int(labels[0].lower() in _INDEX and len(labels) > 1)
    place = f"{path}, line {first}"
    columns = [_column(place, label) for label in labels[skipped:]]
    names = [name for name, _ in columns]
    for name in names:
        if names.count(name) > 1:
            raise ParameterError(f"{place}: column {name} is there twice")
    rows = []
    for number, line in table[1:]:
        cells = _cells(line, separator)
        if len(cells) != len(labels):
            counts = f"{len(cells)} cells, but the header has {len(labels)}"
            raise ParameterError(f"{path}, line {number}: {counts}")
        where = f"{path}, line {number}"
        rows.append(
            [
                _number(where, *x)
                for x in zip(
                    labels,
                    cells,
                    strict=True,
                )
            ][skipped:]
        )
    found = {}
    for (name, unit), values in zip(
        columns,
        np.array(rows).T,
        strict=True,
    ):
        try:
            found[name] = rescaled(name, values, unit, SAMPLED[name])
        except ParameterError as error:
            raise ParameterError(f"{place}: {error}") from None
    return found


def _cells(line: str, separator: str) -> list[str]:
    return [cell.strip() for cell in next(csv.reader([line], delimiter=separator))]


def _column(place: str, label: str) -> tuple[str, str]:
    """A column's parameter and unit."""
    parts = _HEADER.fullmatch(label)
    if parts is None or parts[1] not in SAMPLED:
        own_name = re.split(r"[(\[]", label)[0].strip()
        suggestion = hint(own_name, SAMPLED) or f"known: {', '.join(SAMPLED)}"
        raise ParameterError(
            f"{place}: column {label!r} is unknown; {suggestion}; the first line that is no "
            "comment names the parameters, such as 'slip_distance (um),a,b'"
        )
    unit = (parts[2] or parts[3] or SAMPLED[parts[1]].unit).strip()
    return parts[1], "1" if unit == "-" else unit


def _number(place: str, label: str, text: str) -> float:
    try:
        number = float(text)
    except ValueError:
        number = np.nan
    if np.isnan(number):
        raise ParameterError(
            f"{place}, column {label!r}: {text!r} is no number; write a decimal point, no unit and "
            "no separators of thousands"
        )
    return number
