"""``nucleation simulate``: one simulation, from options, a file or a run of a configuration."""

from __future__ import annotations

import contextlib
import dataclasses
import os
import shlex
import signal
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import click

from ..commands import DONE, EXIT_CODES, FAILED, INTERRUPTED, units
from ..configuration.advice import advise
from ..configuration.load import configure
from ..configuration.settings import Limits, estimated_megabytes
from ..configuration.studies import Run, StudySettings
from ..configuration.study_names import study_parameters
from ..model.friction.constants import CONSTANTS, with_constants
from ..model.friction.law import Friction
from ..model.friction.registry import LAWS
from ..model.parameters import Parameters, names
from ..model.quantities import ParameterError, declarations
from .given import of_dataset, of_file, of_run
from .text import event_lines, parameter_lines, with_unit

STUDY = "command"  # name of the study of one run that a command line amounts to


def _flat(parameters: Parameters) -> dict[str, Any]:
    """Parameters by their names in studies."""
    known = names()
    return {known.short(full): value for full, value in parameters.named().items()}


def _defaults() -> dict[str, Any]:
    """The usual values by their names in studies, those of other friction laws among them."""
    laws = [_flat(Parameters(friction=Friction(law=law))) for law in LAWS]
    return {k: v for law in laws for k, v in law.items()} | _flat(Parameters())


RATIO = declarations(StudySettings)["length_over_critical"]
MEMORY = declarations(Limits)["memory"]


def _parameter_options(function: Callable[..., Any]) -> Callable[..., Any]:
    """One option for each parameter of a simulation, from its declaration; also by full name."""
    known, defaults = names(), _defaults()
    for name, entry in reversed(study_parameters().items()):
        note = f"default {with_unit(defaults[name], entry)}" if name in defaults else ""
        note = "6 critical lengths if left out" if name == "length" else note
        called = [name] if name in CONSTANTS else [known.full(name), name]
        words = [f"--{word.replace('_', '-')}" for word in dict.fromkeys(called)]
        function = units.option(*words, key=name, entry=entry, note=note)(function)
    return function


@click.command("simulate", epilog=EXIT_CODES)
@click.argument("output", type=click.Path(dir_okay=False, path_type=Path))
@click.option(
    "--parameters", "file", type=click.Path(exists=True, dir_okay=False, path_type=Path),
    help="YAML or JSON file of parameters by the names below, with units if you like; or the "
    "dataset of an earlier simulation",
)  # fmt: skip
@click.option("--run", "run_id", metavar="ID", help="a run of the configuration, by its id")
@click.option(
    "--config", type=click.Path(dir_okay=False), default="config/config.yaml",
    show_default=True, help="the configuration that --run is in",
)  # fmt: skip
@_parameter_options
@units.option("--length-over-critical", key="length_over_critical", entry=RATIO)
@units.option("--memory", key="memory", entry=MEMORY, note="more is refused; 2000 MB if left out")
@click.option("--force", is_flag=True, help="replace OUTPUT if it exists")
@click.option("--dry-run", is_flag=True, help="check everything, say what would be run, and stop")
def command(
    output: Path, file: Path | None, run_id: str | None, config: str, force: bool, dry_run: bool,
    length_over_critical: float | None, memory: float | None, **options: Any,
) -> int:  # fmt: skip
    """Simulate a block pushed from its side and write the record to OUTPUT (netCDF).

    What an option does not give is taken from --parameters or --run, or is the default. A bar on
    the terminal shows how far the simulation is, a log gets a line now and then. Ctrl-C and SIGTERM
    leave a checkpoint from which the same command goes on. A simulation that fails numerically
    keeps its record beside, in a file that ends in .failed.nc.

    \b
    Example:
      nucleation simulate run.nc --height 5mm --n-x 100 --n-y 10
    """
    if file and run_id:
        raise ParameterError("--parameters and --run can't be combined")
    _check_output(output, force)
    base, given = None, {}
    if run_id:
        base = of_run(config, run_id)
    elif file and file.suffix == ".nc":
        base = of_dataset(file)
    elif file:
        given = of_file(file)
    values = _merged(base, given | _given(options))
    study = _given({"length_over_critical": length_over_critical})
    run = planned(values, study, _given({"memory": memory}), str(output.absolute().parent))
    for warning in advise([run]):
        text = warning.removeprefix(f"studies.{STUDY}: ").replace(f" ({run.id})", "")
        click.echo(f"Warning: {text}", err=True)
    if dry_run:
        click.echo("\n".join([*parameter_lines(run.parameters), *_plan_lines(run)]))
        return DONE
    click.echo("\n".join(_plan_lines(run)))
    return _simulate(run, output, _command(output, run))


