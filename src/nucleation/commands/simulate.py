"""``nucleation simulate``: one simulation, from options, a file, a dataset or the paper."""

from __future__ import annotations

import dataclasses
import math
import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ..installed import require
from ..model.quantities import ParameterError, declared
from ..run.advice import advice
from ..run.checks import contradictions, estimated_megabytes, memory_problem
from ..run.names import GROUPS, parameters
from ..run.run import PAPER_RUN, Run
from ..theory.creep.lengths import stability_length_of
from . import DONE, EXIT_CODES, FAILED, INTERRUPTED
from .faults import NOTES
from .options import (
    Decorator,
    force_option,
    option,
    second_body_option,
    source_options,
    together,
)
from .sources import given_run
from .system_text import printed_warnings, system_of_fault
from .text import event_lines, outcome, parameter_lines, require_writable, show, warn, wrapped
from .unit_text import in_unit, with_unit

if TYPE_CHECKING:
    import xarray as xr

_MEMORY = declared("memory of one simulation", "(100.0, 1e7) MB")
_LIMIT = 2000.0  # MB


def _run_options() -> Decorator:
    """One option for each parameter of a run, with its default."""
    notes = dict(NOTES)
    for cls in GROUPS.values():
        for field in dataclasses.fields(cls):
            name = cls.called.get(field.name, field.name)
            if field.default is not None:
                notes[name] = f"default {with_unit(field.default, parameters()[name])}"
    notes["block_length"] = "6 critical lengths if left out"
    notes["correlation_length"] = "a fifth of L_b if left out"
    notes["end_time"] = notes["time_after_event"] = "by the theory if left out"
    options = []
    for name, entry in parameters().items():
        if name == "second_body":
            options.append(second_body_option)
            continue
        called = f"--{name.replace('_', '-')}"
        options.append(
            option(
                called,
                key=name,
                entry=entry,
                note=notes.get(name, ""),
            )
        )
    return together(*options)


@click.command("simulate", epilog=EXIT_CODES)
@click.argument("output", type=click.Path(dir_okay=False, path_type=Path))
@source_options
@_run_options()
@option(
    "--memory",
    key="memory",
    entry=_MEMORY,
    note="more is refused; 2000 MB if left out",
)
@force_option
@click.option("--dry-run", is_flag=True, help="check everything, describe the run, and stop")
@click.option("--json", "as_json", is_flag=True, help="print the outcome as JSON, in SI units")
def command(
    output: Path,
    force: bool,
    dry_run: bool,
    as_json: bool,
    memory: float | None,
    **options: Any,
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
        run, names, papers = given_run(options)
    problems = [*contradictions(run), *memory_problem(run, "--memory", memory or _LIMIT)]
    if problems:
        raise ParameterError("; ".join(problems))
    lines = system_of_fault(run.fault, names, papers)
    if math.isinf(options["height"] or 0.0) or (
        not {"height", "block_length"} & names and not papers
    ):
        lines.append(
            f"Half-spaces: computed as blocks {run.fault.height:.4g} m high and "
            f"{run.block.length:.4g} m long, and L_s changes by less than 2 %."
        )
    for topic, _, text in advice(run, run.critical_length):
        warn(f"{topic}: {text}")
    lines += _plan_lines(run)
    if dry_run:
        show(
            as_json,
            _described(run),
            [*parameter_lines(run), *wrapped(*lines)],
        )
        return DONE
    require("solver")
    click.echo("\n".join(wrapped(*lines, err=as_json)), err=as_json)
    return _simulate(run, output, as_json)


def _plan_lines(run: Run) -> list[str]:
    """Theory, duration and memory of a run."""
    critical = run.critical_length
    element = run.block.length / run.block.n_x
    theory = f"critical length {critical:.4g} m, {critical / element:.4g}"
    if math.isnan(critical):
        uniform = run.heterogeneity.varies == "none"
        whose = "sliding" if uniform else "sliding outside the step or bump"
        theory = f"{whose} is stable at every wavelength, no critical length; {run.block.n_x}"
    lines = [f"theory: {theory} elements of {in_unit(element, 'm')}"]
    patch = _stability_length(run)
    if not math.isnan(patch):
        lines.append(f"theory: a creeping patch turns unstable at {patch:.4g} m")
    stepping = run.stepping
    until = f"time: until {stepping.end_time:g} s"
    if stepping.time_after_event < stepping.end_time:
        until += f", or {stepping.time_after_event:g} s after the event's onset"
    return [*lines, until, f"memory: about {estimated_megabytes(run):.0f} MB"]


def _stability_length(run: Run) -> float:
    """L_s (m) of the run's fault, NaN if there is none."""
    return stability_length_of(run.patches, run.critical_length)


def _command(output: Path, run: Run) -> str:
    """A command line that makes the dataset again, with all parameters that are not the paper's."""
    usual = PAPER_RUN.to_dict()
    follow = ("block_length", "end_time", "time_after_event", "correlation_length")
    words = []
    for name, value in run.to_dict().items():
        if name in follow or value != usual.get(name):
            words.append(f"--{name.replace('_', '-')}={value}")
    return shlex.join(["nucleation", "simulate", str(output), "--paper", *words])


def _described(run: Run) -> dict[str, Any]:
    """Theory and parameters of a run for JSON, in SI units."""
    return {
        "theory": {
            "critical_length": run.critical_length,
            "stability_length": _stability_length(run),
        },
        "parameters": run.to_dict(),
    }


def _simulate(run: Run, output: Path, as_json: bool) -> int:
    """Run and write the record, into a file beside the output if the simulation fails."""
    from ..datasets import netcdf, provenance
    from ..extraction.extraction import extract
    from ..simulation.checkpoints import Stopped, run_to_file, simulation_code
    from ..simulation.progress import Progress

    digest = simulation_code(run)
    attributes = provenance.attributes(run.to_dict(), digest, _command(output, run))
    progress = Progress(run, sys.stderr)

    def write(dataset: xr.Dataset, path: Path) -> None:
        netcdf.write(dataset, path, **attributes)

    try:
        dataset, path = run_to_file(run, output, write, digest, progress)
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
    show(
        as_json,
        {"output": str(output), **outcome(dataset), **_described(run)},
        lines,
    )
    return DONE
