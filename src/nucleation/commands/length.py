"""``nucleation length``: the lengths of a fault, each with its range, status and reason."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import click

from ..answers.answer import Answer
from ..answers.drop import USUAL_STRENGTH
from ..answers.lengths import MEANINGS, SYMBOLS, Lengths
from ..lengths import formulas
from ..lengths.formulas import TWO_MATERIALS, Length, of_two_materials
from ..lengths.in_use import LENGTHS
from ..lengths.ranges import DRAWS, WEAKENING_RATE, parse_range
from ..model.quantities import ParameterError, declarations, declared
from ..model.settings import Perturbation
from ..model.units import in_metres, in_unit
from ..theory.status import BEYOND, STABLE, UNKNOWN
from ..theory.values import QUANTITIES
from . import DONE, EXIT_CODES
from . import STABLE as CODE_OF_STABLE
from .given import (
    fault_options,
    given_fault,
    json_option,
    option,
    options_of,
    parameters_of,
    printed_warnings,
    system_of_fault,
)
from .text import Row, show, table, wrapped

if TYPE_CHECKING:
    from ..fault import Fault

_NO_LENGTH = {
    STABLE: "NO LENGTH, STABLE: ",
    BEYOND: "LONGER THAN SEARCHED: ",
    UNKNOWN: "NOT VALID HERE, ",
}
"""The beginning of a reason in place of a length, by the status."""

_PERTURBED = declarations(Perturbation)
_OF_PERTURBATION = {"perturbation": _PERTURBED["kind"], "strength": _PERTURBED["strength"]}
"""The perturbation of the length at the drop, the arguments of ``Fault.lengths``."""

_OF_PATCH = {
    "outside_zeta": QUANTITIES["zeta"],
    "outside_a": QUANTITIES["a"],
    "width": declared(
        "width W of a weakening patch among strengthening surroundings", "(0.0, 1e6) m"
    ),
}

_NOTES = {
    "perturbation": "until the patch runs away; normal_load if left out, none: without L",
    "strength": f"{USUAL_STRENGTH:g} if left out",
    "outside_zeta": "of the surroundings of a weakening patch, for W_c and --width",
    "outside_a": "of the surroundings; that of the patch if left out",
    "width": "needs --outside-zeta",
}


@click.command("length", epilog=EXIT_CODES)
@fault_options
@options_of(_OF_PERTURBATION, _NOTES)
@option(
    "weakening_rate",
    WEAKENING_RATE,
    "of Uenishi and Rice's length, with --all; b sigma0/D if left out",
    parse_range,
)
@options_of(_OF_PATCH, _NOTES)
@option("draws", DRAWS, "of uncertain parameters; default 200", default="200")
@click.option("--all", "with_literature", is_flag=True, help="add the lengths of the literature")
@json_option
def command(as_json: bool, with_literature: bool, draws: int, **options: Any) -> int:
    """How long a slipping patch of a fault must grow before it runs away.

    The patch begins where the fault is pushed at an edge. The answer L comes first, with the
    lengths that it rests on: L_s, where the patch turns unstable, and L_c of a fault that slides
    everywhere. L is one number with --friction; --velocity sets the unit of time.

    With a range "5um (3 to 10)", the median and the quantiles of 5 and 95 %, it prints the
    quantiles of each length; with L if --strength or --perturbation is given.

    Friction is f0 + a log(v/V) + b log(phi V/D) with NATURAL logarithms; zeta = b - a > 0 weakens.

    \b
    Example:
      nucleation length --shear-modulus 30GPa --poisson-ratio 0.25 \\
          --normal-stress 50MPa --a 0.010 --b 0.015 --slip-distance 5um
    """
    perturbed = {n: options[n] for n in _OF_PERTURBATION if options[n] is not None}
    of_patch = {name: options[name] for name in _OF_PATCH}
    with_literature = with_literature or options["weakening_rate"] is not None
    with printed_warnings():
        fault, names, drawn = given_fault(options, draws)
        if drawn:
            from .quantiles import print_quantiles

            for name, value in of_patch.items():
                if value is not None:
                    raise ParameterError(f"{name} is not allowed beside ranges")
            rate = drawn.values.get("weakening_rate", options["weakening_rate"])
            perturbed = perturbed or {"perturbation": "none"}
            return print_quantiles(
                fault,
                names,
                drawn,
                options["paper"],
                with_literature,
                as_json,
                **perturbed,
                weakening_rate=rate,
            )
        found = fault.lengths(**perturbed, weakening_rate=options["weakening_rate"])
        patch = None
        if of_patch["outside_zeta"] is not None:
            from ..lengths.weakening_patch import patch_answer

            patch = patch_answer(fault, *of_patch.values())
        elif any(value is not None for value in of_patch.values()):
            raise ParameterError(
                "outside_zeta is missing: give --outside-zeta, the velocity weakening of the "
                "patch's surroundings, negative where they strengthen"
            )
        mode = _mode(fault)
    system = system_of_fault(fault, names, options["paper"])
    critical = found["critical_length"]
    lines = wrapped(found.sentence, *found.remarks, *system)
    lines += ["", *_theory_lines(found)]
    if critical.exists:
        lines += ["", "Homogeneous sliding:", *_mode_lines(fault, mode)]
    if patch:
        lines += _patch_lines(patch, of_patch["width"], critical.value)
    if with_literature:
        lines += _literature_lines(fault, found)
    else:
        lines += wrapped("", "Lengths of the literature: --all.")
    remark = f"{_moduli(fault)}, b = a + zeta, natural logarithms; all are full lengths"
    everything = {
        "answer": found.sentence,
        "system": system,
        "parameters": parameters_of(fault),
        "mode": mode,
        "perturbation": perturbed,
        "weakening_patch": patch,
        "lengths": [
            {"key": key, **answer._asdict(), "units": "m"} for key, answer in found.items()
        ],
    }
    if with_literature:
        everything["literature"] = [
            {"key": key, **answer._asdict(), **_WORDS[key]}
            for key, answer in found.literature.items()
        ]
    show(as_json, everything, [*lines, "", *wrapped(remark)])
    return DONE if critical.exists else CODE_OF_STABLE


_WORDS = {length.key: length.words() for length in LENGTHS}


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


def _moduli(fault: Fault) -> str:
    """The moduli in the formulas: mu*, and M of two materials."""
    star = {"strain": "mu/(1 - nu)", "stress": "mu (1 + nu)", "antiplane": "mu"}
    text = f"mu* = {star[fault.plane]}"
    second = (fault.second_shear_modulus, fault.second_poisson_ratio)
    if (fault.shear_modulus, fault.poisson_ratio) == second:
        return text
    modulus, _ = of_two_materials(fault)
    return f"{text}, M = {in_unit(float(modulus), 'Pa')}"


def _theory_lines(found: Lengths) -> list[str]:
    """L and the lengths that it rests on, with their ranges, and over L_c."""
    critical = found["critical_length"].value
    rows: list[Row] = []
    for key, answer in found.items():
        symbol = SYMBOLS[key]
        if not answer.exists:
            rows.append(f"  no {symbol}: {answer.reason}")
            continue
        span = f"{answer.value / critical:.3g} L_c" if math.isfinite(critical) else ""
        if key != "stability_length" and answer.high > answer.low:
            span += f" ({in_metres(answer.low, answer.high)})"
        rows.append((symbol, in_metres(answer.value), span, MEANINGS[key]))
    return table(rows)


def _mode_lines(fault: Fault, mode: Mapping[str, Any]) -> list[str]:
    """Wavenumber and frequency of the critical mode."""
    meaning = "angular frequency of the critical mode"
    frequency, unit = mode["critical_frequency"], "rad/s"
    if frequency is None:
        frequency, unit = mode["critical_frequency_over_rate"], "V/D"
        meaning += " (in rad/s with --velocity)"
    lines: list[Row] = [
        ("k_c", f"{mode['critical_wavenumber']:.4g} 1/m", "critical wavenumber, 2 pi/L_c"),
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


def _literature_lines(fault: Fault, found: Lengths) -> list[str]:
    """The lengths of the literature, by the systems for which they are: two materials first."""
    critical = found["critical_length"].value
    of_system: dict[str, list[Row]] = {}
    for length in LENGTHS:
        if length.key in found.literature:
            rows = _length_rows(length, found.literature[length.key], fault, critical)
            of_system.setdefault(length.system, []).extend(rows)
    lines = []
    for system in sorted(of_system, key=lambda system: system != TWO_MATERIALS):
        lines += ["", *wrapped(f"Lengths of the literature, for {system}:")]
        lines += table(of_system[system])
    return lines


def _length_rows(length: Length, answer: Answer, fault: Fault, critical: float) -> list[Row]:
    """One length of the literature: value and formula, source, what it answers and for what."""
    value = float(answer.value)
    text, ratio = "-", ""
    if answer.exists:
        text = in_metres(value)
        ratio = f"{value / critical:.3g} L_c" if math.isfinite(critical) else ""
    rows: list[Row] = [
        (length.title, text, ratio, length.formula),
        f"      {length.source}",
        f"      {length.question} {length.setting}",
    ]
    if not answer.exists:
        rows.append(f"      {_NO_LENGTH.get(str(answer.status), '')}{answer.reason}")
    elif answer.doubt:
        rows.append(f"      NOT THIS FAULT: {answer.doubt}")
    a, b = fault.a, fault.b
    if length.beyond and formulas.between_localised_and_crack(a, b):
        rows.append(f"      {length.beyond}")
    return rows


def _patch_lines(patch: dict[str, Any], width: float | None, critical: float) -> list[str]:
    """The smallest width W_c, and the behaviour of a patch of a width (m)."""
    head = "A weakening patch among strengthening surroundings (docs/creeping_patch.md):"
    smallest = patch["smallest_width"]
    rows: list[Row] = []
    if math.isnan(smallest):
        rows.append("  no W_c: the patch is stable, or its surroundings are not")
    else:
        ratio = f"{smallest / critical:.3g} L_c"
        meaning = "smallest width at which slip is unstable; a narrower patch creeps"
        rows.append(("W_c", in_metres(smallest), ratio, meaning))
        if width is not None:
            own = f"{patch['width_ratio']:.3g} W_c"
            rows.append(("W", in_unit(width, "m"), own, patch["outcome"]))
            if patch["width_ratio"] >= 1.0:
                from ..lengths.weakening_patch import SETTING

                rows.append(f"      simulated: {SETTING}")
    return ["", *wrapped(head), *table(rows)]
