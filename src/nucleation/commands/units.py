"""Values as people write them, "30 GPa" or 5um, checked against their declaration."""

from __future__ import annotations

import re
from collections.abc import Callable
from decimal import Decimal
from functools import cache
from typing import Any

import click
from click.shell_completion import CompletionItem

from ..model.quantities import ParameterError, Quantity, check

NUMBER = re.compile(r"\s*([+-]?(?:(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?|inf(?:inity)?))\s*(.*?)\s*")
UNIT = re.compile(r"[A-Za-zµμ%*/^0-9 ().\-]{1,40}")


@cache
def registry() -> Any:
    """The units library's registry; made when a unit is first read, since that takes a while.

    It reckons in decimal numbers: 5 um is exactly the number that 5e-6 m is.
    """
    import pint

    return pint.UnitRegistry(non_int_type=Decimal)


def parse(key: str, text: str, entry: Quantity) -> Any:
    """The value in SI units that a text means.

    Parameters
    ----------
    key : str
        Name of the parameter, for messages.
    text : str
        A number with or without a unit; a choice or an integer where the declaration says so.
    entry : Quantity
        The declaration.

    Raises
    ------
    ParameterError
        Naming key, value, unit and range, if it is no number, has another dimension or lies
        outside the range.
    """
    if entry.choices or entry.kind == "str":
        value: Any = text
    elif entry.kind == "int":
        value = _integer(text)
    else:
        value = _number(key, text, entry)
    check(key, value, entry)
    return value


def _integer(text: str) -> int | float | str:
    """The integer that a text is, or what else it is, to be refused."""
    if re.fullmatch(r"\s*[+-]?\d{1,18}\s*", text):
        return int(text)
    try:
        return float(text)
    except ValueError:
        return text


def _number(key: str, text: str, entry: Quantity) -> float:
    parts = NUMBER.fullmatch(text)
    if not parts:
        raise ParameterError(_refusal(key, text, entry, "it is no number with a unit"))
    return _converted(key, text, parts[1], parts[2], entry) if parts[2] else float(parts[1])


def _converted(key: str, text: str, number: str, unit: str, entry: Quantity) -> float:
    """The number in the declared unit."""
    import pint

    units = registry()
    try:
        if not UNIT.fullmatch(unit):
            raise ValueError(unit)
        given = units.Quantity(Decimal(number), units.parse_units(unit))
        return float(given.to(declared_unit(entry)).magnitude)
    except pint.DimensionalityError:
        wanted = "it has no dimension" if entry.unit == "1" else f"{entry.unit} is needed"
        reason = f"{unit} is a unit of {_dimension(given)}, but {wanted}"
    except Exception:  # the library raises errors of many kinds for units it can't read
        reason = f"{unit} is not a known unit"
    raise ParameterError(_refusal(key, text, entry, reason)) from None


def declared_unit(entry: Quantity) -> str:
    """A declaration's unit as the units library writes it."""
    return "dimensionless" if entry.unit == "1" else entry.unit.replace("MB", "megabyte")


def _dimension(given: Any) -> str:
    """The dimension of a quantity in words, ``length`` or ``mass / length ** 3``."""
    text = str(given.dimensionality).replace("[", "").replace("]", "")
    names = {
        "mass / length / time ** 2": "stress", "length / time": "velocity",
        "mass / length ** 3": "density", "dimensionless": "a pure number",
    }  # fmt: skip
    return names.get(text, text)


def _refusal(key: str, text: str, entry: Quantity, reason: str) -> str:
    rule = f"{entry.description} must lie in {bounds(entry)}"
    return f"{key} = {text!r} is not allowed: {rule}; {reason}"


def bounds(entry: Quantity) -> str:
    """The range and its unit."""
    unit = "" if entry.unit == "1" or entry.choices else f" {entry.unit}"
    return entry.range_text() + unit


class Declared(click.ParamType):
    """An option's value, read and checked by the declaration of its parameter."""

    def __init__(self, key: str, entry: Quantity) -> None:
        self.key, self.entry = key, entry
        self.name = "choice" if entry.choices else entry.kind

    def convert(self, value: Any, param: Any, ctx: Any) -> Any:
        """The value in SI units; fails with key, value, unit and range."""
        if not isinstance(value, str):
            return value
        try:
            return parse(self.key, value, self.entry)
        except ParameterError as error:
            self.fail(str(error), param, ctx)

    def get_metavar(self, param: click.Parameter, ctx: click.Context) -> str:
        """What stands for the value in the help."""
        if self.entry.choices:
            return f"[{'|'.join(self.entry.choices)}]"
        return "NUMBER" if self.entry.unit == "1" else f"VALUE[{self.entry.unit}]"

    def shell_complete(self, ctx: Any, param: Any, incomplete: str) -> list[CompletionItem]:
        """The choices."""
        return [CompletionItem(c) for c in self.entry.choices if c.startswith(incomplete)]


def option(
    *names: str, key: str, entry: Quantity, note: str = "", **settings: Any
) -> Callable[..., Any]:
    """A click option whose help, unit and range come from the declaration of a parameter."""
    text = entry.description
    if not entry.choices:
        kind = "an integer in" if entry.kind == "int" else "in"
        text += f"; {kind} {bounds(entry)}"
    return click.option(
        *names, key, type=Declared(key, entry), help=f"{text}{note and '; ' + note}", **settings
    )
