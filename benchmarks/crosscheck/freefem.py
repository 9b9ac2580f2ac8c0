"""One block or two solved by FreeFem++: its command line, and its records as a dataset.

The script ``blocks.edp`` solves the same problems as :mod:`nucleation.simulation.run` with
triangles and a time integration of its own. All of its numbers are arguments of the command line.
"""

import os
import subprocess
from dataclasses import asdict
from pathlib import Path

import numpy as np
import xarray as xr

from nucleation.extraction.definitions import ExtractionSettings
from nucleation.model.perturbations import KINDS
from nucleation.model.realisations import BLOCK, SERIES, Series, Sheet, normals
from nucleation.run.run import Run
from nucleation.simulation.event import FAST
from nucleation.types import Array

PROGRAM = "FreeFem++-nw"
PLUGINS = "/usr/lib/freefem++"  # Debian's directory; by default the program searches another one
SCRIPT = Path(__file__).parent / "blocks.edp"
REALISATION = "realisation.txt"  # in the directory of a run
FIELDS = ("slip_rate", "state", "slip", "shear_stress", "sigma_yy")
STEPS = (
    "step_time",
    "step_size",
    "driving_force",
    "maximal_slip_rate",
    "newton_iterations",
    "factorisations",
)
NUMBERS = {
    "slip_per_step": 0.2,  # largest slip within a step, over D
    "most_steps": 200_000,  # a run that needs more has failed
    "drop": ExtractionSettings().drop,
    "fast": FAST,
}
FIXED = {
    "loading": "edge",
    "friction_law": "product",
    "evolution": "aging",
    "grading": 1.0,
    "initial_stress": "no_slip",
    "heterogeneity": "none",
}
"""Parameters for which the script has this one value, by name."""

USED = (
    "shear_modulus",
    "density",
    "slip_distance",
    "regularisation_slip_rate",
    "aging_coefficient",
    "slip_rate_scale",
    "base_friction",
    "state_scale",
    "rate_coefficient",
    "normal_stress",
    "velocity",
    "initial_state",
    "height",
    "block_length",
    "n_x",
    "n_y",
    "end_time",
    "time_after_event",
    "longest_step",
    "perturbation",
    "strength",
)
"""Parameters that the script receives; it calls two of them length and kind."""


class FreeFemError(RuntimeError):
    """FreeFem++ has failed, or does not support a value of a parameter."""


def arguments(run: Run) -> dict[str, str]:
    """The script's arguments by name; FreeFemError if it does not support a value."""
    named = {"second_grading": run.block.grading} | run.to_dict()
    supported: dict[str, tuple[object, ...]] = {name: (value,) for name, value in FIXED.items()}
    supported |= {"perturbation": ("none", *(name for name, kind in KINDS.items() if kind.in_time))}
    below = run.below
    if below is not None:
        supported["second_grading"] = (1.0,)
    for name, allowed in supported.items():
        if named[name] not in allowed:
            choices = ", ".join(map(str, allowed))
            raise FreeFemError(f"the script for FreeFem++ has {name} = {choices} only")
    called = {"block_length": "length", "perturbation": "kind"}
    values = NUMBERS | {called.get(name, name): named[name] for name in USED}
    values["poisson_ratio"] = run.upper.material.in_plane_ratio
    lower = below or run.upper  # of a rigid base the script uses only that it is fixed
    values |= {f"second_{name}": value for name, value in asdict(lower.material).items()}
    values |= {
        "second_poisson_ratio": lower.material.in_plane_ratio,
        "second_height": lower.height,
        "second_n_y": below.n_y if below else 1,
        "second_far_side": below.far_side if below else "rigid",
    }
    return {name: str(value) for name, value in values.items()}


def coefficients_of(made: Series | Sheet, seed: int, until: float) -> Array:
    """The coefficients a_i of the values up to a time (s), a row for each and a column a place."""
    number = int(until / made.spacing + made.phase) + 4
    if isinstance(made, Sheet):
        return np.array([made.row(i) for i in range(number)])
    blocks = [normals(seed, SERIES, row, BLOCK) for row in range(number // BLOCK + 1)]
    return np.concatenate(blocks)[:number, None]


def realisation(run: Run) -> str:
    """The declared perturbation on its own grid, up to the end of a run, for the script to read.

    Spacing of the splines (s), phase, number of splines and of places, and the coefficients a_i of
    :mod:`nucleation.model.realisations`: one line for each spline, of all places.
    """
    declared = run.perturbation
    time = declared.correlation_time * run.memory_time
    series: Series | Sheet = Series(declared.seed, time)
    if declared.kind == "state":
        x = np.linspace(0.0, run.block.length, run.block.n_x + 1)
        series = Sheet(declared.seed, time, declared.correlation_length, x)
    # the last step ends after the end of the run
    until = run.stepping.end_time + run.memory_time
    coefficients = coefficients_of(series, declared.seed, until)
    rows = [(series.spacing, series.phase, *coefficients.shape), *coefficients.tolist()]
    return "\n".join(" ".join(map(repr, row)) for row in rows) + "\n"


def solve(directory: Path, run: Run) -> xr.Dataset:
    """Solve the block, or both, with FreeFem++; its plain-text records are put in the directory.

    The fields of the interface are on (time, x) and the driving force is on (step), as those of
    :func:`nucleation.simulation.run.simulate`. Of its stepping, the end and the longest step are
    used.
    """
    given = arguments(run) | {"directory": str(directory)}
    if run.perturbation.kind != "none":
        (directory / REALISATION).write_text(realisation(run), encoding="ascii")
    command = [PROGRAM, "-nw", "-v", "0", str(SCRIPT)]
    command += [f"{name}={value}" for name, value in given.items()]
    done = subprocess.run(
        command,
        env={"FF_LOADPATH": PLUGINS} | os.environ,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.PIPE,
        stderr=subprocess.STDOUT,
        text=True,
        errors="replace",
        check=False,
    )
    if done.returncode:
        raise FreeFemError(f"FreeFem++ failed (code {done.returncode}):\n{done.stdout[-2000:]}")
    return read(directory, run)


def read(directory: Path, run: Run) -> xr.Dataset:
    """The records in a directory: a line of STEPS for each step, then for each frame its time (s)
    and a line for each of FIELDS at the nodes 0..n_x."""
    nodes = run.block.n_x + 1
    steps = np.loadtxt(directory / "steps.txt", ndmin=2)
    numbers = np.array((directory / "frames.txt").read_text(encoding="ascii").split(), dtype=float)
    frames = numbers.reshape(-1, 1 + len(FIELDS) * nodes)
    fields = frames[:, 1:].reshape(-1, len(FIELDS), nodes)
    on_frames = {name: (("time", "x"), fields[:, i]) for i, name in enumerate(FIELDS)}
    on_steps = {name: ("step", column) for name, column in zip(STEPS, steps.T, strict=True)}
    x = np.linspace(0.0, run.block.length, nodes)
    return xr.Dataset(
        on_frames | on_steps,
        {"time": frames[:, 0], "x": x},
        {"parameters": run.to_json(), "steps": steps.shape[0]},
    )
