"""Results shared between checkouts by their keys, and what can be wrong with a store elsewhere."""

import dataclasses
import shutil
import subprocess
import sys

import pytest

from replication.pipeline.store import Store, read_note

RUN = {"height": [0.02, 0.1], "n_x": 40, "n_y": 4, "end_time": 0.2}


@pytest.fixture(scope="module")
def filled(workflow_type, tmp_path_factory):
    """A shared store that one checkout has filled, and this checkout."""
    shared = tmp_path_factory.mktemp("shared")
    ran = workflow_type(tmp_path_factory.mktemp("first"))
    ran = ran.configured({"studies": {"shared": {"runs": [RUN]}}})
    with pytest.MonkeyPatch.context() as patched:
        patched.setenv("NUCLEATION_STORES", str(shared))
        ran.printed("simulations")
    assert len(Store(shared).listed()) == 2
    return shared, ran


def elsewhere(ran, directory):
    return dataclasses.replace(ran, directory=directory)


def simulations(ran):
    paths = (ran.directory / "results" / "simulations").glob("*.nc")
    return {path.name: path.read_bytes() for path in paths}


def test_results_are_taken_and_wrong_ones_are_made_and_given_again(filled, tmp_path, monkeypatch):
    shared, first = filled
    monkeypatch.setenv("NUCLEATION_STORES", str(shared))
    taken = elsewhere(first, tmp_path / "taken")
    taken.directory.mkdir()
    seen = taken("simulations", "--dry-run")
    assert "as a store has their results: simulate 2" in seen.stdout
    assert not (taken.directory / "results" / "simulations").exists()
    printed = taken.printed("simulations")
    assert "Shown without a job: 2 results, 2 of them taken from other stores" in printed
    assert not [*taken.directory.glob("results/logs/batches/*")], "no job was needed"
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
    printed = third.printed("simulations")
    assert f"Not taken from {shared}" in printed
    assert "holds the result of another key" in printed
    assert "differs from the file that was written" in printed
    assert simulations(third).keys() == simulations(first).keys()
    assert all(read_note(shared / key, whole=True) for key in Store(shared).listed())


def test_job_goes_on_without_a_store_that_its_node_lacks(workflow, monkeypatch):
    """A job on a node, as Snakemake would start it there."""
    workflow.printed("table_s1")
    shutil.rmtree((workflow.directory / "results/quick/tables/table_s1.md").resolve().parent)
    (recipe,) = workflow.directory.glob("results/quick/store/recipes/*/tables/table_s1.*.json")
    monkeypatch.setenv("NUCLEATION_STORES", "/no/such/store")
    monkeypatch.setenv("PYTHONPATH", str(workflow.checkout / "src"))
    command = [sys.executable, "-P", "-m", "replication.pipeline.job"]
    job = [*command, recipe, "table_s1", "1", "log"]
    subprocess.run(job, cwd=workflow.directory, check=True)
    said = (workflow.directory / "log").read_text()
    assert "Not used: the store '/no/such/store' is no directory" in said
    assert (workflow.directory / "results/quick/tables/table_s1.md").exists()
