"""One block or two solved by FreeFem++: its command line, and its records as a dataset.

FreeFem++ (Hecht, 2012) is the program the paper used. The script ``workflow/crosscheck/blocks.edp``
solves the same problems as :mod:`nucleation.simulation.run` with triangles and a time integration
of its own; it takes all numbers from its command line.
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

from ...analysis.definitions import ExtractionSettings
from ...datasets.variables import Variable, annotate, some
from ...model.parameters import Parameters
from ...model.quantities import ParameterError
from ...simulation.event import FAST
from ...simulation.realisation import Series, Sheet
from ...simulation.recorded import RECORDED
from .plan import FIXED, KINDS, LOADINGS, CrosscheckSettings

PROGRAM = "FreeFem++-nw"
PLUGINS = "/usr/lib/freefem++"  # where Debian has them; the program looks elsewhere
MISSING = (
    f"the crosscheck needs {PROGRAM}, which is not installed: "
    "run workflow/install-debian.sh crosscheck"
)
MOST_STEPS = 200_000  # a run that needs more has failed
UNUSED = (
    "material.plane", "loading.kind",
    "loading.initial_shear_stress", "loading.stress_rate", "heterogeneity.shape",
    "heterogeneity.centre", "heterogeneity.width", "heterogeneity.change",
    "stepping.tolerance", "stepping.shortest_step", "stepping.event_drop",
    "perturbation.correlation_time", "perturbation.correlation_length", "perturbation.seed",
    "recording.record",
)  # fmt: skip
"""Parameters without meaning for the script, or for what is handed over to it."""
SCRIPT = "blocks.edp"
REALISATION = "realisation.txt"  # in the directory of a run
FIELDS = ("slip_rate", "state", "slip", "shear_stress", "normal_stress")
STEPS = {
    **some(RECORDED, "step_time", "step_size", "driving_force", "maximal_slip_rate"),
    "newton_iterations": RECORDED["newton_iterations"],
    "factorisations": Variable("1", "factorised matrices of the step"),
}


class FreeFemError(RuntimeError):
    """FreeFem++ is missing, failed, or left a record that can't be read."""


def installed() -> bool:
    """Whether FreeFem++ can be called."""
    return shutil.which(PROGRAM) is not None


def arguments(
    parameters: Parameters, settings: CrosscheckSettings, extraction: ExtractionSettings
) -> dict[str, str]:
    """The script's arguments, by name: those of the simulation and the script's own stepping.

    Raises
    ------
    FreeFemError
        The script can't do what a parameter asks for, see :data:`FIXED` and what follows it.
    """
    named = parameters.named()
    for name, only in FIXED.items():
        if named[name] != only:
            raise FreeFemError(f"the script for FreeFem++ has {name} = {only} only")
    for name, some_of in {"perturbation.kind": KINDS, "loading.kind": LOADINGS}.items():
        if named[name] not in some_of:
            raise FreeFemError(f"the script for FreeFem++ has {name} = {', '.join(some_of)} only")
    unused = (*FIXED, *UNUSED)
    taken = [name for name in named if name not in unused and not name.startswith("second_body.")]
    values = {name.partition(".")[2]: named[name] for name in taken}  # as the script calls them
    values["poisson_ratio"] = parameters.material.in_plane_ratio
    values["slip_per_step"] = settings.slip_per_step
    values |= {"drop": extraction.drop, "fast": FAST, "most_steps": MOST_STEPS}
    values["loading"] = parameters.loading.kind
    below = parameters.below
    if below is not None and below.mesh.grading != 1.0:
        raise FreeFemError("the script for FreeFem++ has second_body.grading = 1.0 only")
    lower = below or parameters  # of a rigid base nothing tells but that it is held
    values |= {f"second_{name}": value for name, value in asdict(lower.material).items()}
    values |= {
        "second_poisson_ratio": lower.material.in_plane_ratio,
        "second_height": lower.geometry.height,
        "second_n_y": below.mesh.n_y if below else 1,
        "second_bottom": below.bottom if below else "rigid",
    }
    return {name: str(value) for name, value in values.items()}


