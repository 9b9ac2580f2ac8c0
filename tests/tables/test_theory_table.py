"""The table of the patch's theory beside simulations, and its figure."""

import numpy as np
import pytest
import xarray as xr
from configurations import papers

from replication.configuration.load import load
from replication.figures import figure_patch
from replication.tables import theory as theory_table

IDS = (
    "converged-aging-H0.1-phi1-seed1",
    "converged-aging-H0.1-phi1-seed2",
    "converged-slip-H0.05-phi1-seed1",
    "converged-aging-H0.005-phi1-seed1",
)


@pytest.fixture(scope="module")
def table():
    runs = {run.id: run for run in papers().runs}
    lengths = [0.4428, 0.4408, 0.3537, np.nan]
    simulated = xr.Dataset({"id": ("run", list(IDS)), "stability_length": ("run", lengths)})
    return theory_table.theory_files([runs[i].to_dict() for i in IDS], [simulated])[".nc"]


@pytest.mark.slow
def test_a_row_for_each_fault(table):
    """Realisations are averaged, and runs without a stability length left out."""
    assert list(table["id"].values) == [IDS[0], IDS[2]]
    assert table["stability_length"].values == pytest.approx([0.4418, 0.3537])
    assert table["front_length"].values == pytest.approx(table["stability_length"], rel=0.02)
    assert set(theory_table.COLUMNS) <= set(table)


@pytest.mark.slow
def test_the_stress_under_a_stiff_body_has_no_kinks():
    """It falls ever less steeply from the pushed edge on; with 32 modes it had steps."""
    stiff = load(lazy=True).runs_of("figure_2_simulated")
    run = next(
        run
        for run in stiff
        if run.labels["height"] == 1.0 and "phi1-shear_modulus120900000000" in run.id
    )
    row = {"id": run.id, "f_beta": -0.38, "front_length": 0.5 * run.critical_length}
    drawn = theory_table._profiles([row], {run.id: run.to_dict()})
    x, stress = drawn["shown_x"][1][0], drawn["shown_stress"][1][0]
    slopes = np.diff(stress) / np.diff(x)
    shown = (x[1:] > 0.1) & (x[1:] < 0.8)
    assert slopes[shown].max() < 0.0
    assert (np.diff(np.abs(slopes[shown])) > -0.02).all()  # from the front to the edge


@pytest.mark.slow
def test_profiles_are_those_of_creep(table):
    assert table["shown_x"].values.min() > 0.0 and table["shown_x"].values.max() < 1.0
    assert (np.diff(table["shown_rate"].values[0]) > 0.0).all()  # from the front to the edge


@pytest.mark.slow
def test_figure(table):
    ratio, parity, creep = figure_patch.draw_theory(table).axes[:3]
    assert ratio.get_xlabel() and parity.get_lines()[0].get_xdata().size == 2
    assert len(creep.get_lines()) == 2 * table.sizes["case"]
