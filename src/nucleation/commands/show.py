"""``nucleation show``: what is in a dataset of the project, and a picture of it."""

from __future__ import annotations

import importlib
import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import click
import numpy as np
import xarray as xr

from ..analysis.extraction import extract
from ..analysis.record import parameters_of
from ..analysis.rows import rows_of
from ..commands import DONE, EXIT_CODES, text
from ..commands.text import require_writable
from ..configuration.installed import require
from ..datasets import netcdf
from ..model.linearised import linearised
from ..model.quantities import ParameterError
from ..theory.critical import NoInstability, run_length

SHOWN_ROWS = 60


@click.command("show", epilog=EXIT_CODES)
@click.argument("file", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option(
    "--plot", type=click.Path(dir_okay=False, path_type=Path), metavar="OUT.png",
    help="draw it; PNG or PDF by the name, or GIF: a film of a simulation, which is run once more",
)  # fmt: skip
@click.option("--force", is_flag=True, help="replace the plot if it exists")
@click.option("--json", "as_json", is_flag=True, help="print JSON, in SI units")
def command(file: Path, plot: Path | None, force: bool, as_json: bool) -> int:
    """Summarise a dataset of the project: what it is, how it was made, what is in it.

    \b
    Example:
      nucleation show run.nc --plot run.png
    """
    require("solver")
    dataset = netcdf.read(file)
    kind = next(kind for kind in KINDS if set(kind.marks) <= set(map(str, dataset.variables)))
    if plot:
        _check_plot(plot, kind, force)
    if as_json:
        click.echo(text.to_json({"file": str(file), **_as_json(dataset, kind)}))
    else:
        lines = [f"{file}: {kind.name}", *kind.summary(dataset), *_origin_lines(dataset, kind)]
        click.echo("\n".join(lines))
    if plot:
        _save(dataset, kind, plot)
        click.echo(f"plot: {plot}", err=as_json)
    return DONE


def _as_json(dataset: xr.Dataset, kind: Kind) -> dict[str, Any]:
    """What a dataset is, where it is from, its variables; its event or its rows."""
    told: dict[str, Any] = {"kind": kind.name}
    for name, value in dataset.attrs.items():
        if name in netcdf.TEXTS | {"key"}:
            told[name] = json.loads(value) if name in netcdf.STRUCTURES else str(value)
    told["variables"] = {
        name: {key: variable.attrs.get(key, "") for key in ("long_name", "units")}
        | {"sizes": dict(variable.sizes)}
        for name, variable in dataset.variables.items()
    }
    if kind.name == SIMULATION:
        told |= text.outcome(dataset)
    elif kind.summary is _length_rows:
        told["rows"] = rows_of(dataset)
    return told


def _check_plot(plot: Path, kind: Kind, force: bool) -> None:
    require("figures")
    if not kind.figure:
        known = ", ".join(k.name for k in KINDS if k.figure)
        raise ParameterError(
            f"there is no plot of this kind of dataset, {kind.name}; of these there is: {known}"
        )
    allowed = (".png", ".pdf", ".gif") if kind.name == SIMULATION else (".png", ".pdf")
    if plot.suffix not in allowed:
        ends = f"{', '.join(allowed[:-1])} or {allowed[-1]}"
        raise ParameterError(f"--plot = '{plot}' is not allowed: it must end in {ends}")
    require_writable(plot, force)


def _save(dataset: xr.Dataset, kind: Kind, plot: Path) -> None:
    """Write the figure as the project's are written, keeping the format asked for; or a film."""
    import matplotlib as mpl

    from ..datasets.files import replacing
    from ..figures import overview, style

    if plot.suffix == ".gif":
        overview.film(dataset, plot)
        return
    module, _, function = kind.figure.rpartition(".")
    draw = getattr(importlib.import_module(f"nucleation.figures.{module}"), function)
    figure = draw(dataset)
    with mpl.rc_context(style.STYLE), replacing(plot) as temporary:
        figure.savefig(temporary, format=plot.suffix[1:])


def _origin_lines(dataset: xr.Dataset, kind: Kind) -> list[str]:
    """Command, date, code and versions."""
    attributes = dataset.attrs
    lines = [f"{name}: {attributes[name]}" for name in ("command", "created") if name in attributes]
    if "code_digest" in attributes:
        digest, verdict = attributes["code_digest"], ""
        if kind.name == SIMULATION:
            from ..pipeline.running import simulation_code  # with the solver, which is an extra

            differs = digest != simulation_code(parameters_of(dataset))
            verdict = f", {'NOT ' if differs else ''}that of this installation"
        lines.append(f"code: {digest[:16]}{verdict}")
    if "key" in attributes:
        lines.append(f"key in the workflow: {attributes['key']}")
    if "versions" in attributes:
        versions = json.loads(attributes["versions"]).items()
        lines.append("versions: " + ", ".join(f"{name} {version}" for name, version in versions))
    return lines


def _simulation_lines(dataset: xr.Dataset) -> list[str]:
    attributes, parameters = dataset.attrs, parameters_of(dataset)
    interface = linearised(parameters.friction, parameters.loading)
    try:
        theory = run_length(parameters, interface)
        said = f"{theory:.4g} m, of the friction law expanded at V"
    except NoInstability as error:
        theory, said = math.nan, f"no critical length: {error}"
    wall = f"{attributes['wall_seconds']:.4g} s of wall time"
    return [
        *text.parameter_lines(parameters),
        f"status: {attributes['status']}",
        f"steps: {attributes['steps']}, {attributes['rejected_steps']} rejected, {wall}, "
        f"{attributes['peak_megabytes']:.0f} MB",
        f"record: {float(dataset['step_time'][-1]):.6g} s, {dataset.sizes['time']} frames of "
        f"{dataset.sizes['x']} points, {dataset.sizes.get('snapshot', 0)} snapshots of the block",
        f"theory: {said}",
        *text.event_lines(extract(dataset), theory),
    ]


def _length_rows(dataset: xr.Dataset) -> list[str]:
    """The table of lengths, one run in a line."""
    lines = [f"{'id':<44} {'H (m)':>8} {'onset (s)':>10} {'L_c (m)':>9} {'theory':>8}  /theory"]
    for row in rows_of(dataset, range(min(dataset.sizes["run"], SHOWN_ROWS))):
        length, theory = row["length"], row["theory_length"]
        lines.append(
            f"{row['id']:<44} {row['height']:>8.4g} {row['onset_time']:>10.4g} {length:>9.4g} "
            f"{theory:>8.4g}  {length / theory:.3f}"
        )
    hidden = dataset.sizes["run"] - SHOWN_ROWS
    return lines + ([f"and {hidden} more"] if hidden > 0 else [])


def _variable_lines(dataset: xr.Dataset) -> list[str]:
    """Every variable with its meaning, unit, shape and range."""
    lines = []
    for name, variable in dataset.variables.items():
        shape = " x ".join(f"{n} {d}" for d, n in variable.sizes.items()) or "one value"
        unit = variable.attrs.get("units", "")
        span = ""
        if variable.dtype.kind in "fiu" and np.isfinite(variable.values).any():
            low, high = np.nanmin(variable.values), np.nanmax(variable.values)
            span = f"{low:.4g}" if low == high else f"{low:.4g} to {high:.4g}"
            span += "" if unit in ("", "1") else f" {unit}"
        lines.append(f"  {name!s:<28} {variable.attrs['long_name']}: {shape}; {span}".rstrip("; "))
    return lines


class Kind(NamedTuple):
    """A kind of dataset: what tells it from others, its picture and its summary."""

    name: str
    marks: tuple[str, ...]  # variables
    figure: str = ""  # its function among the figures
    summary: Callable[[xr.Dataset], list[str]] = _variable_lines


SIMULATION = "simulation"

KINDS = (
    Kind(
        SIMULATION,
        ("slip_rate", "driving_force", "step_time"),
        "overview.plot_run",
        _simulation_lines,
    ),
    Kind("sensitivity table", ("varied", "length"), "beyond.figure_sensitivity.draw", _length_rows),
    Kind("table of refinement", ("length_difference", "length"), "", _length_rows),
    Kind("table of lengths", ("id", "onset_time", "theory_length"), "", _length_rows),
    Kind("patch's stability", ("instant_time", "oscillation_growth")),
    Kind("dispersion relation", ("measured_growth",), "checks.figure_dispersion.draw"),
    Kind("orders of convergence", ("displacement_error",), "checks.figure_verification.draw"),
    Kind("theory", ("critical_length", "thin_limit_length"), "paper.figure_2.draw"),
    Kind("dataset", ()),
)
"""The first kind all of whose marks are in a dataset is its own."""
