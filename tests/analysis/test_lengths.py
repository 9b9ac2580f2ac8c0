"""Tables of lengths: realisations of one fault."""

import numpy as np
import xarray as xr

from nucleation.analysis.lengths import over_realisations, realisations, second_body
from nucleation.model.parameters import Parameters


def rows(**changes):
    columns = {
        "id": ["a-seed1", "b", "a-seed2", "c-seed1"],
        "study": ["one", "one", "one", "two"],
        "height": [0.1, 0.2, 0.1, 0.1],
        "ensemble": ["e1", "e2", "e1", "e1"],
        "seed": [1, 0, 2, 1],
        "length": [0.50, 0.7, 0.54, 0.6],
        "length_low": [0.48, 0.6, 0.46, 0.5],
        "length_high": [0.55, 0.8, 0.56, 0.7],
        "steps": [3000, 3, 3001, 3],
    }
    return xr.Dataset({name: ("run", values) for name, values in (columns | changes).items()})


def test_realisations_differ_in_the_seed_alone():
    assert realisations(rows()) == [[0, 2], [1], [3]]
    assert realisations(rows(ensemble=["e1", "e2", "e3", "e1"])) == [[0], [1], [2], [3]]


def test_mean_of_realisations_and_the_ends_of_their_ranges():
    found = over_realisations(rows())
    assert list(found["id"].values) == ["a-seed1", "b", "c-seed1"]
    assert list(found["realisations"].values) == [2, 1, 1]
    np.testing.assert_allclose(found["length"], [0.52, 0.7, 0.6])
    np.testing.assert_allclose(found["length_low"], [0.46, 0.6, 0.5])
    np.testing.assert_allclose(found["length_high"], [0.56, 0.8, 0.7])
    quiet = over_realisations(rows(length=[0.5, 0.7, np.nan, 0.6]))  # none is passed over
    np.testing.assert_allclose(quiet["length"], [np.nan, 0.7, 0.6])


def test_rows_say_what_lies_below(table):
    assert table["far_side"].item() == "none" and np.isinf(table["second_shear_modulus"].item())
    assert np.isnan(table["second_height"].item())
    pair = Parameters().replaced(
        {"second_body": "deformable", "second_far_side": "clamped", "second_shear_modulus": 9e9,
         "height": 0.02}
    )  # fmt: skip
    assert second_body(pair) == {
        "far_side": "clamped",
        "second_height": 0.02,
        "second_shear_modulus": 9e9,
        "second_poisson_ratio": pair.material.poisson_ratio,
    }
