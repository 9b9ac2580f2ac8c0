"""The fault of a command: from options, a file, samples, a dataset, a run or the paper."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import click

from ..fault import Fault
from ..fault.flat import LAW_NAMES, SECOND_BODY, declarations_of_flat, keywords, read_parameters
from ..lengths.draws import Draws, Range, draw, parse_range
from ..model.quantities import ParameterError
from ..theory.reading import required
from .options import Decorator, option, second_body_option, source_options, together
from .system_text import papers_line

NOTES = {
    "b": "this, --zeta or --zeta-over-a",
    "zeta": "zeta = b - a",
    "friction": "needed where the bodies differ, and for the length at the drop",
    "velocity": "for frequencies and the length at the drop",
    "height": "inf, a half-space, if left out",
    "second_height": "the first body's if left out",
    "far_side": "traction if left out",
    "second_far_side": "of the second body; the first one's if left out",
    "plane": "strain if left out",
    "density": "1200 of PMMA, the paper's, if left out",
    "initial_state": "20 D/V if left out",
    "friction_law": "none if left out: a and b are constant along the patch",
}
"""Additions to the help of options."""

_SOURCES = ("file", "paper")
_PER_DECADE = ("a", "b", "zeta")


def _options() -> list[Decorator]:
    """One option for each parameter of a fault, by its only name."""
    options: list[Decorator] = []
    for key, entry in declarations_of_flat().items():
        read = None if entry.worded else parse_range
        called = f"--{key.replace('_', '-')}"
        options.append(
            option(
                called,
                key=key,
                entry=entry,
                note=NOTES.get(key, ""),
                read=read,
            )
        )
    return options


fault_options = together(
    *_options(),
    second_body_option,
    click.option(
        "--per-decade", is_flag=True, help="a, b and zeta are given per decade, for log10"
    ),
    source_options,
)
"""One option for each parameter of a fault, and options for the source of other parameters."""

FAULT_OPTIONS = (*declarations_of_flat(), SECOND_BODY, "per_decade", *_SOURCES)


def samples_of(path: Path | None) -> dict[str, Any]:
    """The samples in a file, if there is one."""
    if path is None:
        return {}
    from ..fault.samples import read_samples

    return dict(read_samples(path))


class GivenFault(NamedTuple):
    """The fault of a command, and how it was given."""

    fault: Fault
    """With arrays of draws where parameters are uncertain."""
    names: frozenset[str]
    """The parameters that are given."""
    drawn: Draws | None
    """The draws, if parameters are uncertain."""
    papers: list[str]
    """A line with the parameters that are the paper's, or none."""

    @property
    def uncertain(self) -> list[str]:
        """Names of the uncertain parameters."""
        return list(self.drawn.uncertain) if self.drawn else []


def given_fault(
    options: Mapping[str, Any],
    samples: Mapping[str, Any],
    draws: int,
    sought: Mapping[str, float] = {},
) -> GivenFault:
    """The fault that options define (SI units, None: not given), and samples by name.

    A parameter that is `sought` need not be given.
    """
    file, paper = options["file"], options["paper"]
    base = _base(options)
    given = {} if base or file is None else read_parameters(file, _names_of_runs())
    own = {k: x for k, x in options.items() if x is not None and k in FAULT_OPTIONS}
    own = {k: x for k, x in own.items() if k not in (*_SOURCES, "per_decade")}
    for name in samples:
        if name in own:
            raise ParameterError(f"{name} is given twice: as an option and in the samples")
    own |= samples
    if options["per_decade"]:
        own |= {name: _natural(own[name]) for name in own.keys() & {*_PER_DECADE}}
    given |= own
    names = frozenset(given)
    for name, value in sought.items():
        if name not in given and base is None:
            given[name] = value
    drawn = None
    if any(isinstance(x, Range) or x is samples.get(k, None) for k, x in given.items()):
        drawn = draw(given, draws)
        given = drawn.values
    if base is None:
        if paper:
            base = _paper()
        else:
            _require(given, file)
    known = keywords(given)
    fault = base.replace(**known) if base else Fault(**known)
    papers = papers_line(names) if paper else []
    return GivenFault(fault, names, drawn, papers)


def _names_of_runs() -> set[str]:
    """Names of parameters that only simulations have: one file serves all commands."""
    from ..run.names import parameters

    return parameters().keys() - {*declarations_of_flat(), SECOND_BODY}


def _natural(value: Any) -> Any:
    """A coefficient of log10, or its range or samples, as one of the natural logarithm."""
    if not isinstance(value, Range):
        return value / math.log(10.0)
    return Range(*(end / math.log(10.0) for end in (value, value.low, value.high)))


def _paper() -> Fault:
    from ..fault.paper import PAPER

    return PAPER


def _base(options: Mapping[str, Any]) -> Fault | None:
    """The fault of a dataset of a simulation, if one is given."""
    file = options["file"]
    if file is None or file.suffix != ".nc":
        return None
    from .sources import base_of

    run = base_of(options)
    return None if run is None else run.fault


def _require(given: Mapping[str, Any], file: Path | None) -> None:
    """Refuse a fault that lacks a parameter, with the option for it."""
    law = given.get("friction_law") or given.keys() & {*LAW_NAMES}
    for name in required(given.get("plane", "strain")):
        if name not in given and not (law and name == "a"):
            place = f"in {file}" if file else "or --parameters FILE"
            raise ParameterError(
                f"{name} is missing: give --{name.replace('_', '-')} {place}, or take all other "
                "parameters from the paper by --paper"
            )
