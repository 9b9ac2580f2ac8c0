"""``nucleation specimen``: at which stress, slip distance or modulus a nucleation length fits."""

import math
from pathlib import Path
from typing import Any

import click

from ..answers.draws import Range
from ..answers.specimen import CRITERIA, NAMES, SPECIMEN, UNKNOWNS, Fit, specimen_fit
from ..answers.specimen_quantiles import SpecimenQuantiles, specimen_quantiles
from ..answers.status import Answers, answers_of_theory
from ..theory.fault import QUANTITIES, Fault
from ..theory.status import STABLE as STABLE_SLIDING
from . import DONE, EXIT_CODES, STABLE
from .fault_options import doubts_told, fault_options, fault_values, plane_in_words, said_of
from .options import option
from .progress import Progress
from .text import as_plain, to_json
from .uncertainty import as_sure, draws_option, samples_option, take_uncertain, varying


@click.command("specimen", epilog=EXIT_CODES)
@option("--length", key="length", entry=SPECIMEN, required=True)
@click.option(
    "--find", "unknown", type=click.Choice(list(UNKNOWNS.choices)), default="normal_stress",
    show_default=True, help="the parameter to find; if its value is given too, it is judged",
)  # fmt: skip
@click.option(
    "--criterion", type=click.Choice(list(CRITERIA)), default="critical", show_default=True,
    help="the length that has to fit: L_c of homogeneous sliding, or L_s of a patch that is "
    "pushed at its edge",
)  # fmt: skip
@fault_options
@samples_option
@draws_option(200)
@click.option("--json", "as_json", is_flag=True, help="print JSON, in SI units")
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

    The question of `length` asked backwards. A specimen that is shorter than its nucleation length
    does not nucleate, and that is an answer. A range "5um (3 to 10)", the median and the quantiles
    of 5 and 95 %, or --samples give the values at which shares of all draws fit.

    \b
    Example:
      nucleation specimen --length 20cm --height 10cm --shear-modulus 3.1GPa --poisson 0.35 \\
          --a 0.0068 --zeta 0.016 --slip-distance 0.5um --plane stress
    """
    options, uncertain = take_uncertain(options, samples)
    given, _, papers = fault_values(**options, optional=unknown, ranges=True)
    uncertain = {k: v for k, v in given.items() if isinstance(v, Range)} | uncertain
    if uncertain:
        known = varying(given, uncertain, options)
        return _print_quantiles(known, given, length, unknown, criterion, draws, as_json)
    own = given.pop(unknown, None)
    with doubts_told():
        fit = specimen_fit(unknown, length, criterion, **given)
        fault = Fault(**given, **{unknown: fit.searched[0] if own is None else own})
        now = None if own is None else answers_of_theory(fault)[criterion]
    looked_for = own is None and unknown == "shear_modulus"
    said = said_of(fault, given, known=not looked_for) + papers
    if as_json:
        judged = None if now is None else {"value": own, **as_plain(now)}
        found = {
            "system": said, "specimen": length, "criterion": criterion, **fit._asdict(),
            "given": judged, "plane": fault.plane,
        }  # fmt: skip
        click.echo(to_json(found))
    else:
        click.echo("\n".join([*said, _as_text(length, criterion, fit, own, now, fault.plane)]))
    return DONE if fit.exists else STABLE


def _print_quantiles(
    known: dict[str, Any],
    given: dict[str, Any],
    length: float,
    unknown: str,
    criterion: str,
    draws: int,
    as_json: bool,
) -> int:
    """Print at which values shares of all draws fit, and return the exit code."""
    with doubts_told():
        found = specimen_quantiles(
            unknown, length, criterion, draws=draws, progress=Progress("draws"), **known
        )
        middle = Fault(**given | {unknown: given.get(unknown, found.searched[0])})
    looked_for = unknown == "shear_modulus" and unknown not in given
    said = said_of(middle, given, known=not looked_for)
    if as_json:
        everything = found._asdict()
        for name in ("intervals", "errors"):
            everything[name] = {f"{q:g}": x for q, x in everything[name].items()}
        click.echo(
            to_json({"system": said, "specimen": length, "criterion": criterion, **everything})
        )
    else:
        lines = _quantiles_as_text(found, length, criterion, middle.plane)
        click.echo("\n".join([*said, *lines]))
    return DONE if any(found.intervals.values()) else STABLE


def _quantiles_as_text(
    found: SpecimenQuantiles, length: float, criterion: str, plane: str
) -> list[str]:
    name, unit = NAMES[criterion], found.unit
    drawn = f"{found.draws} draws: {found.invalid} left out"
    drawn += f" ({', '.join(found.outside)} not allowed)" if found.outside else ""
    lines = [drawn]
    if not math.isnan(found.share):
        error = max(found.share_error, 1.0 / found.draws)
        lines.append(
            f"At the {found.unknown} that is given {found.share:.0%} (+- {error:.0%}) of the draws "
            "can nucleate."
        )
    lines.append(f"{name} fits into {length:.4g} m, in {plane_in_words(plane)},")
    for share, intervals in found.intervals.items():
        texts = [
            _interval(found.unknown, unit, ends, found.searched, errors)
            for ends, errors in zip(intervals, found.errors[share], strict=True)
        ]
        lines.append(f"  in {share:>4.0%} of the draws if {' or '.join(texts)}" if texts
                     else f"  in {share:>4.0%} of the draws at no value")  # fmt: skip
    low, high = found.searched
    sought = QUANTITIES[found.unknown].description
    return [*lines, f"looked for: {sought}, {low:g} to {high:g} {unit}"]


def _interval(
    unknown: str,
    unit: str,
    ends: tuple[float, float],
    searched: tuple[float, float],
    errors: tuple[float, float],
) -> str:
    """Values from one to another, or beyond one, with the digits that their errors leave."""
    first, last = (as_sure(value, error) for value, error in zip(ends, errors, strict=True))
    if ends[1] == searched[1] and ends[0] > searched[0]:
        return f"{unknown} > {first} {unit}"
    if ends[0] == searched[0] and ends[1] < searched[1]:
        return f"{unknown} < {last} {unit}"
    return f"{first} {unit} < {unknown} < {last} {unit}"


def _as_text(
    length: float, criterion: str, fit: Fit, own: float | None, judged: Answers | None, plane: str
) -> str:
    name, unit, lines = NAMES[criterion], fit.unit, []
    if own is not None and judged is not None:
        now = float(judged.length)
        at, long = f"At {fit.unknown} = {own:.4g} {unit}", f"{name} is {now:.4g} m"
        if now <= length:
            lines += [f"{at} {long}, {now / length:.3g} of the specimen: it can nucleate."]
        elif now > length:
            lines += [f"{at} {long}, {now / length:.3g} times the specimen: it does not nucleate."]
        else:
            stable = judged.status == STABLE_SLIDING
            verdict = "it does not nucleate" if stable else "whether it nucleates is not known"
            lines += [f"{at} there is no {name}: {verdict}.", f"  {judged.reason}"]
    lines.append(f"{name} fits into {length:.4g} m, in {plane_in_words(plane)}, if")
    low, high = fit.searched
    for ends in fit.intervals:
        lines.append(f"  {_interval(fit.unknown, unit, ends, fit.searched, (0.0, 0.0))}")
    if not fit.intervals:
        why = "it is longer" if fit.exists else "there is none"
        lines.append(f"  never: {why} at all values; {fit.reason}")
    sought = QUANTITIES[fit.unknown].description
    return "\n".join([*lines, f"looked for: {sought}, {low:g} to {high:g} {unit}"])
