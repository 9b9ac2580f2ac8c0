"""What a command is given: options of parameters, and the fault or the run that they define.

Further parameters are those of a file or the paper's.
"""

from __future__ import annotations

import contextlib
import warnings
from collections.abc import Callable, Collection, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypeVar

import click

from ..fault import PAPER, Fault
from ..fault.flat import LAW_NAMES, keywords, read_parameters
from ..fault.parameters import fault_parameters, parameters
from ..fault.setting import friction, second_body
from ..lengths.draws import Draws, draw_samples
from ..lengths.ranges import Range, parse_range
from ..model.friction.constants import CONSTANTS
from ..model.hints import ImplausibleWarning
from ..model.perturbations import KINDS
from ..model.quantities import ParameterError, Quantity, declarations
from ..model.units import parse
from ..theory.evaluation import required
from ..theory.values import QUANTITIES
from .text import warn, with_unit

if TYPE_CHECKING:
    from ..run.run import Run

_Function = TypeVar("_Function", bound=Callable[..., Any])

Decorator = Callable[[_Function], _Function]
"""A decorator that adds options to the function of a command."""

NOTES = {
    "b": "this, --zeta or --zeta-over-a",
    "zeta": "zeta = b - a",
    "friction": "needed where the bodies differ, and for the length at the drop",
    "velocity": "for frequencies and the length at the drop",
    "height": "inf, a half-space, if left out",
    "second_body": "deformable, like the first, if left out",
    "second_height": "the first body's if left out",
    "far_side": "free if left out",
    "second_far_side": "of the second body; the first one's if left out",
    "plane": "strain if left out",
    "density": "1200 of PMMA, the paper's, if left out",
    "initial_state": "20 D/V if left out",
    "friction_law": "none if left out: a and b are constant along the patch",
}
"""Additions to the help of options."""

_OF_FAULT = {
    *("shear_modulus", "poisson_ratio", "normal_stress", "slip_distance", "velocity"),
    *("friction", "a", "b", "zeta", "zeta_over_a", "second_shear_modulus"),
}
"""Constants of which one at least makes a fault another one than the paper's."""


def option(
    key: str,
    entry: Quantity,
    note: str = "",
    read: Callable[[str, str, Quantity], Any] = parse,
    **settings: Any,
) -> Decorator:
    """A click option with unit, range and help of a parameter; `read` makes a value of its text."""

    def value_of(text: str) -> Any:
        try:
            return read(key, text, entry)
        except ParameterError as error:
            raise click.BadParameter(str(error)) from None

    metavar = "NUMBER" if entry.unit == "1" else f"VALUE[{entry.unit}]"
    parts = [entry.description]
    if entry.choices:
        metavar = f"[{'|'.join(entry.choices)}]"
    else:
        parts.append(f"{'an integer in' if entry.kind == 'int' else 'in'} {entry.bounds}")
    return click.option(
        f"--{key.replace('_', '-')}",
        key,
        type=value_of,
        metavar=metavar,
        help="; ".join([*parts, note] if note else parts),
        cls=_Once,
        **settings,
    )


class _Once(click.Option):
    """An option that is refused if it is given twice, in place of the last value in silence."""

    def __init__(self, *words: Any, **settings: Any) -> None:
        if "default" in settings:
            settings["default"] = [settings["default"]]
        settings["multiple"] = True
        super().__init__(*words, **settings)

    def process_value(self, ctx: click.Context, value: Any) -> Any:
        given = super().process_value(ctx, value) or [None]
        if len(given) > 1:
            values = " and ".join(str(one) for one in given)
            raise click.UsageError(f"{self.opts[0]} is given twice: {values}", ctx)
        return given[0]


def options_of(
    entries: Mapping[str, Quantity],
    notes: Mapping[str, str] = NOTES,
    read: Callable[[str, str, Quantity], Any] = parse,
) -> Decorator:
    """One option for each parameter, by its only name."""
    options = [option(key, entry, notes.get(key, ""), read) for key, entry in entries.items()]
    return together(*options)


def together(*options: Decorator) -> Decorator:
    """Several options as one decorator, in the order of the help."""

    def with_options(function: _Function) -> _Function:
        for add in reversed(options):
            function = add(function)
        return function

    return with_options


json_option = click.option("--json", "as_json", is_flag=True, help="print JSON, in SI units")

source_options = together(
    click.option(
        "--parameters",
        "file",
        cls=_Once,
        type=click.Path(exists=True, dir_okay=False, path_type=Path),
        help="YAML or JSON file of parameters by the names of options, optionally with units",
    ),
    click.option(
        "--paper",
        is_flag=True,
        help="take other parameters from the paper: PMMA on a rigid base, with its friction law",
    ),
)
"""Options for the source of parameters that are not given as options."""


def fault_options(function: _Function) -> _Function:
    """One option for each parameter of a fault, and options for the source of other parameters."""
    own = options_of(fault_parameters(), read=parse_range)
    return together(own, source_options)(function)


