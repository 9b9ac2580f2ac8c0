"""``nucleation length``: the critical length of a fault, and other lengths in use."""

import math
import textwrap
from pathlib import Path
from typing import Any

import click

from ..answers import formulas
from ..answers.draws import parse_range
from ..answers.in_use import LENGTHS, WEAKENING_RATE
from ..answers.length import HALF_SPACES, THIS_FAULT, TWO_MATERIALS, Length, of_two_materials
from ..answers.status import Answers, answers_of
from ..model.friction.law import Friction
from ..model.loading import LOADINGS
from ..model.material import Material
from ..model.quantities import ParameterError, declarations
from ..theory.arrays import critical_mode
from ..theory.creep.lengths import stability_answers, stability_values
from ..theory.fault import Fault
from ..theory.status import BEYOND, STABLE, UNKNOWN
from . import DONE, EXIT_CODES
from . import STABLE as CODE_OF_STABLE
from .fault_options import fault_options, fault_values
from .options import option
from .pages import with_addresses
from .system_text import (
    BEGINS,
    is_of_one_material,
    parameters_of,
    plane_in_words,
    printed_warnings,
    scales_line,
    system_of_fault,
    systems_of_lengths,
)
from .text import as_plain, to_json, wrapped
from .uncertainty import (
    draws_option,
    print_quantiles,
    ranges_among,
    samples_option,
    take_uncertain,
)
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
@click.option(
    "--loading",
    type=click.Choice(LOADINGS),
    default="edge",
    show_default=True,
    help="where the creeping patch begins: edge that is pushed, free side under a top that moves, "
    "or interior; a top that moves has --far-side velocity",
)
@patch_options
@samples_option
@draws_option(1000)
@click.option("--json", "as_json", is_flag=True, help="print JSON, in SI units")
def command(
    density: float | None,
    loading: str,
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
      nucleation length --shear-modulus 30GPa --poisson-ratio 0.25 --normal-stress 50MPa \\
          --a 0.010 --b 0.015 --slip-distance 5um --velocity 1mm/yr
    """
    options, uncertain = take_uncertain(options, samples)
    weakening_rate = options.pop("weakening_rate")
    of_patch = {name: options.pop(name) for name in OPTIONS}
    given, law, papers = fault_values(**options, ranges=True)
    uncertain = ranges_among(given) | uncertain
    if uncertain:
        for name, value in {"density": density, **of_patch}.items():
            if value is not None:
                raise ParameterError(f"{name} is not allowed beside ranges and samples")
        usual = {"weakening_rate": weakening_rate, "loading": loading, "draws": draws}
        return print_quantiles(given, uncertain, options | usual, as_json)
    if density is not None and "velocity" not in given:
        raise ParameterError("velocity is missing: --density needs it, for the mode's speed")
    with printed_warnings():
        fault = Fault(**given)
        found = answers_of(fault, weakening_rate)
        theory = _theory(given, fault, density, loading, law, found["critical_length"])
        patch = patch_of(fault, of_patch)
    answers = {}
    for length in LENGTHS:
        key = "stability_length" if length.system == THIS_FAULT else length.key
        answers[length.key] = found[key]
    system = system_of_fault(fault, given, loading) + papers
    if as_json:
        everything = {
            "system": system,
            "parameters": parameters_of(fault),
            "theory": theory,
            "weakening_patch": patch and patch._asdict(),
            "lengths": [
                {"key": length.key, **as_plain(answers[length.key]), **length.words()}
                for length in LENGTHS
            ],
        }
        click.echo(to_json(everything))
    else:
        of_patch_lines = []
        if patch:
            of_patch_lines = patch_lines(patch, of_patch["width"], theory["critical_length"])
        text = _as_text(system, fault, theory, answers, law, of_patch_lines)
        click.echo(with_addresses(text))
    return DONE if math.isfinite(theory["critical_length"]) else CODE_OF_STABLE


def _theory(
    given: dict[str, Any],
    fault: Fault,
    density: float | None,
    loading: str,
    law: Friction | None,
    critical: Answers,
) -> dict[str, Any]:
    """The theory's numbers for JSON, in SI units; NaN where there is none, with status."""
    velocity = fault.velocity or fault.slip_distance  # without V a rate V/D of one per second
    mode = critical_mode(**{**given, "velocity": velocity})
    length, wavenumber, frequency = map(float, mode)
    ratio = None
    if density is not None:
        shear_wave = Material(float(fault.shear_modulus), density=density).shear_wave_speed
        ratio = abs(frequency) / wavenumber / shear_wave
    if loading != "edge":
        law = None
    *numbers, status, reason = stability_answers(fault, law, loading)
    stability_length, own_frequency, error = map(float, numbers)
    constant = float(stability_values(fault, None, loading)[0]) if law else stability_length
    return {
        "critical_length": length,
        "critical_length_status": str(critical.status),
        "critical_length_reason": str(critical.reason),
        "critical_wavenumber": wavenumber,
        "critical_frequency": fault.velocity and frequency,
        "critical_frequency_over_rate": frequency / float(velocity / fault.slip_distance),
        "speed_over_shear_wave": ratio,
        "loading": loading,
        "stability_length": stability_length,
        "stability_length_status": str(status),
        "stability_length_reason": str(reason),
        "stability_frequency_over_rate": own_frequency,
        "stability_length_error": error,
        "stability_length_of_constant_a_and_b": constant,
    }


def _as_text(
    system: list[str],
    fault: Fault,
    theory: dict[str, Any],
    answers: dict[str, Answers],
    law: Friction | None,
    patch: list[str],
) -> str:
    lines = [
        *wrapped(*system),
        "",
        "Theory of homogeneous sliding, for this fault (Aldam et al., 2017, Eq. 5):",
    ]
    if math.isfinite(theory["critical_length"]):
        lines += [*_mode_lines(theory), "", *_patch_lines(theory, fault, law)]
    else:
        reason = textwrap.wrap(theory["critical_length_reason"], 90)
        lines += ["  no critical length:", *(f"  {line}" for line in reason)]
    if patch:
        lines += ["", *patch]
    for of_lengths in systems_of_lengths(fault):
        lines += ["", f"Lengths in use, for {of_lengths}:"]
        for length in LENGTHS:
            if length.system == of_lengths:
                critical = theory["critical_length"]
                lines += _length_lines(length, answers[length.key], fault, critical)
    lines += [
        "",
        f"in {plane_in_words(fault.plane)}, with {_moduli(fault)}, b = a + zeta, natural "
        "logarithms;",
        "all are full lengths",
    ]
    return "\n".join(lines)


def _moduli(fault: Fault) -> str:
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
    return f"{text}, M = {float(modulus):.4g} Pa"


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
        value = f"{theory[key]:.4g} {unit}"
        lines.append(f"  {name:<6} {value:<16} {meaning}")
    ratio = theory["speed_over_shear_wave"]
    if ratio is not None:
        verdict = "inertia does not matter" if ratio < 0.1 else "INERTIA MATTERS: beyond the theory"
        lines.append(f"  c/c_s  {ratio:<16.4g} its speed over that of shear waves: {verdict}")
    return lines


def _patch_lines(theory: dict[str, Any], fault: Fault, law: Friction | None) -> list[str]:
    """L_s with its meaning, and the effect of the friction law's scales on it."""
    loading = theory["loading"]
    length = theory["stability_length"]
    head = f"The creeping patch itself, {BEGINS[loading]} (docs/creeping_patch.md):"
    if not math.isfinite(length):
        return [head, f"  no L_s: {theory['stability_length_reason']}"]
    value = f"{length:.4g} m"
    ratio = f"{length / theory['critical_length']:.3g} L_c"
    page = ", docs/drop.md" if loading == "edge" else ""
    meaning = f"it turns unstable; an event follows later{page}"
    lines = [head, f"  L_s    {value:<11} {ratio:<10} {meaning}"]
    constant = theory["stability_length_of_constant_a_and_b"]
    if law and not abs(constant / length - 1.0) < _NOTEWORTHY:
        other = "none up to 3 L_c" if math.isnan(constant) else f"{constant:.4g} m"
        lines += [
            f"         with a and b that vary along the patch by the {law.law} law:",
            f"         {scales_line(law, float(fault.velocity))}; with constant a and b {other}",
        ]
    return lines


def _length_lines(length: Length, answer: Answers, fault: Fault, critical: float) -> list[str]:
    """One length: value and formula, source, validity."""
    value = float(answer.length)
    text = f"{value:.4g} m"
    ratio = f"{value / critical:.3g} L_c" if math.isfinite(critical) else ""
    lowest = min(float(fault.height), float(fault.second_height))
    is_of_half_spaces = length.system in (HALF_SPACES, TWO_MATERIALS)
    validity = f"valid: {length.validity}"
    if is_of_half_spaces and math.isfinite(lowest):
        validity = f"for half-spaces (here H = {lowest:g} m), {length.validity}"
    if not math.isfinite(value):
        text, ratio = "-", ""
        validity = f"{_NO_LENGTH.get(str(answer.status), '')}{answer.reason}"
    lines = [
        f"  {length.title:<28} {text:<11} {ratio:<10} {length.formula}",
        f"      {length.source}",
        f"      {validity}",
    ]
    if length.beyond and formulas.between_localised_and_crack(fault.a, fault.b):
        indent = 6 * " "
        lines += textwrap.wrap(
            length.beyond,
            width=94,
            initial_indent=indent,
            subsequent_indent=indent,
        )
    return lines
