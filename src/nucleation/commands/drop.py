"""``nucleation drop``: where a fault's force drops, under a perturbation of declared strength."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..configuration.advice import changing_friction
from ..configuration.study_names import study_parameters
from ..model.friction.constants import CONSTANTS
from ..model.parameters import Parameters, names
from ..model.perturbation import KINDS, Perturbation
from ..model.quantities import ParameterError
from ..theory import status as status_words
from ..theory.arrays import critical_length, reason_of_stability
from ..theory.fault import Fault
from . import DONE, EXIT_CODES, STABLE, UNKNOWN
from .fault_options import of_parameters, plane_in_words, told
from .options import merged, merged_parameters, parameter_options, planned, source_options, sourced
from .pages import with_addresses
from .text import to_json
from .uncertain_drop import print_drop_quantiles, uncertain_of
from .uncertainty import draws_option, samples_option

if TYPE_CHECKING:
    from ..patch.expected_drop import ExpectedDrop

USUAL = {"perturbation": "normal_load", "strength": 1e-4}  # up to which the law is known
GROUPS = ("material", "friction", "loading", "perturbation", "second_body")
OWN = ("second_n_y", "second_grading", "loading", "stress_rate", "seed")
"""What the law has of its own: mesh, steps, an edge that is pushed, and all realisations."""

COMPARED = (
    "Against simulations of the paper's fault at strengths up to 1e-4 the median has an error of "
    "0.8 %\n(rms), 2 % at most; see docs/drop.md for others."
)

COMPARED_SLOW = (
    "Friction weakens little here: the patch slips slowly in a limit cycle until there is none, "
    "whatever\nthe perturbation. Simulated drops came at 0 to 8 % above L_run; see docs/drop.md."
)


def _counts(name: str) -> bool:
    """Whether a parameter, by its name in studies, decides on the drop."""
    known = name in CONSTANTS or name == "height" or names().full(name).startswith(GROUPS)
    return known and name not in OWN


COUNTING = tuple(filter(_counts, study_parameters()))
"""The parameters that decide on the drop, by their names in studies."""


@click.command("drop", epilog=EXIT_CODES)
@parameter_options(COUNTING, USUAL, ranges=True)
@source_options
@samples_option
@draws_option(50)
@click.option("--json", "as_json", is_flag=True, help="print JSON, in SI units")
def command(
    as_json: bool,
    file: Path | None,
    run_id: str | None,
    config: str | None,
    paper: bool,
    samples: Path | None,
    draws: int,
    **options: Any,
) -> int:
    """Length at which the force drops, of a fault under a declared perturbation.

    A block is pushed from its side, as by `simulate`. Its creeping patch becomes unstable at L_s.
    The force drops once the unstable mode has grown to the size of the loading, so the weaker the
    perturbation, the later. The growth follows from the theory of the patch. A range "5um (3 to
    10)", the median and the quantiles of 5 and 95 %, or --samples give quantiles of the length.

    \b
    Example:
      nucleation drop --height 2cm --perturbation normal_load --strength 1e-4
    """
    base, given = sourced(file, run_id, config, paper, options, ranges=True)
    values = merged(base, USUAL | given if base is None else given)
    if values["perturbation"] == "none":
        raise ParameterError(
            "perturbation = 'none' is not allowed: without one the drop depends on round-off; it "
            f"must be one of {', '.join(KINDS[1:])}"
        )
    uncertain = uncertain_of(given, samples)
    if uncertain:
        return print_drop_quantiles(base, given, uncertain, USUAL, paper, draws, as_json)
    parameters = merged_parameters(None, values)
    fault, found, status, reason = of_parameters(parameters), None, status_words.VALUE, ""
    critical = float(critical_length(**fault))
    if math.isnan(critical):
        code, status = STABLE, status_words.STABLE
        reason = reason_of_stability(Fault(**fault)) + _cure(parameters)
    else:
        run = planned(values, {}, results="results")  # not used
        critical = run.theory_length
        # with the solver, which takes seconds
        from ..patch.expected_drop import NoDrop, expected_drop

        try:
            found, code = expected_drop(run.parameters), DONE
        except NoDrop as error:
            code, status, reason = UNKNOWN, error.status, str(error)
        for topic, _, text in changing_friction(run):
            click.echo(f"Warning: {topic}: {with_addresses(text)}", err=True)
    said = told(parameters, base, given)
    if as_json:
        known = {
            "system": said,
            "status": status,
            "reason": reason,
            "theory": {"critical_length": critical, "plane": parameters.material.plane},
            "perturbation": dataclasses.asdict(parameters.perturbation),
        }
        click.echo(to_json(known | (_described(found) if found else {})))
    else:
        lines = [*said, *_lines(parameters, critical, found, reason)]
        click.echo(with_addresses("\n".join(lines)))
    return code


def _cure(parameters: Parameters) -> str:
    """What to change where the law's own scale, not the fault, may be why sliding is stable."""
    v, v0 = parameters.loading.velocity, parameters.friction.regularisation_slip_rate
    if v > 10.0 * v0:
        return ""
    return f"; v0 = {v0:g} m/s, regularisation_slip_rate, must be far below V = {v:g} m/s"


