"""The targets of refinement and sensitivity on coarse grids; and that they end."""

import os
import signal

import pandas as pd
import pytest

from nucleation.datasets import netcdf
from replication.configuration.load import load
from replication.tables import convergence, sensitivity

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


def test_snakemake_ends_once_all_is_done(workflow):
    """No timer of Snakemake's keeps it, however seldom it looks for work."""
    process = workflow.start("table_s1", "--cores", "1", "--max-jobs-per-timespan", "100/10m")
    try:
        printed, _ = process.communicate(timeout=200)
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
    assert process.returncode == 0, printed
