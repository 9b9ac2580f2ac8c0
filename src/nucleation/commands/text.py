"""Output that several commands share: lines that fit the terminal, events, JSON."""

import json
import math
import os
import re
import shlex
import shutil
import sys
import textwrap
from collections.abc import Collection, Iterable, Mapping, Sequence
from itertools import zip_longest
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..model.quantities import ParameterError
from .pages import with_addresses
from .unit_text import with_unit

if TYPE_CHECKING:
    import xarray as xr

    from ..run.run import Run

Row = Sequence[str] | str
"""The cells of a row of a table, or a line between the rows."""

_GAP = 2
"""Blanks between the columns of a table, and before each of its rows."""

_INSEPARABLE = re.compile(r"(?<=[=<>]) | (?=[=<>] )|(?<=\d) (?=(?:[numckMG]?(?:Pa|m|s)|%|L_c)\b)")
"""Blanks beside relations, and between a number and its unit."""

_LEAST_COLUMN = 10
_LEAST_TERMINAL = 40


def _terminal_width(err: bool = False) -> int | None:
    """Columns of the terminal, or of COLUMNS; None if the output is a file or a pipe."""
    stream = sys.stderr if err else sys.stdout
    if not (os.environ.get("COLUMNS") or (stream and stream.isatty())):
        return None
    return max(shutil.get_terminal_size().columns, _LEAST_TERMINAL)


def wrapped(*texts: str, err: bool = False) -> list[str]:
    """Texts wrapped to the terminal; the further lines of each are indented by two blanks more.

    Parameters
    ----------
    *texts : str
        Pages that they cite get addresses at which the user finds them.
    err : bool
        Whether they are for the standard error.

    Returns
    -------
    list of str
    """
    width = _terminal_width(err)
    lines: list[str] = []
    for text in map(with_addresses, texts):
        if width is None or len(text) <= width:
            lines.append(text)
            continue
        indent = len(text) - len(text.lstrip())
        joined = _INSEPARABLE.sub("\N{NO-BREAK SPACE}", text)
        parts = textwrap.wrap(
            joined,
            width,
            subsequent_indent=" " * (indent + 2),
            break_long_words=False,
            break_on_hyphens=False,
        )
        lines += [part.replace("\N{NO-BREAK SPACE}", " ") for part in parts]
    return lines


def show(as_json: bool, found: Mapping[str, Any], lines: Iterable[str]) -> None:
    """Print the answer of a command: as JSON, or its lines."""
    click.echo(to_json(found) if as_json else "\n".join(lines))


def warn(text: str) -> None:
    """Print a warning on the standard error."""
    click.echo("\n".join(wrapped(f"Warning: {text}", err=True)), err=True)


def printable(text: str) -> str:
    """A text of a file without control characters, which a terminal would obey."""
    return "".join(c if c.isprintable() else repr(c)[1:-1] for c in text)


def table(
    rows: Sequence[Row],
    right: Collection[int] = (),
) -> list[str]:
    """Rows of cells in columns; on a narrow terminal the widest columns are narrowed.

    Parameters
    ----------
    rows : sequence of sequences of str, or of str
        Cells, the same number in each row; a text is a line between the rows.
    right : collection of int
        Numbers of the columns that are aligned to the right.

    Returns
    -------
    list of str
    """
    rows = [row if isinstance(row, str) else [with_addresses(cell) for cell in row] for row in rows]
    cells = [row for row in rows if not isinstance(row, str)]
    widths = _column_widths(cells)
    lines = []
    for row in rows:
        if isinstance(row, str):
            lines += wrapped(row)
            continue
        parts = [
            textwrap.wrap(cell, width, break_long_words=False, break_on_hyphens=False) or [""]
            for cell, width in zip(row, widths, strict=True)
        ]
        for line in zip_longest(*parts, fillvalue=""):
            lines.append(_table_line(line, widths, right))
    return lines


