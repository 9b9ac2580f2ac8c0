"""How fast the solver is: ``make bench``, one core, everything measured in one run.

Times of what is compared are taken in turn, block after block, and the fastest block of each
counts: other work on the machine makes blocks slower, never faster.
"""

from __future__ import annotations

import argparse
import dataclasses
import json
import os
import time
from collections.abc import Callable, Iterable
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_solve_banded, cholesky_banded
from scipy.sparse.linalg import splu

from ..analysis.extraction import extract
from ..configuration.load import load
from ..datasets.files import replacing
from ..fem.assembled import assemble
from ..fem.block import Block
from ..fem.bodies import body_of
from ..fem.grid import Grid
from ..fem.operator import BlockOperator
from ..figures import style
from ..figures.checks import work_precision
from ..model.parameters import Parameters
from ..model.perturbation import KINDS, Perturbation
from ..model.second_body import BOTTOMS
from ..simulation.composition import composed
from ..simulation.run import run, simulate
from ..simulation.state import State
from ..simulation.step import Dynamics
from ..stepping.ladder import rung_value
from ..stepping.scheme import BDF

Array = NDArray[np.float64]

END_TIME = 16.0  # s, of the whole run
CREEP_TIME = 1.0  # s, at which steps are timed
BLOCKS, STEPS = 8, 40  # of timed steps
MESHES_ALONG_X = (400, 800, 1600, 3200)  # n_x, with ROWS
ROWS = 20
PAIR_MESH = (400, 16)  # n_x, n_y in each block of a pair
PAIR_HEIGHT, PAIR_LENGTH = 0.02, 0.7  # m
MESHES_ALONG_Y = (20, 40, 80, 150)  # n_y, with 400 along x
# (tolerance, longest step over D/V) of the work-precision diagram, and of its reference
PRECISIONS = (
    (1e-1, 0.4), (1e-2, 0.4), (1e-2, 0.2), (1e-2, 0.1), (1e-2, 0.05), (1e-3, 0.1), (1e-3, 0.05),
)  # fmt: skip
REFERENCE = (1e-4, 0.02)
STRENGTH = 1e-3  # of the perturbed steps


def fastest(*tasks: Callable[[], Any], blocks: int = BLOCKS) -> list[float]:
    """Wall time (s) of each task's fastest execution, the tasks taking turns."""
    best = [np.inf] * len(tasks)
    for _ in range(blocks):
        for i, task in enumerate(tasks):
            start = time.perf_counter()
            task()
            best[i] = min(best[i], time.perf_counter() - start)
    return best


def creeping(parameters: Parameters) -> tuple[Dynamics, State, int]:
    """A simulation in the middle of its creep, and the rung of its longest step."""
    stepping = dataclasses.replace(parameters.stepping, tolerance=0.1, longest_step=0.4)
    for instant in run(dataclasses.replace(parameters, stepping=stepping)):
        if instant.state.time > CREEP_TIME:
            break
    dynamics, state = composed(parameters), instant.state
    longest = parameters.stepping.longest_step * parameters.memory_time
    rung = dynamics.scheme.steady_rung(longest)
    for _ in range(10):
        state, _ = dynamics.advance(state, rung)
    return dynamics, state, rung


def timed_steps(parameters: Parameters) -> Callable[[], None]:
    """A task that goes on by :data:`STEPS` steps of equal length."""
    dynamics, state, rung = creeping(parameters)

    def task() -> None:
        nonlocal state
        for _ in range(STEPS):
            state, _ = dynamics.advance(state, rung)

    return task


def with_mesh(parameters: Parameters, n_x: int, n_y: int) -> Parameters:
    """The same simulation on another mesh."""
    mesh = dataclasses.replace(parameters.mesh, n_x=n_x, n_y=n_y)
    return dataclasses.replace(parameters, mesh=mesh)


def banded_matrix(body: Block, s: float) -> Array:
    """``K + s M`` of all modes as one band matrix in LAPACK's lower form, x and y interleaved."""
    grid, material = body.grid, body.material
    lame, shear, p_wave = material.lame_modulus, material.shear_modulus, material.p_wave_modulus
    mass, stiffness, derivative = (np.asarray(matrix) for matrix in body.stacked)
    levels = grid.n_y + 1
    band = np.zeros((4, grid.n_x, levels, 2))
    inertia = s * material.density

    def along(a: Array, b: Array, row: int) -> Array:
        """``a M + b K`` per mode on a diagonal of the y-matrices."""
        return a[:, None] * mass[row] + b[:, None] * stiffness[row]

    x = (p_wave * body.x_stiffness + inertia * body.x_mass, shear * body.x_mass)
    y = (shear * body.x_stiffness + inertia * body.x_mass, p_wave * body.x_mass)
    sine = body.sine[:, None]
    band[0, :, :, 0], band[0, :, :, 1] = along(*x, 1), along(*y, 1)
    band[2, :, :-1, 0], band[2, :, :-1, 1] = along(*x, 2)[:, :-1], along(*y, 2)[:, :-1]
    band[1, :, :, 0] = sine * (lame - shear) * derivative[1]
    # A_yx[j+1, j] is A_xy[j, j+1], and A_xy[j+1, j] stands in the row of x one level up
    upper = lame * derivative[2, :-1] - shear * derivative[0, 1:]
    lower = lame * derivative[0, 1:] - shear * derivative[2, :-1]
    band[3, :, :-1, 0] = sine * upper
    band[1, :, :-1, 1] = sine * lower
    return band.reshape(4, -1)


