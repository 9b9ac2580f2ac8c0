"""Stores: entries are whole or not there, and what is not right is neither taken nor kept."""

import functools
import hashlib
import json
import os
import shutil
import socket
import sys
import time
from concurrent.futures import ThreadPoolExecutor

import fsspec
import pytest
from fsspec.implementations.local import LocalFileSystem

from nucleation.pipeline import elsewhere
from nucleation.pipeline import store as module
from nucleation.pipeline.elsewhere import Bucket, SharedDirectory, give_all, others
from nucleation.pipeline.store import NOTE, Store, StoreError, read_note

KEY, OTHER = "0" * 16, "1" * 16


def put(store, key=KEY, content=b"hours of work", name="result.nc"):
    store.put(key, lambda place: (place / name).write_bytes(content), {"name": "a"})
    return store.entry(key)


@pytest.fixture
def store(tmp_path):
    return Store(tmp_path / "store")


def names(directory):
    return sorted(path.name for path in directory.iterdir())


def test_entry_is_whole_or_not_there(store):
    def broken(place):
        (place / "result.nc").write_bytes(b"half")
        raise OSError(28, "No space left on device")

    with pytest.raises(OSError, match="No space"):
        store.put(KEY, broken, {})
    assert names(store.directory) == [] and store.note(KEY) is None
    entry = put(store)
    assert read_note(entry, whole=True)["name"] == "a" and names(store.directory) == [KEY]
    assert {path.stat().st_mode & 0o777 for path in entry.iterdir()} == {0o444}


def test_of_writers_at_once_one_wins(store):
    contents = [bytes([n]) * 10**5 for n in range(16)]
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(lambda content: put(Store(store.directory), KEY, content), contents))
    assert read_note(store.entry(KEY), whole=True)
    assert (store.entry(KEY) / "result.nc").read_bytes() in contents
    assert names(store.directory) == [KEY], "nobody's entry was moved aside"


STEPS = ("content", "flush", "shutil.rmtree", "Path.chmod", "Path.rename", "json.dumps")


@pytest.mark.parametrize("step", STEPS)
def test_kill_between_two_steps(store, step):
    child = os.fork()
    if child == 0:
        *owner, name = step.split(".")
        setattr(functools.reduce(getattr, owner, module), name, lambda *_, **__: os._exit(9))
        put(store)
        os._exit(0)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 9
    assert store.listed() == ([KEY] if step == "shutil.rmtree" else [])
    assert read_note(put(store), whole=True)
    if store.listed():
        assert (store.entry(KEY) / "result.nc").read_bytes() == b"hours of work"


def other_note(**changes):
    def damage(entry):
        note = json.loads((entry / NOTE).read_text()) | changes
        (entry / NOTE).write_text(json.dumps(note))

    return damage


DAMAGE = {
    "of another key": other_note(key=OTHER),
    "note cut off": lambda entry: (entry / NOTE).write_bytes((entry / NOTE).read_bytes()[:40]),
    "no note of ours": lambda entry: (entry / NOTE).write_text("[1]"),
    "deep note": lambda entry: (entry / NOTE).write_text("[" * 10**5),
    "no files": other_note(files=None),
    "file outside": other_note(files={"../../evil.nc": {"size": 4, "sha256": "0"}}),
    "absolute": other_note(files={"/etc/passwd": {"size": 4, "sha256": "0"}}),
    "file cut off": lambda entry: (entry / "result.nc").write_bytes(b"hours"),
    "file gone": lambda entry: (entry / "result.nc").unlink(),
}
UNSEEN = {"file changed": lambda entry: (entry / "result.nc").write_bytes(b"HOURS OF WORK")}
"""What only a look at all bytes tells."""


def damaged(entry, how):
    for path in entry.iterdir():
        path.chmod(0o644)
    how(entry)


@pytest.mark.parametrize("how", [*DAMAGE.values(), *UNSEEN.values()], ids=[*DAMAGE, *UNSEEN])
def test_damaged_entry_is_said_and_moved_aside_for_a_new_one(store, how, capsys):
    damaged(put(store), how)
    seen = how in DAMAGE.values()
    assert (Store(store.directory).note(KEY) is None) == seen
    assert capsys.readouterr().err.count("Not used") == seen
    with pytest.raises(StoreError):
        read_note(store.entry(KEY), whole=True)
    assert read_note(put(Store(store.directory)), whole=True)
    assert len(list((store.directory / "aside").glob(f"*/{KEY}"))) == 1


