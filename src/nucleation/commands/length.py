"""``nucleation length``: the lengths of a fault, each with its range, status and reason."""

from __future__ import annotations

import math
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..lengths import formulas
from ..lengths.answer import Answer
from ..lengths.draws import WEAKENING_RATE, parse_range
from ..lengths.in_use import LENGTHS
from ..lengths.length import HALF_SPACES, TWO_MATERIALS, Length, number, of_two_materials
from ..model.quantities import ParameterError, declarations
from ..model.settings import Perturbation
from ..theory.status import BEYOND, STABLE, UNKNOWN
from . import DONE, EXIT_CODES
from . import STABLE as CODE_OF_STABLE
from .faults import fault_options, given_fault, samples_of
from .options import draws_option, json_option, option, samples_option, together
from .system_text import (
    BEGINS,
    is_of_one_material,
    parameters_of,
    plane_in_words,
    printed_warnings,
    scales_text,
    system_of_fault,
)
from .text import Row, show, table, wrapped
from .unit_text import in_unit
from .weakening_patch import OPTIONS, patch_lines, patch_of, patch_options

if TYPE_CHECKING:
    from ..fault import Fault

_NOTEWORTHY = 0.03
"""Least relative change of L_s by the scales of the friction law that is printed."""

_NO_LENGTH = {
    STABLE: "NO LENGTH, STABLE: ",
    BEYOND: "LONGER THAN SEARCHED: ",
    UNKNOWN: "NOT VALID HERE, ",
}
"""The beginning of a reason in place of a length, by the status."""

_PERTURBED = declarations(Perturbation)
_OF_PERTURBATION = ("perturbation", "strength", "correlation_time", "correlation_length")

perturbation_options = together(
    option(
        "--perturbation",
        key="perturbation",
        entry=_PERTURBED["kind"],
        note="of the length at the drop; normal_load if left out, none: without it",
    ),
    option("--strength", key="strength", entry=_PERTURBED["strength"], note="1e-4 if left out"),
    option(
        "--correlation-time", key="correlation_time", entry=_PERTURBED["correlation_time"], note="1"
    ),
    option(
        "--correlation-length",
        key="correlation_length",
        entry=_PERTURBED["correlation_length"],
        note="a fifth of L_b if left out",
    ),
)
"""The perturbation of the length at the drop, the arguments of ``Fault.lengths``."""


@click.command("length", epilog=EXIT_CODES)
@fault_options
@perturbation_options
@option(
    "--weakening-rate",
    key="weakening_rate",
    entry=WEAKENING_RATE,
    note="of Uenishi and Rice's length; b sigma0/D if left out",
    read=parse_range,
)
@patch_options
@samples_option
@draws_option(200)
@json_option
def command(
    as_json: bool,
    samples: Path | None,
    draws: int,
    **options: Any,
) -> int:
    """Nucleation lengths of a fault: the theory's, the one at the drop, and others in use.

    With --velocity and --friction it has L, at which the force drops under a perturbation. With a
    range "5um (3 to 10)", the median and the quantiles of 5 and 95 %, or with --samples it prints
    the quantiles of each length; with L if --strength or --perturbation is given.

    Friction is f0 + a log(v/V) + b log(phi V/D) with NATURAL logarithms; zeta = b - a > 0 weakens.

    \b
    Example:
      nucleation length --shear-modulus 30GPa --poisson-ratio 0.25 \\
          --normal-stress 50MPa --a 0.010 --b 0.015 --slip-distance 5um
    """
    perturbed = {n: options[n] for n in _OF_PERTURBATION if options[n] is not None}
    of_patch = {name: options[name] for name in OPTIONS}
    columns = samples_of(samples)
    with printed_warnings():
        given = given_fault(options, columns, draws)
        if given.drawn:
            from .quantiles import print_quantiles

            for name, value in of_patch.items():
                if value is not None:
                    raise ParameterError(f"{name} is not allowed beside ranges and samples")
            rate = given.drawn.values.get("weakening_rate", options["weakening_rate"])
            return print_quantiles(given, perturbed, rate, as_json)
        found = given.fault.lengths(**perturbed, weakening_rate=options["weakening_rate"])
        patch = patch_of(given.fault, of_patch)
        mode = _mode(given.fault)
    system = system_of_fault(given.fault, given.names, given.papers)
    lines = _lines(given.fault, mode, found)
    if patch:
        width, critical = of_patch["width"], found["critical_length"].value
        lines[-1:-1] = [
            *patch_lines(
                patch,
                width,
                critical,
            ),
            "",
        ]
    everything = {
        "system": system,
        "parameters": parameters_of(given.fault),
        "mode": mode,
        "perturbation": perturbed,
        "weakening_patch": patch,
        "lengths": [_described(key, answer) for key, answer in found.items()],
    }
    show(as_json, everything, [*wrapped(*system, ""), *lines])
    return DONE if found["critical_length"].exists else CODE_OF_STABLE


_WORDS = {length.key: length.words() for length in LENGTHS}


def _described(key: str, answer: Answer) -> dict[str, Any]:
    """A length for JSON, in SI units."""
    numbers = {name: float(getattr(answer, name)) for name in ("value", "low", "high")}
    texts = {name: str(getattr(answer, name)) for name in ("status", "reason", "doubt")}
    return {"key": key, **numbers, **texts, **_WORDS.get(key, {"units": "m"})}


