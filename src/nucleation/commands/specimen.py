"""``nucleation specimen``: values of one parameter at which a nucleation length fits a specimen."""

from __future__ import annotations

import math
from typing import Any

import click

from ..answers.answer import Answer
from ..answers.lengths import Lengths
from ..answers.specimen import CRITERIA, NAMES, SPECIMEN, UNKNOWNS, Fit
from ..model.hints import RANGES
from ..model.units import in_metres, in_unit
from ..theory.status import STABLE as STABLE_SLIDING
from ..theory.values import QUANTITIES
from . import DONE, EXIT_CODES, STABLE
from .given import (
    fault_options,
    given_fault,
    json_option,
    option,
    printed_warnings,
    system_of_fault,
)
from .text import show, wrapped

_SHORTEST_EVENT = 0.7
"""Least length of a simulated block with an event, over L_s: its far end is free, and the theory's
block is long (PMMA plates 10 cm high and 12 cm long under 1 MPa)."""

_JUDGED = ("critical_length", "stability_length", "drop_length")


@click.command("specimen", epilog=EXIT_CODES)
@option("length", SPECIMEN, required=True)
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
@json_option
def command(length: float, unknown: str, criterion: str, as_json: bool, **options: Any) -> int:
    """Normal stress, slip distance or modulus at which a nucleation length fits into a specimen.

    The inverse of `length`. With the value of the parameter it is judged by L_s and by L, at which
    the force drops; L needs --velocity and --friction.

    \b
    Example:
      nucleation specimen --length 20cm --height 10cm --shear-modulus 3.1GPa \\
          --poisson-ratio 0.35 --a 0.0068 --zeta 0.016 --slip-distance 0.5um
    """
    any_value = math.sqrt(math.prod(RANGES[unknown]))
    with printed_warnings():
        fault, names, _ = given_fault(options, sought={unknown: any_value})
        fit = fault.specimen(unknown, length, criterion)
        is_given = unknown in names
        found = fault.lengths() if is_given else None
    system = system_of_fault(fault, names, options["paper"], "" if is_given else unknown)
    lines = [*system, ""]
    judged = None
    if found is not None:
        value, verdict = fault.single(unknown), _verdict(length, found)
        judged = {"value": value, "verdict": verdict}
        judged |= {key: found[key]._asdict() for key in _JUDGED}
        lines += [f"At {unknown} = {in_unit(value, fit.unit)} {verdict}."]
    lines.append(f"{NAMES[criterion]} fits into {in_unit(length, 'm')} if")
    lines += _fit_lines(fit)
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
        f"blocks of one simulated fault had events from {_SHORTEST_EVENT:g} L_s on (free ends)"
    )


def _with_range(answer: Answer) -> str:
    text = in_metres(answer.value)
    if answer.high > 1.01 * answer.low:
        text += f" ({in_metres(answer.low, answer.high)})"
    return text


def _fit_lines(fit: Fit) -> list[str]:
    """The values at which the length fits, and those that were searched."""
    lines = []
    low, high = fit.searched
    for ends in fit.intervals:
        first, last = (in_unit(end, fit.unit) for end in ends)
        text = f"{first} < {fit.unknown} < {last}"
        if ends[1] == high and ends[0] > low:
            text = f"{fit.unknown} > {first}"
        elif ends[0] == low and ends[1] < high:
            text = f"{fit.unknown} < {last}"
        lines.append(f"  {text}")
    if not fit.intervals:
        why = "it is longer" if fit.exists else "there is none"
        lines.append(f"  never: {why} at all values; {fit.reason}")
    span = " to ".join(in_unit(end, fit.unit) for end in fit.searched)
    return [*lines, f"searched: {QUANTITIES[fit.unknown].description}, {span}"]
