"""What a step and a run cost: on the paper's mesh, over meshes, of pairs, under perturbations."""

import os
import time
from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.sparse.linalg import splu

from nucleation.analysis.extraction import extract
from nucleation.configuration.load import Configuration
from nucleation.fem.block import Block
from nucleation.fem.bodies import body_of
from nucleation.fem.grid import Grid
from nucleation.model.parameters import Parameters
from nucleation.model.perturbation import KINDS
from nucleation.model.second_body import BOTTOMS
from nucleation.simulation.run import composed, run, simulate
from nucleation.simulation.stepping import BDF, rung_value

from .assembled import assemble

CREEP_TIME = 1.0  # s, at which steps are timed
BLOCKS, STEPS = 8, 40  # of timed steps
END_TIME = 16.0  # s, of the whole run
MESHES_ALONG_X, ROWS = (400, 800, 1600, 3200), 20  # n_x, with so many n_y
MESHES_ALONG_Y, COLUMNS = (20, 40, 80, 150), 400  # n_y, with so many n_x
PAIR = {"n_x": 400, "n_y": 16, "height": 0.02, "length": 0.7}  # of each block
STRENGTH = 1e-3  # of the perturbed steps
PRECISIONS = (
    (1e-1, 0.4), (1e-2, 0.4), (1e-2, 0.2), (1e-2, 0.1), (1e-2, 0.05), (1e-3, 0.1), (1e-3, 0.05),
)  # fmt: skip
"""Tolerances and longest steps (D/V) of which the error is measured, against the next."""
REFERENCE = (1e-4, 0.02)


def of_figure_s2(settings: Configuration) -> Parameters:
    """The simulation that is measured."""
    return settings.shown(settings.figures.space_time_height).parameters


def measured(parameters: Parameters) -> dict[str, Any]:
    """All measurements of one simulation."""
    simulate(parameters.replaced({"n_x": 16, "n_y": 4}))  # compiles what is compiled
    whole = whole_run(parameters)  # first: the memory is that of the process
    return {
        **whole,
        **step_over_solve(parameters),
        **speedup_over_sparse(parameters, whole),
        **scaling(parameters),
        **pair_steps(parameters),
        "perturbed_over_quiet": perturbed(parameters),
        "work_precision": precisions(parameters),
        "threads": os.environ.get("OMP_NUM_THREADS", "not set"),
    }


def table(result: dict[str, Any]) -> str:
    """The measurements as text."""
    lines = []
    for name, value in result.items():
        if isinstance(value, list):
            lines.append("  ".join(f"{key:>12}" for key in value[0]))
            lines += ["  ".join(f"{entry:12.3g}" for entry in row.values()) for row in value]
        elif isinstance(value, dict):
            lines.append(f"{name:32}" + "  ".join(f"{k}: {v:.3g}" for k, v in value.items()))
        else:
            lines.append(f"{name:32}{value if isinstance(value, str) else format(value, '.4g')}")
    return "\n".join(lines)


def fastest(*tasks: Callable[[], Any], blocks: int | None = None) -> list[float]:
    """Wall time (s) of each task's fastest execution, the tasks taking turns."""
    best = [np.inf] * len(tasks)
    for _ in range(blocks or BLOCKS):
        for i, task in enumerate(tasks):
            start = time.perf_counter()
            task()
            best[i] = min(best[i], time.perf_counter() - start)
    return best


def timed_steps(parameters: Parameters) -> Callable[[], None]:
    """A task that goes on by :data:`STEPS` longest steps, from the middle of the creep."""
    for instant in run(parameters.replaced({"tolerance": 0.1, "longest_step": 0.4})):
        if instant.state.time > CREEP_TIME:
            break
    dynamics, state = composed(parameters), instant.state
    longest = parameters.stepping.longest_step * parameters.memory_time
    rung = dynamics.scheme.steady_rung(longest)
    for _ in range(10):
        state, _ = dynamics.advance(state, rung)

    def task() -> None:
        nonlocal state
        for _ in range(STEPS):
            state, _ = dynamics.advance(state, rung)

    return task


def step_over_solve(parameters: Parameters) -> dict[str, float]:
    """A whole step against the one solve of the block that it needs at least."""
    body = Block(Grid.of(parameters.geometry, parameters.mesh), parameters.material)
    longest = parameters.stepping.longest_step * parameters.memory_time
    operator = body.operator(1.0 / rung_value(BDF().steady_rung(longest)) ** 2)
    load, at_rest = body.top_load(1e6), np.zeros(body.grid.n_x)
    edge = np.zeros(body.grid.n_y + 1)
    steps, solve = fastest(timed_steps(parameters), lambda: operator.solve(load, at_rest, edge))
    return {
        "step_milliseconds": 1e3 * steps / STEPS,
        "own_solve_milliseconds": 1e3 * solve,
        "step_over_own_solve": steps / STEPS / solve,
    }


