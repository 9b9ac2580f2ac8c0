"""``nucleation length``: the critical length of a fault, and other lengths in use."""

import math
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import click

from ..lengths import formulas
from ..lengths.draws import parse_range
from ..lengths.in_use import LENGTHS, WEAKENING_RATE
from ..lengths.length import HALF_SPACES, TWO_MATERIALS, Length, number, of_two_materials
from ..lengths.status import Answers, answers_of
from ..model.material import Material
from ..model.quantities import ParameterError, declarations
from ..theory.arrays import critical_mode
from ..theory.creep.lengths import stability_answers
from ..theory.fault import FaultParameters
from ..theory.status import BEYOND, STABLE, UNKNOWN
from . import DONE, EXIT_CODES
from . import STABLE as CODE_OF_STABLE
from .fault_options import fault_options, fault_values
from .options import draws_option, json_option, option, samples_option
from .system_text import (
    BEGINS,
    is_of_one_material,
    parameters_of,
    plane_in_words,
    printed_warnings,
    scales_text,
    system_of_fault,
    systems_of_lengths,
)
from .text import Row, as_plain, show, table, wrapped
from .uncertainty import print_quantiles, ranges_among, take_uncertain
from .unit_text import in_unit
from .weakening_patch import OPTIONS, patch_lines, patch_of, patch_options

_NOTEWORTHY = 0.03
"""Least relative change of L_s by the scales of the friction law that is printed."""

_NO_LENGTH = {
    STABLE: "NO LENGTH, STABLE: ",
    BEYOND: "LONGER THAN SEARCHED: ",
    UNKNOWN: "NOT VALID HERE, ",
}
"""The beginning of a reason in place of a length, by the status."""

_DENSITY = declarations(Material)["density"]


@click.command("length", epilog=EXIT_CODES)
@fault_options
@option(
    "--density",
    key="density",
    entry=_DENSITY,
    note="to check that inertia does not matter; needs --velocity",
)
@option(
    "--weakening-rate",
    key="weakening_rate",
    entry=WEAKENING_RATE,
    note="of Uenishi and Rice's length; b sigma0/D if left out",
    read=parse_range,
)
@patch_options
@samples_option
@draws_option(1000)
@json_option
def command(
    density: float | None,
    as_json: bool,
    samples: Path | None,
    draws: int,
    **options: Any,
) -> int:
    """Critical nucleation length of a fault: the theory's, and others in use.

    With a range "5um (3 to 10)", the median and the quantiles of 5 and 95 %, or with --samples it
    prints the quantiles of each length.

    Friction is f0 + a log(v/V) + b log(phi V/D) with NATURAL logarithms; zeta = b - a > 0 weakens.

    \b
    Example:
      nucleation length --shear-modulus 30GPa --poisson-ratio 0.25 \\
          --normal-stress 50MPa --a 0.010 --b 0.015 --slip-distance 5um
    """
    options, uncertain = take_uncertain(options, samples)
    weakening_rate = options.pop("weakening_rate")
    of_patch = {name: options.pop(name) for name in OPTIONS}
    given, papers = fault_values(**options)
    uncertain = ranges_among(given) | uncertain
    if uncertain:
        for name, value in {"density": density, **of_patch}.items():
            if value is not None:
                raise ParameterError(f"{name} is not allowed beside ranges and samples")
        usual = {"weakening_rate": weakening_rate, "draws": draws}
        return print_quantiles(given, uncertain, options | usual, papers, as_json)
    if density is not None and "velocity" not in given:
        raise ParameterError("velocity is missing: --density needs it, for the mode's speed")
    with printed_warnings():
        fault = FaultParameters(**given)
        found = answers_of(fault, weakening_rate)
        theory = _theory(fault, density, found)
        patch = patch_of(fault, of_patch)
    system = system_of_fault(fault, given, papers)
    everything = {
        "system": system,
        "parameters": parameters_of(fault),
        "theory": theory,
        "weakening_patch": patch,
        "lengths": [
            {"key": length.key, **as_plain(found[length.key]), **length.words()}
            for length in LENGTHS
        ],
    }
    of_patch_lines = []
    if patch:
        of_patch_lines = patch_lines(patch, of_patch["width"], theory["critical_length"])
    show(as_json, everything, _lines(system, fault, theory, found, of_patch_lines))
    return DONE if math.isfinite(theory["critical_length"]) else CODE_OF_STABLE


def _theory(
    fault: FaultParameters,
    density: float | None,
    answers: Mapping[str, Answers],
) -> dict[str, Any]:
    """The theory's numbers for JSON, in SI units; NaN where there is none, with status."""
    slip_distance = number(fault, "slip_distance")
    # without V a rate V/D of one per second
    velocity = slip_distance if fault.velocity is None else number(fault, "velocity")
    mode = critical_mode(**{**fault, "velocity": velocity})
    length, wavenumber, frequency = map(float, mode)
    ratio = None
    if density is not None:
        modulus = float(number(fault, "shear_modulus"))
        shear_wave = Material(modulus, density=density).shear_wave_speed
        ratio = abs(frequency) / wavenumber / shear_wave
    stability_length, own_frequency, error = map(float, stability_answers(fault)[:3])
    constant = stability_length
    if fault.friction_law is not None:
        without_law = FaultParameters(**{**fault, "friction_law": None})
        constant = float(stability_answers(without_law)[0])
    critical, stability = answers["critical_length"], answers["stability_length"]
    return {
        "critical_length": length,
        "critical_length_status": str(critical.status),
        "critical_length_reason": str(critical.reason),
        "critical_wavenumber": wavenumber,
        "critical_frequency": None if fault.velocity is None else frequency,
        "critical_frequency_over_rate": frequency / float(velocity / slip_distance),
        "speed_over_shear_wave": ratio,
        "loading": fault.loading,
        "stability_length": stability_length,
        "stability_length_status": str(stability.status),
        "stability_length_reason": str(stability.reason),
        "stability_frequency_over_rate": own_frequency,
        "stability_length_error": error,
        "stability_length_of_constant_a_and_b": constant,
    }


