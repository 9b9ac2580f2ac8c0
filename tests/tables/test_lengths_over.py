"""Lengths over parameters: each point is its own fault, one or many draws of it."""

import numpy as np
import pytest
import xarray as xr

from nucleation.drop.delay import ClosedForm, Drop
from nucleation.drop.expected_drop import ExpectedDrop
from nucleation.model.linearised import interface_state
from nucleation.model.parameters import Parameters
from nucleation.theory.creep.lengths import stability_length_of
from nucleation.theory.critical import run_length
from nucleation.theory.status import NoLength
from replication.figures import lengths_over as module
from replication.figures.lengths_over import lengths_over

BASE = Parameters().replaced({"perturbation": "normal_load", "strength": 1e-4})
HEIGHTS = np.array([0.01, 0.02, 0.04])
HEIGHT = xr.DataArray(
    HEIGHTS, dims="height", name="height", attrs={"long_name": "block height", "units": "m"}
)
THEORY = ("critical_length", "stability_length")


def run_at(point):
    return BASE.replaced({"height": HEIGHTS[point[0]]})


def critical(parameters):
    return run_length(parameters, interface_state(parameters))


def test_one_run_at_each_point():
    seen = []
    found = lengths_over(
        [HEIGHT], lambda point: [run_at(point)], THEORY, lambda *now: seen.append(now)
    )
    runs = [run_at((i,)) for i in range(3)]
    expected = [critical(run) for run in runs]
    for end in ("low", "middle", "high"):
        one = found["length"].sel(key="critical_length", end=end)
        np.testing.assert_allclose(one, expected)
    patch = found["length"].sel(key="stability_length", end="middle")
    expected = [stability_length_of(run, critical(run)) for run in runs]
    np.testing.assert_allclose(patch, expected, rtol=1e-6)
    assert seen == [(1, 3), (2, 3), (3, 3)]
    assert found["height"].attrs == {"long_name": "block height", "units": "m"}


def test_draws_have_a_band_and_points_without_a_fault_are_missing():
    def cases(point):
        own = run_at(point)
        if point == (1,):
            return []
        return [own.replaced({"normal_stress": stress}) for stress in (0.5e6, 1e6, 2e6)]

    found = lengths_over([HEIGHT], cases, ("critical_length",))
    low, middle, high = found["length"].sel(key="critical_length").values
    assert np.isnan(middle).tolist() == [False, True, False]
    assert (low < middle)[[0, 2]].all() and (middle < high)[[0, 2]].all()
    np.testing.assert_allclose(middle[0], critical(run_at((0,))))


@pytest.mark.parametrize("doubt", ["", "it is strong"])
def test_the_drop_has_the_scatter_of_its_realisations(monkeypatch, doubt):
    drop = Drop(0.3, 0.27, 0.36, 14.0, 13.5, 14.5)
    law = ExpectedDrop(0.25, drop, ClosedForm(0.25, 0.322, 0.014, 50.0, 1e-5), doubt)
    monkeypatch.setattr(module, "expected_drop", lambda _: law)
    found = lengths_over([HEIGHT], lambda point: [run_at(point)], ("expected_length",))
    row = found["length"].sel(key="expected_length")
    np.testing.assert_allclose(row.isel(height=0), [0.27, 0.3, 0.36])
    assert found["doubtful"].values.tolist() == [float(bool(doubt))] * 3
    assert found.attrs["doubts"] == doubt


def test_a_reason_stands_where_there_is_no_length(monkeypatch):
    def law(_):
        raise NoLength("no mode grows")

    monkeypatch.setattr(module, "expected_drop", law)
    stable = BASE.replaced({"friction.aging_coefficient": 0.0})
    found = lengths_over([HEIGHT], lambda _: [stable])
    assert np.isnan(found["length"].sel(key="expected_length")).all()
    assert found["why_not"].sel(key="expected_length").values.tolist() == ["no mode grows"] * 3
    assert "friction grows" in found["why_not"].sel(key="critical_length").values[0]