def _column_widths(rows: Sequence[Sequence[str]]) -> list[int]:
    """Widths of columns; while they exceed the terminal, the widest one that can be narrowed is.

    Words are broken only where no column can be narrowed otherwise.
    """
    columns = list(zip(*rows, strict=True))
    widths = [max(1, *map(len, column)) for column in columns]
    longest_words = [max(map(len, " ".join(column).split()), default=1) for column in columns]
    terminal = _terminal_width()
    if terminal is None:
        return widths
    for least in (longest_words, [_LEAST_COLUMN] * len(widths)):
        for column in sorted(range(len(widths)), key=lambda column: -widths[column]):
            excess = sum(widths) + _GAP * len(widths) - terminal
            room = widths[column] - least[column]
            widths[column] -= max(0, min(excess, room))
    return widths


def _table_line(parts: Iterable[str], widths: Sequence[int], right: Collection[int]) -> str:
    line = ""
    for column, (part, width) in enumerate(
        zip(
            parts,
            widths,
            strict=True,
        )
    ):
        aligned = part.rjust(width) if column in right else part.ljust(width)
        line += " " * _GAP + aligned
    return line.rstrip()


def parameter_lines(run: "Run") -> list[str]:
    """The parameters of a run, one in a line, with unit and meaning."""
    from ..run.names import parameters, sections

    values = run.to_dict()
    rows: list[Row] = []
    for section, names in sections().items():
        rows.append(f"{section}:")
        for name in names:
            if name in values:
                entry = parameters()[name]
                meaning = re.split("[;:,]", entry.description)[0]
                rows.append((name, with_unit(values[name], entry), meaning))
    return table(rows)


def event_lines(
    found: dict[str, float],
    critical_length: float,
) -> list[str]:
    """Onset of the event and length of the patch then, with their ranges over the definitions.

    Parameters
    ----------
    found : dict
        The event of a run, from :func:`nucleation.extraction.extraction.extract`.
    critical_length : float
        L_c of the theory (m); NaN if homogeneous sliding is stable.

    Returns
    -------
    list of str
    """
    if math.isnan(found["onset_time"]):
        return ["no event: the force has not dropped"]
    onset, length = (_with_spread(found, name) for name in ("onset_time", "length"))
    over_theory = ""
    if not math.isnan(critical_length):
        over_theory = f", {found['length'] / critical_length:.3g} L_c"
    return [f"onset: {onset} s", f"L: {length} m{over_theory}"]


def _with_spread(
    found: dict[str, float],
    name: str,
) -> str:
    """A value of an event with its range over the definitions."""
    low, high = found[f"{name}_low"], found[f"{name}_high"]
    return f"{found[name]:.4g} ({low:.4g} to {high:.4g})"


def outcome(dataset: "xr.Dataset") -> dict[str, Any]:
    """The status and the event of a simulation, for JSON, in SI units."""
    from ..extraction.extraction import extract

    return {
        "status": dataset.attrs["status"],
        "steps": int(dataset.attrs["steps"]),
        "wall_seconds": float(dataset.attrs["wall_seconds"]),
        "simulated_time": float(dataset["step_time"][-1]),
        "event": extract(dataset),
    }


def to_json(found: Mapping[str, Any]) -> str:
    """The answer of a command as JSON: null for NaN, text for infinity."""
    return json.dumps(_plain(found), indent=2)


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {key: _plain(one) for key, one in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    if value is None or isinstance(value, (str, int)):
        return value
    number = float(value)
    if math.isnan(number):
        return None
    return "inf" if math.isinf(number) else number


def require_writable(
    path: Path,
    force: bool,
) -> None:
    """Refuse a file that can't be written, or exists and may not be replaced.

    Parameters
    ----------
    path : Path
        The file.
    force : bool
        Whether an existing file may be replaced.

    Raises
    ------
    ParameterError
        If the file can't be written.
    """
    if path.exists() and not force:
        raise ParameterError(f"{path} exists already; --force replaces it")
    folder = path.absolute().parent
    if not folder.exists():
        make = shlex.join(["mkdir", "-p", str(folder)])
        raise ParameterError(f"{path} can't be written: there is no directory {folder}; {make}")
    if not folder.is_dir() or not os.access(folder, os.W_OK):
        raise ParameterError(f"{path} can't be written: {folder} is no writable directory")