def _lines(
    system: list[str],
    fault: FaultParameters,
    theory: dict[str, Any],
    answers: dict[str, Answers],
    patch: list[str],
) -> list[str]:
    """All lengths with their meaning, sources and validity."""
    head = "Theory of homogeneous sliding, for this fault (Aldam et al., 2017, Eq. 5):"
    lines = wrapped(*system, "", head)
    if math.isfinite(theory["critical_length"]):
        lines += [*_mode_lines(theory), "", *_patch_lines(theory, fault)]
    else:
        lines += wrapped(f"  no critical length: {theory['critical_length_reason']}")
    if patch:
        lines += ["", *patch]
    critical = theory["critical_length"]
    for of_lengths in systems_of_lengths(fault):
        lines += ["", *wrapped(f"Lengths in use, for {of_lengths}:")]
        rows: list[Row] = []
        for length in LENGTHS:
            if length.system == of_lengths:
                rows += _length_rows(length, answers[length.key], fault, critical)
        lines += table(rows)
    remark = (
        f"in {plane_in_words(fault.plane)}, with {_moduli(fault)}, b = a + zeta, natural "
        "logarithms; all are full lengths"
    )
    return [*lines, "", *wrapped(remark)]


def _moduli(fault: FaultParameters) -> str:
    """The moduli in the formulas: mu*, and M of two materials."""
    star = {
        "strain": "mu/(1 - nu)",
        "stress": "mu (1 + nu)",
        "antiplane": "mu",
    }
    text = f"mu* = {star[fault.plane]}"
    if is_of_one_material(fault):
        return text
    modulus, _ = of_two_materials(fault)
    return f"{text}, M = {in_unit(float(modulus), 'Pa')}"


def _mode_lines(theory: dict[str, Any]) -> list[str]:
    """Length, wavenumber and frequency of the critical mode."""
    omega = ("critical_frequency", "rad/s", "angular frequency of the critical mode")
    if theory["critical_frequency"] is None:
        meaning = "angular frequency of the critical mode (in rad/s with --velocity)"
        omega = ("critical_frequency_over_rate", "V/D", meaning)
    rows = {
        "L_c": ("critical_length", "m", "critical nucleation length, 2 pi/k_c"),
        "k_c": ("critical_wavenumber", "1/m", "critical wavenumber"),
        "omega": omega,
    }
    lines = []
    for name, (key, unit, meaning) in rows.items():
        lines.append((name, f"{theory[key]:.4g} {unit}", meaning))
    ratio = theory["speed_over_shear_wave"]
    if ratio is not None:
        verdict = "inertia does not matter" if ratio < 0.1 else "INERTIA MATTERS: beyond the theory"
        lines.append(
            ("c/c_s", f"{ratio:.4g}", f"its speed over that of shear waves: {verdict}"),
        )
    return table(lines)


def _patch_lines(theory: dict[str, Any], fault: FaultParameters) -> list[str]:
    """L_s with its meaning, and the effect of the friction law's scales on it."""
    loading, law = fault.loading, fault.friction_law
    length = theory["stability_length"]
    head = f"The creeping patch itself, {BEGINS[loading]} (docs/creeping_patch.md):"
    if not math.isfinite(length):
        return wrapped(head, f"  no L_s: {theory['stability_length_reason']}")
    value = f"{length:.4g} m"
    ratio = f"{length / theory['critical_length']:.3g} L_c"
    page = ", docs/drop.md" if loading == "edge" else ""
    meaning = f"it turns unstable; an event follows later{page}"
    lines = [*wrapped(head), *table([("L_s", value, ratio, meaning)])]
    constant = theory["stability_length_of_constant_a_and_b"]
    if law and not abs(constant / length - 1.0) < _NOTEWORTHY:
        other = "none up to 3 L_c" if math.isnan(constant) else f"{constant:.4g} m"
        lines += wrapped(
            f"    a and b vary along the patch by the {law.law} law, {scales_text(law)}, "
            f"V = {in_unit(float(number(fault, 'velocity')), 'm/s')}; with constant a and b {other}"
        )
    return lines


def _length_rows(
    length: Length,
    answer: Answers,
    fault: FaultParameters,
    critical: float,
) -> list[Row]:
    """One length: value and formula, source, validity."""
    value = float(answer.length)
    text = f"{value:.4g} m"
    ratio = f"{value / critical:.3g} L_c" if math.isfinite(critical) else ""
    heights = (number(fault, "height"), number(fault, "second_height"))
    lowest = min(map(float, heights))
    is_of_half_spaces = length.system in (HALF_SPACES, TWO_MATERIALS)
    validity = f"valid: {length.validity}"
    if is_of_half_spaces and math.isfinite(lowest):
        validity = f"for half-spaces (here H = {in_unit(lowest, 'm')}), {length.validity}"
    if not math.isfinite(value):
        text, ratio = "-", ""
        validity = f"{_NO_LENGTH.get(str(answer.status), '')}{answer.reason}"
    rows: list[Row] = [
        (length.title, text, ratio, length.formula),
        f"      {length.source}",
        f"      {validity}",
    ]
    if length.beyond and formulas.between_localised_and_crack(
        number(fault, "a"), number(fault, "b")
    ):
        rows.append(f"      {length.beyond}")
    return rows
