"""``nucleation simulate``: one simulation, from options, a file or a run of a configuration."""

from __future__ import annotations

import math
import shlex
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from replication.configuration.advice import advise
from replication.configuration.half_spaces import without_half_spaces
from replication.configuration.runs import Run
from replication.configuration.settings import Limits, StudySettings, estimated_megabytes
from replication.configuration.single_run import STUDY, flat, merged, single_run
from replication.configuration.study_names import study_parameters

from ..installed import require
from ..model.parameters import Parameters
from ..model.perturbation import KINDS
from ..model.quantities import ParameterError, declarations
from ..theory.creep.lengths import stability_length_of
from . import DONE, EXIT_CODES, FAILED, INTERRUPTED
from .options import force_option, option, parameter_options, source_options
from .sources import given_of, sourced
from .system_text import system_of_run
from .text import event_lines, outcome, parameter_lines, require_writable, show, warn, wrapped
from .unit_text import in_unit

if TYPE_CHECKING:
    import xarray as xr

_RATIO = declarations(StudySettings)["length_over_critical"]
_MEMORY = declarations(Limits)["memory"]


@click.command("simulate", epilog=EXIT_CODES)
@click.argument("output", type=click.Path(dir_okay=False, path_type=Path))
@source_options
@parameter_options(study_parameters())
@option("--length-over-critical", key="length_over_critical", entry=_RATIO)
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
    length_over_critical: float | None,
    memory: float | None,
    **options: Any,
) -> int:
    """Simulate a block pushed from its side and write the record to OUTPUT (netCDF).

    Parameters without an option are taken from --parameters or --run; else they are the paper's. A
    fault with its own a and b has the regularised Dieterich-Ruina law, with scales that follow from
    V and D/V, and two identical bodies. With --paper all other parameters are the paper's. Without
    an end time the run continues until its event, or until the event is long overdue by the theory.
    The terminal shows a progress bar, a log file a line from time to time. Ctrl-C and SIGTERM leave
    a checkpoint from which the same command resumes. The record of a simulation that fails
    numerically is kept in a file that ends in .failed.nc.

    \b
    Example:
      nucleation simulate run.nc --paper --height 5mm --n-x 100 --n-y 10
    """
    if output.suffix != ".nc":
        raise ParameterError(f"OUTPUT = '{output}' is not allowed: its name must end in .nc")
    require_writable(output, force)
    base, given = sourced(options)
    fixed, blocks = without_half_spaces(base, given)
    values = merged(base, fixed)
    if "seed" in given and values["perturbation"] == "none":
        raise ParameterError(
            f"seed = {given['seed']} is not allowed with perturbation = none, which has no "
            f"realisations: perturbation must be one of {', '.join(KINDS[1:])}"
        )
    run = single_run(
        values,
        study=given_of({"length_over_critical": length_over_critical}),
        limits=given_of({"memory": memory}),
        results=str(output.absolute().parent),
    )
    lines = system_of_run(run.parameters, base, given)
    if blocks:
        lines.append(blocks.in_words())
    for warning in advise([run]):
        text = warning.removeprefix(f"studies.{STUDY}: ").replace(f" ({run.id})", "")
        warn(text)
    lines += _plan_lines(run)
    if dry_run:
        show(as_json, _described(run), [*parameter_lines(run.parameters), *wrapped(*lines)])
        return DONE
    require("solver")
    click.echo("\n".join(wrapped(*lines, err=as_json)), err=as_json)
    return _simulate(run, output, as_json)


def _plan_lines(run: Run) -> list[str]:
    """Theory, duration and memory of a run."""
    mesh = run.parameters.mesh
    critical = run.critical_length
    element = run.parameters.geometry.length / mesh.n_x
    theory = f"critical length {critical:.4g} m, {critical / element:.4g}"
    if math.isnan(critical):
        uniform = run.parameters.heterogeneity.varies == "none"
        whose = "sliding" if uniform else "sliding outside the step or bump"
        theory = f"{whose} is stable at every wavelength, no critical length; {mesh.n_x}"
    lines = [f"theory: {theory} elements of {in_unit(element, 'm')}"]
    patch = stability_length_of(run.parameters, critical)
    if not math.isnan(patch):
        lines.append(f"theory: a creeping patch turns unstable at {patch:.4g} m")
    stepping = run.parameters.stepping
    until = f"time: until {stepping.end_time:g} s"
    if stepping.time_after_event < stepping.end_time:
        until += f", or {stepping.time_after_event:g} s after the event's onset"
    memory = estimated_megabytes(run.parameters)
    return [*lines, until, f"memory: about {memory:.0f} MB"]


def _command(output: Path, run: Run) -> str:
    """A command line that makes the dataset again, with all parameters that are not defaults."""
    usual = flat(Parameters())
    words = []
    for name, value in flat(run.parameters).items():
        if name == "block_length" or value != usual.get(name):
            words.append(f"--{name.replace('_', '-')}={value}")
    return shlex.join(["nucleation", "simulate", str(output), "--paper", *words])


def _described(run: Run) -> dict[str, Any]:
    """Theory and parameters of a run for JSON, in SI units."""
    return {
        "theory": {
            "critical_length": run.critical_length,
            "stability_length": stability_length_of(run.parameters, run.critical_length),
        },
        "parameters": run.parameters.to_dict(),
    }


def _simulate(run: Run, output: Path, as_json: bool) -> int:
    """Run and write the record, into a file beside the output if the simulation fails."""
    from ..datasets import netcdf, provenance
    from ..extraction.extraction import extract
    from ..simulation.checkpoints import Stopped
    from ..simulation.progress import Progress
    from ..simulation.to_file import checkpoint_of, run_to_file, simulation_code

    parameters = run.parameters
    digest = simulation_code(parameters)
    attributes = provenance.attributes(parameters.to_dict(), digest, _command(output, run))
    checkpoint = checkpoint_of(parameters, output, digest)
    progress = Progress(parameters, sys.stderr)

    def write(dataset: xr.Dataset, path: Path) -> None:
        netcdf.write(dataset, path, **attributes)

    try:
        with checkpoint.listening():
            dataset, path = run_to_file(parameters, output, write, checkpoint, progress)
    except Stopped as stopped:
        click.echo(f"Error: {stopped}", err=True)
        return INTERRUPTED
    finally:
        progress.close()
    if path != output:
        click.echo(f"Error: {dataset.attrs['status']}; its record is in {path}", err=True)
        return FAILED
    attributes = dataset.attrs
    lines = [
        attributes["status"],
        f"{attributes['steps']} steps in {attributes['wall_seconds']:.3g} s",
        *event_lines(extract(dataset), run.critical_length),
        f"written to {output}",
    ]
    show(as_json, {"output": str(output), **outcome(dataset), **_described(run)}, lines)
    return DONE
