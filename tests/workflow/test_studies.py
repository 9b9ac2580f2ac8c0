"""The targets of refinement and sensitivity on coarse grids."""

import pandas as pd
import pytest

from nucleation.analysis import convergence, sensitivity
from nucleation.configuration.load import load
from nucleation.datasets import netcdf

TARGETS = ("figure_convergence", "figure_sensitivity")


@pytest.fixture(scope="module")
def studies(tmp_path_factory, workflow_type):
    made = workflow_type(tmp_path_factory.mktemp("studies"))
    done = made(*TARGETS)
    assert done.returncode == 0, done.stdout
    return made


def test_targets_leave_figures_and_tables_and_are_complete(studies):
    results = studies.directory / "results" / "quick"
    for name in TARGETS:
        assert (results / "figures" / f"{name}.pdf").read_bytes().startswith(b"%PDF")
        assert (results / "figures" / f"{name}.png").read_bytes().startswith(b"\x89PNG")
    for name, columns in (
        ("convergence", convergence.COLUMNS),
        ("sensitivity", sensitivity.COLUMNS),
    ):
        table = netcdf.read(results / f"{name}.nc", requires=columns)
        assert list(pd.read_csv(results / f"{name}.csv")["id"]) == list(table["id"].values)
    runs = [run.id for run in load(studies.config).runs_of("sensitivity")]
    assert set(pd.read_csv(results / "sensitivity.csv")["id"]) == set(runs)
    assert studies.planned(*TARGETS) == {}
