"""``nucleation drop``: the length at which the force drops, under a declared perturbation."""

from __future__ import annotations

import dataclasses
import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from replication.configuration.advice import changing_friction
from replication.configuration.single_run import merged_parameters

from ..model.parameters import Parameters
from ..model.perturbation import KINDS, Perturbation
from ..model.quantities import ParameterError
from ..theory import status as status_words
from ..theory.arrays import critical_length, reasons_of_stability
from ..theory.fault import FaultParameters
from ..theory.of_runs import fault_of_run
from . import DONE, EXIT_CODES, STABLE, UNKNOWN
from .cases import USUAL, case_of, case_options, run_of, system_of_case, uncertain_of
from .options import draws_option, json_option, samples_option
from .sources import sourced
from .system_text import plane_in_words
from .text import Row, show, table, warn, wrapped
from .uncertain_drop import print_drop_quantiles
from .unit_text import in_unit

if TYPE_CHECKING:
    from ..drop.expected_drop import ExpectedDrop

_COMPARED = (
    "Against simulations of the paper's fault at strengths up to 1e-4 the median has an error of "
    "0.8 % (rms), 2 % at most; see docs/drop.md for others."
)

_COMPARED_SLOW = (
    "Friction weakens little here: the patch slips slowly in a limit cycle until there is none, "
    "for any weak perturbation. In thin blocks simulated drops came from 1 % below to 10 % above "
    "L_run; see docs/drop.md."
)


@click.command("drop", epilog=EXIT_CODES)
@case_options
@samples_option
@draws_option(50)
@json_option
def command(
    as_json: bool,
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
    base, given = sourced(options, ranges=True)
    declared = given.get("perturbation", USUAL["perturbation"] if base is None else "")
    if declared == "none":
        raise ParameterError(
            "perturbation = 'none' is not allowed: without one the drop depends on round-off; it "
            f"must be one of {', '.join(KINDS[1:])}"
        )
    paper = options["paper"]
    uncertain = uncertain_of(given, samples)
    if uncertain:
        return print_drop_quantiles(base, given, uncertain, paper, draws, as_json)
    values, blocks = case = case_of(base, given, paper)
    parameters = merged_parameters(None, values)
    fault = fault_of_run(parameters)
    critical = float(critical_length(**fault))
    found = None
    code, status, reason = DONE, status_words.VALUE, ""
    if math.isnan(critical):
        code, status = STABLE, status_words.STABLE
        reason = reasons_of_stability(FaultParameters(**fault)) + _cure(parameters)
    else:
        run = run_of(values)
        critical = run.critical_length
        # imported here, since the solver takes seconds
        from ..drop.expected_drop import expected_drop

        try:
            found = expected_drop(run.parameters)
            if blocks and blocks.doubt:
                found = found._replace(doubt="; ".join(filter(None, (found.doubt, blocks.doubt))))
        except status_words.NoLength as error:
            code, status, reason = UNKNOWN, error.status, str(error)
        for topic, _, text in changing_friction(run):
            warn(f"{topic}: {text}")
    system = system_of_case(case, base, given, paper)
    known = {
        "system": system,
        "half_spaces": blocks and blocks._asdict(),
        "status": status,
        "reason": reason,
        "theory": {"critical_length": critical, "plane": parameters.material.plane},
        "perturbation": dataclasses.asdict(parameters.perturbation),
    }
    answer = _described(found) if found else {}
    lines = [*wrapped(*system, ""), *_lines(parameters, critical, found, reason)]
    show(as_json, known | answer, lines)
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
    rows: list[Row] = [
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
