"""An archive of results says what it is, and brings entries of a store and nothing else."""

import gzip
import hashlib
import io
import json
import stat
import tarfile
import tempfile
from pathlib import Path

import pytest
import xarray as xr

from nucleation.datasets import netcdf
from nucleation.datasets.variables import DatasetError
from replication.pipeline import bundle
from replication.pipeline.bundle import CHECKSUMS
from replication.pipeline.recipe_files import RECIPES
from replication.pipeline.recipes import Recipe
from replication.pipeline.store import Store
from replication.pipeline.views import lay

KEY, OTHER, UNSHOWN = "0" * 16, "1" * 16, "2" * 16


def dataset(key):
    """The bytes of a dataset with a key."""
    with tempfile.TemporaryDirectory() as place:
        path = Path(place, "result.nc")
        netcdf.write(xr.Dataset(), path, key=key)
        return path.read_bytes()


FILES = {
    KEY: {"result.nc": dataset(KEY)},
    OTHER: {"result.csv": b"1,2\n", "result.columns.csv": b"x"},
    UNSHOWN: {"result.nc": dataset(UNSHOWN)},
}

CONFIG = "studies: {one: {runs: [{height: 0.02, n_x: 40, n_y: 4}]}}"


def put(store, key, files):
    def make(place):
        for name, content in files.items():
            (place / name).write_bytes(content)

    store.put(key, make, {"name": key})


def show(results, name, key, *suffixes):
    """Lay the files of a result, and the recipe that the workflow has planned."""
    files = [f"results/{name}{suffix}" for suffix in suffixes]
    recipe = Recipe(name, files, "results", "module:function", [], {}, {}, [])
    place = results / "store" / RECIPES / "place" / f"{name}.json"
    place.parent.mkdir(parents=True, exist_ok=True)
    place.write_text(json.dumps({"key": key, **recipe._asdict()}))
    for file, suffix in zip(files, suffixes, strict=True):
        lay(results.parent / file, results / "store" / key / f"result{suffix}")


@pytest.fixture
def made(tmp_path):
    """A directory with results of which some are shown, and a file of the user's among them."""
    results = tmp_path / "made" / "results"
    for key, files in FILES.items():
        put(Store(results / "store"), key, files)
    show(results, "simulations/a b", KEY, ".nc")
    show(results, "lengths", OTHER, ".csv", ".columns.csv")
    (results / "lengths.csv").rename(results / "mine.csv")
    (results / "lengths.csv").write_text("mine")
    (tmp_path / "made" / "config.yaml").write_text(CONFIG)
    return tmp_path / "made"


@pytest.fixture
def archive(made):
    bundle.write(made / "out.tar", made / "config.yaml", made)
    return made / "out.tar"


def read(archive, name):
    with tarfile.open(archive) as tar:
        return tar.extractfile(name).read()


def test_archive_holds_what_is_shown(archive):
    with tarfile.open(archive) as tar:
        assert all(member.isreg() and member.mode == 0o644 for member in tar)
        names = tar.getnames()
    entries = {f"store/{k}/{n}" for k in (KEY, OTHER) for n in ("entry.json", *FILES[k])}
    described = {CHECKSUMS, "config.yaml"}
    assert {*names} == {*entries, *described, "lengths.columns.csv"}, (
        "simulations only in the store"
    )
    checksums = read(archive, CHECKSUMS).decode().splitlines()
    assert {line[66:]: line[:64] for line in checksums} == {
        name: hashlib.sha256(read(archive, name)).hexdigest() for name in {*names} - {CHECKSUMS}
    }


def test_restored_entries_are_those_that_were_packed(archive, tmp_path):
    clone = tmp_path / "clone"
    put(Store(clone / "results/deep/store"), KEY, FILES[KEY])
    kept = (clone / "results/deep/store" / KEY).stat().st_mtime_ns
    assert bundle.restore(archive, "results/deep", clone) == 1
    assert bundle.restore(archive, "results/deep", clone) == 0
    store = Store(clone / "results/deep/store")
    assert store.listed() == [KEY, OTHER] and store.entry(KEY).stat().st_mtime_ns == kept
    for key in (KEY, OTHER):
        packed = json.loads(read(archive, f"store/{key}/entry.json"))
        assert json.loads((store.entry(key) / "entry.json").read_text()) == packed
        for name, content in FILES[key].items():
            assert (store.entry(key) / name).read_bytes() == content
            assert stat.S_IMODE((store.entry(key) / name).stat().st_mode) == 0o444
    assert sorted(path.name for path in store.directory.iterdir()) == [KEY, OTHER]


