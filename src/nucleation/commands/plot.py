"""``nucleation plot``: a picture of lengths over one or two parameters of a fault."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click
import numpy as np

from replication.configuration.parameter_files import name_in_studies
from replication.configuration.study_names import study_parameters
from replication.figures.lengths_over import lengths_over

from ..drop.drop_quantiles import TITLES
from ..installed import require
from ..lengths.draws import Draws, with_default_unit
from ..lengths.specimen import SPECIMEN
from ..model.parameters import Parameters
from ..model.quantities import ParameterError, Quantity, declared
from ..model.units import NUMBER, parse
from ..types import Array
from . import DONE, EXIT_CODES, STABLE
from .cases import (
    COUNTING,
    case_of,
    case_options,
    cases_of,
    drawn_from,
    medians_of,
    system_of_case,
    uncertain_of,
)
from .options import draws_option, force_option, option, samples_option
from .pictures import require_picture, save
from .progress import progress_of
from .sources import keys_of_command, sourced
from .text import to_json, wrapped

if TYPE_CHECKING:
    import xarray as xr

_POINTS = declared("number of values of each parameter", "[3, 1000]", kind="int")
_CRITERIA = {
    "critical": "critical_length",
    "stability": "stability_length",
    "drop": "expected_length",
}
_USUAL_POINTS = {1: 20, 2: 10}
"""Number of points by the number of parameters."""

_WIDE = 10.0
"""Least ratio of the ends of a range with values in equal steps of the logarithm."""

_OVER = re.compile(r"([\w.-]+)=(.+):(.+)")


@click.command("plot", epilog=EXIT_CODES)
@click.argument("output", type=click.Path(dir_okay=False, path_type=Path))
@click.option(
    "--over",
    multiple=True,
    required=True,
    metavar="NAME=LOW:HIGH",
    help="a parameter that varies, such as height=5mm:1m; give it twice for a map",
)
@option(
    "--points",
    key="points",
    entry=_POINTS,
    note="20 of one parameter and 10 of two if left out",
)
@option("--specimen", key="specimen", entry=SPECIMEN, note="drawn as a line")
@click.option(
    "--criterion",
    type=click.Choice(list(_CRITERIA)),
    multiple=True,
    help="a length to draw: L_c, L_s or the length at the drop; may be given several times. All if "
    "left out, and L_c on a map",
)
@case_options
@samples_option
@draws_option(20)
@force_option
@click.option("--json", "as_json", is_flag=True, help="print the lengths as JSON, in SI units")
def command(
    output: Path,
    over: tuple[str, ...],
    points: int | None,
    specimen: float | None,
    criterion: tuple[str, ...],
    samples: Path | None,
    draws: int,
    force: bool,
    as_json: bool,
    **options: Any,
) -> int:
    """Draw L_c, L_s and the length at the drop over one or two parameters of a fault.

    The fault is given as for `drop`. Over one parameter the picture has a line for each length;
    over two it is a map of one length. The band of the drop is its expected range: 16 to 84 % of
    the realisations, or after slow slip -3 to +10 % about L_run. With a range "5um (3 to 10)" or
    --samples the bands of all lengths are 5 to 95 % of the draws. OUTPUT is a PNG or PDF by its
    name. A point takes about 2 s for each draw with the drop, and 0.1 s without.

    \b
    Example:
      nucleation plot lengths.png --paper --over height=5mm:1m --specimen 20cm
    """
    require("figures")
    require_picture("OUTPUT", output, force)
    base, given = sourced(options, ranges=True)
    paper = options["paper"]
    number = points or _USUAL_POINTS.get(len(over), 0)
    axes = [_axis(text, number) for text in over]
    _require_axes([axis.name for axis in axes], given)
    lengths = _lengths(criterion, len(axes))
    uncertain = uncertain_of(given, samples)
    fixed = {name: value for name, value in given.items() if name not in uncertain}
    drawn = drawn_from(uncertain, draws) if uncertain else None
    refusals: list[ParameterError] = []

    def cases(point: tuple[int, ...]) -> Sequence[Parameters]:
        at = {}
        for axis, i in zip(axes, point, strict=True):
            at[axis.name] = float(axis.values[i])
        try:
            return cases_of(base, fixed | at, drawn, paper)
        except ParameterError as refusal:
            refusals.append(refusal)
            return []

    shown = [axis.shown for axis in axes]
    found = lengths_over(shown, cases, lengths, progress_of("points"))
    if len(refusals) == found["doubtful"].size:
        raise refusals[0]
    middle = {axis.name: float(axis.values[axis.values.size // 2]) for axis in axes}
    middle |= fixed | medians_of(uncertain)
    case = case_of(base, middle, paper)
    system = system_of_case(case, base, middle, paper, " Each point has its own.")
    system += [_over(axis) for axis in shown]
    if as_json:
        click.echo(to_json(_described(system, found)))
    if not np.isfinite(found["length"]).any():
        click.echo("\n".join(_missing(found, refusals)), err=True)
        return STABLE
    from replication.figures.lengths import draw

    save(draw(found, specimen, _band(drawn, lengths)), output)
    if not as_json:
        click.echo("\n".join([*wrapped(*system), *_missing(found, refusals), f"plot: {output}"]))
    return DONE


class _Varied(NamedTuple):
    """A parameter that varies."""

    name: str
    """Its name in studies."""
    values: Array
    """In SI units."""
    shown: xr.DataArray
    """The axis of the picture, in the unit of the option."""


def _axis(
    text: str,
    points: int,
) -> _Varied:
    """The parameter of ``--over``."""
    parts = _OVER.fullmatch(text)
    if parts is None:
        raise ParameterError(f"--over = {text!r} is not allowed: it must be NAME=LOW:HIGH")
    name = name_in_studies(parts[1].replace("-", "_"), keys_of_command())
    entry = study_parameters()[name]
    if entry.worded or entry.kind == "int" or name not in COUNTING:
        raise ParameterError(f"--over = {text!r} is not allowed: {name} has no range to draw over")
    low_text, high_text = parts[2], parts[3]
    high_number = NUMBER.fullmatch(high_text)
    unit = high_number[3] if high_number else ""
    low, high = (
        float(parse(name, with_default_unit(end, unit), entry)) for end in (low_text, high_text)
    )
    if not low < high or not np.isfinite([low, high]).all():
        raise ParameterError(f"--over = {text!r} is not allowed: LOW must be below HIGH")
    is_wide = low > 0.0 and high >= _WIDE * low
    space: Callable[..., Array] = np.geomspace if is_wide else np.linspace
    values = space(low, high, points)
    factor = 1.0
    if unit:
        without_range = Quantity(entry.description, unit=entry.unit)
        factor = float(parse(name, f"1 {unit}", without_range))
    label = re.split("[;,]", entry.description)[0]
    import xarray as xr  # imported here, since it takes a while

    attributes = {"long_name": label, "units": unit or entry.unit}
    shown = xr.DataArray(values / factor, dims=name, name=name, attrs=attributes)
    return _Varied(name, values, shown)


def _require_axes(
    over: list[str],
    given: Mapping[str, Any],
) -> None:
    """Refuse more than two parameters, repeated ones, and those with a value."""
    if len(over) > 2:
        raise ParameterError("--over is not allowed more than twice")
    if len(set(over)) < len(over):
        raise ParameterError(f"--over is given twice for {over[0]}")
    for name in over:
        if name in given:
            raise ParameterError(f"{name} is given twice: as an option and by --over")


def _lengths(
    criterion: Sequence[str],
    axes: int,
) -> list[str]:
    """Keys of the lengths to draw; a map has one."""
    if axes == 1:
        return [_CRITERIA[one] for one in criterion or _CRITERIA]
    if len(criterion) > 1:
        raise ParameterError("--criterion is not allowed more than once on a map, of one length")
    only = criterion[0] if criterion else "critical"
    return [_CRITERIA[only]]


def _over(axis: xr.DataArray) -> str:
    """A parameter that varies, in words."""
    unit = axis.attrs["units"]
    units = "" if unit == "1" else f" {unit}"
    low, high = axis.values[0], axis.values[-1]
    return f"Over {axis.attrs['long_name']}, {low:.4g} to {high:.4g}{units}; the middle is above."


def _missing(
    found: xr.Dataset,
    refusals: Sequence[ParameterError],
) -> list[str]:
    """The number of points without a length, and the reason."""
    lines = []
    number = found["doubtful"].size
    for key in found["key"].values.tolist():
        one = found.sel(key=key)
        length = one["length"].sel(end="middle").values
        absent = int(np.sum(~np.isfinite(length)))
        if absent:
            reasons = [text for text in one["why_not"].values.ravel().tolist() if text]
            reasons += [str(refusal) for refusal in refusals]
            why = reasons[0] if reasons else "not known"
            lines += wrapped(f"No {TITLES[key]} at {absent} of {number} points: {why}.")
    doubtful = int(np.sum(found["doubtful"].values > 0.0))
    if doubtful:
        doubts = found.attrs["doubts"]
        lines += wrapped(f"DO NOT RELY ON the drop at {doubtful} of {number} points: {doubts}.")
    return lines


def _band(
    drawn: Draws | None,
    lengths: Sequence[str],
) -> str:
    """The meaning of the bands in the picture."""
    if drawn is not None:
        return "5 to 95 % of the draws"
    return "expected range of $L$" if "expected_length" in lengths else ""


def _described(
    system: list[str],
    found: xr.Dataset,
) -> dict[str, Any]:
    """The lengths for JSON."""
    axes = []
    for name in map(str, found["doubtful"].dims):
        values = found[name]
        axes.append(
            {
                "name": name,
                "units": values.attrs["units"],
                "values": values.values.tolist(),
            }
        )
    lengths = []
    for key in found["key"].values.tolist():
        one = found.sel(key=key)
        length: dict[str, Any] = {"key": key, "units": "m"}
        for end in one["end"].values:
            length[end] = one["length"].sel(end=end).values.tolist()
        length["why_not"] = one["why_not"].values.tolist()
        lengths.append(length)
    return {
        "system": system,
        "over": axes,
        "lengths": lengths,
        "doubtful": found["doubtful"].values.tolist(),
    }
