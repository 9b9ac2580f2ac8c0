"""Values of a configuration with their unit, ``30 GPa`` or ``1/3``, as numbers in SI units."""

import re
from typing import Any

from ..model.quantities import ParameterError, Quantity
from ..model.units import parse
from . import schema

BEGINS = re.compile(r"\s*[+-]?[\d.]")
"""How a text begins that is meant as a number."""


def read_units(values: Any) -> tuple[Any, list[str]]:
    """A configuration as read from YAML, with numbers in place of texts that have a unit.

    A text that is a bare number, such as ``1e-8``, is left to be refused: YAML takes it for text
    where its author may not. So is one that does not begin as a number.

    Returns
    -------
    values : the same nested dictionaries and lists, copied.
    problems : of texts that are no numbers, or of another dimension, a line for each.
    """
    problems: list[str] = []
    return _read(values, (), problems), problems


def _read(value: Any, path: tuple[Any, ...], problems: list[str]) -> Any:
    if isinstance(value, dict):
        return {key: _read(own, (*path, key), problems) for key, own in value.items()}
    if isinstance(value, list):
        return [_read(own, (*path, number), problems) for number, own in enumerate(value)]
    entry = schema.entry_at(path) if isinstance(value, str) and BEGINS.match(value) else None
    if entry is None or not _is_quantity(entry) or _bare(value):
        return value
    try:
        return parse(_key(path), value, entry)
    except ParameterError as error:
        problems.append(str(error))
        return _allowed(entry)


def _is_quantity(entry: Quantity) -> bool:
    """Whether a parameter is a number that may have a unit."""
    return not entry.choices and entry.kind not in ("str", "int")


def _bare(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _allowed(entry: Quantity) -> float:
    """Some allowed number, in the place of one that was told of already."""
    low, high = max(entry.low, -1e300), min(entry.high, 1e300)
    return 0.5 * low + 0.5 * high


def _key(path: tuple[Any, ...]) -> str:
    text = "".join(f"[{part}]" if isinstance(part, int) else f".{part}" for part in path)
    return text.lstrip(".")