def step_over_solve(parameters: Parameters) -> dict[str, float]:
    """(a) A whole step at the paper's mesh against one banded solve of its size."""
    grid = Grid.of(parameters.geometry, parameters.mesh)
    body = Block(grid, parameters.material)
    longest = parameters.stepping.longest_step * parameters.memory_time
    s = 1.0 / rung_value(BDF().steady_rung(longest)) ** 2
    factor = cholesky_banded(banded_matrix(body, s), lower=True)
    right = np.random.default_rng(1).normal(size=factor.shape[1])
    operator, load = BlockOperator(body, s), body.top_load(1e6)
    at_rest, edge = np.zeros(grid.n_x), np.zeros(grid.n_y + 1)
    steps, banded, own = fastest(
        timed_steps(parameters),
        lambda: cho_solve_banded((factor, True), right, check_finite=False),
        lambda: operator.solve(load, at_rest, edge),
    )
    return {
        "step_over_solve": steps / STEPS / banded,
        "step_milliseconds": 1e3 * steps / STEPS,
        "banded_solve_milliseconds": 1e3 * banded,
        "own_solve_milliseconds": 1e3 * own,
        "step_over_own_solve": steps / STEPS / own,
    }


def whole_run(parameters: Parameters) -> dict[str, float]:
    """(b), (e) The whole run through the event to :data:`END_TIME`, and its memory."""
    stepping = dataclasses.replace(parameters.stepping, end_time=END_TIME, time_after_event=1e3)
    record = simulate(dataclasses.replace(parameters, stepping=stepping))
    measured = extract(record)
    sizes = record["step_size"].values[1:]
    return {
        "run_seconds": record.attrs["wall_seconds"],
        "peak_mb": record.attrs["peak_megabytes"],
        "run_steps": record.attrs["steps"],
        "run_rejected_steps": record.attrs["rejected_steps"],
        "run_step_size_changes": int(np.count_nonzero(np.abs(np.diff(sizes)) > 1e-9 * sizes[1:])),
        "run_onset_time": measured["onset_time"],
    }


def speedup_over_sparse(parameters: Parameters, whole: dict[str, float]) -> dict[str, float]:
    """(c) The same steps with the assembled sparse matrix, LU reused while the step size stays.

    One factorisation and two solves are timed and multiplied by the run's counts: two solves in
    each step, accepted or not, and a factorisation whenever the step size changed. That leaves
    out the interface's Newton iterations, so it is a lower bound for the ordinary way.
    """
    grid = Grid.of(parameters.geometry, parameters.mesh)
    stiffness, mass = assemble(grid, parameters.material)
    levels = np.arange(grid.n_y + 1)
    held = np.unique(np.concatenate((
        2 * levels * (grid.n_x + 1), 2 * np.arange(grid.n_x + 1), 2 * np.arange(grid.n_x + 1) + 1
    )))  # fmt: skip
    free = np.setdiff1d(np.arange(stiffness.shape[0]), held)
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
    """(d) Time per step against the number of elements, with fitted exponents."""
    along_x = [with_mesh(parameters, n, ROWS) for n in MESHES_ALONG_X]
    along_y = [with_mesh(parameters, MESHES_ALONG_X[0], n) for n in MESHES_ALONG_Y]
    result: dict[str, Any] = {}
    for axis, numbers, meshes in (
        ("x", MESHES_ALONG_X, along_x),
        ("y", MESHES_ALONG_Y, along_y),
    ):
        times = np.array(fastest(*map(timed_steps, meshes))) / STEPS
        result[f"exponent_n_{axis}"] = float(np.polyfit(np.log(numbers), np.log(times), 1)[0])
        result[f"step_milliseconds_by_n_{axis}"] = {
            str(n): 1e3 * t for n, t in zip(numbers, times.tolist(), strict=True)
        }
    return result


def pair_steps(parameters: Parameters) -> dict[str, float]:
    """(g) A step of two identical blocks over a step of one, on the same mesh in each, in turn.

    Both creep; the patch of either has some tens of nodes.
    """
    one = with_mesh(parameters, *PAIR_MESH)
    one = one.replaced({"height": PAIR_HEIGHT, "length": PAIR_LENGTH})
    pairs = [
        one.replaced({"second_body": "deformable", "second_bottom": bottom}) for bottom in BOTTOMS
    ]
    base, *times = fastest(*(timed_steps(run) for run in (one, *pairs)))
    operators = [body_of(run).operator(1e6).megabytes for run in (one, pairs[0])]
    return {
        **{f"pair_step_over_one_{b}": t / base for b, t in zip(BOTTOMS, times, strict=True)},
        "pair_operator_over_one_mb": operators[1] / operators[0],
    }


