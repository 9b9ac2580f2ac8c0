"""Stores: entries are whole or not there, and what is not right is neither taken nor kept."""

import functools
import hashlib
import json
import os
import shutil
import time
import traceback
from concurrent.futures import ThreadPoolExecutor

import pytest
import xarray as xr

from nucleation.datasets import netcdf
from nucleation.datasets.variables import DatasetError
from replication.pipeline import store as module
from replication.pipeline.store import NOTE, VARIABLE, Store, others, read_note

KEY, OTHER = "0" * 16, "1" * 16


def put(store, key=KEY, content=b"hours of work", name="result.csv"):
    store.put(key, lambda place: (place / name).write_bytes(content), {"name": "a"})
    return store.entry(key)


@pytest.fixture
def store(tmp_path):
    return Store(tmp_path / "store")


def names(directory):
    return sorted(path.name for path in directory.iterdir())


def test_entry_is_whole_or_not_there(store):
    def broken(place):
        (place / "result.csv").write_bytes(b"half")
        raise OSError(28, "No space left on device")

    with pytest.raises(OSError, match="No space"):
        store.put(KEY, broken, {})
    assert names(store.directory) == [] and not store.has(KEY)
    entry = put(store)
    assert read_note(entry, whole=True)["name"] == "a" and names(store.directory) == [KEY]
    assert {path.stat().st_mode & 0o777 for path in entry.iterdir()} == {0o444}


def test_of_writers_at_once_one_wins(store):
    contents = [bytes([n]) * 10**5 for n in range(16)]
    with ThreadPoolExecutor(8) as pool:
        list(pool.map(lambda content: put(Store(store.directory), KEY, content), contents))
    assert read_note(store.entry(KEY), whole=True)
    assert (store.entry(KEY) / "result.csv").read_bytes() in contents
    assert names(store.directory) == [KEY], "nobody's entry was moved aside"


STEPS = ["digest_of_file", "flush", "Path.chmod", "Path.rename", "json.dumps", "_mark"]


@pytest.mark.parametrize("step", [*STEPS, "shutil.rmtree"])
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
        assert (store.entry(KEY) / "result.csv").read_bytes() == b"hours of work"


def rewrite(entry, **changes):
    path = entry / NOTE
    note = {**json.loads(path.read_text()), **changes}
    path.write_text(json.dumps(note))


def changed_unnoticed(path):
    """Change a file, but neither its size nor its times."""
    before = path.stat()
    path.write_bytes(b"HOURS OF WORK")
    os.utime(path, ns=(before.st_atime_ns, before.st_mtime_ns))


def fifo_for_a_note(entry):
    (entry / NOTE).unlink()
    os.mkfifo(entry / NOTE)


def endless_file(entry):
    rewrite(entry, files={"result.csv": {"size": 0, "sha256": hashlib.sha256(b"").hexdigest()}})
    (entry / "result.csv").unlink()
    (entry / "result.csv").symlink_to("/dev/zero")


def elsewhere(entry):
    entry.rename(entry.parent.parent / "elsewhere")
    entry.symlink_to(entry.parent.parent / "elsewhere")


def another_result(entry):
    """A dataset of another key, with the digest that the note says."""
    path = entry / "result.nc"
    netcdf.write(xr.Dataset(), path, key=OTHER)
    content = path.read_bytes()
    about = {"size": len(content), "sha256": hashlib.sha256(content).hexdigest()}
    rewrite(entry, files={"result.nc": about})


DAMAGE = {
    "of another key": lambda entry: rewrite(entry, key=OTHER),
    "note cut off": lambda entry: (entry / NOTE).write_bytes((entry / NOTE).read_bytes()[:40]),
    "no note of ours": lambda entry: (entry / NOTE).write_text("[1]"),
    "deep note": lambda entry: (entry / NOTE).write_text("[" * 10**5),
    "no files": lambda entry: rewrite(entry, files={}),
    "file outside": lambda entry: rewrite(entry, files={"../../e.nc": {"size": 4, "sha256": "0"}}),
    "absolute": lambda entry: rewrite(entry, files={"/etc/passwd": {"size": 4, "sha256": "0"}}),
    "file cut off": lambda entry: (entry / "result.csv").write_bytes(b"hours"),
    "file gone": lambda entry: (entry / "result.csv").unlink(),
    "file changed": lambda entry: (entry / "result.csv").write_bytes(b"HOURS OF WORK"),
    "file changed, its times put back": lambda entry: changed_unnoticed(entry / "result.csv"),
    "surrogates": lambda entry: rewrite(entry, key="\ud800"),
    "forged line": lambda entry: rewrite(entry, key="\x1b[2K\nAll is current\n" + 500_000 * "0"),
    "huge note": lambda entry: os.truncate(entry / NOTE, 2**33),
    "fifo": fifo_for_a_note,
    "endless file": endless_file,
    "a link": elsewhere,
    "another result": another_result,
}


