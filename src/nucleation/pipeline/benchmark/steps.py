"""The time of a step: against a banded solve, over the mesh, of pairs, under perturbations."""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_solve_banded, cholesky_banded

from ...fem.block import Block, BlockOperator
from ...fem.bodies import body_of
from ...fem.grid import Grid
from ...model.parameters import Parameters
from ...model.perturbation import KINDS, Perturbation
from ...model.second_body import BOTTOMS
from ...stepping.ladder import rung_value
from ...stepping.scheme import BDF
from . import timing
from .timing import creeping, fastest, timed_steps, with_mesh

Array = NDArray[np.float64]

MESHES_ALONG_X = (400, 800, 1600, 3200)  # n_x, with ROWS
ROWS = 20
PAIR_MESH = (400, 16)  # n_x, n_y in each block of a pair
PAIR_HEIGHT, PAIR_LENGTH = 0.02, 0.7  # m
MESHES_ALONG_Y = (20, 40, 80, 150)  # n_y, with 400 along x
STRENGTH = 1e-3  # of the perturbed steps


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
        "step_over_solve": steps / timing.STEPS / banded,
        "step_milliseconds": 1e3 * steps / timing.STEPS,
        "banded_solve_milliseconds": 1e3 * banded,
        "own_solve_milliseconds": 1e3 * own,
        "step_over_own_solve": steps / timing.STEPS / own,
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
        times = np.array(fastest(*map(timed_steps, meshes))) / timing.STEPS
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
    right edge moves as predicted (:meth:`nucleation.fem.block.BlockOperator.responses`).
    """
    kinds = [Perturbation(kind=kind, strength=STRENGTH, seed=1) for kind in KINDS]
    runs = [dataclasses.replace(parameters, perturbation=declared) for declared in kinds]
    quiet, *times = fastest(*map(timed_steps, runs))
    return {
        "perturbed_over_quiet": {k: t / quiet for k, t in zip(KINDS[1:], times, strict=True)},
        "solves_per_step": {run.perturbation.kind: solves_per_step(run) for run in runs},
    }


def solves_per_step(parameters: Parameters) -> float:
    """Solves of one block in each of some steps of the creep, between one and two."""
    dynamics, state, rung = creeping(parameters)
    operator = dynamics.operator(dynamics.scheme.step(rung, state.past_times).s)
    assert isinstance(operator, BlockOperator)
    swept = 0
    for _ in range(timing.STEPS):
        swept += float(state.body_memory) < operator.edge.round_off
        state, _ = dynamics.advance(state, rung)
    return 2.0 - swept / timing.STEPS
