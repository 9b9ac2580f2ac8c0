"""``nucleation simulate``: one simulation, from options, a file, a dataset or the paper."""

from __future__ import annotations

import math
import os
import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..fault.parameters import PARTS, parameters, sections
from ..installed import require
from ..model.quantities import ParameterError, declared
from ..model.units import in_metres, in_unit
from ..run.advice import advice
from ..run.checks import contradictions, estimated_megabytes, memory_problem
from ..run.run import PAPER_RUN, Run
from . import DONE, EXIT_CODES, FAILED, INTERRUPTED
from .given import (
    NOTES,
    given_run,
    json_option,
    option,
    options_of,
    printed_warnings,
    source_options,
    system_of_fault,
)
from .text import Row, show, table, warn, with_unit, wrapped

if TYPE_CHECKING:
    import xarray as xr

_MEMORY = declared("memory of one simulation", "(100.0, 1e7) MB")
_LIMIT = 2000.0  # MB

_NOTES = NOTES | {
    name: f"default {with_unit(one.default, one)}"
    for name, one in parameters().items()
    if one.part in PARTS and one.default is not None
}
_NOTES |= dict.fromkeys(("end_time", "time_after_event"), "by the theory if left out")
_NOTES["block_length"] = "6 critical lengths if left out"
_NOTES["correlation_length"] = "a fifth of L_b if left out"


@click.command("simulate", epilog=EXIT_CODES)
@click.argument("output", type=click.Path(dir_okay=False, path_type=Path))
@source_options
@options_of(parameters(), _NOTES)
@option("memory", _MEMORY, "more is refused; 2000 MB if left out")
@click.option("--force", is_flag=True, help="replace OUTPUT if it exists")
@click.option("--dry-run", is_flag=True, help="check everything, describe the run, and stop")
@json_option
def command(
    output: Path, force: bool, dry_run: bool, as_json: bool, memory: float | None, **options: Any
) -> int:
    """Simulate a block pushed from its side and write the record to OUTPUT (netCDF).

    A fault with its own f, a and b at V has the regularised Dieterich-Ruina law, with scales that
    follow from V and D/V, and two identical bodies. With --paper all other parameters are the
    paper's. Without an end time the run continues until its event, or until the event is long
    overdue by the theory. A terminal shows a line that changes, a log file one from time to time.
    Ctrl-C and SIGTERM leave a checkpoint from which the same command resumes. The record of a
    simulation that fails numerically is kept in a file that ends in .failed.nc.

    \b
    Example:
      nucleation simulate run.nc --paper --height 5mm --n-x 100 --n-y 10
    """
    if output.suffix != ".nc":
        raise ParameterError(f"OUTPUT = '{output}' is not allowed: its name must end in .nc")
    require_writable(output, force)
    with printed_warnings():
        run, names, paper = given_run(options)
    problems = [*contradictions(run), *memory_problem(run, "--memory", memory or _LIMIT)]
    if problems:
        raise ParameterError("; ".join(problems))
    lines = system_of_fault(run.fault, names, paper)
    given_size = {"height", "block_length"} & names
    if math.isinf(options["height"] or 0.0) or not (given_size or paper):
        lines.append(
            f"Half-spaces: computed as blocks {in_metres(run.fault.height)} high and "
            f"{in_metres(run.block.length)} long, and L_s changes by less than 2 %."
        )
    for topic, _, text in advice(run, run.critical_length):
        warn(f"{topic}: {text}")
    lines += _plan_lines(run)
    described: dict[str, Any] = {"parameters": run.to_dict()}
    if dry_run or as_json:
        from ..theory.creep.lengths import stability_length_of

        critical = run.critical_length
        stability = stability_length_of(run.patches, critical)
        described["theory"] = {"critical_length": critical, "stability_length": stability}
        if not math.isnan(stability):
            lines.append(f"theory: a creeping patch turns unstable at {in_metres(stability)}")
    if dry_run:
        show(as_json, described, [*parameter_lines(run), *wrapped(*lines)])
        return DONE
    require("solver")
    click.echo("\n".join(wrapped(*lines, err=as_json)), err=as_json)
    return _simulate(run, output, as_json, described)


