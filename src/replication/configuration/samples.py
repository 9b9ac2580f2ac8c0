"""Samples of a fault's parameters from a text file, such as a posterior."""

import csv
import io
import math
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np

from nucleation.datasets.files import refuse_pipe
from nucleation.lengths.draws import SAMPLED
from nucleation.model.quantities import ParameterError
from nucleation.model.synonyms import hint
from nucleation.model.units import rescaled
from nucleation.theory.arrays import aliases
from nucleation.types import Array

_HEADER = re.compile(r"\s*(\w+)\s*(?:\((.*)\)|\[(.*)\])?\s*")
_NUMBER = re.compile(r"[+-]?(?:(?:\d+\.?\d*|\.\d+)(?:e[+-]?\d+)?|inf)", re.ASCII | re.IGNORECASE)
_DECIMAL_COMMA = re.compile(r"[+-]?\d*,\d+(?:e[+-]?\d+)?", re.ASCII | re.IGNORECASE)
_SEPARATORS = {";": "semicolons", "\t": "tabs", ",": "commas"}
_INDEX = {"", "index", "unnamed: 0"}
"""Names of a column of row numbers in small letters, as programs write them."""


class _Line(NamedTuple):
    """One line of the table."""

    number: int  # in the file, from 1
    cells: list[str]


