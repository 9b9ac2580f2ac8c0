"""Rows of a table as plain Python; runs without an event are counted, and each is told why."""

import math

import numpy as np
import pytest
import xarray as xr

from replication.tables.rows import remarked, rows_of, why, without_event

COLUMNS = {"id": ["a", "b"], "n_x": [400, 800], "length": [0.2, np.nan]}
TABLE = xr.Dataset({name: ("run", np.array(values)) for name, values in COLUMNS.items()})


def test_rows_are_plain():
    first, second = rows_of(TABLE)
    assert (first["id"], first["n_x"], first["length"]) == ("a", 400, 0.2)
    assert {type(first[name]) for name in ("id", "n_x", "length")} == {str, int, float}
    assert math.isnan(second["length"]) and list(second) == list(TABLE.data_vars)


ROW = {
    "id": "r", "status": "completed: the end time was reached", "onset_time": float("nan"),
    "zeta": 0.016, "critical_length": 0.5, "reached_length": 0.1,
    "simulated_time": 5.0, "block_length": 2.0, "loading": "edge",
}  # fmt: skip


def test_all_are_named_and_counted():
    assert without_event([ROW | {"onset_time": 3.0}]) == []
    lines = without_event([ROW, ROW | {"id": "s", "onset_time": 1.0}, ROW | {"id": "t"}])
    assert lines[0].startswith("2 of 3 runs had no event")
    assert [line.partition(":")[0] for line in lines[1:]] == ["r", "t"]


@pytest.mark.parametrize(("changed", "said"), [
    ({}, "after 5 s its patch was 0.1 m long, 0.2 of the theory's critical length: a longer"),
    ({"reached_length": 0.7}, "1.4 of the theory's critical length, and the force has not"),
    ({"reached_length": 0.999}, "filled the half of the block"),
    ({"reached_length": 0.999, "loading": "remote"}, "and the force has not dropped"),
    ({"critical_length": float("nan"), "zeta": -0.01}, "stable by the theory"),
    ({"status": "failed: tension"}, "failed: tension"),
])  # fmt: skip
def test_reasons(changed, said):
    assert said in why(ROW | changed)


def test_remarks_of_finished_runs_are_told():
    doubtful = "completed: the end time was reached; not resolved: why; slip elsewhere: where"
    rows = [ROW, ROW | {"id": "s", "status": doubtful}, ROW | {"status": "failed: tension; more"}]
    assert remarked(rows) == ["s: not resolved: why; slip elsewhere: where"]
