"""``nucleation plot``: lengths of a fault over one or two of its parameters, as a picture."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import click
import numpy as np

from ..answers.draws import Draws
from ..answers.specimen import SPECIMEN
from ..configuration.installed import require
from ..configuration.study_names import study_parameters
from ..model.parameters import Parameters
from ..model.quantities import ParameterError, Quantity
from ..model.units import NUMBER, parse
from ..patch.drop_quantiles import TITLES
from ..patch.lengths_over import Axis, lengths_over
from ..types import Array
from . import DONE, EXIT_CODES, STABLE
from .drop import COUNTING, USUAL
from .fault_options import told
from .options import (
    merged_parameters,
    name_in_studies,
    option,
    parameter_options,
    source_options,
    sourced,
)
from .progress import Progress
from .text import require_writable, to_json, wrapped
from .uncertain_drop import case_of, cases_of, completed, draw_in_studies, uncertain_of
from .uncertainty import draws_option, samples_option

ENDS = (".png", ".pdf")
POINTS = Quantity("number of values of each parameter", low=3, high=1000, closed="both", kind="int")
CRITERIA = {"critical": "critical_length", "stability": "stability_length", "drop": "drop_length"}
USUAL_POINTS = {1: 20, 2: 10}
WIDE = 10.0  # ratio of the ends of a range from which its values are spaced evenly in the logarithm
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
    entry=POINTS,
    note="20 of one parameter and 10 of two if left out",
)
@option("--specimen", key="specimen", entry=SPECIMEN, note="drawn as a line")
@click.option(
    "--criterion",
    type=click.Choice(list(CRITERIA)),
    multiple=True,
    help="a length to draw: L_c, L_s or the length at the drop; may be given several times. All if "
    "left out, and L_c on a map",
)
@parameter_options(COUNTING, USUAL, ranges=True)
@source_options
@samples_option
@draws_option(20)
@click.option("--force", is_flag=True, help="replace OUTPUT if it exists")
@click.option("--json", "as_json", is_flag=True, help="print the lengths as JSON, in SI units")
def command(
    output: Path,
    over: tuple[str, ...],
    points: int | None,
    specimen: float | None,
    criterion: tuple[str, ...],
    file: Path | None,
    run_id: str | None,
    config: str | None,
    paper: bool,
    samples: Path | None,
    draws: int,
    force: bool,
    as_json: bool,
    **options: Any,
) -> int:
    """Draw L_c, L_s and the length at the drop over one or two parameters of a fault.

    The fault is given as to `drop`. Over one parameter there is a line for each length, over two a
    map of one length. The band of the drop is its expected range: 16 to 84 % of the realisations,
    or after slow slip -3 to +10 % about L_run. A range "5um (3 to 10)" or --samples make the bands
    of all lengths those of 5 to 95 % of the draws. OUTPUT is a PNG or PDF by its name. A point
    takes about 2 s for each draw with the drop, and 0.1 s without.

    \b
    Example:
      nucleation plot lengths.png --paper --over height=5mm:1m --specimen 20cm
    """
    require("figures")
    if output.suffix not in ENDS:
        raise ParameterError(f"OUTPUT = '{output}' is not allowed: it must end in .png or .pdf")
    require_writable(output, force)
    base, given = sourced(file, run_id, config, paper, options, ranges=True)
    axes = [_axis(text, points or USUAL_POINTS.get(len(over), 0)) for text in over]
    _require_axes([name for name, _, _ in axes], given)
    lengths = _lengths(criterion, len(axes))
    uncertain = uncertain_of(given, samples)
    fixed = {name: value for name, value in given.items() if name not in uncertain}
    drawn = draw_in_studies(uncertain, draws) if uncertain else None
    refusals: list[ParameterError] = []

    def cases(point: tuple[int, ...]) -> Sequence[Parameters]:
        at = {name: float(values[i]) for (name, values, _), i in zip(axes, point, strict=True)}
        try:
            return _cases_at(base, fixed | at, drawn, paper)
        except ParameterError as refusal:
            refusals.append(refusal)
            return []

    shown = [axis for _, _, axis in axes]
    found = lengths_over(shown, cases, lengths, Progress("points"))
    if len(refusals) == found["doubtful"].size:
        raise refusals[0]
    middle = {name: float(values[values.size // 2]) for name, values, _ in axes}
    middle |= {name: float(np.median(value)) for name, value in uncertain.items()}
    said = _said(base, fixed | middle, paper, shown)
    if as_json:
        click.echo(to_json(_described(said, found)))
    if not np.isfinite(found["length"]).any():
        click.echo("\n".join(_missing(found, refusals)), err=True)
        return STABLE
    _save(found, specimen, _band(drawn, lengths), output)
    if not as_json:
        click.echo("\n".join([*said, *_missing(found, refusals), f"plot: {output}"]))
    return DONE


def _axis(text: str, points: int) -> tuple[str, Any, Axis]:
    """The name in studies of a parameter that varies, its values in SI units, and as shown."""
    parts = _OVER.fullmatch(text)
    if parts is None:
        raise ParameterError(f"--over = {text!r} is not allowed: it must be NAME=LOW:HIGH")
    name = name_in_studies(parts[1].replace("-", "_"))
    entry = study_parameters()[name]
    if entry.worded or entry.kind == "int" or name not in COUNTING:
        raise ParameterError(f"--over = {text!r} is not allowed: {name} has no range to draw over")
    high = NUMBER.fullmatch(parts[3])
    unit = high[3] if high else ""
    low_text = parts[2]
    low_number = NUMBER.fullmatch(low_text)
    if low_number and not low_number[3]:
        low_text = f"{low_text} {unit}"
    ends = [float(parse(name, end, entry)) for end in (low_text, parts[3])]
    if not ends[0] < ends[1] or not np.isfinite(ends).all():
        raise ParameterError(f"--over = {text!r} is not allowed: LOW must be below HIGH")
    is_wide = ends[0] > 0.0 and ends[1] >= WIDE * ends[0]
    space: Callable[..., Array] = np.geomspace if is_wide else np.linspace
    values = space(*ends, points)
    factor = float(parse(name, f"1 {unit}", _without_range(entry))) if unit else 1.0
    label = entry.description.split(";")[0].split(",")[0]
    return name, values, Axis(name, label, unit or entry.unit, values / factor)


def _without_range(entry: Quantity) -> Quantity:
    """The declaration of a quantity of which any number is allowed."""
    return Quantity(entry.description, unit=entry.unit)


def _require_axes(over: list[str], given: Mapping[str, Any]) -> None:
    """Refuse more than two parameters, one twice, and one that is given a value as well."""
    if len(over) > 2:
        raise ParameterError("--over is not allowed more than twice")
    if len(set(over)) < len(over):
        raise ParameterError(f"--over is given twice for {over[0]}")
    for name in over:
        if name in given:
            raise ParameterError(f"{name} is given twice: as an option and by --over")


def _lengths(criterion: Sequence[str], axes: int) -> list[str]:
    """Keys of the lengths to draw; on a map there is one."""
    if axes == 1:
        return [CRITERIA[one] for one in criterion or CRITERIA]
    if len(criterion) > 1:
        raise ParameterError("--criterion is not allowed more than once on a map, of one length")
    return [CRITERIA[(criterion or ("critical",))[0]]]


def _cases_at(
    base: Parameters | None, given: dict[str, Any], drawn: Draws | None, paper: bool
) -> Sequence[Parameters]:
    """The runs at one point."""
    if drawn is not None:
        return cases_of(base, USUAL, given, drawn, paper)
    return [case_of(base, USUAL, given, base is not None or paper)]


def _said(
    base: Parameters | None, given: dict[str, Any], paper: bool, axes: Sequence[Axis]
) -> list[str]:
    """The system in the middle of the picture, and what varies."""
    own = completed(given, base is not None or paper)
    parameters = merged_parameters(base, {**({} if base is not None else USUAL), **own})
    lines = wrapped(*told(parameters, base, own))
    for axis in axes:
        units = "" if axis.units == "1" else f" {axis.units}"
        low, high = axis.values[0], axis.values[-1]
        lines.append(f"Over {axis.long_name}, {low:.4g} to {high:.4g}{units}; the middle is above.")
    return lines


def _missing(found: Any, refusals: Sequence[ParameterError]) -> list[str]:
    """How many points lack a length, and why."""
    lines = []
    number = found["doubtful"].size
    for key in found["key"].values.tolist():
        one = found.sel(key=key)
        absent = int(np.sum(~np.isfinite(one["length"].sel(end="middle").values)))
        reasons = [text for text in one["why_not"].values.ravel().tolist() if text]
        if absent:
            why = reasons[0] if reasons else str(refusals[0]) if refusals else "not known"
            lines += wrapped(f"No {TITLES[key]} at {absent} of {number} points: {why}.")
    doubtful = int(np.sum(found["doubtful"].values > 0.0))
    if doubtful:
        doubts = found.attrs["doubts"]
        lines += wrapped(f"DO NOT RELY ON the drop at {doubtful} of {number} points: {doubts}.")
    return lines


def _band(drawn: Draws | None, lengths: Sequence[str]) -> str:
    """What the bands of the picture are."""
    if drawn is not None:
        return "5 to 95 % of the draws"
    return "expected range of $L$" if "drop_length" in lengths else ""


def _described(said: list[str], found: Any) -> dict[str, Any]:
    """The lengths for JSON."""
    axes = []
    for name in map(str, found["doubtful"].dims):
        units, values = found[name].attrs["units"], found[name].values.tolist()
        axes.append({"name": name, "units": units, "values": values})
    lengths = []
    for key in found["key"].values.tolist():
        one = found.sel(key=key)
        ends = {end: one["length"].sel(end=end).values.tolist() for end in one["end"].values}
        lengths.append(
            {"key": key, "units": "m", **ends, "why_not": one["why_not"].values.tolist()}
        )
    doubtful = found["doubtful"].values.tolist()
    return {"system": said, "over": axes, "lengths": lengths, "doubtful": doubtful}


def _save(found: Any, specimen: float | None, band: str, output: Path) -> None:
    """Write the picture, as the project's own are written."""
    import matplotlib as mpl

    from ..datasets.files import replacing
    from ..figures import lengths, style

    figure = lengths.draw(found, specimen, band)
    with mpl.rc_context(style.STYLE), replacing(output) as temporary:
        figure.savefig(temporary, format=output.suffix[1:])