def read_samples(path: Path | str) -> dict[str, Array]:
    """Joint samples of parameters, one in each row, for ``length_quantiles``.

    Parameters
    ----------
    path : Path or str
        Text file with a header of parameters and units, ``slip_distance (um),a,b``; the default are
        SI units. Columns are separated by commas, semicolons or tabs; numbers have a decimal
        point, or a decimal comma where semicolons or tabs separate the columns. Empty lines, lines
        that begin with ``#`` and a first column of row numbers are skipped. The encoding is UTF-8,
        UTF-16 or Latin-1.

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
    text = _text_of(path)
    header, *rows = _table_of(path, text)
    found: dict[str, Array] = {}
    comma = _has_decimal_commas(path, rows)
    for position, label in enumerate(header.cells):
        name, unit = _column(path, header.number, label)
        if name in found:
            raise ParameterError(f"{path}, line {header.number}: column {name} is there twice")
        numbers = []
        for row in rows:
            cell = row.cells[position]
            numbers.append(_cell(path, row.number, label, cell, comma))
        try:
            found[name] = rescaled(name, np.array(numbers), unit, SAMPLED[name])
        except ParameterError as error:
            place = f"{path}, line {header.number}, column {label!r}"
            raise ParameterError(f"{place}: {error}") from None
    return found


def _text_of(path: Path | str) -> str:
    """The text of a file in one of the usual encodings of tables."""
    try:
        refuse_pipe(path)
        content = Path(path).read_bytes()
    except OSError as error:
        raise ParameterError(f"{path} can't be read: {error}") from None
    is_wide = content.startswith((b"\xff\xfe", b"\xfe\xff"))
    try:
        text = content.decode("utf-16" if is_wide else "utf-8-sig")
    except UnicodeDecodeError:
        text = content.decode("latin-1")
    if "\0" in text:
        raise ParameterError(f"{path} is no text file: export the table as CSV")
    return text


def _table_of(
    path: Path | str,
    text: str,
) -> list[_Line]:
    """The header and the rows, without comments and a column of row numbers."""
    plain = [line for line in text.splitlines() if line.strip() and not _is_comment(line)]
    if len(plain) < 2:
        raise ParameterError(f"{path} is empty: no row of samples below a header of parameters")
    separator = _separator(plain[0])
    # comments are blanked and not dropped, so that the reader's line numbers are those of the file
    kept = ["" if _is_comment(line) else line for line in text.splitlines()]
    reader = csv.reader(io.StringIO("\n".join(kept)), delimiter=separator, strict=True)
    lines: list[_Line] = []
    try:
        for cells in reader:
            stripped = [cell.strip() for cell in cells]
            if any(stripped):
                lines.append(_Line(reader.line_num, stripped))
    except csv.Error as error:
        raise ParameterError(f"{path}, line {reader.line_num}: {error}") from None
    header, *rows = lines
    _require_names(path, header)
    for row in rows:
        _require_width(path, row, header, separator)
    table = _without_row_numbers([header, *rows])
    return _without_empty_columns(path, table)


def _is_comment(line: str) -> bool:
    return line.lstrip().startswith("#")


def _separator(header: str) -> str:
    """The separator of the columns in the header; a comma for a single column."""
    return next((sign for sign in _SEPARATORS if sign in header), ",")


def _require_names(
    path: Path | str,
    header: _Line,
) -> None:
    """Refuse a table without a header, and one with columns separated by blanks."""
    place = f"{path}, line {header.number}"
    numbers = [cell for cell in header.cells if cell]
    if all(_NUMBER.fullmatch(cell) or _DECIMAL_COMMA.fullmatch(cell) for cell in numbers):
        raise ParameterError(
            f"{place}: there is no header; the first line that is no comment must name the "
            "parameters, such as 'slip_distance (um),a,b'"
        )
    words = header.cells[0].split()
    if len(header.cells) == 1 and len([w for w in words if _is_known(w)]) > 1:
        raise ParameterError(
            f"{place}: the columns are separated by blanks; separate them by commas, semicolons "
            "or tabs"
        )


def _is_known(word: str) -> bool:
    return aliases().get(word, word) in SAMPLED


def _require_width(
    path: Path | str,
    row: _Line,
    header: _Line,
    separator: str,
) -> None:
    """Refuse a row that has more or fewer cells than the header."""
    if len(row.cells) == len(header.cells):
        return
    remark = ""
    if separator == "," and len(row.cells) > len(header.cells):
        remark = "; with decimal commas separate the columns by semicolons or tabs"
    elif len(row.cells) == 1 and any(sign in row.cells[0] for sign in _SEPARATORS):
        remark = f"; the header's columns are separated by {_SEPARATORS[separator]}"
    raise ParameterError(
        f"{path}, line {row.number}: {len(row.cells)} cells, but the header has "
        f"{len(header.cells)}{remark}"
    )


def _without_row_numbers(table: list[_Line]) -> list[_Line]:
    """The table without a first column that counts the rows, from 0 or from 1."""
    header, *rows = table
    if header.cells[0].lower() not in _INDEX or len(header.cells) == 1:
        return table
    first = [row.cells[0] for row in rows]
    from_zero = [str(number) for number in range(len(rows))]
    from_one = [str(number + 1) for number in range(len(rows))]
    if first not in (from_zero, from_one):
        return table
    return [line._replace(cells=line.cells[1:]) for line in table]


def _without_empty_columns(
    path: Path | str,
    table: list[_Line],
) -> list[_Line]:
    """The table without columns that have neither name nor content, as from spreadsheets."""
    header, *rows = table
    kept = []
    for position, label in enumerate(header.cells):
        filled = next((row for row in rows if row.cells[position]), None)
        if label:
            kept.append(position)
        elif filled is not None:
            raise ParameterError(
                f"{path}, line {header.number}: column {position + 1} has no name, but a value "
                f"in line {filled.number}; row numbers must count the rows"
            )
    narrow = []
    for line in table:
        cells = [line.cells[position] for position in kept]
        narrow.append(line._replace(cells=cells))
    return narrow


def _has_decimal_commas(
    path: Path | str,
    rows: list[_Line],
) -> bool:
    """Whether numbers have a decimal comma; a mixture with decimal points is refused."""
    commas = []
    points = []
    for row in rows:
        for cell in row.cells:
            if _DECIMAL_COMMA.fullmatch(cell):
                commas.append(row.number)
            elif "." in cell and _NUMBER.fullmatch(cell):
                points.append(row.number)
    if commas and points:
        raise ParameterError(
            f"{path}: line {commas[0]} has a decimal comma and line {points[0]} a decimal point; "
            "write all numbers with a decimal point"
        )
    return bool(commas)


def _column(
    path: Path | str,
    line: int,
    label: str,
) -> tuple[str, str]:
    """A column's parameter and unit."""
    parts = _HEADER.fullmatch(label)
    name = aliases().get(parts[1], parts[1]) if parts else ""
    if parts is None or name not in SAMPLED:
        own_name = re.split(r"[(\[]", label)[0].strip()
        suggestion = hint(own_name, SAMPLED) or f"known: {', '.join(SAMPLED)}"
        raise ParameterError(f"{path}, line {line}: column {label!r} is unknown; {suggestion}")
    unit = (parts[2] or parts[3] or SAMPLED[name].unit).strip()
    return name, "1" if unit == "-" else unit


def _cell(
    path: Path | str,
    line: int,
    label: str,
    text: str,
    decimal_commas: bool,
) -> float:
    """The number of a cell."""
    number = text.replace(",", ".") if decimal_commas and text.count(",") == 1 else text
    if _NUMBER.fullmatch(number):
        value = float(number)
        if math.isfinite(value) or "inf" in number.lower():
            return value
    place = f"{path}, line {line}, column {label!r}"
    if not text:
        raise ParameterError(f"{place}: the cell is empty")
    remark = ""
    if re.match(r"[+-]?[\d.]*\d[.,\d]*\s*[A-Za-zµμ]", text):
        remark = "; units belong in the header, such as 'slip_distance (um)'"
    elif "," in text and "." in text:
        remark = "; write it without separators of thousands"
    raise ParameterError(f"{place}: {text!r} is no number{remark}")
