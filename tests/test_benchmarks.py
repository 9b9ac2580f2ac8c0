"""The benchmarks run and measure what they say; times themselves are no test."""

import numpy as np
import pytest

from benchmarks import solver, workflow
from nucleation.model.parameters import Geometry, Mesh, Parameters, Stepping
from nucleation.model.perturbation import KINDS


@pytest.mark.slow
def test_the_solver_is_measured(monkeypatch):
    small = {
        "STEPS": 3, "CREEP_TIME": 0.05, "MESHES_ALONG_X": (40, 60), "ROWS": 4,
        "MESHES_ALONG_Y": (4, 6), "COLUMNS": 40, "PAIR": solver.PAIR | {"n_x": 60, "n_y": 4},
        "PRECISIONS": ((0.1, 0.4), (0.05, 0.2)), "REFERENCE": (0.05, 0.1),
    }  # fmt: skip
    for name, value in small.items():
        monkeypatch.setattr(solver, name, value)
    stepping = Stepping(tolerance=0.05, end_time=solver.END_TIME)
    geometry, mesh = Geometry(0.005, 0.9), Mesh(60, 4)
    result = solver.measured(Parameters(geometry=geometry, mesh=mesh, stepping=stepping))
    assert 0 < result["run_step_size_changes"] < result["run_steps"]
    assert 5.0 < result["run_onset_time"] < 16.0
    assert set(result["perturbed_over_quiet"]) == set(KINDS[1:])
    assert 1.5 < result["pair_operator_over_one_mb"] < 3.0
    assert all(0.0 < row["onset_error"] < 0.1 for row in result["work_precision"])
    numbers = [value for value in result.values() if isinstance(value, (int, float))]
    assert len(numbers) >= 17 and np.isfinite(numbers).all()
    assert len(solver.table(result).splitlines()) == len(result) + 2


def test_costs_are_those_of_all_processes(tmp_path):
    work = "x = bytearray(200_000_000); sum(range(3_000_000))"
    child = f"import subprocess, sys; subprocess.run([sys.executable, '-c', {work!r}])"
    cost = workflow.cost(["-c", child], tmp_path)
    assert cost.megabytes > 190.0 and 0.02 < cost.processor_seconds < 10.0


@pytest.mark.slow
@pytest.mark.system
def test_the_workflow_is_measured(monkeypatch, tmp_path):
    """Every run is made, all is current, and an archive of it is taken."""
    monkeypatch.setattr(workflow, "END_TIME", 0.5)
    assert workflow.planned(50, 50, tmp_path)["seconds"] > 0.0
    found = workflow.made(tmp_path)
    assert found["runs"] == 50 and 0.0 < found["overhead_seconds"] < found["seconds"] / 50
    for name in ("check", "bundle"):
        workflow.cost(workflow.COMMANDS[name], tmp_path)  # fails if anything is not current
    (tmp_path / "results").rename(tmp_path / "moved")
    workflow.cost(workflow.COMMANDS["restore"], tmp_path)
    assert len(list((tmp_path / "results/store").glob("*/result.nc"))) > 50
