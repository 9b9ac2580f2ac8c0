"""One block or two solved by FreeFem++: its command line, and its records as a dataset.

FreeFem++ (Hecht, 2012) is the program the paper used. The script ``workflow/crosscheck/blocks.edp``
solves the same problems as :mod:`nucleation.simulation.run` with triangles and a time integration
of its own. All of its numbers are arguments of the command line.
"""

import os
import shutil
import subprocess
from collections.abc import Sequence
from dataclasses import asdict
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np
import xarray as xr

from nucleation.datasets.variables import Variable, annotate, some
from nucleation.extraction.definitions import ExtractionSettings
from nucleation.model.parameters import Parameters
from nucleation.model.quantities import ParameterError
from nucleation.simulation.event import FAST
from nucleation.simulation.realisation import Series, Sheet
from nucleation.simulation.recorded import RECORDED

from .plan import FIXED, KINDS, CrosscheckSettings

PROGRAM = "FreeFem++-nw"
PLUGINS = "/usr/lib/freefem++"  # Debian's directory; by default the program searches another one
MISSING = (
    f"the crosscheck needs {PROGRAM}, which is not installed: "
    "run workflow/install-debian.sh crosscheck"
)
MOST_STEPS = 200_000  # a run that needs more has failed
UNUSED = (
    "material.plane",
    "loading.kind",
    "loading.initial_shear_stress",
    "loading.stress_rate",
    "heterogeneity.shape",
    "heterogeneity.centre",
    "heterogeneity.width",
    "heterogeneity.change",
    "stepping.tolerance",
    "stepping.shortest_step",
    "stepping.event_drop",
    "perturbation.correlation_time",
    "perturbation.correlation_length",
    "perturbation.seed",
    "recording.record",
)
"""Parameters that the script does not use, or receives in another form."""

SCRIPT = "blocks.edp"
REALISATION = "realisation.txt"  # in the directory of a run
FIELDS = ("slip_rate", "state", "slip", "shear_stress", "sigma_yy")
STEPS = {
    **some(RECORDED, "step_time", "step_size", "driving_force", "maximal_slip_rate"),
    "newton_iterations": RECORDED["newton_iterations"],
    "factorisations": Variable("1", "factorised matrices of the step"),
}


class FreeFemError(RuntimeError):
    """FreeFem++ is missing, has failed, or its record can't be read."""


def installed() -> bool:
    """Return whether FreeFem++ can be called."""
    return shutil.which(PROGRAM) is not None


def arguments(
    parameters: Parameters,
    settings: CrosscheckSettings,
    extraction: ExtractionSettings,
) -> dict[str, str]:
    """Return the script's arguments, by name.

    Parameters
    ----------
    parameters : Parameters
        The simulation.
    settings : CrosscheckSettings
        The script's own steps in the event.
    extraction : ExtractionSettings
        The drop of the force that makes an event.

    Returns
    -------
    dict of str

    Raises
    ------
    FreeFemError
        If the script does not support a value of a parameter.
    """
    named = parameters.named()
    _require_supported(parameters)
    unused = (*FIXED, *UNUSED)
    values = {}
    for name, value in named.items():
        group, _, short = name.partition(".")
        if name not in unused and group != "second_body":
            values[short] = value  # the script uses the short names
    values |= {
        "poisson_ratio": parameters.material.in_plane_ratio,
        "slip_per_step": settings.slip_per_step,
        "drop": extraction.drop,
        "fast": FAST,
        "most_steps": MOST_STEPS,
    }
    below = parameters.below
    lower = below or parameters  # of a rigid base the script uses only that it is fixed
    for name, value in asdict(lower.material).items():
        values[f"second_{name}"] = value
    values |= {
        "second_poisson_ratio": lower.material.in_plane_ratio,
        "second_height": lower.geometry.height,
        "second_n_y": below.mesh.n_y if below else 1,
        "second_far_side": below.far_side if below else "rigid",
    }
    return {name: str(value) for name, value in values.items()}


def _require_supported(parameters: Parameters) -> None:
    """Raise a FreeFemError if the script does not support a value of a parameter."""
    supported: dict[str, tuple[object, ...]] = {name: (value,) for name, value in FIXED.items()}
    supported |= {"perturbation.kind": KINDS}
    named = parameters.named()
    if parameters.below is not None:
        supported["second_body.grading"] = (1.0,)
        named["second_body.grading"] = parameters.below.mesh.grading
    for name, values in supported.items():
        if named[name] not in values:
            choices = ", ".join(map(str, values))
            raise FreeFemError(f"the script for FreeFem++ has {name} = {choices} only")


