"""Options of the command line whose values are parameters, with units as people write them."""

from collections.abc import Callable
from typing import Any

import click
from click.shell_completion import CompletionItem

from ..model.quantities import ParameterError, Quantity
from ..model.units import bounds, parse


class Declared(click.ParamType):
    """An option's value, read and checked by the declaration of its parameter."""

    def __init__(self, key: str, entry: Quantity, read: Callable[..., Any] = parse) -> None:
        self.key, self.entry, self.read = key, entry, read
        self.name = "choice" if entry.choices else entry.kind

    def convert(self, value: Any, param: Any, ctx: Any) -> Any:
        """The value in SI units; fails with key, value, unit and range."""
        if not isinstance(value, str):
            return value
        try:
            return self.read(self.key, value, self.entry)
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
    *names: str, key: str, entry: Quantity, note: str = "", read: Callable[..., Any] = parse,
    **settings: Any,
) -> Callable[..., Any]:  # fmt: skip
    """A click option whose help, unit and range come from the declaration of a parameter."""
    text = entry.description
    if not entry.choices:
        kind = "an integer in" if entry.kind == "int" else "in"
        text += f"; {kind} {bounds(entry)}"
    return click.option(
        *names,
        key,
        type=Declared(key, entry, read),
        help=f"{text}{note and '; ' + note}",
        **settings,
    )
