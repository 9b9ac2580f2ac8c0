"""The table of the patch's theory beside simulations."""

import numpy as np
import pytest
import xarray as xr
from configurations import papers

from replication.tables import theory

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
    return theory.theory_table([runs[i].to_dict() for i in IDS], [simulated])


@pytest.mark.slow
def test_a_row_for_each_fault(table):
    """Realisations are averaged, and runs without a stability length left out."""
    assert list(table["id"].values) == [IDS[0], IDS[2]]
    assert table["stability_length"].values == pytest.approx([0.4418, 0.3537])
    assert table["front_length"].values == pytest.approx(table["stability_length"], rel=0.02)
    assert set(theory.COLUMNS) <= set(table)
