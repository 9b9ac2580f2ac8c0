"""Recipes: a job makes what was planned or refuses; Snakemake sees what planning has changed."""

from types import SimpleNamespace

import pytest
from snakemake.io import IOCache

from nucleation.datasets import code
from replication.pipeline import making
from replication.pipeline.making import verify
from replication.pipeline.planning import Plan
from replication.pipeline.recipes import Recipe, as_json, read

CALL = "replication.tables.rows:rows_of"


@pytest.fixture
def planned(tmp_path):
    """A recipe as a job reads it."""
    file = tmp_path / "recipe.json"
    part = Recipe("part", ["results/part.nc"], "results", CALL, [], {"n": 1}, {}, [])
    whole = Recipe("whole", ["results/whole.json"], "results", "", [], {}, {}, [part])
    file.write_text(as_json({"planned": "", **vars(whole)}))
    return read(file)


def test_a_job_has_the_keys_that_were_planned(planned, monkeypatch):
    verify(planned)
    monkeypatch.setattr(code, "digest", lambda *roots: "of edited code")
    (part,) = planned.parts
    assert part.key != part.key_now()
    assert planned.expected() == {"results/whole.json": f'{{"part": "{part.key}"}}\n'}


def test_code_edited_after_the_store_was_asked_is_refused(planned, monkeypatch):
    """The store is asked first, for the key: this must not keep the key of the former code."""
    assert all(one.key for one in planned.needed)
    monkeypatch.setattr(code, "load", lambda *roots: None)
    monkeypatch.setattr(code, "digest", lambda *roots: "of edited code")
    with pytest.raises(code.DatasetError, match="the sources of part have changed"):
        verify(planned)


def test_snakemake_sees_what_planning_writes_in_a_directory_that_it_has_listed(
    tmp_path, monkeypatch
):
    monkeypatch.chdir(tmp_path)
    cache = IOCache(max_wait_time=10)
    cache.exists_local.has_inventory.add("results")
    workflow = SimpleNamespace(iocache=cache)
    file, other = "results/recipe.json", "results/other.json"
    assert not cache.exists_local[file]
    (tmp_path / "results").mkdir()
    for path in (file, other):
        (tmp_path / path).touch()
        Plan._refresh(SimpleNamespace(_workflow=workflow), path)
    assert cache.exists_local[file] and cache.exists_local[other]
    (tmp_path / file).unlink()
    Plan._refresh(SimpleNamespace(_workflow=workflow), file)
    assert not cache.exists_local[file] and cache.exists_local[other]


def test_the_time_left_is_that_of_runs_to_compute(monkeypatch, capsys):
    """Runs that the store had were counted as if they had been computed."""
    clock = [0.0]

    def result(maker, part):
        clock[0] += 0.0 if part.is_in(None) else 10.0

    monkeypatch.setattr(making.time, "monotonic", lambda: clock[0])
    monkeypatch.setattr(making._Maker, "result", result)
    parts = [
        SimpleNamespace(name="run", show=lambda: None, is_in=lambda _, number=number: number < 3)
        for number in range(6)
    ]
    making._Maker("rule", None, False, []).each(parts, 1)
    said = [f"{done} of 6 runs done, about {left} s left" for done, left in ((4, 20), (5, 10))]
    assert capsys.readouterr().err.splitlines() == said
