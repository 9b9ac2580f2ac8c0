"""Whole runs: their time and memory, the ordinary way's, and error against time."""

from __future__ import annotations

import dataclasses
import time
from collections.abc import Iterable

import numpy as np
from scipy.sparse.linalg import splu

from ...analysis.extraction import extract
from ...fem.assembled import assemble
from ...fem.grid import Grid
from ...model.parameters import Parameters
from ...simulation.run import simulate
from .timing import fastest

END_TIME = 16.0  # s, of the whole run
# (tolerance, longest step over D/V) of the work-precision diagram, and of its reference
PRECISIONS = (
    (1e-1, 0.4), (1e-2, 0.4), (1e-2, 0.2), (1e-2, 0.1), (1e-2, 0.05), (1e-3, 0.1), (1e-3, 0.05),
)  # fmt: skip
REFERENCE = (1e-4, 0.02)


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
