"""``nucleation length``: the theory's critical length of a fault beside the lengths in use."""

import json
import textwrap
from pathlib import Path
from typing import Any

import click
import numpy as np

from ..commands import DONE, EXIT_CODES, STABLE, units
from ..model.friction.law import Friction
from ..model.loading import LOADINGS
from ..model.material import Material
from ..model.quantities import ParameterError, declarations
from ..theory.arrays import CriticalMode, critical_mode, reason_of_stability
from ..theory.creep.lengths import stability_values
from ..theory.fault import Fault
from ..theory.literature_table import (
    HALF_SPACES,
    LENGTHS,
    TWO_MATERIALS,
    WEAKENING_RATE,
    Length,
    of_two_materials,
    values_of,
)
from ..theory.uncertainty import Range, parse_range
from .fault_options import assumed_line, doubts_told, fault_options, fault_values, given_of
from .options import scales
from .system import BEGINS, system_line, systems_of_lengths
from .text import plain
from .uncertainty import print_quantiles, samples_option, take_uncertain

NOTEWORTHY = 0.03
"""Relative change of L_s by the scales of the usual friction law that is told."""

DENSITY = declarations(Material)["density"]


@click.command("length", epilog=EXIT_CODES)
@fault_options
@units.option(
    "--density", key="density", entry=DENSITY,
    note="to check that inertia does not matter; needs --velocity",
)  # fmt: skip
@units.option(
    "--weakening-rate", key="weakening_rate", entry=WEAKENING_RATE,
    note="of Uenishi and Rice's length; b sigma0/D if left out", read=parse_range,
)  # fmt: skip
@click.option(
    "--loading", type=click.Choice(LOADINGS), default="edge", show_default=True,
    help="where the creeping patch begins: edge that is pushed, free side under a top that moves, "
    "or interior; a top that moves has --far-side velocity",
)  # fmt: skip
@samples_option
@click.option("--json", "as_json", is_flag=True, help="print JSON, in SI units")
def command(
    density: float | None, loading: str, as_json: bool, samples: Path | None,
    **options: Any,
) -> int:  # fmt: skip
    """Critical nucleation length of a fault: the theory's, and others in use.

    A range "5um (3 to 10)", the median and the quantiles of 5 and 95 %, or --samples give the
    quantiles of each length.

    Friction is f0 + a log(v/V) + b log(phi V/D) with NATURAL logarithms; zeta = b - a > 0 weakens.

    \b
    Example:
      nucleation length --shear-modulus 30GPa --poisson 0.25 --normal-stress 50MPa \\
          --a 0.010 --b 0.015 --slip-distance 5um --velocity 1mm/yr
    """
    chosen = {"law": options["friction_law"], "evolution": options["evolution"]}
    law = Friction(**{name: value for name, value in chosen.items() if value is not None})
    options, uncertain = take_uncertain(options, samples)
    weakening_rate = options.pop("weakening_rate")
    given = fault_values(**options, ranges=True)
    uncertain = {k: v for k, v in given.items() if isinstance(v, Range)} | uncertain
    if uncertain:
        if density is not None:
            raise ParameterError("density is not allowed beside ranges and samples")
        usual = {"weakening_rate": weakening_rate, "loading": loading}
        return print_quantiles(given, uncertain, options | usual, as_json)
    if density is not None and "velocity" not in given:
        raise ParameterError("velocity is missing: --density needs it, for the mode's speed")
    with doubts_told():
        fault = Fault(**given)
        mode = critical_mode(
            **given if "velocity" in given else {**given, "velocity": _unit_rate(fault)}
        )
    lengths = values_of(fault, weakening_rate)
    print_as = _as_json if as_json else _as_text
    said = [system_line(fault, loading), *assumed_line(given)]
    found = {k: float(lengths[k]) for k in lengths}
    click.echo(print_as(said, fault, mode, found, density, loading, law))
    return DONE if np.isfinite(mode.length) else STABLE


