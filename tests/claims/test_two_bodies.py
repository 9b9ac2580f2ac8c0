"""Verdicts on two bodies follow from the table of pairs."""

import numpy as np
import pytest
import xarray as xr

from nucleation.claims.statements.two_bodies import CLAIMS

FOUND = {claim.id: claim for claim in CLAIMS}


def table(ratio=0.8, slope=-1.0):
    contrast = np.array([0.0, 0.1, 0.3, -0.1, -0.3])
    columns = {
        "study": ["pairs_identical"] * 2 + ["figure_2_simulated"] * 5,
        "height": [0.01, 1.0, *[1.0] * 5],
        "theory_length": [0.1, 0.5, *[0.5] * 5],
        "length_ratio": [0.3, ratio, *[ratio] * 5],
        "half_space_ratio": [1.0, 1.0, *(1.0 + slope * np.abs(contrast))],
        "f_beta": [0.0, 0.0, *contrast],
        "zeta_over_a": [2.4, 2.4, *[3.0] * 5],
        "strength": [1e-5] * 7,
        "kind": ["normal_load"] * 7,
    }
    return xr.Dataset({name: ("run", values) for name, values in columns.items()})


@pytest.mark.parametrize(("ratio", "verdict"), [(0.8, "replicated"), (0.6, "not replicated")])
def test_half_spaces_are_judged_by_the_high_blocks(ratio, verdict):
    row = FOUND["pairs-half-spaces"].evaluate(table(ratio))
    assert (row["verdict"], row["ours"]) == (verdict, ratio)
    assert "normal_load of 1e-05" in row["reason"]
    assert FOUND["pairs-bimaterial"].evaluate(table(ratio))["verdict"] == verdict


@pytest.mark.parametrize(("slope", "verdict"), [(-1.0, "replicated"), (0.2, "not replicated")])
def test_contrast_has_to_shorten(slope, verdict):
    row = FOUND["pairs-decreasing"].evaluate(table(slope=slope))
    assert row["verdict"] == verdict
    assert row["ours"] == pytest.approx(0.8 * slope)
    assert FOUND["pairs-smaller"].evaluate(table(1.2, slope=0.2))["verdict"] == "not replicated"


def test_without_runs_nothing_is_judged():
    empty = table().isel(run=slice(0, 1))
    assert {claim.evaluate(empty)["verdict"] for claim in CLAIMS} == {"cannot be checked"}
