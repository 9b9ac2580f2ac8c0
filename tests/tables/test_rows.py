"""Rows of a table as plain Python, and the ratios in them."""

import math

import numpy as np
import xarray as xr

from replication.tables.ratios import ratios
from replication.tables.rows import rows_of

COLUMNS = {
    "id": ["a", "b"], "n_x": [400, 800], "length": [0.2, np.nan], "critical_length": [0.4, 0.5],
    "stability_length": [0.1, 0.3], "zeta": [0.016, 0.03],
    "a": [0.008, 0.01],
}  # fmt: skip
TABLE = xr.Dataset({name: ("run", np.array(values)) for name, values in COLUMNS.items()})


def test_rows_are_plain():
    first, second = rows_of(TABLE)
    assert (first["id"], first["n_x"], first["length"]) == ("a", 400, 0.2)
    assert {type(first[name]) for name in ("id", "n_x", "length")} == {str, int, float}
    assert math.isnan(second["length"]) and list(second) == list(TABLE.data_vars)


def test_ratios_of_a_table_and_of_a_row_are_the_same():
    whole = ratios(TABLE)
    np.testing.assert_allclose(whole["length_ratio"], [0.5, np.nan])
    np.testing.assert_allclose(whole["stability_ratio"], [0.25, 0.6])
    np.testing.assert_allclose(whole["zeta_over_a"], [2.0, 3.0])
    for i, row in enumerate(rows_of(TABLE)):
        for name, value in ratios(row).items():
            np.testing.assert_equal(value, float(whole[name][i]))
