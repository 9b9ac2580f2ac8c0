"""Output that several commands share: lines that fit the terminal, values with units, JSON."""

import json
import math
import os
import re
import shutil
import sys
import textwrap
from collections.abc import Collection, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any

import click

from ..installed import DISTRIBUTION
from ..model.quantities import Quantity
from ..model.units import in_unit

Row = Sequence[str] | str
"""The cells of a row of a table, or a line between the rows."""

_LEAST_TERMINAL = 40


def with_unit(value: Any, entry: Quantity) -> str:
    """A value of a parameter (SI units) as text with its unit."""
    if isinstance(value, float):
        return in_unit(value, entry.unit, digits=6)
    return f"{value}{entry.unit_suffix}"


def _with_addresses(text: str) -> str:
    """The text with the addresses of pages, docs/drop.md, in an installation."""

    def address(cited: re.Match[str]) -> str:
        installed = Path(sys.prefix, "share", "doc", DISTRIBUTION, cited[1])
        in_checkout = (Path(__file__).parents[3] / cited[0]).exists()
        return str(installed) if installed.exists() and not in_checkout else cited[0]

    return re.sub(r"\bdocs/(\w+\.md)\b", address, text)


def wrapped(*texts: str, err: bool = False, indent: int | None = None) -> list[str]:
    """Texts wrapped to the terminal, if there is one, the standard error's with `err`.

    The further lines of each are indented by `indent` columns, by default two more than the first.
    """
    stream = sys.stderr if err else sys.stdout
    to_terminal = os.environ.get("COLUMNS") or (stream and stream.isatty())
    width = max(shutil.get_terminal_size().columns, _LEAST_TERMINAL) if to_terminal else 10**6
    lines: list[str] = []
    for text in map(_with_addresses, texts):
        hanging = len(text) - len(text.lstrip()) + 2 if indent is None else indent
        lines += textwrap.wrap(
            text,
            width,
            subsequent_indent=" " * min(hanging, width // 2),
            break_long_words=False,
            break_on_hyphens=False,
        ) or [""]
    return lines


def show(as_json: bool, found: Mapping[str, Any], lines: Iterable[str]) -> None:
    """Print the answer of a command: as JSON (null for NaN, text for infinity), or its lines."""
    click.echo(json.dumps(_plain(found), indent=2) if as_json else "\n".join(lines))


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


def warn(text: str) -> None:
    """Print a warning on the standard error."""
    click.echo("\n".join(wrapped(f"Warning: {text}", err=True)), err=True)


def table(rows: Sequence[Row], right: Collection[int] = ()) -> list[str]:
    """Rows of cells in columns, and lines between them; on a narrow terminal the last one wraps.

    The columns with the numbers `right` are aligned to the right.
    """
    cells = [row for row in rows if not isinstance(row, str)]
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    lines = []
    for row in rows:
        if isinstance(row, str):
            lines += wrapped(row)
            continue
        line, last = "", 0
        for number, (cell, width) in enumerate(zip(row, widths, strict=True)):
            last = len(line) + 2
            line += "  " + (cell.rjust(width) if number in right else cell.ljust(width))
        lines += wrapped(line.rstrip(), indent=last)
    return lines
