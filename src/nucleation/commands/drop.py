"""``nucleation drop``: the length at which the force drops, under a declared perturbation."""

from __future__ import annotations

import dataclasses
import math
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..configuration.advice import changing_friction
from ..configuration.single_run import merged, merged_parameters, single_run, without_half_spaces
from ..configuration.study_names import study_parameters
from ..model.friction.constants import CONSTANTS
from ..model.parameters import Parameters, names
from ..model.perturbation import KINDS, Perturbation
from ..model.quantities import ParameterError
from ..theory import status as status_words
from ..theory.arrays import critical_length, reasons_of_stability
from ..theory.fault import FaultParameters
from ..theory.of_runs import fault_of_run
from . import DONE, EXIT_CODES, STABLE, UNKNOWN
from .options import parameter_options, source_options
from .sources import sourced
from .system_text import plane_in_words, system_of_run
from .text import table, to_json, wrapped
from .uncertain_drop import print_drop_quantiles, uncertain_of
from .uncertainty import draws_option, samples_option
from .unit_text import in_unit

if TYPE_CHECKING:
    from ..patch.expected_drop import ExpectedDrop

USUAL = {"perturbation": "normal_load", "strength": 1e-4}
"""The perturbation by default; the law is verified up to this strength."""

_GROUPS = ("material", "friction", "loading", "perturbation", "second_body")
_WITHOUT_EFFECT = ("second_n_y", "second_grading", "loading", "stress_rate", "seed")
"""Parameters of these groups without effect: the law has no mesh, holds for an edge that is pushed,
and covers all realisations."""

_COMPARED = (
    "Against simulations of the paper's fault at strengths up to 1e-4 the median has an error of "
    "0.8 % (rms), 2 % at most; see docs/drop.md for others."
)

_COMPARED_SLOW = (
    "Friction weakens little here: the patch slips slowly in a limit cycle until there is none, "
    "for any weak perturbation. In thin blocks simulated drops came from 1 % below to 10 % above "
    "L_run; see docs/drop.md."
)


def _counts(name: str) -> bool:
    """Whether a parameter, by its name in studies, has an effect on the drop."""
    if name in CONSTANTS or name == "height":
        return True
    return names().full(name).startswith(_GROUPS) and name not in _WITHOUT_EFFECT


