"""Results shared between checkouts by their keys, and what can be wrong with a store elsewhere."""

import dataclasses
import shutil

import pytest

from nucleation.pipeline.store import Store, read_note

RUN = {"height": [0.02, 0.1], "n_x": 40, "n_y": 4, "tolerance": 0.1}


@pytest.fixture(scope="module")
def filled(workflow_type, tmp_path_factory):
    """A shared store that one checkout has filled, and this checkout."""
    shared = tmp_path_factory.mktemp("shared")
    ran = workflow_type(tmp_path_factory.mktemp("first"))
    ran = ran.configured({"studies": {"shared": {"runs": [RUN]}}})
    with pytest.MonkeyPatch.context() as patched:
        patched.setenv("NUCLEATION_STORES", str(shared))
        done = ran("simulations")
    assert done.returncode == 0, done.stdout
    assert len(Store(shared).listed()) == 2
    return shared, ran


def elsewhere(ran, directory):
    return dataclasses.replace(ran, directory=directory)


def logs(ran):
    paths = sorted((ran.directory / "results" / "logs" / "simulations").glob("*.log"))
    return "".join(path.read_text() for path in paths)


def simulations(ran):
    paths = (ran.directory / "results" / "simulations").glob("*.nc")
    return {path.name: path.read_bytes() for path in paths}


def test_results_are_taken_and_wrong_ones_are_made_and_given_again(filled, tmp_path, monkeypatch):
    shared, first = filled
    monkeypatch.setenv("NUCLEATION_STORES", str(shared))
    taken = elsewhere(first, tmp_path / "taken")
    taken.directory.mkdir()
    assert taken("simulations").returncode == 0
    assert logs(taken).count(f"taken from {shared}") == 2
    assert simulations(taken) == simulations(first)

    swapped, damaged = sorted(shared.iterdir())
    shutil.rmtree(swapped)
    shutil.copytree(damaged, swapped)  # whole, and another's
    path = damaged / "result.nc"
    path.chmod(0o644)
    content = bytearray(path.read_bytes())
    content[len(content) // 3] ^= 1
    path.write_bytes(content)
    third = elsewhere(first, tmp_path / "third")
    third.directory.mkdir()
    assert third("simulations").returncode == 0
    assert logs(third).count(f"Not taken from {shared}") == 2
    assert "holds the result of another key" in logs(third)
    assert "is not what was written" in logs(third)
    assert simulations(third).keys() == simulations(first).keys()
    assert all(read_note(shared / key, whole=True) for key in Store(shared).listed())


def test_job_goes_on_without_a_store_that_its_node_lacks(workflow, monkeypatch):
    """What jobs of a running Snakemake see: the environment of the process that began it."""
    monkeypatch.setenv("NUCLEATION_STORES", "/no/such/store")
    monkeypatch.setenv("NUCLEATION_WARNED", "yes")
    done = workflow("table_s1")
    assert done.returncode == 0, done.stdout
    assert "Not used: the store '/no/such/store' is no directory" in done.stdout
