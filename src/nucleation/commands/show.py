"""``nucleation show``: what is in a dataset of the project, and a picture of it."""

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
from ..commands.output import require_writable
from ..datasets import netcdf
from ..datasets.installed import require
from ..model.linearised import linearised
from ..model.quantities import ParameterError
from ..pipeline.running import simulation_code
from ..theory.critical import NoInstability, run_length

SHOWN_ROWS = 60


class Kind(NamedTuple):
    """A kind of dataset: what tells it from others, its summary and its picture."""

    name: str
    marks: tuple[str, ...]  # variables
    summary: Callable[[xr.Dataset], list[str]]
    figure: Callable[[xr.Dataset], Any] | None


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
    dataset = netcdf.read(file)
    kind = kind_of(dataset)
    if plot:
        _check_plot(plot, kind, force)
    if as_json:
        click.echo(json.dumps({"file": str(file), **_as_json(dataset, kind)}, indent=2))
    else:
        lines = [f"{file}: {kind.name}", *kind.summary(dataset), *_origin_lines(dataset, kind)]
        click.echo("\n".join(lines))
    if plot and kind.figure:
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
        str(name): {
            "long_name": variable.attrs.get("long_name", ""),
            "units": variable.attrs.get("units", ""),
            "sizes": {str(dimension): size for dimension, size in variable.sizes.items()},
        }
        for name, variable in dataset.variables.items()
    }
    if kind.name == SIMULATION:
        told |= text.outcome(dataset)
    elif kind.summary is _length_rows:
        told["rows"] = [
            {name: text.plain(value) for name, value in row.items()} for row in rows_of(dataset)
        ]
    return told


def kind_of(dataset: xr.Dataset) -> Kind:
    """The first kind all of whose marks are in the dataset."""
    return next(kind for kind in KINDS if set(kind.marks) <= set(map(str, dataset.variables)))


def _check_plot(plot: Path, kind: Kind, force: bool) -> None:
    require("figures")
    if kind.figure is None:
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
    assert kind.figure is not None
    figure = kind.figure(dataset)
    with mpl.rc_context(style.STYLE), replacing(plot) as temporary:
        figure.savefig(temporary, format=plot.suffix[1:])


def _origin_lines(dataset: xr.Dataset, kind: Kind) -> list[str]:
    """Command, date, code and versions."""
    attributes = dataset.attrs
    lines = [f"{name}: {attributes[name]}" for name in ("command", "created") if name in attributes]
    if "code_digest" in attributes:
        digest = attributes["code_digest"]
        verdict = ""
        if kind.name == SIMULATION:
            same = digest == simulation_code(parameters_of(dataset))
            verdict = ", that of this installation" if same else ", NOT that of this installation"
        lines.append(f"code: {digest[:16]}{verdict}")
    if "key" in attributes:
        lines.append(f"key in the workflow: {attributes['key']}")
    if "versions" in attributes:
        versions = json.loads(attributes["versions"])
        lines.append("versions: " + ", ".join(f"{k} {v}" for k, v in versions.items()))
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


def _draw_simulation(dataset: xr.Dataset) -> Any:
    from ..figures import overview

    return overview.plot_run(dataset)


def _draw_theory(dataset: xr.Dataset) -> Any:
    from ..figures import overview

    return overview.draw_theory(dataset)


def _draw_lengths(dataset: xr.Dataset) -> Any:
    from ..figures import overview

    return overview.draw_lengths(dataset)


def _draw_patch(dataset: xr.Dataset) -> Any:
    from ..figures import overview

    return overview.draw_patch(dataset)


def _draw_dispersion(dataset: xr.Dataset) -> Any:
    from ..figures.checks import figure_dispersion

    return figure_dispersion.draw(dataset)


def _draw_convergence(dataset: xr.Dataset) -> Any:
    from ..figures.checks import figure_verification

    return figure_verification.draw(dataset)


def _draw_sensitivity(dataset: xr.Dataset) -> Any:
    from ..figures.beyond import figure_sensitivity

    return figure_sensitivity.draw(dataset)


SIMULATION = "simulation"

KINDS = (
    Kind(
        SIMULATION, ("slip_rate", "driving_force", "step_time"),
        _simulation_lines, _draw_simulation,
    ),
    Kind("sensitivity table", ("varied", "length"), _length_rows, _draw_sensitivity),
    Kind("table of refinement", ("length_difference", "length"), _length_rows, None),
    Kind("table of lengths", ("id", "onset_time", "theory_length"), _length_rows, _draw_lengths),
    Kind("twin runs", ("twin_growth",), _variable_lines, None),
    Kind("patch's stability", ("instant_time", "oscillation_growth"), _variable_lines, _draw_patch),
    Kind("dispersion relation", ("measured_growth",), _variable_lines, _draw_dispersion),
    Kind("orders of convergence", ("displacement_error",), _variable_lines, _draw_convergence),
    Kind("theory", ("critical_length", "thin_limit_length"), _variable_lines, _draw_theory),
    Kind("dataset", (), _variable_lines, None),
)  # fmt: skip
