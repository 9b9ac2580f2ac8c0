"""``nucleation specimen``: values of one parameter at which a nucleation length fits a specimen."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click
import numpy as np

from ..lengths.answer import Answer, Lengths
from ..lengths.draws import QUANTILES
from ..lengths.specimen import CRITERIA, NAMES, SPECIMEN, UNKNOWNS, Fit, Interval, at_share
from ..theory.status import STABLE as STABLE_SLIDING
from ..theory.values import QUANTITIES, arrays_of
from . import DONE, EXIT_CODES, STABLE
from .faults import GivenFault, fault_options, given_fault, samples_of
from .options import draws_option, json_option, option, samples_option
from .progress import progress_of
from .quantiles import drawn_size, median_fault
from .system_text import plane_in_words, printed_warnings, system_of_fault
from .text import show, wrapped
from .unit_text import in_unit

if TYPE_CHECKING:
    from ..fault import Fault

_DIGITS_OF_SHARES = 2  # as many as some hundred draws leave
_SHORTEST_EVENT = 0.7
"""Least length of a simulated block with an event, over L_s: its far end is free, and the theory's
block is long (PMMA plates 10 cm high and 12 cm long under 1 MPa)."""


@click.command("specimen", epilog=EXIT_CODES)
@option("--length", key="length", entry=SPECIMEN, required=True)
@click.option(
    "--find",
    "unknown",
    type=click.Choice(list(UNKNOWNS.choices)),
    default="normal_stress",
    show_default=True,
    help="the parameter to find; if its value is given too, it is judged",
)
@click.option(
    "--criterion",
    type=click.Choice(list(CRITERIA)),
    default="critical",
    show_default=True,
    help="the length that has to fit: L_c of homogeneous sliding, or L_s of a patch that is "
    "pushed at its edge",
)
@fault_options
@samples_option
@draws_option(200)
@json_option
def command(
    length: float,
    unknown: str,
    criterion: str,
    as_json: bool,
    samples: Path | None,
    draws: int,
    **options: Any,
) -> int:
    """Normal stress, slip distance or modulus at which a nucleation length fits into a specimen.

    The inverse of `length`. With the value of the parameter it is judged by L_s and by L, at which
    the force drops; L needs --velocity and --friction. With a range "5um (3 to 10)", the median and
    the quantiles of 5 and 95 %, or with --samples it prints the values at which shares of all draws
    fit.

    \b
    Example:
      nucleation specimen --length 20cm --height 10cm --shear-modulus 3.1GPa \\
          --poisson-ratio 0.35 --a 0.0068 --zeta 0.016 --slip-distance 0.5um
    """
    columns = samples_of(samples)
    any_value = {unknown: _middle(unknown)}
    with printed_warnings():
        given = given_fault(options, columns, draws, sought=any_value)
        if given.drawn:
            return _print_shares(given, length, unknown, criterion, as_json)
        fault = given.fault
        fit = fault.specimen(unknown, length, criterion)
        is_given = unknown in given.names
        found = fault.lengths() if is_given else None
    system = system_of_fault(fault, given.names, given.papers, "" if is_given else unknown)
    lines = [*system, ""]
    judged = None
    if found is not None:
        verdict = _verdict(length, found)
        judged = {"value": fault.single(unknown), "verdict": verdict, **_numbers(found)}
        lines += [f"At {unknown} = {in_unit(fault.single(unknown), fit.unit)} {verdict}."]
    lines += _fit_lines(_fits(length, criterion, fault), fit)
    everything = {
        "system": system,
        "specimen": length,
        "criterion": criterion,
        **fit._asdict(),
        "given": judged,
        "plane": fault.plane,
    }
    show(as_json, everything, wrapped(*lines))
    return DONE if fit.exists else STABLE


def _middle(unknown: str) -> float:
    low, high = _searched(unknown)
    return math.sqrt(low * high)


def _searched(unknown: str) -> Interval:
    from ..model.hints import RANGES

    return RANGES[unknown]


_JUDGED = ("critical_length", "stability_length", "drop_length")


def _numbers(found: Lengths) -> dict[str, Any]:
    """L_c, L_s and L for JSON."""
    return {key: {n: _plain(x) for n, x in found[key]._asdict().items()} for key in _JUDGED}


def _plain(value: Any) -> Any:
    return value if isinstance(value, str) else float(value)


def _verdict(length: float, found: Lengths) -> str:
    """Whether a specimen of a length (m) nucleates, as far as it is shown."""
    critical, stability, drop = (found[key] for key in _JUDGED)
    if critical.status == STABLE_SLIDING:
        return f"it does not nucleate: {critical.reason}"
    if not stability.exists:
        return f"whether it nucleates is not known: there is no L_s, {stability.reason}"
    known = f"L_s is {_with_range(stability)}, {stability.value / length:.3g} of the specimen"
    if drop.exists:
        known += f", and L at the drop {_with_range(drop)}"
    else:
        known += f"; L at the drop is not known ({drop.reason})"
    if drop.exists and length >= drop.high:
        return f"it nucleates: {known}"
    if length >= stability.value:
        return f"it can nucleate: {known}"
    return (
        f"whether it nucleates is not known: {known}; these are lengths in long blocks, and "
        f"simulated blocks had events from {_SHORTEST_EVENT:g} L_s on, where the end is free"
    )


def _with_range(answer: Answer) -> str:
    text = f"{answer.value:.4g} m"
    if answer.high > 1.01 * answer.low:
        text += f" ({answer.low:.4g} to {answer.high:.4g} m)"
    return text


class _Shares(NamedTuple):
    """The values at which a length fits in shares of the draws."""

    unknown: str
    unit: str
    searched: Interval
    intervals: dict[float, tuple[Interval, ...]]
    draws: int
    invalid: int
    outside: tuple[str, ...]
    share: float
    """Of the draws in which the length fits at the given value; NaN without a value."""


def _shares(
    given: GivenFault,
    length: float,
    unknown: str,
    criterion: str,
) -> _Shares:
    drawn, fault = given.drawn, given.fault
    assert drawn is not None
    arrays = {name: x for name, x in arrays_of(fault).items() if name != unknown}
    size = drawn_size(given)
    report = progress_of("draws")
    fits = []
    for i in range(size):
        one = {name: float(x[i]) for name, x in arrays.items()}
        single = fault.replace(**one | {unknown: _middle(unknown)})
        fits.append(single.specimen(unknown, length, criterion))
        report(i + 1, size)
    share = math.nan
    if unknown in given.names:
        found = getattr(fault, CRITERIA[criterion])()
        share = float(np.mean(np.asarray(found) <= length))
    return _Shares(
        unknown=unknown,
        unit=fits[0].unit,
        searched=fits[0].searched,
        intervals={q: at_share(fits, q) for q in QUANTILES},
        draws=drawn.total,
        invalid=sum(drawn.invalid.values()),
        outside=tuple(drawn.invalid),
        share=share,
    )


def _print_shares(
    given: GivenFault, length: float, unknown: str, criterion: str, as_json: bool
) -> int:
    """Print the values at which shares of all draws fit, and return the exit code."""
    found = _shares(given, length, unknown, criterion)
    fault = given.fault
    middle = median_fault(fault)
    sought = "" if unknown in given.names else unknown
    system = system_of_fault(middle, given.names, given.papers, sought)
    everything = {
        "system": system,
        "specimen": length,
        "criterion": criterion,
        **found._asdict(),
        "intervals": {f"{share:g}": ends for share, ends in found.intervals.items()},
    }
    lines = _share_lines(_fits(length, criterion, middle), found)
    show(as_json, everything, wrapped(*system, "", *lines))
    return DONE if any(found.intervals.values()) else STABLE


def _fits(length: float, criterion: str, fault: Fault) -> str:
    """The beginning of the sentence that ends with values."""
    plane = plane_in_words(fault.plane)
    return f"{NAMES[criterion]} fits into {in_unit(length, 'm')}, in {plane},"


def _share_lines(fits: str, found: _Shares) -> list[str]:
    """The values at which shares of the draws fit."""
    drawn = f"{found.draws} draws: {found.invalid} left out"
    if found.outside:
        drawn += f" ({', '.join(found.outside)} not allowed)"
    lines = [drawn]
    if not math.isnan(found.share):
        lines.append(f"At the given {found.unknown} it fits in {found.share:.0%} of them.")
    lines.append(fits)
    for share, intervals in found.intervals.items():
        texts = [_interval(found, ends, _DIGITS_OF_SHARES) for ends in intervals]
        values = f"if {' or '.join(texts)}" if texts else "at no value"
        lines.append(f"  in {share:>4.0%} of the draws {values}")
    return [*lines, _searched_line(found)]


def _searched_line(found: Fit | _Shares) -> str:
    span = " to ".join(in_unit(end, found.unit) for end in found.searched)
    return f"searched: {QUANTITIES[found.unknown].description}, {span}"


def _interval(found: Fit | _Shares, ends: Interval, digits: int) -> str:
    """An interval of values."""
    first, last = (in_unit(end, found.unit, digits) for end in ends)
    if ends[1] == found.searched[1] and ends[0] > found.searched[0]:
        return f"{found.unknown} > {first}"
    if ends[0] == found.searched[0] and ends[1] < found.searched[1]:
        return f"{found.unknown} < {last}"
    return f"{first} < {found.unknown} < {last}"


def _fit_lines(fits: str, fit: Fit) -> list[str]:
    """The values at which the length fits."""
    lines = [f"{fits} if"]
    for ends in fit.intervals:
        lines.append(f"  {_interval(fit, ends, 4)}")
    if not fit.intervals:
        why = "it is longer" if fit.exists else "there is none"
        lines.append(f"  never: {why} at all values; {fit.reason}")
    return [*lines, _searched_line(fit)]
