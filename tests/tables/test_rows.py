"""Rows of a table as plain Python."""

import math

import numpy as np
import xarray as xr

from replication.tables.rows import rows_of

COLUMNS = {"id": ["a", "b"], "n_x": [400, 800], "length": [0.2, np.nan]}
TABLE = xr.Dataset({name: ("run", np.array(values)) for name, values in COLUMNS.items()})


def test_rows_are_plain():
    first, second = rows_of(TABLE)
    assert (first["id"], first["n_x"], first["length"]) == ("a", 400, 0.2)
    assert {type(first[name]) for name in ("id", "n_x", "length")} == {str, int, float}
    assert math.isnan(second["length"]) and list(second) == list(TABLE.data_vars)