def damaged(entry, how):
    for path in entry.iterdir():
        path.chmod(0o644)
    how(entry)


@pytest.mark.parametrize("how", DAMAGE.values(), ids=DAMAGE)
def test_damaged_entry_is_said_and_moved_aside_for_a_new_one(store, how, capsys):
    damaged(put(store), how)
    assert not Store(store.directory).has(KEY)
    assert capsys.readouterr().err.count("Not used") == 1
    with pytest.raises(DatasetError):
        read_note(store.entry(KEY), whole=True)
    assert read_note(put(Store(store.directory)), whole=True)
    assert len(list(store.directory.glob(f"damaged-{KEY}-*"))) == 1


def test_bytes_are_read_again_only_after_a_change(store, monkeypatch):
    entry = put(store)
    read, digest = [], module.digest_of_file
    monkeypatch.setattr(module, "digest_of_file", lambda path: read.append(path) or digest(path))
    assert Store(store.directory).has(KEY) and read == []
    time.sleep(0.05)  # longer than a tick of the clock of inodes
    (entry / "result.csv").touch()
    for _ in range(2):
        assert Store(store.directory).has(KEY)
    assert [path.name for path in read] == ["result.csv"]


def test_a_changed_byte_is_seen_although_files_came_and_went(store):
    entry = put(store)
    damaged(entry, lambda entry: changed_unnoticed(entry / "result.csv"))
    time.sleep(0.05)
    (entry / "note.txt").touch()
    (entry / "note.txt").unlink()
    assert not Store(store.directory).has(KEY)


def test_an_entry_without_all_files_is_replaced(store, other, tmp_path, capsys):
    """A result of an earlier state of the project, say, whole in itself."""
    put(store, name="result.txt")
    store.give(KEY, [other])
    assert not Store(store.directory).has(KEY, ["result.csv"])
    assert Store(tmp_path / "clone").take(KEY, ["result.csv"], [other]) is None
    assert capsys.readouterr().err.count("lacks files of the result") == 2
    again = Store(store.directory)
    put(again)
    assert again.has(KEY, ["result.csv"]) and len(list(store.directory.glob("damaged-*"))) == 1


@pytest.mark.parametrize("umask", [0o002, 0o022, 0o077])
def test_modes_are_those_of_the_umask_and_the_directory(tmp_path, umask):
    (tmp_path / "store").mkdir()
    (tmp_path / "store").chmod(0o2775)
    before = os.umask(umask)
    try:
        entry = put(Store(tmp_path / "store"))
        clone = Store(tmp_path / "clone")
        clone.take(KEY, (), [Store(tmp_path / "store")])
    finally:
        os.umask(before)
    assert entry.stat().st_mode & 0o7777 == 0o2777 & ~umask
    for path in (*entry.iterdir(), *clone.entry(KEY).iterdir()):
        assert path.stat().st_mode & 0o777 == 0o444 & ~umask


@pytest.mark.skipif(os.geteuid() != 0, reason="only root can be two users")
def test_a_damaged_entry_of_another_user_stops_nobody(tmp_path):
    """In a store of their group, with any umask."""
    place = tmp_path / "store"
    place.mkdir()
    os.chown(place, -1, 3000)
    place.chmod(0o2775)
    for above in (tmp_path, *tmp_path.parents):
        above.chmod(above.stat().st_mode | 0o011)

    def first():
        damaged(put(Store(place)), lambda entry: (entry / "result.csv").write_bytes(b"hours"))

    def second():
        store = Store(place)
        assert not store.has(KEY)
        put(store)
        assert Store(place).has(KEY) and len(list(place.glob("damaged-*"))) == 1

    def third():
        with pytest.raises(PermissionError, match="another user's"):
            Store(place).remove(KEY)
        assert Store(place).has(KEY)

    as_user(2001, first)
    as_user(2002, second)
    as_user(2001, third)