def realisation(parameters: Parameters) -> str:
    """The declared perturbation on its own grid, up to the end of a run, for the script to read.

    Spacing of the splines (s), phase, number of splines and of places, and the coefficients a_i of
    :mod:`nucleation.simulation.realisation`: one line for each spline, of all places.
    """
    declared, end = parameters.perturbation, parameters.stepping.end_time
    time = declared.correlation_time * parameters.memory_time
    made: Series | Sheet = Series(declared.seed, time)
    if declared.kind == "state":
        x = np.linspace(0.0, parameters.geometry.length, parameters.mesh.n_x + 1)
        made = Sheet(declared.seed, time, declared.correlation_length, x)
    rows = made.coefficients(end + parameters.memory_time)  # the last step goes beyond the end
    numbers = (made.spacing, made.phase, *rows.shape)
    lines = [" ".join(map(repr, row)) for row in [numbers, *rows.tolist()]]
    return "\n".join(lines) + "\n"


def run(
    scripts: Path,
    directory: Path,
    parameters: Parameters,
    settings: CrosscheckSettings,
    extraction: ExtractionSettings = ExtractionSettings(),
) -> xr.Dataset:
    """Solve the block, or both, with FreeFem++ and return its record.

    Parameters
    ----------
    scripts : the directory of the FreeFem++ scripts.
    directory : an existing directory for its plain-text records.
    parameters : the simulation; of its stepping, the end and the longest step are used.
    settings : the steps of the script in the event.
    extraction : the drop of the force that makes an event.

    Returns
    -------
    Dataset with the interface's fields on (time, x) and the driving force on (step), of the
    layout of :func:`nucleation.simulation.run.simulate`; without fields of the bulk.

    Raises
    ------
    FreeFemError
        FreeFem++ is missing or failed.
    """
    if not installed():
        raise FreeFemError(MISSING)
    given = arguments(parameters, settings, extraction) | {"directory": str(directory)}
    if parameters.perturbation.kind != "none":
        (directory / REALISATION).write_text(realisation(parameters), encoding="ascii")
    command = [PROGRAM, "-nw", "-v", "0", str(scripts / SCRIPT)]
    command += [f"{name}={value}" for name, value in given.items()]
    environment = os.environ | {"FF_LOADPATH": os.environ.get("FF_LOADPATH", PLUGINS)}
    done = subprocess.run(
        command, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT, text=True, errors="replace", check=False,
    )  # fmt: skip
    if done.returncode:
        raise FreeFemError(f"FreeFem++ failed (code {done.returncode}):\n{done.stdout[-2000:]}")
    return read(directory, parameters)


def read(directory: Path, parameters: Parameters) -> xr.Dataset:
    """The records of the FreeFem++ script in a directory as a dataset.

    ``steps.txt`` has one line of :data:`STEPS` per step. ``frames.txt`` has for each frame a
    line with its time (s) and then one line for each of :data:`FIELDS` at the nodes 0..n_x.

    Raises
    ------
    FreeFemError
        A record is missing or incomplete.
    """
    geometry, nodes = parameters.geometry, parameters.mesh.n_x + 1
    try:
        steps = np.loadtxt(directory / "steps.txt", ndmin=2)
        words = (directory / "frames.txt").read_text(encoding="ascii").split()
        frames = np.array(words, dtype=float).reshape(-1, 1 + len(FIELDS) * nodes)
        rows = dict(zip(STEPS, steps.T, strict=True))
    except (OSError, ValueError) as error:
        raise FreeFemError(f"the records in {directory} can't be read: {error}") from error
    fields = frames[:, 1:].reshape(-1, len(FIELDS), nodes)
    data = {name: (("time", "x"), fields[:, i]) for i, name in enumerate(FIELDS)}
    data |= {name: (("step",), row) for name, row in rows.items()}  # type: ignore[misc]
    coords = {"time": frames[:, 0], "x": np.linspace(0.0, geometry.length, nodes)}
    attributes = {"parameters": parameters.to_json(), "steps": steps.shape[0]}
    return annotate(xr.Dataset(data, coords=coords, attrs=attributes), RECORDED | STEPS)


def of_run(
    scripts: Sequence[Path], parameters: Parameters, crosscheck: CrosscheckSettings,
    settings: ExtractionSettings,
) -> xr.Dataset:  # fmt: skip
    """The step ``crosscheck_freefem``: a run with these scripts, its own records thrown away.

    Raises
    ------
    ParameterError
        If FreeFem++ is missing or failed.
    """
    with TemporaryDirectory() as directory:
        try:
            found = run(scripts[0].parent, Path(directory), parameters, crosscheck, settings)
        except FreeFemError as error:
            raise ParameterError(str(error)) from None
    return found.assign_attrs(parameters=parameters.to_json())
