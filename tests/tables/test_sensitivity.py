"""What a run varies against its base, in words and in numbers."""

import made_up_runs
import numpy as np
import pytest
from made_up_runs import changed, record, run

from nucleation.extraction.definitions import ExtractionSettings
from nucleation.extraction.extraction import extract
from replication.tables.sensitivity import COLUMNS, sensitivity_table, variation

BASE = run("base")


@pytest.mark.parametrize(
    ("values", "critical", "expected"),
    [
        ({}, 0.5, ("base", "base")),
        ({"density": 600.0}, 0.5, ("density", "rho x 0.5")),
        ({"density": 0.0}, 0.5, ("density", "rho = 0")),
        ({"velocity": 2e-5, "block_length": 2.001}, 0.5, ("velocity", "V x 2")),
        ({"time_after_event": 0.1}, 0.5, ("base", "base")),
        ({"block_length": 4.0, "n_x": 400}, 0.5, ("block_length", "L x 2")),
        # the same multiple of L_c, but for rounding
        ({"block_length": 2.014}, 0.5, ("base", "base")),
        ({"block_length": 2.03}, 0.5, ("block_length", "L x 1.01")),
        ({"slip_distance": 1e-6, "block_length": 4.0}, 1.0,
         ("slip_distance", "D x 2")),
        ({"initial_stress": "uniform_shear"}, 0.5, ("initial_shear_stress", "tau0 = 0")),
        ({"initial_stress": "uniform_shear", "initial_shear_stress": 5e4}, 0.5,
         ("initial_shear_stress", "tau0 = 50000 Pa")),
        ({"evolution": "slip"}, 0.5, ("evolution", "evolution = slip")),
        ({"density": 600.0, "velocity": 2e-5}, 0.5, ("density, velocity", "rho x 0.5, V x 2")),
    ],
)  # fmt: skip
def test_variation_in_words(values, critical, expected):
    assert variation(run("run", changed(**values), critical), BASE) == expected


@pytest.fixture(scope="module")
def table():
    doubled = changed(density=2400.0, block_length=4.0, n_x=400)
    runs = [run("a"), run("b", doubled, critical_length=1.0), run("c", changed(height=0.1))]
    simulations = [record(0.1), record(0.125, doubled), record(0.1, changed(height=0.1))]
    return sensitivity_table(runs, simulations)


def test_changes_are_against_the_base_of_the_height(table):
    assert tuple(table.data_vars) == tuple(COLUMNS)
    first = {v: table.isel(run=i) for i, v in reversed([*enumerate(table["variation"].values)])}
    other = first["rho x 2"]
    # a front that takes 1.25 times as long for each node: 80 nodes instead of 100
    assert float(other["length_change"]) == pytest.approx(-0.2, abs=0.01)
    assert float(other["ratio_change"]) == pytest.approx(-0.6, abs=0.01)
    assert float(other["onset_change"]) == pytest.approx(0.0)
    bases = table["variation"].values == "base"
    assert list(table["id"].values[bases]) == ["a", "c"]
    for name in ("length_change", "ratio_change", "onset_change"):
        assert (table[name].values[bases] == 0.0).all()


def test_definitions_are_varied_on_the_base_run(table):
    simulation = record(0.1)
    for i in np.flatnonzero(table["varied"].values == "edge_threshold"):
        row = table.isel(run=int(i))
        value = float(str(row["variation"].values).split()[2])
        again = extract(simulation, ExtractionSettings(edge_threshold=value))
        assert float(row["length"]) == again["length"]
        assert str(row["id"].values) in ("a", "c")
    (drop,) = {float(x) for x in table["onset_time"].values[table["varied"].values == "drop"]}
    assert drop == pytest.approx(made_up_runs.ONSET)
    ends = table["onset_time"].values[table["varied"].values == "instant"]
    np.testing.assert_allclose(ends, made_up_runs.ONSET + 2e-3)


def test_run_without_an_event_has_no_length():
    quiet = record()
    quiet["driving_force"] = quiet["driving_force"] * 0.0 - 1e4
    table = sensitivity_table([run("a"), run("b", changed(density=600.0))], [record(), quiet])
    assert np.isnan(table["length"].values[1])
    assert str(table["variation"].values[1]) == "rho x 0.5"
