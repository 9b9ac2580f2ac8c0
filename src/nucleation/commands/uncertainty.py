"""Parameters that are ranges or samples, and the quantiles of lengths that follow from them."""

import math
import textwrap
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import click
import numpy as np

from ..answers.draws import DRAWS, Range
from ..answers.in_use import LENGTHS, THIS_FAULT, TWO_MATERIALS
from ..answers.uncertainty import QUANTILES, length_quantiles
from ..configuration.samples import read_samples
from ..model.quantities import ParameterError
from ..theory.fault import Fault
from . import DONE, STABLE
from .fault_options import doubts_told, parameters_of, said_of, systems_of_lengths
from .options import Decorator, option
from .progress import Progress
from .text import to_json, wrapped

samples_option = click.option(
    "--samples",
    type=click.Path(exists=True, dir_okay=False, path_type=Path),
    help="CSV of joint samples: a column for each parameter, such as 'slip_distance (um)'",
)


def draws_option(usual: int) -> Decorator:
    """The option for the number of draws, with a command's usual number."""
    note = f"of uncertain parameters, and most rows of --samples; default {usual}"
    return option("--draws", key="draws", entry=DRAWS, note=note, default=str(usual))


def take_uncertain(
    options: dict[str, Any], samples: Path | None
) -> tuple[dict[str, Any], dict[str, Any]]:
    """Options with medians in the place of ranges and samples, and those themselves.

    Raises ParameterError if a parameter is given twice, or what stays while `a` varies is not said.
    """
    uncertain: dict[str, Any] = {k: v for k, v in options.items() if isinstance(v, Range)}
    if samples is not None:
        uncertain |= (drawn := read_samples(samples))
        if twice := [name for name in drawn if options.get(name) is not None]:
            raise ParameterError(f"{twice[0]} is given twice: as an option and in {samples}")
    medians = options | {name: float(np.median(values)) for name, values in uncertain.items()}
    given = any(medians.get(name) is not None for name in ("zeta", "b", "file"))
    if "a" in uncertain and not given:
        raise ParameterError("zeta or b is needed beside an uncertain a: which one stays as it is?")
    if options["per_decade"]:
        for name in uncertain.keys() & {"a", "b", "zeta"}:
            value = uncertain[name]
            if isinstance(value, Range):
                ends = value, value.low, value.high
                uncertain[name] = Range(*(end / math.log(10.0) for end in ends))
            else:
                uncertain[name] = value / math.log(10.0)
    return medians, uncertain


def varying(
    given: dict[str, Any], uncertain: dict[str, Any], options: dict[str, Any]
) -> dict[str, Any]:
    """The parameters of a median fault with those that are uncertain in their place.

    If b was given it stays when a varies, and a second body like the first varies with it.
    """
    known = dict(given)
    if options["b"] is not None and "zeta" in known:
        known["b"] = known["a"] + known.pop("zeta")
    if options["second_body"] in (None, "same"):
        for name in ("shear_modulus", "poisson_ratio", "height"):
            if known.get(f"second_{name}") == known.get(name):
                known.pop(f"second_{name}", None)
    return known | uncertain


def print_quantiles(
    given: dict[str, Any], uncertain: dict[str, Any], options: dict[str, Any], as_json: bool
) -> int:
    """Print the quantiles of all lengths, and return the exit code; `given` is the median fault."""
    known = varying(given, uncertain, options)
    known |= {name: options[name] for name in ("weakening_rate", "loading", "draws")}
    if "weakening_rate" in uncertain:
        known["weakening_rate"] = uncertain["weakening_rate"]
    with doubts_told():
        middle = Fault(**given)
        found = length_quantiles(progress=Progress("draws"), **known)
    said = said_of(middle, given, options["loading"])
    click.echo((_as_json if as_json else _as_text)(said, found, middle, uncertain))
    return DONE if found["share"][0] > 0.0 else STABLE


def _as_json(said: list[str], found: Any, middle: Fault, uncertain: dict[str, Any]) -> str:
    words = {length.key: length.words() for length in LENGTHS}
    lengths = [
        {
            "key": key,
            "quantiles": {f"{q:g}": x for q, x in zip(QUANTILES, values, strict=True)},
            "errors": {f"{q:g}": x for q, x in zip(QUANTILES, errors, strict=True)},
            "share": share, **words.get(key, {"units": "m"}),
        }
        for key, _, values, errors, share in _rows(found)
    ]  # fmt: skip
    return to_json(
        {
            "system": said, "parameters": parameters_of(middle), "uncertain": list(uncertain),
            **found.attrs, "lengths": lengths,
        }
    )  # fmt: skip


def _as_text(said: list[str], found: Any, middle: Fault, uncertain: dict[str, Any]) -> str:
    count = found.attrs
    drawn = f"{count['draws']} draws of {', '.join(uncertain)}: {count['invalid']} left out"
    drawn += f" ({count['outside']} not allowed)" if count["invalid"] else ""
    drawn += f", {count['stable']} of the others stable, without L_c"
    drawn += f", {count['beyond']} with an L_s beyond 3 L_c" if count["beyond"] else ""
    head = "".join(f"{share:>10.0%}" for share in QUANTILES)
    lines = [*wrapped(*said), "", *wrapped(drawn), "", f"{'quantiles (m)':<32}{head}   share"]
    systems, nowhere = {length.key: length.system for length in LENGTHS}, []
    for system in systems_of_lengths(middle, uncertain):
        rows = [row for row in _rows(found) if systems.get(row[0], THIS_FAULT) == system]
        two = " (two materials)" if system == TWO_MATERIALS else ""
        nowhere += [f"{title}{two}" for _, title, _, _, share in rows if share == 0.0]
        if there := [row[1:] for row in rows if row[-1] > 0.0]:
            lines.append(f"for {system}:")
        for title, values, errors, share in there:
            pairs = zip(values, errors, strict=True)
            row = "".join(f"{as_sure(value, error):>10}" for value, error in pairs)
            lines.append(f"  {title:<30}{row}{share:>8.1%}")
    if nowhere:
        lines += ["", *textwrap.wrap(f"without a value in any draw: {'; '.join(nowhere)}", 95)]
    lines += [
        "",
        "stable: no patch nucleates, or none that was searched, which counts as an infinite",
        "length; digits as far as the number of draws tells. share: of the draws that have the",
        "length; full lengths",
    ]
    return "\n".join(lines)


def as_sure(value: float, error: float) -> str:
    """A quantile with the digits that its standard error leaves, at most four.

    >>> as_sure(2.8083, 0.04), as_sure(8.09, 0.6), as_sure(4.89012, 1e-5), as_sure(12.3, 20.0)
    ('2.81', '8.1', '4.890', '10')
    """
    if math.isinf(value):
        return "stable"
    if not (value > 0.0 and math.isfinite(error)):
        return f"{value:.1g}"
    size = math.floor(math.log10(value))
    digits = 4
    if error > 0.0:
        digits = min(max(size - math.floor(math.log10(error)) + 1, 1), 4)
    decimals = digits - 1 - size
    if abs(size) > 4:
        return f"{value:.{digits - 1}e}"
    return f"{round(value, decimals):.{max(decimals, 0)}f}"


def _rows(found: Any) -> Iterable[tuple[str, str, list[float], list[float], float]]:
    """Key, title, quantiles (m), their errors (m) and share of each length."""
    names = ("key", "title", "value", "error", "share")
    return zip(*(found[name].values.tolist() for name in names), strict=True)