def perturbed(parameters: Parameters) -> dict[str, dict[str, float]]:
    """(h) Time of a step under each kind of perturbation over that of a quiet one, in turn.

    And how many solves of the block a step takes: the shortcut of one serves while the block's
    right edge moves as predicted (:meth:`nucleation.fem.operator.BlockOperator.responses`).
    """
    kinds = [Perturbation(kind=kind, strength=STRENGTH, seed=1) for kind in KINDS]
    runs = [dataclasses.replace(parameters, perturbation=declared) for declared in kinds]
    quiet, *times = fastest(*map(timed_steps, runs))
    return {
        "perturbed_over_quiet": {k: t / quiet for k, t in zip(KINDS[1:], times, strict=True)},
        "solves_per_step": {run.perturbation.kind: solves_per_step(run) for run in runs},
    }


def solves_per_step(parameters: Parameters) -> float:
    """Solves of one block in each of :data:`STEPS` steps of the creep, between one and two."""
    dynamics, state, rung = creeping(parameters)
    operator = dynamics.operator(dynamics.scheme.step(rung, state.past_times).s)
    assert isinstance(operator, BlockOperator)
    swept = 0
    for _ in range(STEPS):
        swept += float(state.body_memory) < operator.edge.round_off
        state, _ = dynamics.advance(state, rung)
    return 2.0 - swept / STEPS


def precisions(
    parameters: Parameters, settings: Iterable[tuple[float, float]] = PRECISIONS,
    reference: tuple[float, float] = REFERENCE,
) -> list[dict[str, float]]:  # fmt: skip
    """(f) Error of the onset time against wall time."""

    def onset(tolerance: float, longest_step: float) -> tuple[float, float, int]:
        stepping = dataclasses.replace(
            parameters.stepping, tolerance=tolerance, longest_step=longest_step,
            time_after_event=0.0,
        )  # fmt: skip
        record = simulate(dataclasses.replace(parameters, stepping=stepping))
        return extract(record)["onset_time"], record.attrs["wall_seconds"], record.attrs["steps"]

    exact, _, _ = onset(*reference)
    rows = []
    for tolerance, longest_step in settings:
        found, seconds, steps = onset(tolerance, longest_step)
        rows.append({
            "tolerance": tolerance, "longest_step": longest_step, "steps": steps,
            "seconds": seconds, "onset_error": abs(found - exact) / exact,
        })  # fmt: skip
    return rows


def benchmark(parameters: Parameters) -> dict[str, Any]:
    """All measurements of one simulation, the one of Figure S2."""
    simulate(with_mesh(parameters, 16, 4))  # compiles what is compiled
    whole = whole_run(parameters)  # first: the memory is that of the process
    return {
        **whole,
        **step_over_solve(parameters),
        **speedup_over_sparse(parameters, whole),
        **scaling(parameters),
        **pair_steps(parameters),
        **perturbed(parameters),
        "work_precision": precisions(parameters),
        "threads": os.environ.get("OMP_NUM_THREADS", "not set"),
    }


def report(result: dict[str, Any]) -> str:
    """The measurements as a table."""
    lines = []
    for name, value in result.items():
        if name == "work_precision":
            lines.append("tolerance  longest step  steps  seconds  onset error")
            lines += [
                f"{row['tolerance']:9g}  {row['longest_step']:12g}  {row['steps']:5d}  "
                f"{row['seconds']:7.1f}  {row['onset_error']:11.1e}"
                for row in value
            ]
        elif isinstance(value, dict):
            lines.append(f"{name:32}" + "  ".join(f"{k}: {v:.3g}" for k, v in value.items()))
        else:
            lines.append(f"{name:32}{value if isinstance(value, str) else format(value, '.4g')}")
    return "\n".join(lines)


def main() -> None:
    """Measure, print, and write bench.json and the work-precision diagram."""
    parser = argparse.ArgumentParser(description=main.__doc__)
    parser.add_argument("configuration", type=Path)
    arguments = parser.parse_args()
    settings = load(arguments.configuration)
    parameters = settings.find(
        study="paper", law="aging", height=settings.figures.space_time_height,
        phi0=settings.base.loading.initial_state,
    ).parameters  # fmt: skip
    result = benchmark(parameters)
    print(report(result))
    results = Path(settings.results)
    with replacing(results / "bench.json") as temporary:
        temporary.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
    style.save(work_precision.draw(result["work_precision"]), results / "figures/work_precision")


if __name__ == "__main__":
    main()