def _given(
    options: Mapping[str, Any], known: Mapping[str, Quantity], ignored: Collection[str] = ()
) -> dict[str, Any]:
    """The known values of options and of their file, in SI units."""
    own = {k: x for k, x in options.items() if x is not None and k in known}
    file = options["file"]
    return read_parameters(file, ignored, known) | own if file else own


def given_fault(
    options: Mapping[str, Any], draws: int = 0, sought: Mapping[str, float] = {}
) -> tuple[Fault, frozenset[str], Draws | None]:
    """The fault that options define (None: not given), names of what is given, and its draws.

    There are draws, and arrays in the fault, if there are ranges. A parameter that is `sought` need
    not be given.
    """
    known = fault_parameters()
    ignored: Collection[str] = ()
    if options["file"]:  # one file serves all commands
        ignored = parameters().keys() - known.keys()
    given = _given(options, known, ignored)
    names = frozenset(given)
    base = PAPER if options["paper"] else None
    if base is None:
        given = {**sought, **given}
        _require_all(given, options["file"])
    drawn = None
    if any(isinstance(x, Range) for x in given.values()):
        if not draws:
            _refuse_ranges(given)
        drawn = draw_samples(given, draws)
        given = drawn.values
    own = keywords(given)
    return (base.replace(**own) if base else Fault(**own)), names, drawn


def _require_all(given: Mapping[str, Any], file: Path | None) -> None:
    """Raise a ParameterError, with what to do, if a fault lacks a parameter without a default."""
    law = given.get("friction_law") or given.keys() & {*LAW_NAMES}
    for name in required(given.get("plane", "strain")):
        if name not in given and not (law and name == "a"):
            place = f"in {file}" if file else "or --parameters FILE"
            raise ParameterError(
                f"{name} is missing: give --{name.replace('_', '-')} {place}, or take all "
                "other parameters from the paper by --paper"
            )


def given_run(options: Mapping[str, Any]) -> tuple[Run, frozenset[str], bool]:
    """The run that options define (None: not given), names of what is given, if it is the paper's.

    The sizes of the block and the times follow from the theory. Without any constant of a fault it
    is the paper's.
    """
    from ..run.run import PAPER_RUN, Run

    given = _given(options, parameters())
    names = frozenset(given)
    if options["file"]:
        _refuse_ranges(given)
    if "seed" in given and given.get("perturbation", "none") == "none":
        raise ParameterError(
            f"seed = {given['seed']} is not allowed with perturbation = none, which has no "
            f"realisations: perturbation must be one of {', '.join(KINDS)}"
        )
    flat = fault_parameters()
    of_fault = {name: x for name, x in given.items() if name in flat}
    others = {name: x for name, x in given.items() if name not in flat}
    if options["paper"] or not _OF_FAULT & names:
        paper = PAPER_RUN.replaced(**of_fault)
        return Run.sized(paper.fault, paper.law, **others), names, True
    _require_all(of_fault, options["file"])
    return Run.sized(Fault(**keywords(of_fault)), **others), names, False


def _refuse_ranges(given: Mapping[str, Any]) -> None:
    for name, value in given.items():
        if isinstance(value, Range):
            raise ParameterError(
                f"{name}: a range is not allowed here, where each parameter has one value; "
                "`nucleation length` takes ranges"
            )


def parameters_of(fault: Fault) -> dict[str, Any]:
    """All parameters of a fault that are not None, by name."""
    values = {name: getattr(fault, name) for name in QUANTITIES}
    return {name: value for name, value in values.items() if value is not None}


def system_of_fault(
    fault: Fault, given: Collection[str], paper: bool, sought: str = ""
) -> list[str]:
    """The fault that a command computes: the parameters that are given, and all others.

    With `paper` the others are the paper's. Those of a second body that are not given and like the
    first one's are a sentence. The parameter that is `sought` has no value yet.
    """
    named = {*given, sought}
    weakenings = {*CONSTANTS[2:]}
    if weakenings & named:
        named |= weakenings
    texts: dict[bool, list[str]] = {True: [], False: []}
    for name, value in parameters_of(fault).items():
        first = name.removeprefix("second_")
        if first == name or name in named or value != getattr(fault, first):
            text = "to find" if name == sought else with_unit(value, QUANTITIES[name])
            texts[name in named].append(f"{name} = {text}")
    law = fault.friction_law
    if law is not None:
        for name, entry in declarations(type(law)).items():
            if name not in (*QUANTITIES, *law.set_by_expansion):
                texts[entry.name in named].append(
                    f"{entry.name} = {with_unit(getattr(law, name), entry)}"
                )
    heads = {True: "Given", False: "Not given, so the paper's" if paper else "Others"}
    lines = [f"{heads[which]}: {', '.join(own)}." for which, own in texts.items() if own]
    lines += [second_body(fault), friction(fault)]
    if fault.plane == "stress":  # which has no thickness to compare with
        lines.append("Plane stress holds for plates that are much thinner than these lengths.")
    return lines


@contextlib.contextmanager
def printed_warnings() -> Iterator[None]:
    """Print warnings of implausible magnitudes on the standard error, each once."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", ImplausibleWarning)
        yield
    for text in dict.fromkeys(str(warning.message) for warning in caught):
        warn(text)