def _realisation(parameters: Parameters) -> str:
    """The declared perturbation on its own grid, up to the end of a run, for the script to read.

    Spacing of the splines (s), phase, number of splines and of places, and the coefficients a_i of
    :mod:`nucleation.simulation.realisation`: one line for each spline, of all places.
    """
    declared = parameters.perturbation
    time = declared.correlation_time * parameters.memory_time
    series: Series | Sheet = Series(declared.seed, time)
    if declared.kind == "state":
        x = np.linspace(
            0.0,
            parameters.geometry.length,
            parameters.mesh.n_x + 1,
        )
        series = Sheet(declared.seed, time, declared.correlation_length, x)
    # the last step ends after the end of the run
    coefficients = series.coefficients(parameters.stepping.end_time + parameters.memory_time)
    numbers = (series.spacing, series.phase, *coefficients.shape)
    rows = [numbers, *coefficients.tolist()]
    lines = [" ".join(map(repr, row)) for row in rows]
    return "\n".join(lines) + "\n"


def solve(
    scripts: Path,
    directory: Path,
    parameters: Parameters,
    settings: CrosscheckSettings,
    extraction: ExtractionSettings = ExtractionSettings(),
) -> xr.Dataset:
    """Solve the block, or both, with FreeFem++ and return its record.

    Parameters
    ----------
    scripts : Path
        The directory of the FreeFem++ scripts.
    directory : Path
        An existing directory for its plain-text records.
    parameters : Parameters
        The simulation; of its stepping, the end and the longest step are used.
    settings : CrosscheckSettings
        The steps of the script in the event.
    extraction : ExtractionSettings
        The drop of the force that makes an event.

    Returns
    -------
    Dataset
        The interface's fields on (time, x) and the driving force on (step), in the layout of
        :func:`nucleation.simulation.run.simulate`; without fields of the bulk.

    Raises
    ------
    FreeFemError
        If FreeFem++ is missing or fails.
    """
    if not installed():
        raise FreeFemError(MISSING)
    given = arguments(parameters, settings, extraction) | {"directory": str(directory)}
    if parameters.perturbation.kind != "none":
        (directory / REALISATION).write_text(_realisation(parameters), encoding="ascii")
    command = [PROGRAM, "-nw", "-v", "0", str(scripts / SCRIPT)]
    command += [f"{name}={value}" for name, value in given.items()]
    load_path = os.environ.get("FF_LOADPATH", PLUGINS)
    done = subprocess.run(
        command,
        env=os.environ | {"FF_LOADPATH": load_path},
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        check=False,
    )
    if done.returncode:
        raise FreeFemError(f"FreeFem++ failed (code {done.returncode}):\n{done.stdout[-2000:]}")
    return _read(directory, parameters)


def _read(directory: Path, parameters: Parameters) -> xr.Dataset:
    """The records of the FreeFem++ script in a directory as a dataset.

    ``steps.txt`` has one line of :data:`STEPS` per step. ``frames.txt`` has for each frame a
    line with its time (s) and then one line for each of :data:`FIELDS` at the nodes 0..n_x.
    A record that is missing or incomplete is a FreeFemError.
    """
    nodes = parameters.mesh.n_x + 1
    try:
        steps = np.loadtxt(directory / "steps.txt", ndmin=2)
        words = (directory / "frames.txt").read_text(encoding="ascii").split()
        numbers = np.array(words, dtype=float)
        frames = numbers.reshape(-1, 1 + len(FIELDS) * nodes)
        columns = dict(zip(STEPS, steps.T, strict=True))
    except (OSError, ValueError) as error:
        raise FreeFemError(f"the records in {directory} can't be read: {error}") from error
    fields = frames[:, 1:].reshape(-1, len(FIELDS), nodes)
    on_frames = {name: (("time", "x"), fields[:, i]) for i, name in enumerate(FIELDS)}
    on_steps = {name: (("step",), column) for name, column in columns.items()}
    coordinates = {
        "time": frames[:, 0],
        "x": np.linspace(0.0, parameters.geometry.length, nodes),
    }
    attributes = {
        "parameters": parameters.to_json(),
        "steps": steps.shape[0],
    }
    found = xr.Dataset(
        {**on_frames, **on_steps},
        coordinates,
        attributes,
    )
    return annotate(found, RECORDED | STEPS)


def of_run(
    scripts: Sequence[Path],
    parameters: Parameters,
    crosscheck: CrosscheckSettings,
    settings: ExtractionSettings,
) -> xr.Dataset:
    """Make the record of the step ``crosscheck_freefem``.

    Parameters
    ----------
    scripts : sequence of Path
        The FreeFem++ scripts.
    parameters : Parameters
        The simulation.
    crosscheck : CrosscheckSettings
        The steps of the script in the event.
    settings : ExtractionSettings
        The drop of the force that makes an event.

    Returns
    -------
    Dataset

    Raises
    ------
    ParameterError
        If FreeFem++ is missing or fails.
    """
    with TemporaryDirectory() as directory:
        try:
            return solve(
                scripts[0].parent,
                Path(directory),
                parameters,
                crosscheck,
                settings,
            )
        except FreeFemError as error:
            raise ParameterError(str(error)) from None
