"""Drops beside the law: what stands in the table, and that it is the law's."""

import dataclasses

import numpy as np
import pytest
import xarray as xr
from drop.test_delay import LOAD, PARAMETERS, START, history

from nucleation.drop.delay import growth
from nucleation.model.settings import Perturbation
from nucleation.run.derived import fault
from replication.figures import figure_drop
from replication.tables import drops as module
from replication.tables.drops import COLUMNS, drop_files

FAULT = fault(PARAMETERS)
STIFF = PARAMETERS.replaced(shear_modulus=9.3e9)


def drops(**changes):
    same = {
        "study": "drop",
        "role": "drop",
        "evolution": "aging",
        "n_x": 800,
        "n_y": 8,
        "block_length": 2.7,
        "longest_step": 0.1,
        "onset_time": 9.0,
        "critical_length": 0.45,
    }
    columns = {name: [value] * 4 for name, value in same.items()} | {
        "id": list("abcd"),
        "height": [0.02, 0.02, 0.02, 0.3],
        "fault": [FAULT] * 3 + ["of another"],
        "kind": ["normal_load", "none", "state", "state"],
        "strength": [1e-5, 0.0, 1e-6, 1e-6],
        "seed": [3, 0, 1, 1],
        "correlation_length": [0.02, 0.02, 0.05, 0.05],
        "length": [0.32, 0.33, 0.34, 0.5],
    }
    return xr.Dataset({name: ("run", values) for name, values in (columns | changes).items()})


def described(parameters):
    return {"parameters": parameters.to_dict(), "critical_length": 0.45}


def softness(patches):
    return float(patches.one.softness[0])


@pytest.fixture(scope="module", autouse=True)
def histories():
    """Made-up ones: of the usual fault, and of one that is stiffer."""
    patches, length = STIFF.patches, 1.5 * history().length
    other = dataclasses.replace(history(), patches=patches, length=length)
    with pytest.MonkeyPatch.context() as patched:
        made = {softness(own.patches): own for own in (history(), other)}
        patched.setattr(module, "mode_history", lambda patches, *_: made[softness(patches)])
        yield


@pytest.fixture(scope="module")
def table(histories):
    return drop_files([drops()], [described(PARAMETERS)])[".nc"][list(COLUMNS)]


def test_rows_are_those_of_faults_whose_mode_is_known(table):
    assert tuple(table.data_vars) == tuple(COLUMNS)
    assert list(table["id"].values) == ["a", "b", "c"]
    np.testing.assert_allclose(table["front_length"], START, rtol=2e-3)


def test_each_material_has_its_own_law():
    """With the heights, laws and ages of both alike, the modes of one were taken for the other."""
    runs = [described(PARAMETERS), described(STIFF)]
    faults = [FAULT, FAULT, fault(STIFF), fault(STIFF)]
    for order in (runs, runs[::-1]):
        found = drop_files([drops(fault=faults, height=[0.02] * 4)], order)[".nc"]
        expected = START * np.array([1.0, 1.0, 1.5, 1.5])
        np.testing.assert_allclose(found["front_length"], expected, rtol=2e-3)


def test_predictions_are_those_of_the_law(table):
    row = table.isel(run=0)
    expected = growth(history(), LOAD).drop(1e-5)
    assert float(row["law_length"]) == expected.length
    assert float(row["law_low"]) == expected.low
    assert float(row["law_high"]) == expected.high
    declared = Perturbation(kind="state", strength=1e-6, correlation_length=0.05)
    other = growth(history(), declared).drop(1e-6)
    assert float(table["law_length"].values[2]) == other.length


def test_floor_is_the_strength_whose_median_drops_where_a_quiet_run_does(table):
    row = table.isel(run=1)
    assert np.isnan(row["law_length"])
    strength = float(row["floor_normal_load"])
    assert growth(history(), LOAD).drop(strength).length == pytest.approx(0.33, rel=1e-3)
    assert np.isnan(table["floor_state"].values[[0, 2]]).all()


def test_curves_are_the_law_at_their_strengths():
    files = module.drop_files([drops()], [described(PARAMETERS)])
    found = files[".nc"]
    assert files[".csv"].splitlines()[0] == ",".join(COLUMNS)
    case = int(np.flatnonzero(found["curve_kind"].values == "normal_load")[0])
    assert str(found["curve_fault"].values[case]) == FAULT
    at = int(np.argmin(np.abs(found["curve_strength"].values - 1e-5)))
    strength = float(found["curve_strength"][at])
    law = growth(history(), LOAD).drop(strength)
    drawn = [float(found[name][case, at]) for name in ("curve_low", "curve_length", "curve_high")]
    assert drawn == pytest.approx([law.low, law.length, law.high], rel=1e-12)
    load = figure_drop.draw(found).axes[0]
    assert any(np.allclose(line.get_ydata(), 0.32 / 0.45) for line in load.lines)  # the run's drop
    line = next(line for line in load.lines if "median" in line.get_label())
    shown = found["curve_strength"].values <= 1.01e-5  # up to the strongest run
    np.testing.assert_array_equal(line.get_xdata(), found["curve_strength"].values[shown])
