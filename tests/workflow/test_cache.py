"""Costly datasets shared between checkouts by their keys, and what can be wrong with a cache."""

import dataclasses
import os
import shutil

import numpy as np
import pytest

from nucleation.datasets import netcdf
from nucleation.pipeline import cache as module


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    """A cache that is filled by a first run of one study."""
    return tmp_path_factory.mktemp("cache")


@pytest.fixture
def cached(workflow, cache, monkeypatch):
    monkeypatch.setenv(module.VARIABLE, str(cache))
    run = {"height": [0.02, 0.1], "n_x": 40, "n_y": 4, "tolerance": 0.1}
    return workflow.configured({"studies": {"shared": {"runs": [run]}}})


def simulations(ran):
    paths = sorted((ran.directory / "results" / "simulations").glob("*.nc"))
    return {path.name: netcdf.read(path) for path in paths}


def assert_same(one, other):
    assert one.keys() == other.keys()
    for name, dataset in one.items():
        for variable in dataset.variables:
            np.testing.assert_array_equal(dataset[variable], other[name][variable])


def logs(ran):
    paths = sorted((ran.directory / "results" / "logs" / "simulate").glob("*.log"))
    return "".join(path.read_text() for path in paths)


def elsewhere(ran, factory, name):
    return dataclasses.replace(ran, directory=factory.mktemp(name))


def test_cold_and_warm_runs_damaged_and_swapped_entries(cached, cache, tmp_path_factory):
    cold = cached("simulations")
    assert cold.returncode == 0, cold.stdout
    first = simulations(cached)
    assert len(first) == 2 == len(list(cache.glob("*.nc")))
    mask = os.umask(0)
    os.umask(mask)
    assert {path.stat().st_mode & 0o777 for path in cache.glob("*.nc")} == {0o666 & ~mask}

    warm = elsewhere(cached, tmp_path_factory, "warm")
    done = warm("simulations")
    assert done.returncode == 0, done.stdout
    assert logs(warm).count("taken from") == 2
    assert_same(first, simulations(warm))
    assert not any(p.is_symlink() for p in (warm.directory / "results").rglob("*.nc"))

    one, other = sorted(cache.glob("*.nc"))
    held = one.read_bytes()
    shutil.copyfile(other, one)  # valid, and another's
    content = bytearray(other.read_bytes())
    content[len(content) // 3] ^= 1
    other.write_bytes(content)
    third = elsewhere(cached, tmp_path_factory, "third")
    done = third("simulations")
    assert done.returncode == 0, done.stdout
    assert logs(third).count("The cache's entry is removed and computed again") == 2
    assert "is the result of another key" in logs(third)
    assert_same(first, simulations(third))
    assert netcdf.read(one).attrs["key"] == one.stem != "" and len(held) > 0


def test_no_cache_is_used_unless_it_is_named(cached, cache, monkeypatch):
    monkeypatch.delenv(module.VARIABLE)
    before = {path: path.stat().st_mtime_ns for path in cache.iterdir()}
    done = cached("simulations")
    assert done.returncode == 0, done.stdout
    assert "taken from" not in logs(cached)
    assert {path: path.stat().st_mtime_ns for path in cache.iterdir()} == before


def test_cache_that_is_not_there_is_named_before_the_first_job(cached, monkeypatch):
    monkeypatch.setenv(module.VARIABLE, "/no/such/cache")
    done = cached("simulations")
    assert done.returncode != 0
    assert "'/no/such/cache' is not allowed: it is no directory" in done.stdout
    assert not (cached.directory / "results").exists()


def test_result_is_kept_whatever_the_cache_does(tmp_path, capsys, monkeypatch):
    result = tmp_path / "run.nc"
    result.write_bytes(b"hours of work")

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(module.shutil, "copyfile", full)
    module.keep(tmp_path, "0" * 16, result)
    assert "No space left on device" in capsys.readouterr().err
    assert result.read_bytes() == b"hours of work"
    assert [path.name for path in tmp_path.iterdir()] == ["run.nc"]


def test_read_only_cache_is_used_with_a_warning(tmp_path, monkeypatch):
    monkeypatch.setattr(module.os, "access", lambda path, mode: mode != os.W_OK)
    assert module.problem(tmp_path) is None
    assert "is not writable" in module.warning(tmp_path)


def test_result_that_snakemake_discards_is_not_computed_again(workflow):
    """It removes the results of a failed job's partners in its group; their second names stay."""
    runs = [{"height": 0.02, "n_x": 40, "n_y": 4, "tolerance": 0.1}]
    alone = workflow.configured({"studies": {"kept": {"runs": runs}}})
    results = alone.directory / "results"
    assert alone("simulations").returncode == 0
    (path,) = (results / "simulations").glob("*.nc")
    module.hold(results, path.name.split(".")[-2], path)
    made = netcdf.read(path).attrs["created"]
    path.unlink()
    done = alone("simulations", "--forcerun", "simulate", "--quiet", "rules")
    assert done.returncode == 0, done.stdout
    assert netcdf.read(path).attrs["created"] == made
    assert not list((results / module.KEPT).iterdir()), "released once the result is in its place"
