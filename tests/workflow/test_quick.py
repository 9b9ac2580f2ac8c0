"""The whole workflow on coarse grids: what it leaves behind, and what it does not do again."""

import json
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from nucleation.datasets import netcdf
from nucleation.extraction.extraction import extract
from nucleation.run.run import Run
from replication.configuration.load import load, read_yaml
from replication.pipeline.recipes import key_in
from replication.tables import lengths

ROOT = Path(__file__).parents[2]
CLAIMING = {"claims", "write_article"}


def shared_runs(config):
    """The runs that the default target makes: those of studies without a table of their own."""
    return [run for run in config.runs if config.studies[run.study].table == "lengths"]


@pytest.fixture
def results(quick):
    return quick.directory / "results" / "quick"


def test_every_file_is_there(results):
    names = ("figure_1", "figure_2", "figure_3", "figure_s1", "figure_s2")
    for name in names:
        assert (results / "figures" / f"{name}.pdf").read_bytes().startswith(b"%PDF")
        assert (results / "figures" / f"{name}.png").read_bytes().startswith(b"\x89PNG")
    assert "5/18" in (results / "tables" / "table_s1.md").read_text()
    assert len((results / "tables" / "table_s1.csv").read_text().splitlines()) == 8
    assert {path.name for path in results.rglob(".*")} <= set()


def test_simulations_carry_their_origin_and_units(quick, results):
    for run in shared_runs(load(quick.config)):
        path = quick.dataset("simulations", run.id)
        dataset = netcdf.read(path)
        assert Run.from_dict(json.loads(dataset.attrs["parameters"])) == run.run
        assert set(json.loads(dataset.attrs["versions"])) >= {"numpy", "scipy", "nucleation"}
        assert dataset.attrs["key"] == key_in(path)
        assert dataset["slip_rate"].attrs["units"] == "m/s"
        assert dataset["slip_rate"].attrs["symbol"] == "v"
        for name, variable in dataset.variables.items():
            assert np.isfinite(variable.values).all(), name


def test_table_of_lengths(quick, results):
    config = load(quick.config)
    table = netcdf.read(results / "lengths.nc")
    assert {*lengths.COLUMNS, *lengths.MEASURES} <= {*table.variables}
    text = pd.read_csv(results / "lengths.csv")
    assert set(lengths.COMPARED) < set(text.columns) and len(text.columns) < 30
    assert list(text["id"]) == [run.id for run in shared_runs(config)] == list(table["id"].values)
    for name in text.columns:
        np.testing.assert_array_equal(text[name].to_numpy(), table[name].values)
    assert (text["length_low"] <= text["length"]).all()
    assert (text["length"] <= text["length_high"]).all()
    assert (text["length"] / text["critical_length"]).between(0.3, 1.2).all()
    assert text["onset_time"].between(5.0, 20.0).all()
    for index, run in enumerate(shared_runs(config)):
        simulation = netcdf.read(quick.dataset("simulations", run.id))
        again = extract(simulation, config.extraction)
        assert again["length"] == float(table["length"][index])
        assert float(table["height"][index]) == run.run.fault.height
        assert int(table["n_x"][index]) == run.run.block.n_x
        assert float(table["critical_length"][index]) == run.critical_length


@pytest.mark.parametrize(
    ("section", "values", "expected"),
    [
        (
            "extraction",
            {"edge_threshold": 0.2},
            {"extract", "lengths", "figure_3", "figure_s2", "follow_patches", *CLAIMING},
        ),
        (
            "curves",
            {"zeta_over_a": [1.0]},
            {"theory", "figure_2", "figure_3", "figure_s1", *CLAIMING},
        ),
        ("limits", {"memory": 1999.0}, set()),
    ],
)
def test_change_of_a_setting_reruns_what_depends_on_it(quick, section, values, expected):
    config = read_yaml(quick.config)
    config[section] = {**config.get(section, {}), **values}
    planned = quick.configured(config, f"{section}.yaml").planned()
    assert set(planned) == expected


def test_change_of_one_run_reruns_it_alone(quick):
    config = read_yaml(quick.config)
    config["studies"]["paper"]["runs"][1]["tolerance"] = 0.04
    config["studies"]["paper"]["runs"][2]["density"] = 1200.0  # the value it has, by another name
    planned = quick.configured(config, "one.yaml").planned("simulations")
    assert planned["simulate"] == 1  # the other's name changes, its parameters do not


SPARE = "\nSPARE = 1\n"
SIMULATIONS = 6  # of the quick configuration

WORDS = {
    "src/nucleation/simulation/run.py": "\n# a remark\n",
    "src/nucleation/simulation/stepping.py": '\n"""More words."""\n',
    "src/nucleation/simulation/progress.py": SPARE,
    "workflow/rules/simulations.smk": "\n# a remark\n",
}
OF_SOLVER = {"simulate", "follow_patches", "dispersion"}
OF_LENGTHS = {"extract", "lengths", "figure_3", "figure_s2", *CLAIMING}
EDITS = {
    "words": (WORDS, set()),
    "solver": ({"src/nucleation/fem/kernels.py": SPARE}, OF_SOLVER | OF_LENGTHS),
    "extraction": ({"src/replication/tables/lengths.py": SPARE}, OF_LENGTHS),
    "figure": ({"src/replication/figures/figure_1.py": SPARE}, {"figure_1"}),
}


@pytest.mark.parametrize(("additions", "expected"), EDITS.values(), ids=EDITS.keys())
def test_change_of_code_reruns_what_depends_on_it(checkout, additions, expected):
    for path, addition in additions.items():
        file = checkout.checkout / path
        file.write_text(file.read_text() + addition)
    planned = checkout.planned()
    # of another checkout the template is another file: the job then finds the article in the store
    assert set(planned) - {"write_article"} == expected - {"write_article"}
    assert planned.get("simulate", 0) in (0, SIMULATIONS)


def test_claims_are_in_the_order_of_the_paper(results):
    listed = pd.read_csv(results / "tables" / "claims.csv")["id"].tolist()
    claims = read_yaml(ROOT / "src/replication/claims/claims.yaml")
    stated = [id for entries in claims.values() for id in entries]
    assert listed == [id for id in stated if id in listed]
