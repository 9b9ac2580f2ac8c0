"""Options of the command line for parameters, with units, ranges and help from declarations."""

from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

import click
from click.shell_completion import CompletionItem

from ..lengths.draws import DRAWS
from ..model.quantities import ParameterError, Quantity
from ..model.units import parse

_Function = TypeVar("_Function", bound=Callable[..., Any])

Decorator = Callable[[_Function], _Function]
"""A decorator that adds options to the function of a command."""

_Read = Callable[[str, str, Quantity], Any]
"""A function that reads a text, from the name of a parameter, the text and the declaration."""


def option(
    *names: str,
    key: str,
    entry: Quantity,
    note: str = "",
    read: _Read | None = None,
    **settings: Any,
) -> Decorator:
    """A click option with unit, range and help from the declaration of a parameter.

    Parameters
    ----------
    *names : str
        Names of the option, with their hyphens.
    key : str
        Name of the argument in the function of the command.
    entry : Quantity
        The declaration.
    note : str
        Addition to the help text.
    read : callable
        Reads a value from its text.
    **settings
        Other settings of :func:`click.option`.

    Returns
    -------
    callable
        A decorator.
    """

    def value_of(text: str) -> Any:
        try:
            return (read or parse)(key, text, entry)
        except ParameterError as error:
            raise click.BadParameter(str(error)) from None

    def completed(
        context: click.Context,
        parameter: click.Parameter,
        begun: str,
    ) -> list[CompletionItem | str]:
        return [choice for choice in entry.choices if choice.startswith(begun)]

    return click.option(
        *names,
        key,
        type=value_of,
        metavar=_metavar(entry),
        help=_help(entry, note),
        shell_complete=completed,
        **settings,
    )


def _metavar(entry: Quantity) -> str:
    """The form of a value in the help of an option."""
    if entry.choices:
        return f"[{'|'.join(entry.choices)}]"
    return "NUMBER" if entry.unit == "1" else f"VALUE[{entry.unit}]"


def _help(entry: Quantity, note: str) -> str:
    """Meaning and range of a parameter, and a note."""
    parts = [entry.description]
    if not entry.choices:
        kind = "an integer in" if entry.kind == "int" else "in"
        parts.append(f"{kind} {entry.bounds}")
    if note:
        parts.append(note)
    return "; ".join(parts)


def together(*options: Decorator) -> Decorator:
    """Several options as one decorator, in the order of the help."""

    def with_options(function: _Function) -> _Function:
        for add in reversed(options):
            function = add(function)
        return function

    return with_options


second_body_option = click.option(
    "--second-body",
    metavar="BODY",
    help="same: like the first; rigid; or MODULUS,POISSON[,HEIGHT], such as 60GPa,0.3; "
    "default same",
)

json_option = click.option("--json", "as_json", is_flag=True, help="print JSON, in SI units")

force_option = click.option("--force", is_flag=True, help="replace OUTPUT if it exists")

samples_option = click.option(
    "--samples",
    type=click.Path(exists=True, dir_okay=False, path_type=Path),
    help="CSV of joint samples: a column for each parameter, such as 'slip_distance (um)'",
)


def draws_option(usual: int) -> Decorator:
    """The option for the number of draws, with the default of a command."""
    return option(
        "--draws",
        key="draws",
        entry=DRAWS,
        note=f"of uncertain parameters, and most rows of --samples; default {usual}",
        default=str(usual),
    )


source_options = together(
    click.option(
        "--parameters",
        "file",
        type=click.Path(exists=True, dir_okay=False, path_type=Path),
        help="YAML or JSON file of parameters by the names of options, optionally with units; or "
        "the dataset of an earlier simulation",
    ),
    click.option(
        "--paper",
        is_flag=True,
        help="take other parameters from the paper: PMMA on a rigid base, with its friction law",
    ),
)
"""Options for the source of parameters that are not given as options."""
