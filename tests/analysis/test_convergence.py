"""Sequences of refinement, and orders on values of known order."""

import itertools

import numpy as np
import pytest
import xarray as xr

from nucleation.analysis.convergence import COLUMNS, observed_order, refinement_table, sequences


def row(**values):
    usual = {
        "id": "run", "height": 0.02, "law": "aging", "phi0": 1.0, "kind": "normal_load",
        "strength": 1e-5, "seed": 1, "n_x": 400, "n_y": 20,
        "grading": 20.0, "longest_step": 0.02, "tolerance": 1e-2, "length": 0.3,
        "theory_length": 0.5, "onset_time": 12.0, "onset_time_high": 12.1, "steps": 100,
        "wall_seconds": 1.0,
    }  # fmt: skip
    return {**usual, **values}


def table(rows):
    return xr.Dataset({name: ("run", [r[name] for r in rows]) for name in rows[0]})


@pytest.mark.parametrize("order", [1, 2, 3])
@pytest.mark.parametrize("ratio", [2.0, 4.0])
def test_order_of_a_power(order, ratio):
    sizes = 0.3 / ratio ** np.arange(3)
    assert observed_order(7.0 - 5.0 * sizes**order, sizes) == pytest.approx(order)


def test_no_order_without_one_ratio_or_one_direction():
    assert np.isnan(observed_order([1.0, 2.0, 1.5], [4.0, 2.0, 1.0]))
    assert np.isnan(observed_order([1.0, 2.0, 2.5], [4.0, 2.0, 1.5]))


def test_sequences_differ_in_one_parameter_and_go_from_coarse_to_fine():
    rows = [row(n_x=n, height=h) for n, h in itertools.product((1600, 400, 800), (0.02, 0.1))]
    rows += [row(longest_step=step) for step in (0.01, 0.04)]
    rows += [row(n_x=3200, tolerance=1e-3), row(n_x=3200, grading=5.0)]
    rows += [row(n_x=3200, kind="none"), row(n_x=3200, strength=1e-3), row(n_x=3200, seed=2)]
    found = sequences(rows, "n_x")
    assert [[r["n_x"] for r in sequence] for sequence in found] == [[400, 800, 1600]] * 2
    assert [{r["height"] for r in sequence} for sequence in found] == [{0.02}, {0.1}]
    (steps,) = sequences(rows, "longest_step")
    assert [r["longest_step"] for r in steps] == [0.04, 0.02, 0.01]
    assert sequences(rows, "n_y") == sequences(rows, "tolerance") == []


def test_table_compares_with_the_next_coarser_run():
    steps = 0.01 * 2.0 ** np.arange(4)
    rows = [
        row(id=f"step{h}", longest_step=h, length=0.3 + h, onset_time_high=12.0 + 1e3 * h**3)
        for h in steps
    ]
    found = refinement_table(table(rows))
    assert tuple(found.data_vars) == COLUMNS
    assert (found["refinement"] == "longest_step").all()
    np.testing.assert_allclose(found["longest_step"], steps[::-1])
    expected = (0.3 + steps[-2::-1]) / (0.3 + steps[:0:-1]) - 1.0
    np.testing.assert_allclose(found["length_change"], [np.nan, *expected])
    np.testing.assert_allclose(found["observed_order"], [np.nan, np.nan, 3.0, 3.0])
    np.testing.assert_allclose(found["drop_time_change"][1:], 1e3 * np.diff(steps[::-1] ** 3))
    np.testing.assert_allclose(found["length_over_theory"], found["length"] / 0.5)


def test_a_run_stands_in_each_of_its_sequences():
    rows = [row(), *(row(n_x=n) for n in (800, 1600)), *(row(n_y=n) for n in (10, 40))]
    found = refinement_table(table(rows))
    usual = (found["n_x"] == 400) & (found["n_y"] == 20)
    assert list(found["refinement"].values[usual.values]) == ["n_x", "n_y"]
    assert found.sizes["run"] == 6
