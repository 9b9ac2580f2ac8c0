"""The benchmark measures what it says; its times themselves are no test."""

import dataclasses

import numpy as np
import pytest
from scipy.linalg import cho_solve_banded, cholesky_banded

from nucleation.fem.block import Block, BlockOperator
from nucleation.fem.grid import Grid
from nucleation.figures.checks import work_precision
from nucleation.model.material import Material
from nucleation.model.parameters import Geometry, Mesh, Parameters, Stepping
from nucleation.model.perturbation import KINDS
from nucleation.pipeline.benchmark import __main__, runs, steps, timing

pytestmark = pytest.mark.slow


def test_banded_matrix_is_that_of_the_solver():
    """Its compliance at the interface is the inverse of the solver's condensed stiffness."""
    body, s = Block(Grid(0.7, 0.2, 9, 5, grading=3.0), Material()), 1e10
    factor = cholesky_banded(steps.banded_matrix(body, s), lower=True)
    pivot = BlockOperator(body, s).pivot
    for mode in range(9):
        right = np.zeros(factor.shape[1])
        first = mode * 2 * 6
        right[first] = 1.0
        compliance = cho_solve_banded((factor, True), right)[first : first + 2]
        xx, xy, yy = pivot[:, mode]
        np.testing.assert_allclose(compliance, np.linalg.inv([[xx, xy], [xy, yy]])[0], rtol=1e-10)


def test_measurements_are_whole(monkeypatch, tmp_path):
    monkeypatch.setattr(timing, "STEPS", 3)
    monkeypatch.setattr(steps, "ROWS", 4)
    monkeypatch.setattr(steps, "MESHES_ALONG_X", (40, 60))
    monkeypatch.setattr(steps, "MESHES_ALONG_Y", (4, 6))
    monkeypatch.setattr(steps, "PAIR_MESH", (60, 4))
    monkeypatch.setattr(timing, "CREEP_TIME", 0.05)
    parameters = Parameters(
        geometry=Geometry(0.005, 0.9), mesh=Mesh(60, 4), stepping=Stepping(tolerance=0.05)
    )
    whole = runs.whole_run(parameters)
    assert 0 < whole["run_step_size_changes"] < whole["run_steps"]
    assert 5.0 < whole["run_onset_time"] < 16.0
    result = {
        **whole, **steps.step_over_solve(parameters),
        **runs.speedup_over_sparse(parameters, whole), **steps.scaling(parameters),
        **steps.pair_steps(parameters),
    }  # fmt: skip
    wanted = {
        "step_over_solve", "run_seconds", "speedup_over_sparse", "exponent_n_x", "exponent_n_y",
        "peak_mb", "pair_step_over_one_free", "pair_operator_over_one_mb",
    }  # fmt: skip
    assert wanted <= set(result)
    assert all(np.isfinite(value) for value in result.values() if not isinstance(value, dict))
    perturbed = steps.perturbed(parameters)
    assert set(perturbed["perturbed_over_quiet"]) == set(KINDS[1:])
    assert all(0.1 < ratio < 10.0 for ratio in perturbed["perturbed_over_quiet"].values())
    # a load that fluctuates moves the right edge as no prediction foresees
    assert perturbed["solves_per_step"]["normal_load"] == 2.0
    result |= perturbed
    stepping = dataclasses.replace(parameters.stepping, end_time=16.0)
    rows = runs.precisions(
        dataclasses.replace(parameters, stepping=stepping), [(0.1, 0.4), (0.05, 0.2)], (0.05, 0.1)
    )
    assert all(0.0 < row["onset_error"] < 0.1 for row in rows)
    assert len(__main__.report(result | {"work_precision": rows}).splitlines()) > 12
    assert len(work_precision.draw(rows).axes[0].lines) == 2