def _unit_rate(fault: Fault) -> float:
    """The velocity (m/s) at which V/D is one per second."""
    return float(fault.slip_distance)


def _over_rate(fault: Fault, mode: CriticalMode) -> float:
    """Angular frequency of the critical mode over V/D, which the velocity has no part in."""
    rate = (fault.velocity or _unit_rate(fault)) / fault.slip_distance
    return float(mode.angular_frequency / rate)


def _as_json(
    said: list[str], fault: Fault, mode: CriticalMode, lengths: dict[str, float],
    density: float | None, loading: str, law: Friction,
) -> str:  # fmt: skip
    return json.dumps(
        {
            "system": said,
            "parameters": given_of(fault),
            "theory": {
                "critical_length": plain(mode.length),
                "critical_wavenumber": plain(mode.wavenumber),
                "critical_frequency": fault.velocity and plain(mode.angular_frequency),
                "critical_frequency_over_rate": plain(_over_rate(fault, mode)),
                "speed_over_shear_wave": plain(_speed_ratio(fault, mode, density)),
                "loading": loading,
                **{name: plain(value) for name, value in _stability(fault, loading, law).items()},
            },
            "lengths": [
                {"key": length.key, "length": plain(lengths[length.key]), **length.words()}
                for length in LENGTHS
            ],
        },
        indent=2,
    )  # fmt: skip


def _as_text(
    said: list[str], fault: Fault, mode: CriticalMode, lengths: dict[str, float],
    density: float | None, loading: str, law: Friction,
) -> str:  # fmt: skip
    lines = [
        *(line for text in said for line in textwrap.wrap(text, 95, subsequent_indent="  ")),
        "",
        *_theory_lines(fault, mode, density),
        *_patch_lines(fault, float(mode.length), loading, law),
    ]
    one_material = (fault.shear_modulus, fault.poisson_ratio) == (
        fault.second_shear_modulus, fault.second_poisson_ratio,
    )  # fmt: skip
    differ = not one_material and np.isfinite(float(fault.second_shear_modulus))
    for system in systems_of_lengths(bool(differ)):
        lines += ["", f"Lengths in use, for {system}:"]
        for length in LENGTHS:
            if length.system == system:
                lines += _length_lines(length, lengths[length.key], fault, float(mode.length))
    modulus = "" if one_material else f", M = {float(of_two_materials(fault)[0]):.4g} Pa"
    star = "mu/(1 - nu)" if fault.plane == "strain" else "mu (1 + nu)"
    lines += [
        "",
        f"in plane {fault.plane}, with mu* = {star}{modulus}, b = a + zeta, natural logarithms;",
        "all are full lengths",
    ]
    return "\n".join(lines)


def _theory_lines(fault: Fault, mode: CriticalMode, density: float | None) -> list[str]:
    """Length, wavenumber and frequency of the critical mode."""
    head = "Theory of homogeneous sliding, for this fault (Aldam et al., 2017, Eq. 5):"
    if not np.isfinite(mode.length):
        reason = textwrap.wrap(reason_of_stability(fault), 90)
        return [head, "  no critical length:", *(f"  {line}" for line in reason)]
    frequency = float(mode.angular_frequency)
    lines = [
        head,
        f"  L_c    {_metres(mode.length):<16} critical nucleation length, 2 pi/k_c",
        f"  k_c    {f'{float(mode.wavenumber):.4g} 1/m':<16} critical wavenumber",
    ]
    unit, note = "rad/s", "angular frequency of the critical mode"
    if fault.velocity is None:
        unit, note = "V/D", f"{note} (in rad/s with --velocity)"
    lines.append(f"  omega  {f'{frequency:.4g} {unit}':<16} {note}")
    ratio = _speed_ratio(fault, mode, density)
    if ratio is not None:
        verdict = "inertia does not matter" if ratio < 0.1 else "INERTIA MATTERS: beyond the theory"
        lines.append(f"  c/c_s  {ratio:<16.4g} its speed over the shear waves': {verdict}")
    return lines


