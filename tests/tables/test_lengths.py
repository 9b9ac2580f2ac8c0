"""Tables of lengths: rows, realisations, and why a run has no event."""

import math

import numpy as np
import pytest
import xarray as xr
from made_up_runs import ONSET, PARAMETERS, changed, record
from made_up_runs import run as made_up_run

from nucleation.datasets.variables import DatasetError
from nucleation.extraction.definitions import ExtractionSettings
from replication.tables.lengths import (
    COMPARED,
    description,
    files,
    join,
    lengths_table,
    over_realisations,
    realisations,
    row,
)
from replication.tables.rows import remarked, rows_of, why, without_event


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
    assert row(rows(), "b")["height"].item() == 0.2
    quiet = over_realisations(rows(length=[0.5, 0.7, np.nan, 0.6]))  # none is passed over
    np.testing.assert_allclose(quiet["length"], [np.nan, 0.7, 0.6])


def test_a_column_without_a_rule_is_not_aggregated():
    with pytest.raises(DatasetError, match=r"rule for the realisations of one fault: \['extra'\]"):
        over_realisations(rows(extra=[1.0, 2.0, 3.0, 4.0]))


def test_rows_say_what_lies_below(table):
    assert table["far_side"].item() == "none" and np.isinf(table["second_shear_modulus"].item())
    assert np.isnan(table["second_height"].item())
    second = {"second_far_side": "clamped", "second_shear_modulus": 9e9}
    pair = changed(second_body="deformable", height=0.02, **second)
    row = description(made_up_run("pair", pair) | {"study": "made_up", "role": "own"})
    names = "far_side", "second_height", "second_shear_modulus", "second_poisson_ratio"
    second = [row[name] for name in names]
    assert second == ["clamped", 0.02, 9e9, pair.fault.poisson_ratio]


RUN = {"status": "completed: made up", "steps": 3, "wall_seconds": 1.0, "peak_megabytes": 1.0}
PERTURBED = {"perturbation": "normal_load", "strength": 1e-3, "seed": 3}


def made_up_table(parameters, simulation):
    """The table of one run with this record, of slip rates alone."""
    parameters = parameters.replaced(record="lengths")
    interface = parameters.fault
    own = made_up_run("mine", parameters) | {"study": "made_up", "role": "own"}
    own |= {"interface": {name: getattr(interface, name) for name in ("friction", "a", "zeta")}}
    simulation = simulation.assign_attrs(RUN | {"parameters": parameters.to_json()})
    return lengths_table([own], [simulation], ExtractionSettings())


@pytest.mark.parametrize(("given", "strength"), [({}, 0.0), (PERTURBED, 1e-3)])
def test_strength_is_that_of_the_declared_perturbation(given, strength):
    table = made_up_table(changed(**given), record())
    assert table["strength"].item() == strength
    assert table["simulated_time"].item() == pytest.approx(ONSET + 2e-3)
    assert table["reached_length"].item() == table["length"].item()


def test_a_run_without_an_event_has_the_length_that_it_reached():
    quiet = record()
    rising = -np.linspace(1.0, 2.0, quiet.sizes["step"])
    table = made_up_table(PARAMETERS, quiet.assign(driving_force=("step", rising)))
    last = np.flatnonzero(quiet["slip_rate"].values[-1] > 0.01 * PARAMETERS.fault.velocity)[-1]
    assert np.isnan(table["length"].item())
    assert table["reached_length"].item() == pytest.approx(float(quiet["x"][last]), abs=0.011)


REMOTE = {"loading": "remote", "stress_rate": 1e5}


@pytest.mark.parametrize(
    ("given", "known"),
    [
        ({}, True),
        ({"heterogeneity": "normal_stress", "change": -0.1, "width": 0.3}, True),
        (REMOTE | {"heterogeneity": "friction", "change": -0.1, "width": 0.3}, True),
        (REMOTE | {"heterogeneity": "normal_stress", "change": -0.1, "width": 0.3}, False),
    ],
)
def test_without_an_edge_the_stability_length_needs_a_uniform_interface(given, known):
    parameters = changed(**given)
    simulation = record()
    if given.get("loading") == "remote":
        nowhere = np.zeros(simulation.sizes["step"])
        simulation = simulation.assign(fastest_position=("step", nowhere))
    table = made_up_table(parameters, simulation)
    assert (table["stability_status"].item() != "unknown") == known


def test_csv_has_what_people_compare():
    """Results, and the parameters that vary; the netCDF has all.

    The shortest step is a measure, though a parameter has that name.
    """
    one = made_up_table(PARAMETERS, record())
    one = one.assign(shortest_step=1e-6 * one["n_x"])
    changed = {name: one[name] + 1 for name in ("n_x", "seed", "shortest_step")}
    two = join([one, one.assign(changed)])
    made = files(two)
    listed = made[".csv"].splitlines()[0].split(",")
    assert set(listed) == {*COMPARED, "n_x"} and len(listed) < 30
    assert set(made[".nc"]) > set(listed)
    assert len(made[".csv"].splitlines()) == 3


COLUMNS = {"id": ["a", "b"], "n_x": [400, 800], "length": [0.2, np.nan]}
TABLE = xr.Dataset({name: ("run", np.array(values)) for name, values in COLUMNS.items()})


def test_rows_are_plain():
    first, second = rows_of(TABLE)
    assert (first["id"], first["n_x"], first["length"]) == ("a", 400, 0.2)
    assert {type(first[name]) for name in ("id", "n_x", "length")} == {str, int, float}
    assert math.isnan(second["length"]) and list(second) == list(TABLE.data_vars)


ROW = {
    "id": "r",
    "status": "completed: the end time was reached",
    "onset_time": float("nan"),
    "zeta": 0.016,
    "critical_length": 0.5,
    "reached_length": 0.1,
    "simulated_time": 5.0,
    "block_length": 2.0,
    "loading": "edge",
}


def test_all_are_named_and_counted():
    assert without_event([ROW | {"onset_time": 3.0}]) == []
    lines = without_event([ROW, ROW | {"id": "s", "onset_time": 1.0}, ROW | {"id": "t"}])
    assert lines[0].startswith("2 of 3 runs had no event")
    assert [line.partition(":")[0] for line in lines[1:]] == ["r", "t"]


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({}, "after 5 s its patch was 0.1 m long, 0.2 of the theory's critical length: a longer"),
        ({"reached_length": 0.7}, "1.4 of the theory's critical length, and the force has not"),
        ({"reached_length": 0.999}, "filled the half of the block"),
        ({"reached_length": 0.999, "loading": "remote"}, "and the force has not dropped"),
        ({"critical_length": float("nan"), "zeta": -0.01}, "stable by the theory"),
        ({"status": "failed: tension"}, "failed: tension"),
    ],
)
def test_reasons(changed, said):
    assert said in why(ROW | changed)


def test_remarks_of_finished_runs_are_told():
    doubtful = "completed: the end time was reached; not resolved: why; slip elsewhere: where"
    rows = [ROW, ROW | {"id": "s", "status": doubtful}, ROW | {"status": "failed: tension; more"}]
    assert remarked(rows) == ["s: not resolved: why; slip elsewhere: where"]
