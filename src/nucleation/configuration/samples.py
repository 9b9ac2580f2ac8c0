"""Samples of a fault's parameters from a CSV file, such as a posterior."""

import csv
import difflib
import math
import re
from pathlib import Path

import numpy as np

from ..answers.uncertainty import SAMPLED
from ..model.quantities import ParameterError
from ..model.units import rescaled
from ..theory.arrays import aliases
from ..types import Array

_HEADER = re.compile(r"\s*(\w+)\s*(?:\((.*)\)|\[(.*)\])?\s*")


def read_samples(path: Path | str) -> dict[str, Array]:
    """Joint samples of parameters, a row each, for ``length_quantiles``.

    Parameters
    ----------
    path : Path or str
        CSV with a header of parameters and units, ``slip_distance (um),a,b``; SI units where there
        is none.

    Returns
    -------
    dict
        Samples in SI units by parameter, all of shape (number of rows,).

    Raises
    ------
    ParameterError
        If there is no row, a column is unknown or there twice, or a unit or a cell is wrong, with
        its name, row and unit.
    """
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            lines = csv.reader(file)
            (_, header), *rows = [(lines.line_num, x) for x in lines if any(map(str.strip, x))]
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise ParameterError(f"{path} can't be read: {error}") from None
    except ValueError:  # of unpacking
        rows = []
    if not rows:
        raise ParameterError(f"{path} is empty: no row of samples below a header of parameters")
    columns = [_column(path, text) for text in header]
    for number, row in rows:
        if len(row) != len(header):
            raise ParameterError(
                f"{path}, row {number}: {len(row)} cells, but the header has {len(header)}"
            )
    found: dict[str, Array] = {}
    for i, (name, unit) in enumerate(columns):
        if name in found:
            raise ParameterError(f"{path}: column {name} is there twice")
        cells = [_cell(path, number, header[i], row[i]) for number, row in rows]
        try:
            found[name] = rescaled(name, np.array(cells), unit, SAMPLED[name])
        except ParameterError as error:
            raise ParameterError(f"{path}, column {header[i].strip()!r}: {error}") from None
    return found


def _column(path: Path | str, text: str) -> tuple[str, str]:
    """A column's parameter and unit."""
    parts = _HEADER.fullmatch(text)
    name = aliases().get(parts[1], parts[1]) if parts else ""
    if parts is None or name not in SAMPLED:
        close = difflib.get_close_matches(name, SAMPLED, n=1)
        hint = f"did you mean {close[0]}?" if close else f"known: {', '.join(SAMPLED)}"
        raise ParameterError(f"{path}: column {text.strip()!r} is unknown; {hint}")
    unit = (parts[2] or parts[3] or SAMPLED[name].unit).strip()
    return name, "1" if unit == "-" else unit


def _cell(path: Path | str, number: int, column: str, text: str) -> float:
    """The number of a cell."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if math.isnan(value):
        said = f"{text.strip()!r} is no number" if text.strip() else "the cell is empty"
        raise ParameterError(f"{path}, row {number}, column {column.strip()!r}: {said}")
    return value
