"""Simulations shared between checkouts through Snakemake's cache, and damage in it."""

import dataclasses

import numpy as np
import pytest

from nucleation.datasets import netcdf


@pytest.fixture(scope="module")
def cache(tmp_path_factory):
    """A cache that is filled by a first run of one study."""
    return tmp_path_factory.mktemp("cache")


@pytest.fixture
def cached(workflow, cache, monkeypatch):
    monkeypatch.setenv("SNAKEMAKE_OUTPUT_CACHE", str(cache))
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


def test_cold_and_warm_runs_and_damaged_entries(cached, cache, tmp_path_factory):
    cold = cached("simulations")
    assert cold.returncode == 0, cold.stdout
    first = simulations(cached)
    assert len(first) == 2 == len(list(cache.glob("*.nc")))

    warm = dataclasses.replace(cached, directory=tmp_path_factory.mktemp("warm"))
    done = warm("simulations")
    assert done.returncode == 0, done.stdout
    assert done.stdout.count("Symlinking output file") == 2, done.stdout
    assert_same(first, simulations(warm))

    truncated, flipped = sorted(cache.glob("*.nc"))
    truncated.write_bytes(truncated.read_bytes()[:5000])
    content = bytearray(flipped.read_bytes())
    content[len(content) // 3] ^= 1
    flipped.write_bytes(content)
    third = dataclasses.replace(cached, directory=tmp_path_factory.mktemp("third"))
    done = third("simulations")
    assert done.returncode == 0, done.stdout
    assert done.stdout.count("The cache's entry is removed and computed again") == 2, done.stdout
    assert_same(first, simulations(third))
    for entry in cache.glob("*.nc"):
        netcdf.read(entry)


def test_no_cache_is_used_unless_it_is_named(cached, cache, monkeypatch):
    monkeypatch.delenv("SNAKEMAKE_OUTPUT_CACHE")
    before = {path: path.stat().st_mtime_ns for path in cache.iterdir()}
    done = cached("simulations")
    assert done.returncode == 0, done.stdout
    assert "from cache" not in done.stdout
    assert {path: path.stat().st_mtime_ns for path in cache.iterdir()} == before
    assert not any(p.is_symlink() for p in (cached.directory / "results").rglob("*.nc"))