def _mode(fault: Fault) -> dict[str, Any]:
    """Wavenumber and frequency of the critical mode; without V the frequency over V/D."""
    distance = fault.single("slip_distance")
    velocity = distance if fault.velocity is None else fault.single("velocity")
    _, wavenumber, frequency = map(float, fault.replace(velocity=velocity).critical_mode())
    ratio = None
    density = fault.single("density")
    if fault.velocity is not None and density > 0.0:
        shear_wave = math.sqrt(fault.single("shear_modulus") / density)
        ratio = abs(frequency) / wavenumber / shear_wave
    return {
        "critical_wavenumber": wavenumber,
        "critical_frequency": None if fault.velocity is None else frequency,
        "critical_frequency_over_rate": frequency * distance / velocity,
        "speed_over_shear_wave": ratio,
    }


def _lines(fault: Fault, mode: Mapping[str, Any], found: Mapping[str, Answer]) -> list[str]:
    """The answer in lines that fit the terminal."""
    critical = found["critical_length"]
    lines = wrapped(f"Theory of homogeneous sliding, in {plane_in_words(fault.plane)}:")
    if critical.exists:
        lines += [
            *_mode_lines(
                fault,
                critical,
                mode,
            ),
            "",
            *_patch_lines(fault, found),
        ]
    else:
        lines += wrapped(f"  no critical length: {critical.reason}")
    of_system: dict[str, list[Row]] = {}
    for length in LENGTHS:
        if length.key in found:
            rows = _length_rows(length, found[length.key], fault, critical.value)
            of_system.setdefault(length.system, []).extend(rows)
    for system in sorted(of_system, key=lambda system: system != TWO_MATERIALS):
        lines += ["", *wrapped(f"Lengths in use, for {system}:"), *table(of_system[system])]
    remark = (
        f"in {plane_in_words(fault.plane)}, with {_moduli(fault)}, b = a + zeta, natural "
        "logarithms; all are full lengths"
    )
    return [*lines, "", *wrapped(remark)]


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
    return f"{text}, M = {in_unit(float(modulus), 'Pa')}"


def _mode_lines(fault: Fault, critical: Answer, mode: Mapping[str, Any]) -> list[str]:
    """Length, wavenumber and frequency of the critical mode."""
    meaning = "angular frequency of the critical mode"
    frequency, unit = mode["critical_frequency"], "rad/s"
    if frequency is None:
        frequency, unit = mode["critical_frequency_over_rate"], "V/D"
        meaning += " (in rad/s with --velocity)"
    lines: list[Row] = [
        ("L_c", f"{critical.value:.4g} m", "critical nucleation length, 2 pi/k_c"),
        ("k_c", f"{mode['critical_wavenumber']:.4g} 1/m", "critical wavenumber"),
        ("omega", f"{frequency:.4g} {unit}", meaning),
    ]
    ratio = mode["speed_over_shear_wave"]
    if ratio is not None:
        verdict = "inertia does not matter" if ratio < 0.1 else "INERTIA MATTERS: beyond the theory"
        density = f"{fault.single('density'):.4g} kg/m^3"
        lines.append(
            ("c/c_s", f"{ratio:.4g}", f"its speed over that of shear waves ({density}): {verdict}")
        )
    return table(lines)


_OF_PATCH = {
    "stability_length": ("L_s", "it turns unstable"),
    "runaway_length": ("L_run", "slow slip ends there, where friction weakens little"),
    "drop_length": ("L", "the force drops (docs/drop.md)"),
    "process_zone": ("L_pz", "process zone: a mesh has to resolve it"),
}


def _patch_lines(fault: Fault, found: Mapping[str, Answer]) -> list[str]:
    """L_s, L_run and L with their ranges, and the effect of the friction law's scales on L_s."""
    critical = found["critical_length"].value
    rows: list[Row] = []
    for key, (symbol, meaning) in _OF_PATCH.items():
        answer = found.get(key)
        if answer is None:
            continue
        if not answer.exists:
            rows.append(f"  no {symbol}: {answer.reason}")
            continue
        span = f"{answer.value / critical:.3g} L_c"
        if key != "stability_length" and answer.high > answer.low:
            span += f" ({answer.low:.4g} to {answer.high:.4g} m)"
        rows.append((symbol, f"{float(answer.value):.4g} m", span, meaning))
        if answer.doubt:
            rows.append(f"      DO NOT RELY ON IT: {answer.doubt}")
    head = f"The creeping patch itself, {BEGINS[fault.loading]} (docs/creeping_patch.md):"
    return [*wrapped(head), *table(rows), *_effect_of_law(fault, found["stability_length"])]


def _effect_of_law(fault: Fault, stability: Answer) -> list[str]:
    law = fault.friction_law
    if law is None or not stability.exists:
        return []
    constant = float(fault.replace(friction_law=None, **_constants(fault)).stability_length())
    if abs(constant / stability.value - 1.0) < _NOTEWORTHY:
        return []
    other = "none up to 3 L_c" if math.isnan(constant) else f"{constant:.4g} m"
    return wrapped(
        f"    a and b vary along the patch by the {law.law} law, {scales_text(law)}, "
        f"V = {in_unit(fault.single('velocity'), 'm/s')}; with constant a and b L_s = {other}"
    )


def _constants(fault: Fault) -> dict[str, float]:
    return {n: fault.single(n) for n in ("friction", "a", "zeta", "slip_distance")}


def _length_rows(
    length: Length,
    answer: Answer,
    fault: Fault,
    critical: float,
) -> list[Row]:
    """One length of the literature: value and formula, source, validity."""
    value = float(answer.value)
    text = f"{value:.4g} m"
    ratio = f"{value / critical:.3g} L_c" if math.isfinite(critical) else ""
    lowest = min(fault.single("height"), fault.single("second_height"))
    validity = f"valid: {length.validity}"
    if length.system in (HALF_SPACES, TWO_MATERIALS) and math.isfinite(lowest):
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
