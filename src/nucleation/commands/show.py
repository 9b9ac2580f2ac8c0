"""``nucleation show``: summary and picture of a dataset of the project."""

from __future__ import annotations

import contextlib
import json
import math
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import click
import numpy as np
import xarray as xr

from ..datasets import DatasetError, netcdf, provenance
from ..extraction.extraction import extract, parameters_of
from ..installed import require
from ..model.quantities import ParameterError
from ..theory.critical import critical_length_of
from ..theory.evaluation import single_system
from ..theory.status import NoLength
from . import DONE, EXIT_CODES, text
from .options import json_option
from .unit_text import engineering_unit

_SHOWN_ROWS = 60


@click.command("show", epilog=EXIT_CODES)
@click.argument(
    "file",
    type=click.Path(
        exists=True,
        dir_okay=False,
        path_type=Path,
    ),
)
@click.option(
    "--plot",
    type=click.Path(dir_okay=False, path_type=Path),
    metavar="OUT.png",
    help="draw it, if it is a simulation; PNG or PDF by the name",
)
@click.option("--force", is_flag=True, help="replace the plot if it exists")
@json_option
def command(
    file: Path,
    plot: Path | None,
    force: bool,
    as_json: bool,
) -> int:
    """Summarise a dataset of the project: its kind, origin and variables.

    \b
    Example:
      nucleation show run.nc --plot run.png
    """
    require("solver")
    dataset = netcdf.read(file)
    kind = _kind_of(dataset)
    if plot:
        _require_picture(plot, kind, force)
    with _refusing(file, kind):
        if as_json:
            shown = [text.to_json({"file": str(file), **_described(dataset, kind)})]
        else:
            lines = [*kind.summary(dataset), *_origin_lines(dataset, kind)]
            shown = text.wrapped(f"{file}: {kind.name}", *map(text.printable, lines))
    click.echo("\n".join(shown))
    if plot:
        from ..pictures import run, style

        style.write(run.draw(dataset, xr.Dataset(extract(dataset))), plot)
        click.echo(f"plot: {plot}", err=as_json)
    return DONE


@contextlib.contextmanager
def _refusing(file: Path, kind: _Kind) -> Iterator[None]:
    """Refuse a file whose attributes or variables are not those of its kind."""
    try:
        yield
    except (KeyError, ValueError, TypeError, AttributeError) as error:
        reason = f"{error} is missing" if isinstance(error, KeyError) else error
        raise DatasetError(f"{file} is no {kind.name} of this version: {reason}") from error


def _described(dataset: xr.Dataset, kind: _Kind) -> dict[str, Any]:
    """Kind, origin and variables of a dataset, and its event or its rows."""
    found: dict[str, Any] = {"kind": kind.name}
    for name, value in dataset.attrs.items():
        if name in provenance.TEXTS:
            found[name] = json.loads(value) if name in provenance.STRUCTURES else str(value)
    variables = {}
    for name, variable in dataset.variables.items():
        variables[name] = {
            "long_name": variable.attrs.get("long_name", ""),
            "units": variable.attrs.get("units", ""),
            "sizes": dict(variable.sizes),
        }
    found["variables"] = variables
    if kind.name == _SIMULATION:
        found |= text.outcome(dataset)
    elif kind.summary is _length_rows:
        found["rows"] = rows_of(dataset)
    return found


def _require_picture(plot: Path, kind: _Kind, force: bool) -> None:
    """Refuse a picture that can't be drawn or written."""
    require("figures")
    if plot.suffix not in (".png", ".pdf"):
        raise ParameterError(f"--plot = '{plot}' is not allowed: it must end in .png or .pdf")
    text.require_writable(plot, force)
    if kind.name != _SIMULATION:
        raise ParameterError(f"there is a plot of simulations alone, and this is a {kind.name}")


def _origin_lines(dataset: xr.Dataset, kind: _Kind) -> list[str]:
    """Command, date, code and versions."""
    attributes = dataset.attrs
    lines = []
    for name in ("command", "created"):
        if name in attributes:
            lines.append(f"{name}: {attributes[name]}")
    if "code_digest" in attributes:
        digest = attributes["code_digest"]
        verdict = ""
        if kind.name == _SIMULATION:
            from ..simulation.checkpoints import simulation_code

            differs = digest != simulation_code(parameters_of(dataset))
            verdict = f", {'NOT ' if differs else ''}that of this installation"
        lines.append(f"code: {digest[:16]}{verdict}")
    if "key" in attributes:
        lines.append(f"key in the workflow: {attributes['key']}")
    if "versions" in attributes:
        versions = json.loads(attributes["versions"])
        listed = ", ".join(f"{name} {version}" for name, version in versions.items())
        lines.append(f"versions: {listed}")
    return lines