COUNTING = tuple(filter(_counts, study_parameters()))
"""The parameters with an effect on the drop, by their names in studies."""


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

    A block is pushed from its side, as by `simulate`. Its creeping patch turns unstable at L_s. The
    force drops once the unstable mode has grown to the size of the loading, so a weaker
    perturbation means a later drop. The growth follows from the theory of the patch. With a range
    "5um (3 to 10)", the median and the quantiles of 5 and 95 %, or with --samples it prints
    quantiles of the length.

    \b
    Example:
      nucleation drop --height 2cm --perturbation normal_load --strength 1e-4
    """
    base, given = sourced(file, run_id, config, paper, options, ranges=True)
    declared = given.get("perturbation", USUAL["perturbation"] if base is None else "")
    if declared == "none":
        raise ParameterError(
            "perturbation = 'none' is not allowed: without one the drop depends on round-off; it "
            f"must be one of {', '.join(KINDS[1:])}"
        )
    uncertain = uncertain_of(given, samples)
    if uncertain:
        return print_drop_quantiles(base, given, uncertain, USUAL, paper, draws, as_json)
    fixed, blocks = without_half_spaces(base, USUAL | given if base is None else given)
    values = merged(base, fixed)
    parameters = merged_parameters(None, values)
    fault = fault_of_run(parameters)
    critical = float(critical_length(**fault))
    found = None
    code, status, reason = DONE, status_words.VALUE, ""
    if math.isnan(critical):
        code, status = STABLE, status_words.STABLE
        reason = reasons_of_stability(FaultParameters(**fault)) + _cure(parameters)
    else:
        # neither results nor a mesh are made
        run = single_run(values, results="results", limits={"memory": 9e6})
        critical = run.critical_length
        # imported here, since the solver takes seconds
        from ..patch.expected_drop import NoDrop, expected_drop

        try:
            found = expected_drop(run.parameters)
            if blocks and blocks.doubt:
                found = found._replace(doubt="; ".join(filter(None, (found.doubt, blocks.doubt))))
        except NoDrop as error:
            code, status, reason = UNKNOWN, error.status, str(error)
        for topic, _, text in changing_friction(run):
            click.echo("\n".join(wrapped(f"Warning: {topic}: {text}", err=True)), err=True)
    system = system_of_run(parameters, base, given)
    if blocks:
        system.append(blocks.in_words())
    if as_json:
        known = {
            "system": system,
            "half_spaces": blocks and blocks._asdict(),
            "status": status,
            "reason": reason,
            "theory": {"critical_length": critical, "plane": parameters.material.plane},
            "perturbation": dataclasses.asdict(parameters.perturbation),
        }
        answer = _described(found) if found else {}
        click.echo(to_json(known | answer))
    else:
        lines = [*wrapped(*system, ""), *_lines(parameters, critical, found, reason)]
        click.echo("\n".join(lines))
    return code


def _cure(parameters: Parameters) -> str:
    """The parameter to change if the scale v0 of the friction law may be why sliding is stable."""
    velocity = parameters.loading.velocity
    v0 = parameters.friction.regularisation_slip_rate
    if velocity > 10.0 * v0:
        return ""
    shown_v0, shown_velocity = (in_unit(rate, "m/s") for rate in (v0, velocity))
    return f"; v0 = {shown_v0}, regularisation_slip_rate, must be far below V = {shown_velocity}"


def _described(found: ExpectedDrop) -> dict[str, Any]:
    """The drop for JSON, in SI units."""
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
    parameters: Parameters,
    critical: float,
    found: ExpectedDrop | None,
    reason: str,
) -> list[str]:
    """The lengths of the theory and of the drop, one line each."""
    if math.isnan(critical):
        return wrapped(f"No critical length: {reason}.")
    rows: list[Sequence[str] | str] = [
        f"Theory of homogeneous sliding, in {plane_in_words(parameters.material.plane)}:",
        ("L_c", f"{critical:.4g} m", "", "critical nucleation length"),
        "The creeping patch:",
    ]
    if found is None:
        rows.append(f"  The law of the drop is not applicable to this fault: {reason}.")
        return table(rows)
    for name, length, meaning in _rows(found):
        ratio = f"{length / critical:.3g} L_c"
        rows.append((name, f"{length:.4g} m", ratio, meaning))
    if not found.slips_slowly:
        drop = found.drop
        span = f"{drop.time_low:.4g} to {drop.time_high:.4g} s"
        rows.append(("t_d", f"{drop.time:.4g} s", "", span))
    rows.append(f"perturbed: {_perturbed(parameters.perturbation)}")
    if found.doubt:
        rows.append(f"DO NOT RELY ON IT: {found.doubt}.")
    else:
        rows.append(_COMPARED_SLOW if found.slips_slowly else _COMPARED)
    return table(rows)


def _rows(found: ExpectedDrop) -> list[tuple[str, float, str]]:
    """Symbol, length (m) and meaning of each length of the creeping patch."""
    stability = found.stability_length
    if found.slips_slowly:
        return [
            ("L_s", stability, "it turns unstable: slow slip from here on,"),
            ("L_run", found.runaway_length, "and to here, where the force drops"),
        ]
    return [
        ("L_s", stability, "it turns unstable"),
        ("L", found.drop.length, "half of the realisations have dropped,"),
        ("", found.drop.low, "16 % of them,"),
        ("", found.drop.high, "84 % of them"),
    ]


def _perturbed(declared: Perturbation) -> str:
    """The perturbation in words."""
    time = f"{declared.correlation_time:g} D/V"
    length = in_unit(declared.correlation_length, "m")
    scales = {"strength": length, "state": f"{time} and {length}"}
    return (
        f"{declared.kind}, relative strength {declared.strength:g}, "
        f"correlated over {scales.get(declared.kind, time)}"
    )
