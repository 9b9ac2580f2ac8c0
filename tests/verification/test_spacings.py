"""Spacings of the convergence study, and which of its errors have a meaning."""

import numpy as np
import pytest

from replication.verification import orders


@pytest.fixture
def dataset(monkeypatch):
    """The study with made-up errors."""
    ones = np.ones((len(orders.ROWS), len(orders.ERRORS)))
    monkeypatch.setattr(orders, "_mesh_errors", lambda problem: ones)
    monkeypatch.setattr(orders, "step_errors", lambda problem, name: ones)
    return orders.convergence_dataset()


def test_element_sizes_are_those_of_the_meshes(dataset):
    for rows, size in zip(orders.ROWS, dataset["element_size"].values, strict=True):
        assert orders.manufactured("aging", "mesh", rows).grid.dx == pytest.approx(size)


@pytest.mark.parametrize("name", ["step", "quasi_static_step"])
def test_step_sizes_are_those_of_the_solver(dataset, name):
    problem = orders.manufactured("aging", name, orders.STEP_ROWS)
    for rung, size in zip(orders.STEP_RUNGS[name], dataset[f"{name}_size"].values, strict=True):
        state, _ = problem.run(rung)
        assert state.last_step == pytest.approx(size)


def test_elastodynamics_has_the_displacement_alone_and_no_quasi_static_limit(dataset):
    known = np.isfinite(dataset.to_array("error")).all("level")
    for problem in orders.PROBLEMS:
        for refinement in orders.REFINEMENTS:
            own = known.sel(problem=problem, refinement=refinement)
            alone = problem == "elastodynamics"
            assert bool(own.sel(error="displacement_error")) != (
                alone and refinement == "quasi_static_step"
            )
            assert bool(own.sel(error="slip_rate_error")) != alone
            assert bool(own.sel(error="log_state_error")) != alone