def _plan_lines(run: Run) -> list[str]:
    """Theory, duration and memory of a run."""
    critical = run.critical_length
    element = run.block.length / run.block.n_x
    theory = f"critical length {in_metres(critical)}, {critical / element:.4g}"
    if math.isnan(critical):
        uniform = run.heterogeneity.varies == "none"
        whose = "sliding" if uniform else "sliding outside the step or bump"
        theory = f"{whose} is stable at every wavelength, no critical length; {run.block.n_x}"
    lines = [f"theory: {theory} elements of {in_unit(element, 'm')}"]
    stepping = run.stepping
    until = f"time: until {stepping.end_time:g} s"
    if stepping.time_after_event < stepping.end_time:
        until += f", or {stepping.time_after_event:g} s after the event's onset"
    return [*lines, until, f"memory: about {estimated_megabytes(run):.0f} MB"]


def _simulate(run: Run, output: Path, as_json: bool, described: dict[str, Any]) -> int:
    """Run and write the record, into a file beside the output if the simulation fails."""
    from ..datasets import netcdf, provenance
    from ..extraction.extraction import extract
    from ..simulation.checkpoints import Stopped, run_to_file, simulation_code
    from ..simulation.progress import Progress

    # the command makes the dataset again, with all parameters that are not the paper's
    usual, words = PAPER_RUN.to_dict(), []
    follow = ("block_length", "end_time", "time_after_event", "correlation_length")
    for name, value in run.to_dict().items():
        if name in follow or value != usual.get(name):
            words.append(f"--{name.replace('_', '-')}={value}")
    again = shlex.join(["nucleation", "simulate", str(output), "--paper", *words])
    digest = simulation_code(run)
    attributes = provenance.attributes(run.to_dict(), digest, again)
    progress = Progress(run, sys.stderr)
    try:
        dataset, path = run_to_file(
            run,
            output,
            lambda dataset, path: netcdf.write(dataset, path, **attributes),
            digest,
            progress,
        )
    except Stopped as stopped:
        click.echo(f"Error: {stopped}", err=True)
        return INTERRUPTED
    finally:
        progress.close()
    if path != output:
        click.echo(f"Error: {dataset.attrs['status']}; its record is in {path}", err=True)
        return FAILED
    lines = [
        dataset.attrs["status"],
        f"{dataset.attrs['steps']} steps in {dataset.attrs['wall_seconds']:.3g} s",
        *event_lines(extract(dataset), run.critical_length),
        f"written to {output}",
    ]
    show(as_json, {"output": str(output), **outcome(dataset), **described}, lines)
    return DONE


def parameter_lines(run: Run) -> list[str]:
    """The parameters of a run, one in a line, with unit and meaning."""
    values = run.to_dict()
    if run.below is not None:
        values |= {"second_n_y": run.below.n_y, "second_grading": run.below.grading}
    rows: list[Row] = []
    for section, names in sections().items():
        rows.append(f"{section}:")
        for name in names:
            if name in values:
                entry = parameters()[name]
                rows.append((name, with_unit(values[name], entry), entry.description))
    return table(rows)


def event_lines(found: dict[str, float], critical_length: float) -> list[str]:
    """Onset of the event and length of the patch then, with their ranges over the definitions.

    `critical_length` is L_c (m) of the theory; NaN if homogeneous sliding is stable.
    """
    if math.isnan(found["onset_time"]):
        return ["no event: the force has not dropped"]
    onset, length = (
        f"{found[name]:.4g} ({found[f'{name}_low']:.4g} to {found[f'{name}_high']:.4g})"
        for name in ("onset_time", "length")
    )
    over_theory = ""
    if not math.isnan(critical_length):
        over_theory = f", {found['length'] / critical_length:.3g} L_c"
    return [f"onset: {onset} s", f"L: {length} m{over_theory}"]


def outcome(dataset: xr.Dataset) -> dict[str, Any]:
    """The status and the event of a simulation, for JSON, in SI units."""
    from ..extraction.extraction import extract

    return {
        "status": dataset.attrs["status"],
        "steps": int(dataset.attrs["steps"]),
        "wall_seconds": float(dataset.attrs["wall_seconds"]),
        "simulated_time": float(dataset["step_time"][-1]),
        "event": extract(dataset),
    }


def require_writable(path: Path, force: bool) -> None:
    """Refuse a file that can't be written, or exists and may not be replaced by `force`."""
    if path.exists() and not force:
        raise ParameterError(f"{path} exists already; --force replaces it")
    folder = path.absolute().parent
    if not folder.exists():
        make = shlex.join(["mkdir", "-p", str(folder)])
        raise ParameterError(f"{path} can't be written: there is no directory {folder}; {make}")
    if not folder.is_dir() or not os.access(folder, os.W_OK):
        raise ParameterError(f"{path} can't be written: {folder} is no writable directory")