def _stability(fault: Fault, loading: str, law: Friction) -> dict[str, float]:
    """L_s with constant a and b, its frequency and error, and L_s as simulations have friction."""
    length, frequency, error = (float(value) for value in stability_values(fault, None, loading))
    found = {
        "stability_length": length,
        "stability_frequency_over_rate": frequency,
        "stability_length_error": error,
    }
    given = fault.velocity is not None and fault.friction is not None
    if given and loading == "edge" and np.isfinite(length):
        try:
            simulated = float(stability_values(fault, law)[0])
            found["stability_length_as_simulated"] = simulated
        except ParameterError:
            pass  # the law can't have these constants
    return found


def _patch_lines(fault: Fault, critical: float, loading: str, law: Friction) -> list[str]:
    """L_s, what it means, and what friction's own scales make of it."""
    if not np.isfinite(critical):
        return []
    found = _stability(fault, loading, law)
    head = ["", f"The creeping patch itself, {BEGINS[loading]} (docs/patch_theory.md):"]
    length = found["stability_length"]
    if not np.isfinite(length):
        return [
            *head,
            "  no L_s: no patch up to 3 L_c turns unstable, or its creep opens it",
        ]
    lines = [
        *head,
        f"  L_s    {_metres(length):<11} {f'{length / critical:.3g} L_c':<10} "
        "it turns unstable; an event follows later"
        + (", docs/drop.md" if loading == "edge" else ""),
    ]
    own = found.get("stability_length_as_simulated", length)
    if not abs(own / length - 1.0) < NOTEWORTHY:
        said = "none up to 3 L_c" if np.isnan(own) else f"{own:.4g} m, {own / critical:.3g} L_c,"
        lines.append(
            f"         {said} with the law of `simulate` and `drop`, {law.law}, whose a and b\n"
            f"         change along the patch: {scales(law, float(fault.velocity))}"
        )
    return lines


def _speed_ratio(fault: Fault, mode: CriticalMode, density: float | None) -> float | None:
    """Phase speed of the critical mode over the shear waves' of the first body."""
    if density is None:
        return None
    speed = abs(float(mode.angular_frequency)) / float(mode.wavenumber)
    return speed / Material(float(fault.shear_modulus), density=density).shear_wave_speed


def _length_lines(length: Length, value: float, fault: Fault, critical: float) -> list[str]:
    """One length: value and formula, source, validity."""
    if np.isfinite(value):
        ratio = f"{value / critical:.3g} L_c" if np.isfinite(critical) else ""
        said, valid = _metres(value), f"valid: {length.validity}"
        lowest = min(float(fault.height), float(fault.second_height))
        if length.system in (HALF_SPACES, TWO_MATERIALS) and np.isfinite(lowest):
            valid = f"for half-spaces (here H = {lowest:g} m), {length.validity}"
    else:
        said, ratio = "-", ""
        valid = f"NOT VALID HERE, needs {length.needs}: {_why(length, fault)}"
    return [
        f"  {length.title:<28} {said:<11} {ratio:<10} {length.formula}",
        f"      {length.source}",
        f"      {valid}",
    ]


def _why(length: Length, fault: Fault) -> str:
    """What of the fault decides on the validity of a length."""
    a, b, zeta, height = (float(x) for x in (fault.a, fault.b, fault.zeta, fault.height))
    facts = []
    if "a/b" in length.needs:
        facts.append(f"a/b = {a / b:.4g}" if b > 0.0 else f"b = {b:.4g}")
    if "zeta" in length.needs:
        facts.append(f"zeta = {zeta:.4g}")
    if "b > 0" in length.needs:
        facts.append(f"b = {b:.4g}")
    if "beta" in length.needs:
        facts.append(f"f |beta| = {float(of_two_materials(fault)[1]):.4g}")
    if "H/L" in length.needs:
        facts.append(f"H = {height:g} m")
    return ", ".join(facts)


def _metres(value: Any) -> str:
    return f"{float(value):.4g} m"
