"""``nucleation specimen``: at which stress, slip distance or modulus a nucleation length fits."""

from typing import Any

import click

from ..answers.specimen import CRITERIA, NAMES, SPECIMEN, UNKNOWNS, Fit, specimen_fit
from ..answers.status import Answers, answers_of_theory
from ..theory.fault import QUANTITIES, Fault
from ..theory.status import STABLE as STABLE_SLIDING
from . import DONE, EXIT_CODES, STABLE
from .fault_options import doubts_told, fault_options, fault_values, plane_in_words, said_of
from .options import option
from .text import as_plain, to_json


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
@click.option("--json", "as_json", is_flag=True, help="print JSON, in SI units")
def command(length: float, unknown: str, criterion: str, as_json: bool, **options: Any) -> int:
    """Normal stress, slip distance or modulus at which a nucleation length fits into a specimen.

    The question of `length` asked backwards. A specimen that is shorter than its nucleation length
    does not nucleate, and that is an answer.

    \b
    Example:
      nucleation specimen --length 20cm --height 10cm --shear-modulus 3.1GPa --poisson 0.35 \\
          --a 0.0068 --zeta 0.016 --slip-distance 0.5um --plane stress
    """
    given, _, papers = fault_values(**options, optional=unknown)
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
    for first, last in fit.intervals:
        if last == high and first > low:
            lines.append(f"  {fit.unknown} > {first:.4g} {unit}")
        elif first == low and last < high:
            lines.append(f"  {fit.unknown} < {last:.4g} {unit}")
        else:
            lines.append(f"  {first:.4g} {unit} < {fit.unknown} < {last:.4g} {unit}")
    if not fit.intervals:
        why = "it is longer" if fit.exists else "there is none"
        lines.append(f"  never: {why} at all values; {fit.reason}")
    sought = QUANTITIES[fit.unknown].description
    return "\n".join([*lines, f"looked for: {sought}, {low:g} to {high:g} {unit}"])
