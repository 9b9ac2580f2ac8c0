"""The target of refinement on coarse grids; and that Snakemake ends."""

import os
import signal

import pandas as pd
import pytest

from nucleation.datasets import netcdf
from nucleation.fault.files import read_yaml
from replication.tables.ratios import REFINEMENT

TARGET = "convergence"


@pytest.fixture(scope="module")
def studies(tmp_path_factory, workflow_type):
    quick = read_yaml(workflow_type.config)
    study = quick["studies"]["convergence_x"] | {"runs": [{"height": 0.1, "n_x": [40, 60]}]}
    made = workflow_type(tmp_path_factory.mktemp("studies"))
    made = made.configured({**quick, "studies": {"convergence_x": study}})
    made.printed(TARGET)
    return made


def test_target_leaves_its_table_and_is_complete(studies):
    results = studies.directory / "results" / "quick"
    table = netcdf.read(results / "convergence.nc")
    assert {*REFINEMENT} <= {*table.variables}
    assert list(pd.read_csv(results / "convergence.csv")["id"]) == list(table["id"].values)
    assert studies.planned(TARGET) == {}


def test_snakemake_ends_once_all_is_done(workflow):
    """No timer of Snakemake's keeps it, however seldom it looks for work."""
    process = workflow.start("table_s1", "--cores", "1", "--max-jobs-per-timespan", "100/10m")
    try:
        printed, _ = process.communicate(timeout=200)
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
    assert process.returncode == 0, printed
