"""The cost of a step and of a run: on the paper's mesh, over meshes, of pairs, if perturbed."""

import os
import time
from collections.abc import Callable
from typing import Any

import numpy as np
import xarray as xr
from scipy.sparse.linalg import splu

from nucleation.extraction.extraction import extract
from nucleation.fem.body import Body
from nucleation.fem.operator import Operator
from nucleation.model.perturbations import KINDS
from nucleation.run.run import Run
from nucleation.simulation.run import instants, simulate
from nucleation.simulation.start import body_of, composed, grid_of
from nucleation.simulation.stepping import BDF, rung_value
from replication.configuration.load import Configuration

from .assembled import assemble

CREEP_TIME = 1.0  # s, at which steps are timed
BLOCKS, STEPS = 8, 40  # of timed steps
END_TIME = 16.0  # s, of the whole run
MESHES_ALONG_X, ROWS = (400, 800, 1600, 3200), 20  # values of n_x, and their n_y
MESHES_ALONG_Y, COLUMNS = (20, 40, 80, 150), 400  # values of n_y, and their n_x
BOTTOMS = ("free", "clamped", "roller")
PAIR = {"n_x": 400, "n_y": 16, "height": 0.02, "block_length": 0.7}  # of each block
STRENGTH = 1e-3  # of the perturbed steps
PRECISIONS = (
    (1e-1, 0.4),
    (1e-2, 0.4),
    (1e-2, 0.2),
    (1e-2, 0.1),
    (1e-2, 0.05),
    (1e-3, 0.1),
    (1e-3, 0.05),
)
"""Tolerances and longest steps (D/V) for which the error is measured."""

REFERENCE = (1e-4, 0.02)
"""Those of the run against which the error is measured."""

Task = Callable[[], Any]


def of_figure_s2(settings: Configuration) -> Run:
    """Return the simulation that is measured."""
    return settings.shown(0.005).run


def measure_solver(parameters: Run) -> dict[str, Any]:
    """Return all measurements of one simulation."""
    simulate(parameters.replaced(n_x=16, n_y=4))  # compiles the kernels
    whole = _whole_run(parameters)  # first: the memory is that of the process
    return {
        **whole,
        **_step_over_solve(parameters),
        **_speedup_over_sparse(parameters, whole),
        **_scaling(parameters),
        **_pair_steps(parameters),
        "perturbed_over_quiet": _perturbed(parameters),
        "work_precision": _precisions(parameters),
        "threads": os.environ.get("OMP_NUM_THREADS", "not set"),
    }


def solver_table(result: dict[str, Any]) -> str:
    """Return the measurements as text."""
    lines = []
    for name, value in result.items():
        if isinstance(value, list):
            lines.append("  ".join(f"{key:>12}" for key in value[0]))
            for row in value:
                lines.append("  ".join(f"{entry:12.3g}" for entry in row.values()))
        elif isinstance(value, dict):
            entries = "  ".join(f"{key}: {entry:.3g}" for key, entry in value.items())
            lines.append(f"{name:32}{entries}")
        elif isinstance(value, str):
            lines.append(f"{name:32}{value}")
        else:
            lines.append(f"{name:32}{value:.4g}")
    return "\n".join(lines)


def _fastest(*tasks: Task, blocks: int = BLOCKS) -> list[float]:
    """Wall time (s) of each task's fastest execution; the tasks take turns."""
    best = [np.inf] * len(tasks)
    for _ in range(blocks):
        for i, task in enumerate(tasks):
            start = time.perf_counter()
            task()
            seconds = time.perf_counter() - start
            best[i] = min(best[i], seconds)
    return best


def _longest_rung(parameters: Run) -> int:
    """The rung of the longest steps."""
    longest = parameters.stepping.longest_step * parameters.memory_time
    return BDF().steady_rung(longest)


def _timed_steps(parameters: Run) -> Task:
    """A task that makes the next :data:`STEPS` longest steps, from the middle of the creep."""
    for instant in instants(parameters.replaced(tolerance=0.1, longest_step=0.4)):
        if instant.state.time > CREEP_TIME:
            break
    dynamics = composed(parameters)
    state = instant.state
    rung = _longest_rung(parameters)

    def task(steps: int = STEPS) -> None:
        nonlocal state
        for _ in range(steps):
            state, _ = dynamics.advance(state, rung)

    task(steps=10)
    return task


def _step_over_solve(parameters: Run) -> dict[str, float]:
    """A whole step against the one solve of the block that it needs at least."""
    grid = grid_of(parameters.upper)
    body = Body((grid, parameters.upper.material))
    beta = rung_value(_longest_rung(parameters))
    operator = Operator(body, 1.0 / beta**2)
    load = body.far_load(1e6)
    at_rest = np.zeros(grid.n_x)
    edge = np.zeros(grid.n_y + 1)

    def solve() -> None:
        swept = operator.swept_down(load, edge)
        operator.substitute_up(swept, at_rest, 0.0)

    steps, solve_seconds = _fastest(_timed_steps(parameters), solve)
    step_seconds = steps / STEPS
    return {
        "step_milliseconds": 1e3 * step_seconds,
        "own_solve_milliseconds": 1e3 * solve_seconds,
        "step_over_own_solve": step_seconds / solve_seconds,
    }