@pytest.fixture(scope="module")
def server():
    """A server of S3 in this process, with an empty bucket."""
    from moto.server import ThreadedMotoServer

    with pytest.MonkeyPatch.context() as patched:
        served = ThreadedMotoServer("127.0.0.1", port=0, verbose=False)
        served.start()
        address = "http://{}:{}".format(*served.get_host_and_port())
        for name, value in {
            "AWS_ENDPOINT_URL": address, "AWS_ACCESS_KEY_ID": "a", "AWS_SECRET_ACCESS_KEY": "b",
            "AWS_DEFAULT_REGION": "us-east-1", "NO_PROXY": "127.0.0.1", "no_proxy": "127.0.0.1",
        }.items():  # fmt: skip
            patched.setenv(name, value)
        fsspec.filesystem("s3").mkdir("bucket")
        yield address
        served.stop()


@pytest.fixture(params=["directory", "bucket"])
def other(request, tmp_path):
    """A store elsewhere, and its address."""
    if request.param == "directory":
        (tmp_path / "shared").mkdir()
        return SharedDirectory(tmp_path / "shared"), str(tmp_path / "shared")
    request.getfixturevalue("server")
    return Bucket(f"s3://bucket/{tmp_path.name}/store/"), f"s3://bucket/{tmp_path.name}/store"


def tampered(address, key, how, scratch):
    """Change an entry of a store elsewhere: a copy is damaged, and put in its place."""
    files, root = fsspec.core.url_to_fs(address)
    copy = scratch / "tampered" / key
    copy.mkdir(parents=True)
    for path in files.find(f"{root}/{key}"):
        files.get_file(path, str(copy / os.path.basename(path)))
    damaged(copy, how)
    files.rm(f"{root}/{key}", recursive=True)
    files.makedirs(f"{root}/{key}", exist_ok=True)
    for path in copy.iterdir():
        files.put_file(str(path), f"{root}/{key}/{path.name}")


def test_what_is_given_is_taken_by_another(store, other, tmp_path, capsys):
    there, address = other
    entry, clone = put(store), Store(tmp_path / "clone")
    assert clone.take(KEY, [there]) is None
    for _ in range(2):
        there.give(entry)
    assert clone.take(KEY, [there]) == address
    for name in (NOTE, "result.nc"):
        assert (clone.entry(KEY) / name).stat().st_mode & 0o777 == 0o444
    assert read_note(clone.entry(KEY), whole=True) == read_note(entry)
    assert capsys.readouterr().err == "" and names(clone.directory) == [KEY]


@pytest.mark.parametrize("how", [*DAMAGE.values(), *UNSEEN.values()], ids=[*DAMAGE, *UNSEEN])
def test_damaged_entry_elsewhere_is_said_not_taken_and_replaced(
    store, other, how, tmp_path, capsys
):
    there, address = other
    entry, clone = put(store), Store(tmp_path / "clone")
    there.give(entry)
    tampered(address, KEY, how, tmp_path)
    asked = [there]
    assert clone.take(KEY, asked) is None and asked == [there]
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"Not taken from {address}: ")
    assert names(clone.directory) == [] and not list(tmp_path.rglob("evil*"))
    there.give(entry)
    assert clone.take(KEY, asked) == address


def test_upload_that_was_cut_off_is_no_entry(store, other, tmp_path, capsys):
    there, address = other
    entry, clone = put(store), Store(tmp_path / "clone")
    there.give(entry)
    tampered(address, KEY, lambda copy: (copy / NOTE).unlink(), tmp_path)
    assert clone.take(KEY, [there]) is None and capsys.readouterr().err == ""
    there.give(entry)
    assert clone.take(KEY, [there]) == address


def test_note_is_uploaded_last_and_once(store, monkeypatch):
    there, entry, put_names = Bucket("memory://bucket/store"), put(store), []
    files, _ = there._place
    put_file = files.put_file

    def counted(path, target):
        put_names.append(os.path.basename(target))
        put_file(path, target)

    monkeypatch.setattr(files, "put_file", counted)
    for _ in range(2):
        there.give(entry)
    assert put_names == ["result.nc", NOTE]


