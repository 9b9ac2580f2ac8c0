"""The targets of refinement and sensitivity on coarse grids."""

import shutil

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


def test_figure_of_any_study_and_its_simulations(workflow):
    """Two runs from a configuration of one's own; a lost simulation is missed by the target."""
    runs = [{"height": [0.1, 0.2], "zeta_over_a": 4.0}]
    defaults = {"n_x": 60, "n_y": 4, "longest_step": 0.3, "tolerance": 0.1, "time_after_event": 0.0}
    study = {"length_over_critical": 3.0, "defaults": defaults, "runs": runs}
    own = workflow.configured({"studies": {"mine": study}})
    done = own("figure_studies")
    assert done.returncode == 0, done.stdout
    results = own.directory / "results"
    assert (results / "figures" / "study_mine.pdf").read_bytes().startswith(b"%PDF")
    assert (results / "figures" / "study_mine.png").read_bytes().startswith(b"\x89PNG")
    table = pd.read_csv(results / "lengths" / "mine.csv")
    assert list(table["id"]) == [f"mine-aging-H0.{i}-phi1-zeta_over_a4" for i in (1, 2)]
    assert (table["length"] / table["theory_length"]).between(0.4, 1.3).all()
    assert own.planned("figure_study_mine") == {}
    lost = own.dataset("simulations", "mine-aging-H0.1-phi1-zeta_over_a4", "results")
    shutil.rmtree(lost.parent)
    assert own.planned("figure_study_mine")["simulate"] == 1
    assert own.planned("figure_studies")["simulate"] == 1