def test_nothing_is_written_without_results_or_over_a_file(made, archive):
    with pytest.raises(DatasetError, match="exists already"):
        bundle.write(archive, made / "config.yaml", made)
    with pytest.raises(DatasetError, match="no results in"):
        bundle.write(made / "b.tar", made / "config.yaml", made / "empty")
    path = made / "results" / "store" / KEY / "result.nc"
    path.chmod(0o644)
    path.write_bytes(b"A RUN")
    with pytest.raises(DatasetError, match="is damaged"):
        bundle.write(made / "b.tar", made / "config.yaml", made)
    assert not (made / "b.tar").exists()


def test_program_among_results_is_not_packed(made):
    put(Store(made / "results/store"), "3" * 16, {"result.py": b"1"})
    show(made / "results", "own", "3" * 16, ".nc")
    with pytest.raises(DatasetError, match=r"result\.py.: it is neither"):
        bundle.write(made / "out.tar", made / "config.yaml", made)


def member(name, kind=tarfile.REGTYPE, content=b"x", **fields):
    entry = tarfile.TarInfo(name)
    entry.type, entry.mode = kind, 0o777
    for field, value in fields.items():
        setattr(entry, field, value)
    entry.size = len(content) if kind == tarfile.REGTYPE else 0
    return entry, content


def note(key, **files):
    told = {
        f"result.{suffix}": {"size": len(text), "sha256": hashlib.sha256(text).hexdigest()}
        for suffix, text in files.items()
    }
    return json.dumps({"key": key, "files": told}).encode()


CSV = f"store/{KEY}/result.csv"
WHOLE = [member(CSV), member(f"store/{KEY}/entry.json", content=note(KEY, csv=b"x"))]


def packed(path, *members):
    """An archive of some members, with right checksums of all."""
    plain = [(entry.name, content) for entry, content in members if entry.isreg()]
    lines = [f"{hashlib.sha256(content).hexdigest()}  {name}\n" for name, content in plain]
    with tarfile.open(path, "w") as tar:
        for entry, content in [*members, member(CHECKSUMS, content="".join(lines).encode())]:
            tar.addfile(entry, io.BytesIO(content))
    return path


FOREIGN = {
    "hook": member(".git/hooks/post-checkout"),
    "module": member("src/nucleation/evil.py"),
    "lock": member(".snakemake/locks/0.input.lock"),
    "hidden": member(".envrc.csv"),
    "program in an entry": member(f"store/{KEY}/result.py"),
    "program with two endings": member(f"store/{KEY}/result.csv.py"),
    "hidden in an entry": member(f"store/{KEY}/.result.csv"),
    "no key": member("store/views/0.json"),
    "key in capitals": member(f"store/{'A' * 16}/result.csv"),
    "deeper": member(f"store/{KEY}/a/result.csv"),
    "absolute": member("/etc/cron.d/evil.csv"),
    "upwards": member("../outside.csv"),
    "upwards in between": member(f"store/{KEY}/../../../evil.csv"),
    "not shortest": member("figures//a.csv"),
    "backslash": member("..\\..\\a.csv"),
    "control": member("a\x1b[2J.csv"),
    "newline": member("a\nb.csv"),
    "symbolic link": member(CSV.replace(".csv", ".nc"), tarfile.SYMTYPE, linkname="/etc/passwd"),
    "hard link": member("a.csv", tarfile.LNKTYPE, linkname=CSV),
    "directory": member("figures", tarfile.DIRTYPE),
    "pipe": member("a.csv", tarfile.FIFOTYPE),
}


