"""Options of the command line whose values are parameters, with units as people write them."""

from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from typing import Any

import click

from ..configuration.study_names import study_parameters
from ..model.friction.law import Friction
from ..model.friction.registry import LAWS
from ..model.parameters import Parameters, names
from ..model.quantities import ParameterError, Quantity
from ..model.units import bounds, parse
from .text import with_unit

Decorator = Callable[[Callable[..., Any]], Callable[..., Any]]


def option(
    *names: str, key: str, entry: Quantity, note: str = "", read: Callable[..., Any] = parse,
    **settings: Any,
) -> Decorator:  # fmt: skip
    """A click option whose help, unit and range come from the declaration of a parameter."""

    def value_of(text: str) -> Any:
        try:
            return read(key, text, entry)
        except ParameterError as error:
            raise click.BadParameter(str(error)) from None

    help, metavar = entry.description, f"[{'|'.join(entry.choices)}]"
    if not entry.choices:
        metavar = "NUMBER" if entry.unit == "1" else f"VALUE[{entry.unit}]"
        help += f"; {'an integer in' if entry.kind == 'int' else 'in'} {bounds(entry)}"
    return click.option(
        *names, key, type=value_of, metavar=metavar, help=f"{help}; {note}" if note else help,
        shell_complete=lambda ctx, param, begun: [c for c in entry.choices if c.startswith(begun)],
        **settings,
    )  # fmt: skip


def together(*options: Decorator) -> Decorator:
    """Several options as one decorator, in the order of the help."""

    def with_options(function: Callable[..., Any]) -> Callable[..., Any]:
        for add in reversed(options):
            function = add(function)
        return function

    return with_options


def words(name: str) -> list[str]:
    """The options for a parameter: its full name, its other names, and the one it goes by."""
    known = names()
    full = known.full(name)
    called = dict.fromkeys([*known.others(full), known.short(full)])
    ambiguous = ("f", "kind", "law")  # which would be read as something else
    return [f"--{word.replace('_', '-')}" for word in called if word not in ambiguous]


second_body_option = click.option(
    "--second-body", metavar="BODY",
    help="same: like the first; rigid; or MODULUS,POISSON[,HEIGHT], such as 60GPa,0.3; "
    "default same",
)  # fmt: skip

source_options = together(
    click.option(
        "--parameters", "file", type=click.Path(exists=True, dir_okay=False, path_type=Path),
        help="YAML or JSON file of parameters by the names of options, with units if you like; "
        "or the dataset of an earlier simulation",
    ),
    click.option("--run", "run_id", metavar="ID", help="a run of the configuration, by its id"),
    click.option(
        "--config", type=click.Path(dir_okay=False), default="config/config.yaml",
        show_default=True, help="the configuration that --run is in",
    ),
)  # fmt: skip
"""Where other parameters are from."""


def flat(parameters: Parameters) -> dict[str, Any]:
    """Parameters by their names in studies, but for those that are left out."""
    known, given = names(), parameters.named().items()
    return {known.short(full): value for full, value in given if value is not None}


def parameter_options(chosen: Collection[str], changed: Mapping[str, Any] = {}) -> Decorator:
    """Options for parameters by their names in studies, some with `changed` defaults."""
    usual: dict[str, Any] = {}
    for law in (*LAWS, Friction().law):
        usual |= flat(Parameters(friction=Friction(law=law)))
    known = names()
    notes = {
        k: f"default {with_unit(v, known[known.full(k)])}" for k, v in (usual | changed).items()
    }
    notes["length"] = "6 critical lengths if left out"
    entries = {name: entry for name, entry in study_parameters().items() if name in chosen}
    return together(*(
        second_body_option if name == "second_body"
        else option(*words(name), key=name, entry=entry, note=notes.get(name, ""))
        for name, entry in entries.items()
    ))  # fmt: skip