def _simulation_lines(dataset: xr.Dataset) -> list[str]:
    """Parameters, outcome, record, theory and event of a simulation."""
    attributes = dataset.attrs
    sizes = dataset.sizes
    run = parameters_of(dataset)
    try:
        theory = critical_length_of(single_system(run.fault))
        theory_text = f"{theory:.4g} m, of the friction law expanded at V"
    except NoLength as error:
        theory = math.nan
        theory_text = f"no critical length: {error}"
    duration = float(dataset["step_time"][-1])
    seconds, megabytes = (float(attributes[key]) for key in ("wall_seconds", "peak_megabytes"))
    steps, rejected = (int(attributes[key]) for key in ("steps", "rejected_steps"))
    return [
        *text.parameter_lines(run),
        f"status: {attributes['status']}",
        f"steps: {steps}, {rejected} rejected, {seconds:.4g} s of wall time, {megabytes:.0f} MB",
        f"record: {duration:.6g} s, {sizes['time']} frames of {sizes['x']} points",
        f"theory: {theory_text}",
        *text.event_lines(extract(dataset), theory),
    ]


def rows_of(table: xr.Dataset, number: int | None = None) -> list[dict[str, Any]]:
    """The first rows of a table, by default all, as dictionaries of plain values."""
    columns = {str(name): table[name].values[:number].tolist() for name in table.data_vars}
    rows = zip(*columns.values(), strict=True)
    return [dict(zip(columns, values, strict=True)) for values in rows]


def _length_rows(dataset: xr.Dataset) -> list[str]:
    """The table of lengths, one line for each run."""
    rows = [("id", "H (m)", "onset (s)", "L_c (m)", "theory", "/theory")]
    number = dataset.sizes["run"]
    for row in rows_of(dataset, _SHOWN_ROWS):
        length = row["length"]
        theory = row["critical_length"]
        numbers = [f"{value:.4g}" for value in (row["height"], row["onset_time"], length, theory)]
        rows.append((row["id"], *numbers, f"{length / theory:.3f}"))
    lines = text.table(rows, right=range(1, 6))
    if number > _SHOWN_ROWS:
        lines.append(f"and {number - _SHOWN_ROWS} more")
    return lines


def _variable_lines(dataset: xr.Dataset) -> list[str]:
    """Every variable with its meaning, unit, shape and range."""
    rows = []
    for name, variable in dataset.variables.items():
        sizes = " x ".join(f"{n} {dimension}" for dimension, n in variable.sizes.items())
        parts = [sizes or "one value"]
        span = _span(variable)
        if span:
            parts.append(span)
        rows.append((str(name), f"{variable.attrs['long_name']}: {'; '.join(parts)}"))
    return text.table(rows)


def _span(variable: xr.Variable) -> str:
    """The range of a variable with its unit; empty without finite numbers."""
    if variable.dtype.kind not in "fiu" or not np.isfinite(variable.values).any():
        return ""
    low = float(np.nanmin(variable.values))
    high = float(np.nanmax(variable.values))
    largest = max(abs(low), abs(high))
    unit, size = engineering_unit(largest, variable.attrs.get("units", ""))
    ends = dict.fromkeys(f"{end / size:.4g}" for end in (low, high))
    span = " to ".join(ends)
    return span if unit in ("", "1") else f"{span} {unit}"


class _Kind(NamedTuple):
    """A kind of dataset."""

    name: str
    marks: tuple[str, ...]
    """Variables that other kinds lack."""
    summary: Callable[[xr.Dataset], list[str]] = _variable_lines
    """The lines of its summary."""


_SIMULATION = "simulation"

_KINDS = (
    _Kind(
        _SIMULATION,
        marks=("slip_rate", "driving_force", "step_time"),
        summary=_simulation_lines,
    ),
    _Kind(
        "table of refinement",
        marks=("length_difference", "length"),
        summary=_length_rows,
    ),
    _Kind(
        "table of lengths",
        marks=("id", "onset_time", "critical_length"),
        summary=_length_rows,
    ),
    _Kind(
        "patch's stability",
        marks=("instant_time", "oscillation_growth"),
    ),
    _Kind(
        "dispersion relation",
        marks=("measured_growth",),
    ),
    _Kind(
        "theory",
        marks=("critical_length", "thin_limit_length"),
    ),
    _Kind("dataset", marks=()),
)


def _kind_of(dataset: xr.Dataset) -> _Kind:
    """The first kind with all its marks in the dataset."""
    variables = set(map(str, dataset.variables))
    return next(kind for kind in _KINDS if variables.issuperset(kind.marks))