def _merged(base: Parameters | None, given: dict[str, Any]) -> dict[str, Any]:
    """All values, from a base or the defaults, and those given; constants of friction set its law.

    Without a base, the block's length is left out unless it is given: it follows from the theory.
    """
    plain = {name: value for name, value in given.items() if name not in CONSTANTS}
    parameters = (base or Parameters()).replaced(plain)
    friction = with_constants(parameters.friction, parameters.loading.velocity, given)
    values = _flat(dataclasses.replace(parameters, friction=friction))
    if base is None and "length" not in given:
        del values["length"]
    return values


def planned(
    values: dict[str, Any], study: dict[str, Any], limits: dict[str, Any], results: str
) -> Run:
    """The run that values by their names in studies stand for, checked as a configuration.

    Raises
    ------
    ParameterError
        With all that is wrong with it.
    """
    defaults = dict(values)
    runs = [{"height": defaults.pop("height")}]
    study = study | {"defaults": defaults, "runs": runs}
    try:
        settings = configure({"studies": {STUDY: study}, "limits": limits, "results": results})
    except ParameterError as error:
        text = str(error)
        for place in (f"studies.{STUDY}.runs[0]", f"studies.{STUDY}.defaults"):
            text = text.replace(f"{place}: ", "").replace(f"{place}.", "")
        raise ParameterError(text) from None
    return settings.runs[0]


def _given(values: dict[str, Any]) -> dict[str, Any]:
    return {name: value for name, value in values.items() if value is not None}


def _check_output(output: Path, force: bool) -> None:
    """Refuse an output that can't be written, before hours are spent on it."""
    if output.suffix != ".nc":
        raise ParameterError(f"OUTPUT = '{output}' is not allowed: its name must end in .nc")
    if output.exists() and not force:
        raise ParameterError(f"{output} exists already; --force replaces it")
    folder = next(p for p in output.absolute().parents if p.exists())
    if not folder.is_dir() or not os.access(folder, os.W_OK):
        raise ParameterError(f"{output} can't be written: {folder} is no writable directory")


def _plan_lines(run: Run) -> list[str]:
    mesh = run.parameters.mesh
    element = run.parameters.geometry.length / mesh.n_x
    return [
        f"theory: critical length {run.theory_length:.4g} m, {run.theory_length / element:.4g} "
        f"elements of {element:.4g} m",
        f"memory: about {estimated_megabytes(mesh):.0f} MB",
    ]


def _command(output: Path, run: Run) -> str:
    """A command line that makes the dataset again: what differs from the defaults."""
    values, usual = _flat(run.parameters), _flat(Parameters())
    changed = {k: v for k, v in values.items() if k == "length" or v != usual.get(k)}
    words = [f"--{k.replace('_', '-')}={v}" for k, v in changed.items()]
    return shlex.join(["nucleation", "simulate", str(output), *words])


def _simulate(run: Run, output: Path, command_line: str) -> int:
    """Run it and write its record, beside the place of the result if it failed."""
    from ..datasets import provenance
    from ..pipeline.progress import Progress
    from ..pipeline.running import checkpoint_of, run_to_file, simulation_code
    from ..simulation.checkpoints import Stopped
    from ..simulation.run import simulate

    digest = simulation_code(run.parameters)
    attributes = provenance.attributes(run.parameters.to_dict(), digest, command_line)
    checkpoint = checkpoint_of(run.parameters, output, digest)
    progress = Progress(run.parameters, sys.stderr)
    try:
        with _listening(checkpoint):
            dataset, path = run_to_file(
                simulate, run.parameters, output, attributes,
                checkpoint=checkpoint, progress=progress,
            )  # fmt: skip
    except Stopped as stopped:
        click.echo(f"Error: {stopped}", err=True)
        return INTERRUPTED
    finally:
        progress.close()
    if path != output:
        click.echo(f"Error: {dataset.attrs['status']}; its record is in {path}", err=True)
        return FAILED
    click.echo(_result(dataset, run, output))
    return DONE


@contextlib.contextmanager
def _listening(checkpoint: Any) -> Iterator[None]:
    """Signals stop the run after its present step, within the context alone."""
    from ..simulation.checkpoints import SIGNALS

    before = {number: signal.getsignal(number) for number in SIGNALS}
    checkpoint.listen()
    try:
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def _result(dataset: Any, run: Run, output: Path) -> str:
    from ..analysis.extraction import extract

    attributes, found = dataset.attrs, extract(dataset)
    lines = [
        f"{attributes['status']}",
        f"{attributes['steps']} steps in {attributes['wall_seconds']:.3g} s",
        *event_lines(found, run.theory_length),
        f"written to {output}",
    ]
    return "\n".join(lines)
