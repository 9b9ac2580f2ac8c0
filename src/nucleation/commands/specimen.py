"""``nucleation specimen``: values of one parameter at which a nucleation length fits a specimen."""

import math
from pathlib import Path
from typing import Any

import click

from ..lengths.specimen import CRITERIA, NAMES, SPECIMEN, UNKNOWNS, Fit, Interval, specimen_fit
from ..lengths.specimen_quantiles import SpecimenQuantiles, specimen_quantiles
from ..lengths.status import Answers, answers_of_theory
from ..theory.fault import QUANTITIES, FaultParameters
from ..theory.status import STABLE as STABLE_SLIDING
from . import DONE, EXIT_CODES, STABLE
from .fault_options import fault_options, fault_values
from .options import draws_option, json_option, option, samples_option
from .progress import progress_of
from .system_text import plane_in_words, printed_warnings, system_of_fault
from .text import as_plain, show, wrapped
from .uncertainty import as_sure, ranges_among, take_uncertain, varying
from .unit_text import engineering_unit, in_unit


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

    The inverse of `length`. A specimen that is shorter than its nucleation length does not
    nucleate, and that is an answer. With a range "5um (3 to 10)", the median and the quantiles of 5
    and 95 %, or with --samples it prints the values at which shares of all draws fit.

    \b
    Example:
      nucleation specimen --length 20cm --height 10cm --shear-modulus 3.1GPa \\
          --poisson-ratio 0.35 --a 0.0068 --zeta 0.016 --slip-distance 0.5um
    """
    options, uncertain = take_uncertain(options, samples)
    given, papers = fault_values(**options, optional=unknown)
    uncertain = ranges_among(given) | uncertain
    if uncertain:
        known = varying(given, uncertain, options)
        return _print_quantiles(known, given, length, unknown, criterion, draws, papers, as_json)
    own = given.pop(unknown, None)
    with printed_warnings():
        fit = specimen_fit(unknown, length, criterion, **given)
        value = fit.searched[0] if own is None else own
        fault = FaultParameters(**given | {unknown: value})
        judged = None if own is None else answers_of_theory(fault)[criterion]
    sought = unknown if own is None else ""
    system = system_of_fault(fault, given, papers, sought)
    verdict = None
    lines = [*system, ""]
    if judged is not None:
        verdict = {"value": own, **as_plain(judged)}
        lines += _judged_lines(length, criterion, fit, own, judged)
    lines += _fit_lines(_fits(length, criterion, fault), fit)
    everything = {
        "system": system,
        "specimen": length,
        "criterion": criterion,
        **fit._asdict(),
        "given": verdict,
        "plane": fault.plane,
    }
    show(as_json, everything, wrapped(*lines))
    return DONE if fit.exists else STABLE


def _print_quantiles(
    known: dict[str, Any],
    given: dict[str, Any],
    length: float,
    unknown: str,
    criterion: str,
    draws: int,
    papers: list[str],
    as_json: bool,
) -> int:
    """Print the values at which shares of all draws fit, and return the exit code."""
    with printed_warnings():
        found = specimen_quantiles(
            unknown,
            length,
            criterion,
            draws=draws,
            progress=progress_of("draws"),
            **known,
        )
        value = given.get(unknown, found.searched[0])
        middle = FaultParameters(**given | {unknown: value})
    sought = "" if unknown in given else unknown
    system = system_of_fault(middle, given, papers, sought)
    everything = {
        "system": system,
        "specimen": length,
        "criterion": criterion,
        **found._asdict(),
    }
    for name in ("intervals", "errors"):
        by_share = getattr(found, name)
        everything[name] = {f"{share:g}": value for share, value in by_share.items()}
    lines = _quantile_lines(_fits(length, criterion, middle), found)
    show(as_json, everything, wrapped(*system, "", *lines))
    return DONE if any(found.intervals.values()) else STABLE


def _fits(length: float, criterion: str, fault: FaultParameters) -> str:
    """The beginning of the sentence that ends with values."""
    plane = plane_in_words(fault.plane)
    return f"{NAMES[criterion]} fits into {in_unit(length, 'm')}, in {plane},"


def _quantile_lines(fits: str, found: SpecimenQuantiles) -> list[str]:
    """The values at which shares of all draws fit."""
    drawn = f"{found.draws} draws: {found.invalid} left out"
    if found.outside:
        drawn += f" ({', '.join(found.outside)} not allowed)"
    lines = [drawn]
    if not math.isnan(found.share):
        error = max(found.share_error, 1.0 / found.draws)
        lines.append(
            f"At the given {found.unknown} {found.share:.0%} (+- {error:.0%}) of the draws "
            "can nucleate."
        )
    lines.append(fits)
    for share, intervals in found.intervals.items():
        texts = []
        for ends, errors in zip(intervals, found.errors[share], strict=True):
            texts.append(_interval(found, ends, errors))
        values = f"if {' or '.join(texts)}" if texts else "at no value"
        lines.append(f"  in {share:>4.0%} of the draws {values}")
    return [*lines, _searched_line(found)]


def _searched_line(found: Fit | SpecimenQuantiles) -> str:
    span = " to ".join(in_unit(end, found.unit) for end in found.searched)
    return f"searched: {QUANTITIES[found.unknown].description}, {span}"


def _interval(found: Fit | SpecimenQuantiles, ends: Interval, errors: Interval) -> str:
    """An interval of values, with the digits that the errors of its ends leave."""
    first, last = map(_end, ends, errors, (found.unit, found.unit))
    if ends[1] == found.searched[1] and ends[0] > found.searched[0]:
        return f"{found.unknown} > {first}"
    if ends[0] == found.searched[0] and ends[1] < found.searched[1]:
        return f"{found.unknown} < {last}"
    return f"{first} < {found.unknown} < {last}"


def _end(value: float, error: float, unit: str) -> str:
    """The end of an interval in an engineering unit, with the digits that its error leaves."""
    name, size = engineering_unit(value, unit)
    return f"{as_sure(value / size, error / size)} {name}"


def _judged_lines(
    length: float,
    criterion: str,
    fit: Fit,
    own: float,
    judged: Answers,
) -> list[str]:
    """Whether the specimen nucleates at the given value."""
    name = NAMES[criterion]
    place = f"At {fit.unknown} = {in_unit(own, fit.unit)}"
    now = float(judged.length)
    ratio = now / length
    if now <= length:
        return [f"{place} {name} is {now:.4g} m, {ratio:.3g} of the specimen: it can nucleate."]
    if now > length:
        return [
            f"{place} {name} is {now:.4g} m, {ratio:.3g} times the specimen: it does not nucleate."
        ]
    stable = judged.status == STABLE_SLIDING
    verdict = "it does not nucleate" if stable else "whether it nucleates is not known"
    return [f"{place} there is no {name}: {verdict}.", f"  {judged.reason}"]


def _fit_lines(fits: str, fit: Fit) -> list[str]:
    """The values at which the length fits."""
    lines = [f"{fits} if"]
    for ends in fit.intervals:
        lines.append(f"  {_interval(fit, ends, (0.0, 0.0))}")
    if not fit.intervals:
        why = "it is longer" if fit.exists else "there is none"
        lines.append(f"  never: {why} at all values; {fit.reason}")
    return [*lines, _searched_line(fit)]
