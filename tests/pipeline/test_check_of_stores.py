"""Checks of a store in which anything may have the name of an entry, and of plans for jobs."""

import json
import os
import socket
from types import SimpleNamespace

import pytest

from replication.pipeline import check
from replication.pipeline.planning import PLAN, Plan
from replication.pipeline.store import NOTE, Store

KEY, OTHER = "0" * 16, "1" * 16


@pytest.fixture
def store(tmp_path):
    store = Store(tmp_path / "store")
    store.put(KEY, lambda place: (place / "result.csv").write_text("1\n"), {"name": "a"})
    return store


def fifo(path):
    os.mkfifo(path)


def connection(path):
    os.chdir(path.parent)  # the names of sockets are short
    socket.socket(socket.AF_UNIX).bind(path.name)


def loop(path):
    path.symlink_to(path.name)


def plain_file(path):
    path.write_text("x")


@pytest.mark.parametrize("make", [fifo, connection, loop, plain_file])
def test_anything_with_the_name_of_an_entry_is_found_and_pruned(store, make, monkeypatch):
    monkeypatch.chdir(store.directory)
    make(store.entry(OTHER))
    results = store.directory.parent
    (wrong,) = [found for found in check.check_results(results, {}) if found[1] != check.UNUSED]
    assert wrong[:2] == (store.entry(OTHER), "damaged")
    assert not store.has(OTHER)
    assert check.prune(results, {}, remove=True).endswith("2 results removed")
    assert store.listed() == [] and not list(store.directory.glob(".*"))


def test_an_entry_without_all_expected_files_is_found(store):
    expected = {"results/a.csv": "store/" + f"{KEY}/result.csv"}
    results = store.directory.parent
    assert list(check.check_results(results, expected)) == []
    expected["results/a.nc"] = f"store/{KEY}/result.nc"
    ((_, state, reason),) = check.check_results(results, expected)
    assert state == "damaged" and "lacks files" in reason


def test_no_note_forges_a_line(store, capsys):
    note = store.entry(KEY) / NOTE
    note.chmod(0o644)
    name = "\x1b[2K\r\nAll is current\ud800" + 10**6 * "a"
    note.write_text(json.dumps(json.loads(note.read_text()) | {"name": name}))
    printed = check.prune(store.directory.parent, {}, remove=False)
    assert len(printed.splitlines()) == 2 and printed.encode() and len(printed) < 1000


class File(str):
    """A file as Snakemake's rules have it."""

    def apply_wildcards(self, wildcards):
        return self


def test_a_job_elsewhere_takes_what_the_latest_run_planned(tmp_path, monkeypatch):
    """Even if the configuration, and so the key, has changed since then."""
    monkeypatch.chdir(tmp_path)
    rules = SimpleNamespace(a=SimpleNamespace(output=[File("results/a.nc")]))
    job = Plan(rules, SimpleNamespace(is_main_process=False), "results")
    ask = job("a")
    place = tmp_path / job._place
    place.mkdir(parents=True)
    monkeypatch.setenv(PLAN, "planned-mine")
    (place / "planned-mine").write_text(f"b {OTHER}\na {OTHER}\na {KEY}\n")
    assert ask({}) == f"{job._place}/a.{KEY}.json"