def _whole_run(parameters: Run) -> dict[str, float]:
    """The whole run through the event to :data:`END_TIME`, and its memory."""
    whole = parameters.replaced(end_time=END_TIME, time_after_event=1e3)
    record = simulate(whole)
    sizes = record["step_size"].values[1:]
    changed = np.abs(np.diff(sizes)) > 1e-9 * sizes[1:]
    return {
        "run_seconds": record.attrs["wall_seconds"],
        "peak_mb": record.attrs["peak_megabytes"],
        "run_steps": record.attrs["steps"],
        "run_rejected_steps": record.attrs["rejected_steps"],
        "run_step_size_changes": int(np.count_nonzero(changed)),
        "run_onset_time": extract(record)["onset_time"],
    }


def _speedup_over_sparse(parameters: Run, whole: dict[str, float]) -> dict[str, float]:
    """The same steps with the assembled sparse matrix; its LU serves while the step size is kept.

    One factorisation and two solves are timed and multiplied by the run's counts: two solves in
    each step, accepted or not, and a factorisation whenever the step size changed. The interface's
    Newton iterations are left out, so the result is a lower bound for the ordinary way.
    """
    grid = grid_of(parameters.upper)
    stiffness, mass = assemble(grid, parameters.upper.material)
    nodes = grid.n_x + 1
    driven = 2 * np.arange(grid.n_y + 1) * nodes
    interface = np.arange(2 * nodes)
    free = np.setdiff1d(np.arange(stiffness.shape[0]), np.append(driven, interface))
    matrix = (stiffness + 1e6 * mass)[free][:, free].tocsc()
    start = time.perf_counter()
    factors = splu(matrix, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
    factorisation = time.perf_counter() - start
    right = np.ones(free.size)
    (solve,) = _fastest(lambda: factors.solve(right), blocks=3)
    steps = whole["run_steps"] + whole["run_rejected_steps"]
    total = 2 * steps * solve + whole["run_step_size_changes"] * factorisation
    return {
        "speedup_over_sparse": total / whole["run_seconds"],
        "sparse_run_seconds": total,
        "sparse_factorisation_seconds": factorisation,
        "sparse_solve_seconds": solve,
    }


def _scaling(parameters: Run) -> dict[str, Any]:
    """Time per step against the number of elements along x and y, with fitted exponents."""
    along_x = [parameters.replaced(n_x=n, n_y=ROWS) for n in MESHES_ALONG_X]
    along_y = [parameters.replaced(n_y=n, n_x=COLUMNS) for n in MESHES_ALONG_Y]
    return {
        **_scaling_along("n_x", MESHES_ALONG_X, along_x),
        **_scaling_along("n_y", MESHES_ALONG_Y, along_y),
    }


def _scaling_along(axis: str, numbers: tuple[int, ...], meshes: list[Run]) -> dict[str, Any]:
    """Time per step on some meshes with these numbers of elements along one axis."""
    tasks = [_timed_steps(mesh) for mesh in meshes]
    seconds = np.array(_fastest(*tasks)) / STEPS
    exponent, _ = np.polyfit(np.log(numbers), np.log(seconds), 1)
    milliseconds = (1e3 * seconds).tolist()
    return {
        f"exponent_{axis}": float(exponent),
        f"step_milliseconds_by_{axis}": dict(zip(map(str, numbers), milliseconds, strict=True)),
    }


def _pair_steps(parameters: Run) -> dict[str, float]:
    """A step of two identical blocks over a step of one, on the same mesh in each."""
    one = parameters.replaced(**PAIR)
    pairs = [one.replaced(second_body="deformable", second_far_side=bottom) for bottom in BOTTOMS]
    base, *times = _fastest(*map(_timed_steps, (one, *pairs)))
    found = {}
    for bottom, seconds in zip(BOTTOMS, times, strict=True):
        found[f"pair_step_over_one_{bottom}"] = seconds / base
    of_pair = body_of(pairs[0]).operator_megabytes
    own = body_of(one).operator_megabytes
    found["pair_operator_over_one_mb"] = of_pair / own
    return found


def _perturbed(parameters: Run) -> dict[str, float]:
    """Time of a step under each kind of perturbation over that of an unperturbed one."""
    kinds = tuple(KINDS)
    values = {"strength": STRENGTH, "seed": 1}
    runs = [parameters.replaced(perturbation=kind, **values) for kind in kinds]
    unperturbed, *times = _fastest(*map(_timed_steps, (parameters, *runs)))
    return {kind: seconds / unperturbed for kind, seconds in zip(kinds, times, strict=True)}


def _precisions(parameters: Run) -> list[dict[str, float]]:
    """Error of the onset time and wall time, by tolerance and longest step."""
    reference = _simulated(parameters, *REFERENCE)
    exact = extract(reference)["onset_time"]
    rows = []
    for tolerance, longest_step in PRECISIONS:
        record = _simulated(parameters, tolerance, longest_step)
        ratio = extract(record)["onset_time"] / exact
        row = {
            "tolerance": tolerance,
            "longest_step": longest_step,
            "steps": record.attrs["steps"],
            "seconds": record.attrs["wall_seconds"],
            "onset_error": abs(ratio - 1.0),
        }
        rows.append(row)
    return rows


def _simulated(parameters: Run, tolerance: float, longest_step: float) -> xr.Dataset:
    values = {"tolerance": tolerance, "longest_step": longest_step, "time_after_event": 0.0}
    return simulate(parameters.replaced(**values))