@pytest.mark.parametrize("kind", ["directory", "bucket"])
def test_note_of_others_names_no_file_outside(store, kind, tmp_path, capsys):
    """All that such a note says is true of what lies there."""
    evil, content = f"../../../{KEY[:4]}evil.nc", b"evil"
    files = {evil: {"size": 4, "sha256": hashlib.sha256(content).hexdigest()}}
    shared = tmp_path / "far" / "away" / "shared"
    damaged(put(Store(shared)), other_note(files=files))
    (shared / KEY / evil).resolve().write_bytes(content)
    there = SharedDirectory(shared)
    if kind == "bucket":
        there = Bucket("memory://bucket/store")
        there._place = LocalFileSystem(), str(shared)
    assert Store(tmp_path / "clone" / "a" / "b").take(KEY, [there]) is None
    assert "is no name of a result's file" in capsys.readouterr().err
    assert len(list(tmp_path.rglob("*evil.nc"))) == 1


def test_first_store_that_is_right_serves(store, other, tmp_path, capsys):
    there, address = other
    (tmp_path / "first").mkdir()
    first = SharedDirectory(tmp_path / "first")
    entry = put(store)
    for each in (first, there):
        each.give(entry)
    shutil.rmtree(tmp_path / "first" / KEY)
    shutil.copytree(put(store, OTHER, b"another"), tmp_path / "first" / KEY)
    assert Store(tmp_path / "clone").take(KEY, [first, there]) == address
    assert f"holds the result of another key, {OTHER}" in capsys.readouterr().err


def test_result_is_kept_whatever_happens_elsewhere(store, tmp_path, monkeypatch, capsys):
    (tmp_path / "shared").mkdir()
    there, entry = SharedDirectory(tmp_path / "shared"), put(store)

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(elsewhere.shutil, "copyfile", full)
    asked = [there]
    give_all(entry, asked)
    assert "Not kept" in capsys.readouterr().err and asked == []
    assert read_note(entry, whole=True) and names(tmp_path / "shared") == []


@pytest.mark.slow
@pytest.mark.parametrize("answers", [False, True], ids=["nobody there", "nobody answers"])
def test_bucket_out_of_reach_is_said_once_and_soon(server, store, answers, monkeypatch, capsys):
    with socket.socket() as silent:
        silent.bind(("127.0.0.1", 0))
        if answers:
            silent.listen()
        monkeypatch.setenv("AWS_ENDPOINT_URL", f"http://127.0.0.1:{silent.getsockname()[1]}")
        monkeypatch.setattr(elsewhere, "PATIENCE", elsewhere.PATIENCE | {"read_timeout": 1})
        fsspec.get_filesystem_class("s3").clear_instance_cache()
        asked, entry, began = [Bucket("s3://bucket/away")], put(store), time.monotonic()
        for key in (KEY, OTHER):
            assert Store(store.directory / "clone").take(key, asked) is None
        give_all(entry, asked)
        assert time.monotonic() - began < 10.0 and asked == []
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("Not taken from s3://bucket/away: ")
    fsspec.get_filesystem_class("s3").clear_instance_cache()


def test_bucket_that_does_not_exist_is_said(server, store, capsys):
    give_all(put(store), [Bucket("s3://missing/store")])
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith("Not kept in s3://missing/store: ")


def test_stores_are_named_by_the_environment(tmp_path, monkeypatch, capsys):
    monkeypatch.delenv(elsewhere.VARIABLE, raising=False)
    assert others() == []
    monkeypatch.setenv("NUCLEATION_STORES", f"{tmp_path}, memory://shared")
    assert [*map(str, others())] == [str(tmp_path), "memory://shared"]
    for name, reason in {
        "/no/such/store": "is no directory", "nosuch://store": "Protocol not known",
    }.items():  # fmt: skip
        monkeypatch.setenv("NUCLEATION_STORES", f"{name},{tmp_path}")
        with pytest.raises(StoreError, match=reason):
            others()
        assert [*map(str, others(strict=False))] == [str(tmp_path)]
        assert reason in capsys.readouterr().err


def test_no_network_is_asked_before_a_result_is(monkeypatch):
    monkeypatch.setitem(sys.modules, "fsspec.core", None)
    assert str(Bucket("s3://bucket/store/")) == "s3://bucket/store"