def whole_run(parameters: Parameters) -> dict[str, float]:
    """The whole run through the event to :data:`END_TIME`, and its memory."""
    record = simulate(parameters.replaced({"end_time": END_TIME, "time_after_event": 1e3}))
    sizes = record["step_size"].values[1:]
    return {
        "run_seconds": record.attrs["wall_seconds"],
        "peak_mb": record.attrs["peak_megabytes"],
        "run_steps": record.attrs["steps"],
        "run_rejected_steps": record.attrs["rejected_steps"],
        "run_step_size_changes": int(np.count_nonzero(np.abs(np.diff(sizes)) > 1e-9 * sizes[1:])),
        "run_onset_time": extract(record)["onset_time"],
    }


def speedup_over_sparse(parameters: Parameters, whole: dict[str, float]) -> dict[str, float]:
    """The same steps with the assembled sparse matrix, LU reused while the step size stays.

    One factorisation and two solves are timed and multiplied by the run's counts: two solves in
    each step, accepted or not, and a factorisation whenever the step size changed. That leaves
    out the interface's Newton iterations, so it is a lower bound for the ordinary way.
    """
    grid = Grid.of(parameters.geometry, parameters.mesh)
    stiffness, mass = assemble(grid, parameters.material)
    level, below = 2 * np.arange(grid.n_y + 1) * (grid.n_x + 1), np.arange(2 * (grid.n_x + 1))
    free = np.setdiff1d(np.arange(stiffness.shape[0]), np.append(level, below))
    matrix = (stiffness + 1e6 * mass)[free][:, free].tocsc()
    start = time.perf_counter()
    factors = splu(matrix, permc_spec="MMD_AT_PLUS_A", options={"SymmetricMode": True})
    factorisation = time.perf_counter() - start
    right = np.ones(free.size)
    (solve,) = fastest(lambda: factors.solve(right), blocks=3)
    steps = whole["run_steps"] + whole["run_rejected_steps"]
    total = 2 * steps * solve + whole["run_step_size_changes"] * factorisation
    return {
        "speedup_over_sparse": total / whole["run_seconds"],
        "sparse_run_seconds": total,
        "sparse_factorisation_seconds": factorisation,
        "sparse_solve_seconds": solve,
    }


def scaling(parameters: Parameters) -> dict[str, Any]:
    """Time per step against the number of elements along x and y, with fitted exponents."""
    result: dict[str, Any] = {}
    for axis, numbers, other in (
        ("n_x", MESHES_ALONG_X, {"n_y": ROWS}), ("n_y", MESHES_ALONG_Y, {"n_x": COLUMNS}),
    ):  # fmt: skip
        meshes = [parameters.replaced({axis: n, **other}) for n in numbers]
        times = np.array(fastest(*map(timed_steps, meshes))) / STEPS
        result[f"exponent_{axis}"] = float(np.polyfit(np.log(numbers), np.log(times), 1)[0])
        result[f"step_milliseconds_by_{axis}"] = dict(
            zip(map(str, numbers), (1e3 * times).tolist(), strict=True)
        )
    return result


def pair_steps(parameters: Parameters) -> dict[str, float]:
    """A step of two identical blocks over a step of one, on the same mesh in each."""
    one = parameters.replaced(PAIR)
    pairs = [
        one.replaced({"second_body": "deformable", "second_bottom": bottom}) for bottom in BOTTOMS
    ]
    base, *times = fastest(*map(timed_steps, (one, *pairs)))
    own, of_pair = (body_of(parts).operator(1e6).megabytes for parts in (one, pairs[0]))
    return {
        **{f"pair_step_over_one_{b}": t / base for b, t in zip(BOTTOMS, times, strict=True)},
        "pair_operator_over_one_mb": of_pair / own,
    }


def perturbed(parameters: Parameters) -> dict[str, float]:
    """Time of a step under each kind of perturbation over that of a quiet one."""
    values = {"strength": STRENGTH, "seed": 1}
    runs = [parameters, *(parameters.replaced({"kind": k, **values}) for k in KINDS[1:])]
    quiet, *times = fastest(*map(timed_steps, runs))
    return {kind: t / quiet for kind, t in zip(KINDS[1:], times, strict=True)}


def precisions(parameters: Parameters) -> list[dict[str, float]]:
    """Error of the onset time and wall time, by tolerance and longest step."""

    def row(tolerance: float, longest_step: float) -> dict[str, float]:
        values = {"tolerance": tolerance, "longest_step": longest_step}
        record = simulate(parameters.replaced({**values, "time_after_event": 0.0}))
        said = {"steps": record.attrs["steps"], "seconds": record.attrs["wall_seconds"]}
        return values | said | {"onset_error": extract(record)["onset_time"]}

    rows = [row(*setting) for setting in (REFERENCE, *PRECISIONS)]
    exact = rows.pop(0)["onset_error"]
    return [row | {"onset_error": abs(row["onset_error"] / exact - 1.0)} for row in rows]