def as_user(number, work):
    child = os.fork()
    if child == 0:
        os.setgroups([])
        os.setgid(3000)
        os.setuid(number)
        os.umask(0o022)
        try:
            work()
        except BaseException:
            traceback.print_exc()
            os._exit(1)
        os._exit(0)
    assert os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]) == 0


@pytest.fixture
def other(tmp_path):
    """A store elsewhere."""
    (tmp_path / "shared").mkdir()
    return Store(tmp_path / "shared")


def test_what_is_given_is_taken_by_another(store, other, tmp_path, capsys):
    entry, clone = put(store), Store(tmp_path / "clone")
    assert clone.take(KEY, (), [other]) is None
    for _ in range(2):
        store.give(KEY, [other])
    assert clone.take(KEY, (), [other]) == other.directory
    for name in (NOTE, "result.csv"):
        assert (clone.entry(KEY) / name).stat().st_mode & 0o777 == 0o444
    assert read_note(clone.entry(KEY), whole=True) == read_note(entry)
    assert capsys.readouterr().err == "" and names(clone.directory) == [KEY]


@pytest.mark.parametrize("how", DAMAGE.values(), ids=DAMAGE)
def test_damaged_entry_elsewhere_is_said_not_taken_and_replaced(
    store, other, how, tmp_path, capsys
):
    put(store)
    clone = Store(tmp_path / "clone")
    store.give(KEY, [other])
    damaged(other.entry(KEY), how)
    asked = [other]
    assert clone.take(KEY, (), asked) is None and asked == [other]
    (line,) = capsys.readouterr().err.splitlines()
    assert line.startswith(f"Not taken from {other.directory}: ") and len(line) < 500
    assert line.isascii() and "All is current" not in line
    assert clone.listed() == [] and not list(tmp_path.rglob("evil*"))
    store.give(KEY, [other])
    assert clone.take(KEY, (), asked) == other.directory
    assert read_note(other.entry(KEY), whole=True)["name"] == "a", "the right one is there now"


def test_note_of_others_names_no_file_outside(store, tmp_path, capsys):
    """All that such a note says is true of what lies there."""
    evil, content = f"../../../{KEY[:4]}evil.nc", b"evil"
    files = {evil: {"size": 4, "sha256": hashlib.sha256(content).hexdigest()}}
    shared = Store(tmp_path / "far" / "away" / "shared")
    damaged(put(shared), lambda entry: rewrite(entry, files=files))
    (shared.entry(KEY) / evil).resolve().write_bytes(content)
    assert Store(tmp_path / "clone" / "a" / "b").take(KEY, (), [shared]) is None
    assert "names other files" in capsys.readouterr().err
    assert len(list(tmp_path.rglob("*evil.nc"))) == 1


def test_no_byte_of_a_wrong_file_is_copied(store, other, monkeypatch):
    """A sparse file of any size, say, whose digest is another."""
    entry = put(other)
    monkeypatch.setattr(module.shutil, "copyfile", lambda *_: pytest.fail("it is copied"))
    damaged(entry, lambda entry: os.truncate(entry / "result.csv", 2**24))
    rewrite(entry, files={"result.csv": {"size": 2**24, "sha256": "0" * 64}})
    assert store.take(KEY, (), [other]) is None


def test_first_store_that_is_right_serves(store, other, tmp_path, capsys):
    first = Store(tmp_path / "first")
    put(store)
    store.give(KEY, [other])
    first.directory.mkdir()
    shutil.copytree(put(store, OTHER, b"another"), first.entry(KEY))
    assert Store(tmp_path / "clone").take(KEY, (), [first, other]) == other.directory
    assert "holds the result of another key" in capsys.readouterr().err


def test_result_is_kept_whatever_happens_elsewhere(store, other, monkeypatch, capsys):
    entry = put(store)

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(module.shutil, "copyfile", full)
    asked = [other]
    store.give(KEY, asked)
    assert "Not kept" in capsys.readouterr().err and asked == []
    assert read_note(entry, whole=True) and names(other.directory) == []


def test_stores_are_named_by_the_environment(tmp_path, monkeypatch, capsys):
    monkeypatch.delenv(VARIABLE, raising=False)
    assert others() == []
    monkeypatch.setenv("NUCLEATION_STORES", f"/no/such/store, {tmp_path}")
    with pytest.raises(DatasetError, match="is no directory"):
        others()
    assert [store.directory for store in others(strict=False)] == [tmp_path]
    assert "is no directory" in capsys.readouterr().err