def _described(found: ExpectedDrop) -> dict[str, Any]:
    """What JSON has of the drop."""
    return {
        "stability_length": found.stability_length,
        "runaway_length": found.runaway_length,
        "runaway_length_status": found.runaway_status,
        "runaway_length_reason": found.runaway_reason,
        "length": found.length,
        "drop": found.drop._asdict(),
        "closed_form": found.closed_form._asdict(),
        "trusted": found.trusted,
        "doubt": found.doubt,
    }


def _lines(
    parameters: Parameters, critical: float, found: ExpectedDrop | None, reason: str
) -> list[str]:
    if math.isnan(critical):
        return [f"No critical length: {reason}."]
    lines = [
        f"Theory of homogeneous sliding, in {plane_in_words(parameters.material.plane)}:",
        f"  L_c    {f'{critical:.4g} m':<26} critical nucleation length",
        "The creeping patch:",
    ]
    if found is None:
        return [*lines, f"  The law of the drop does not reach this fault: {reason}."]
    drop = found.drop
    rows = [
        ("L_s", found.stability_length, "it turns unstable"),
        ("L_d", drop.length, "half of the realisations have dropped,"),
        ("", drop.low, "16 % of them,"),
        ("", drop.high, "84 % of them"),
    ]
    if found.slips_slowly:
        rows[0] = ("L_s", found.stability_length, "it turns unstable: slow slip from here on,")
        rows[1:] = [("L_run", found.runaway_length, "and to here, where the force drops")]
    for name, length, meaning in rows:
        ratio = f"{length / critical:.3g} L_c"
        lines.append(f"  {name:<6} {f'{length:.4g} m':<11} {ratio:<14} {meaning}")
    if not found.slips_slowly:
        times = f"{drop.time_low:.4g} to {drop.time_high:.4g} s"
        lines.append(f"  t_d    {f'{drop.time:.4g} s':<26} {times}")
    trusted = COMPARED_SLOW if found.slips_slowly else COMPARED
    return [
        *lines,
        f"perturbed: {_perturbed(parameters.perturbation)}",
        f"DO NOT RELY ON IT: {found.doubt}." if found.doubt else trusted,
    ]


def _perturbed(declared: Perturbation) -> str:
    text = f"{declared.kind}, relative strength {declared.strength:g}, correlated over "
    if declared.kind == "strength":
        return f"{text}{declared.correlation_length:g} m"
    along = f" and {declared.correlation_length:g} m" if declared.kind == "state" else ""
    return f"{text}{declared.correlation_time:g} D/V{along}"