@pytest.mark.parametrize("foreign", FOREIGN.values(), ids=FOREIGN.keys())
def test_foreign_file_is_refused_by_name(foreign, tmp_path):
    archive = packed(tmp_path / "evil.tar", *WHOLE, foreign)
    with pytest.raises(DatasetError, match="nothing is written") as caught:
        bundle.restore(archive, "results", tmp_path / "checkout")
    assert repr(foreign[0].name) in str(caught.value)
    assert not (tmp_path / "checkout").exists()


BROKEN = {
    "of another key": [
        member(CSV),
        member(f"store/{KEY}/entry.json", content=note(OTHER, csv=b"x")),
    ],
    "twice": [*WHOLE, member(CSV, content=b"y")],
    "other content": [member(CSV, content=b"y"), WHOLE[1]],
    "more files": [*WHOLE, member(f"store/{KEY}/result.md")],
    "fewer files": [WHOLE[1]],
    "no note": [WHOLE[0]],
    "no text": [WHOLE[0], member(f"store/{KEY}/entry.json", content=b"\xff")],
    "deep": [WHOLE[0], member(f"store/{KEY}/entry.json", content=b"[" * 10**5)],
}


@pytest.mark.parametrize("members", BROKEN.values(), ids=BROKEN.keys())
def test_entry_is_what_its_note_tells_of(members, tmp_path):
    archive = packed(tmp_path / "a.tar", *members)
    with pytest.raises(DatasetError, match="damaged or no archive of results"):
        bundle.restore(archive, "results", tmp_path / "checkout")
    assert not (tmp_path / "checkout").exists()


def test_files_and_their_checksums_are_the_same_set(tmp_path):
    whole = packed(tmp_path / "whole", *WHOLE, member("a.csv"))
    *lines, _ = read(whole, CHECKSUMS).splitlines(keepends=True)
    for name, text in (("fewer", b"".join(lines)), ("more", lines[0] + b"0" * 64 + b"  b.csv")):
        with tarfile.open(tmp_path / name, "w") as tar:
            for entry, content in [*WHOLE, member("a.csv"), member(CHECKSUMS, content=text)]:
                tar.addfile(entry, io.BytesIO(content))
        with pytest.raises(DatasetError, match=r"[ab]\.csv differs from the file that was packed"):
            bundle.restore(tmp_path / name, "results", tmp_path / "checkout")


@pytest.mark.parametrize("name", ["config.yaml", CHECKSUMS, f"store/{KEY}/result.nc"])
def test_damaged_archive_puts_nothing_in_place(archive, tmp_path, name):
    with tarfile.open(archive) as tar:
        place = tar.getmember(name).offset_data
    whole = archive.read_bytes()
    for content in (whole[:place] + b"\0" + whole[place + 1 :], whole[: place + 2], b"", b"no tar"):
        (tmp_path / "damaged.tar").write_bytes(content)
        with pytest.raises(DatasetError, match="damaged"):
            bundle.restore(tmp_path / "damaged.tar", "results", tmp_path / "clone")
    with pytest.raises(DatasetError, match="no archive"):
        bundle.restore(tmp_path / "missing.tar", "results", tmp_path / "clone")
    assert not (tmp_path / "clone").exists()


def test_links_that_are_there_are_not_followed_out(archive, tmp_path):
    (tmp_path / "elsewhere").mkdir()
    for name in ("results", "own/store"):
        (tmp_path / "checkout" / name).parent.mkdir(exist_ok=True)
        (tmp_path / "checkout" / name).symlink_to(tmp_path / "elsewhere")
        with pytest.raises(DatasetError, match="over a link"):
            bundle.restore(archive, name.removesuffix("/store"), tmp_path / "checkout")
    assert not list((tmp_path / "elsewhere").iterdir())


def test_bombs_are_refused(archive, tmp_path):
    (tmp_path / "small.tar.gz").write_bytes(gzip.compress(archive.read_bytes()))
    with pytest.raises(DatasetError, match="no archive of results"):  # no compression is undone
        bundle.restore(tmp_path / "small.tar.gz", "results", tmp_path / "checkout")
    for name in (CHECKSUMS, f"store/{KEY}/entry.json"):
        huge = tarfile.TarInfo(name)
        huge.size = bundle.LARGEST_TEXT + 1
        with pytest.raises(DatasetError, match="it is too large"):
            bundle._refuse_foreign([huge])
