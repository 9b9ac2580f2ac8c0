"""Sequences of refinement, and each run beside the finest one."""

import itertools

import numpy as np
import pandas as pd
import xarray as xr

from replication.tables.ratios import REFINEMENT, refinement_table, sequences


def row(**values):
    usual = {
        "id": "run", "height": 0.02, "evolution": "aging", "initial_state": 1.0,
        "kind": "normal_load", "strength": 1e-5, "correlation_length": 0.0, "seed": 1,
        "n_x": 400, "n_y": 20,
        "grading": 20.0, "longest_step": 0.02, "tolerance": 1e-2, "length": 0.3, "fault": "f0.02",
        "critical_length": 0.5, "block_length": 2.0, "onset_time": 12.0, "steps": 100,
        "wall_seconds": 1.0,
    }  # fmt: skip
    return {**usual, **values}


def table(rows):
    return xr.Dataset({name: ("run", [r[name] for r in rows]) for name in rows[0]})


def test_sequences_differ_in_one_parameter_and_go_from_coarse_to_fine():
    rows = [
        row(n_x=n, height=h, fault=f"f{h}")
        for n, h in itertools.product((1600, 400, 800), (0.02, 0.1))
    ]
    rows += [row(longest_step=step) for step in (0.01, 0.04)] + [row(n_y=40, fault="other")]
    rows += [row(n_x=3200, tolerance=1e-3), row(n_x=3200, grading=5.0)]
    rows += [row(n_x=3200, kind="none"), row(n_x=3200, strength=1e-3), row(n_x=3200, seed=2)]
    rows += [row(n_x=3200, correlation_length=0.01), row(n_x=3200, block_length=4.0)]
    runs = pd.DataFrame(rows)
    found = sequences(runs, "n_x")
    assert [list(own["n_x"]) for own in found] == [[400, 800, 1600]] * 2
    assert [set(own["height"]) for own in found] == [{0.02}, {0.1}]
    (steps,) = sequences(runs, "longest_step")
    assert list(steps["longest_step"]) == [0.04, 0.02, 0.01]
    assert sequences(runs, "n_y") == sequences(runs, "tolerance") == []


def test_table_compares_with_the_finest_run():
    rows = [
        row(id=f"n{n}", n_x=n, length=0.3 + 10.0 / n, onset_time=12.0 - 100.0 / n)
        for n in (1600, 400, 800)
    ]
    found = refinement_table([table(rows)])
    assert tuple(found.data_vars) == tuple(REFINEMENT)
    assert list(found["id"].values) == ["n400", "n800", "n1600"]
    sizes = np.array([400.0, 800.0, 1600.0])
    length, onset = 0.3 + 10.0 / sizes, 12.0 - 100.0 / sizes
    np.testing.assert_allclose(found["length_difference"], length / length[-1] - 1.0)
    np.testing.assert_allclose(found["onset_difference"], onset / onset[-1] - 1.0)
    np.testing.assert_allclose(found["elements_difference"], (length - length[-1]) * sizes / 2.0)
    assert (found["refinement"] == "n_x").all()
    np.testing.assert_allclose(found["length_over_theory"], found["length"] / 0.5)
