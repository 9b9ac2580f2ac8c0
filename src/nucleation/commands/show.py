"""``nucleation show``: summary of a dataset of the project, and the picture of a simulation."""

from __future__ import annotations

import json
import math
from pathlib import Path

import click
import xarray as xr

from ..datasets import DatasetError, netcdf, provenance
from ..extraction.extraction import extract, parameters_of
from ..installed import require
from ..model.quantities import ParameterError
from ..model.units import in_metres
from ..theory.critical import critical_length_of
from ..theory.status import NoLength
from . import DONE, EXIT_CODES, text
from .given import json_option
from .simulate import event_lines, outcome, parameter_lines, require_writable

_OF_SIMULATION = ("slip_rate", "driving_force", "step_time")
"""Variables that other datasets lack."""


@click.command("show", epilog=EXIT_CODES)
@click.argument("file", type=click.Path(exists=True, dir_okay=False, path_type=Path))
@click.option(
    "--plot",
    type=click.Path(dir_okay=False, path_type=Path),
    metavar="OUT.png",
    help="draw it, if it is a simulation; PNG or PDF by the name",
)
@click.option("--force", is_flag=True, help="replace the plot if it exists")
@json_option
def command(file: Path, plot: Path | None, force: bool, as_json: bool) -> int:
    """Summarise a dataset of the project: its kind, origin and variables.

    \b
    Example:
      nucleation show run.nc --plot run.png
    """
    require("solver")
    dataset = netcdf.read(file)
    is_simulation = set(_OF_SIMULATION) <= set(dataset.variables)
    kind = "simulation" if is_simulation else "dataset"
    if plot:
        require("figures")
        if plot.suffix not in (".png", ".pdf"):
            raise ParameterError(f"--plot = '{plot}' is not allowed: it must end in .png or .pdf")
        require_writable(plot, force)
        if not is_simulation:
            raise ParameterError("there is a plot of simulations alone, and this is none")
    try:
        found, lines = {"file": str(file), "kind": kind, **dataset.to_dict(data=False)}, []
        for name in provenance.STRUCTURES & dataset.attrs.keys():
            found["attrs"][name] = json.loads(dataset.attrs[name])
        if not as_json:
            lines = _lines(dataset, kind)
        elif is_simulation:
            found |= outcome(dataset)
        event = extract(dataset) if plot else {}
    except (KeyError, ValueError, TypeError, AttributeError, RecursionError) as error:
        reason = f"{error} is missing" if isinstance(error, KeyError) else error
        raise DatasetError(f"{file} is no {kind} of this version: {reason}") from error
    # no control characters, which a terminal would obey
    lines = ["".join(c if c.isprintable() else repr(c)[1:-1] for c in line) for line in lines]
    lines = text.wrapped(f"{file}: {kind}", *lines)
    text.show(as_json, found, lines)
    if plot:
        from ..pictures import run, style

        style.save_one(run.draw(dataset, xr.Dataset(event)), plot)
        click.echo(f"plot: {plot}", err=as_json)
    return DONE


def _lines(dataset: xr.Dataset, kind: str) -> list[str]:
    """The content of a dataset, or the outcome of a simulation; command, date, code, versions."""
    attributes = dataset.attrs
    own = ("command", "created", "code_digest", "key", "versions")
    described = [f"{name}: {attributes[name]}" for name in own if name in attributes]
    if kind != "simulation":
        return [*str(dataset).splitlines(), *described]
    sizes = dataset.sizes
    run = parameters_of(dataset)
    try:
        theory = critical_length_of(run.fault)
        theory_text = f"{in_metres(theory)}, of the friction law expanded at V"
    except NoLength as error:
        theory = math.nan
        theory_text = f"no critical length: {error}"
    duration = float(dataset["step_time"][-1])
    seconds, megabytes = (float(attributes[key]) for key in ("wall_seconds", "peak_megabytes"))
    steps, rejected = (int(attributes[key]) for key in ("steps", "rejected_steps"))
    return [
        *parameter_lines(run),
        f"status: {attributes['status']}",
        f"steps: {steps}, {rejected} rejected, {seconds:.4g} s of wall time, {megabytes:.0f} MB",
        f"record: {duration:.6g} s, {sizes['time']} frames of {sizes['x']} points",
        f"theory: {theory_text}",
        *event_lines(extract(dataset), theory),
        *described,
    ]
