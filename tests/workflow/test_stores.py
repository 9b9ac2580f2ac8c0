"""Results taken from another store by their keys, and what can be wrong with it."""

import dataclasses
import shutil

import numpy as np
import pytest

from nucleation.datasets import netcdf
from nucleation.pipeline.elsewhere import VARIABLES


@pytest.fixture(scope="module")
def other(tmp_path_factory):
    """A store that is filled by a first run of one study."""
    return tmp_path_factory.mktemp("other")


@pytest.fixture
def stored(workflow, other, monkeypatch):
    monkeypatch.setenv(VARIABLES[0], str(other))
    run = {"height": [0.02, 0.1], "n_x": 40, "n_y": 4, "tolerance": 0.1}
    return workflow.configured({"studies": {"shared": {"runs": [run]}}})


def simulations(ran):
    paths = (ran.directory / "results" / "store").glob("*/result.nc")
    return {path.parent.name: netcdf.read(path) for path in paths}


def assert_same(one, other):
    assert one.keys() == other.keys()
    for name, dataset in one.items():
        for variable in dataset.variables:
            np.testing.assert_array_equal(dataset[variable], other[name][variable])


def logs(ran):
    paths = sorted((ran.directory / "results" / "logs" / "simulations").glob("*.log"))
    return "".join(path.read_text() for path in paths)


def elsewhere(ran, factory, name):
    return dataclasses.replace(ran, directory=factory.mktemp(name))


def test_cold_and_warm_runs_damaged_and_swapped_entries(stored, other, tmp_path_factory):
    cold = stored("simulations")
    assert cold.returncode == 0, cold.stdout
    first = simulations(stored)
    assert len(first) == 2 and {path.name for path in other.iterdir()} == first.keys()

    warm = elsewhere(stored, tmp_path_factory, "warm")
    done = warm("simulations")
    assert done.returncode == 0, done.stdout
    assert logs(warm).count("taken from") == 2
    assert_same(first, simulations(warm))

    one, two = sorted(other.iterdir())
    shutil.rmtree(one)
    shutil.copytree(two, one)  # whole, and another's
    content = bytearray((two / "result.nc").read_bytes())
    content[len(content) // 3] ^= 1
    (two / "result.nc").chmod(0o644)
    (two / "result.nc").write_bytes(content)
    third = elsewhere(stored, tmp_path_factory, "third")
    done = third("simulations")
    assert done.returncode == 0, done.stdout
    assert logs(third).count(f"Not taken from {other}") == 2
    assert "holds the result of another key" in logs(third)
    assert "is not what was written" in logs(third)
    assert_same(first, simulations(third))

    shutil.rmtree(third.directory / "results")
    assert third("simulations").returncode == 0
    assert logs(third).count("taken from") == 2, "what was wrong there has been replaced"


def test_no_other_store_is_used_unless_it_is_named(stored, other, monkeypatch):
    monkeypatch.delenv(VARIABLES[0])
    before = {path: path.stat().st_mtime_ns for path in other.rglob("*")}
    done = stored("simulations")
    assert done.returncode == 0, done.stdout
    assert "taken from" not in logs(stored)
    assert {path: path.stat().st_mtime_ns for path in other.rglob("*")} == before


def test_store_that_is_not_there_is_named_before_the_first_job(stored, monkeypatch):
    monkeypatch.setenv(VARIABLES[0], "/no/such/store")
    done = stored("simulations", "--quiet", "all")
    assert done.returncode != 0
    assert "the store '/no/such/store' is no directory" in done.stdout
    assert not (stored.directory / "results").exists()
