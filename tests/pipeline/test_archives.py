"""An archive from others brings results and notes on them, and nothing else, whatever is in it."""

import base64
import hashlib
import io
import os
import stat
import tarfile

import pytest

from nucleation.pipeline import archives, bundle
from nucleation.pipeline.archives import CHECKSUMS, NOTES, BundleError

CSV = "results/mine/lengths.csv"


def note_on(path):
    return f"{NOTES}/{base64.urlsafe_b64encode(path.encode()).decode()}"


def member(name, kind=tarfile.REGTYPE, content=b"x", **fields):
    entry = tarfile.TarInfo(name)
    entry.type, entry.mode = kind, 0o777
    for key, value in fields.items():
        setattr(entry, key, value)
    entry.size = len(content) if kind == tarfile.REGTYPE else 0
    return entry, content


def packed(path, *members):
    """An archive with a result, its note, some members more, and right checksums of all."""
    members = [member(CSV), member(note_on(CSV), content=b"{}"), *members]
    plain = [(entry.name, content) for entry, content in members if entry.isreg()]
    lines = [f"{hashlib.sha256(content).hexdigest()}  {name}\n" for name, content in plain]
    with tarfile.open(path, "w") as tar:
        for entry, content in [*members, member(CHECKSUMS, content="".join(lines).encode())]:
            tar.addfile(entry, io.BytesIO(content))
    return path


FOREIGN = {
    "hook": member(".git/hooks/post-checkout"),
    "module": member("src/nucleation/evil.py"),
    "startup": member("sitecustomize.py"),
    "profile": member("workflow/profiles/default/config.yaml"),
    "program among results": member("results/mine/sitecustomize.py"),
    "hidden": member("results/mine/.envrc"),
    "hidden directory": member("results/mine/.git/config.csv"),
    "other results": member("results/theirs.csv"),
    "beside": member("results/mine.csv"),
    "reference set": member("results/mine/reference/lengths.csv"),
    "absolute": member("/etc/cron.d/evil.csv"),
    "upwards": member("results/mine/../../outside.csv"),
    "not shortest": member("results/mine//a.csv"),
    "backslash": member("results/mine/..\\..\\a.csv"),
    "control": member("results/mine/a\x1b[2J.csv"),
    "newline": member("results/mine/a\nb.csv"),
    "symbolic link": member("results/mine/a.csv", tarfile.SYMTYPE, linkname="/etc/passwd"),
    "hard link": member("results/mine/a.csv", tarfile.LNKTYPE, linkname=CSV),
    "linked directory": member("results/mine/figures", tarfile.SYMTYPE, linkname="../../src"),
    "directory": member("results/mine/figures", tarfile.DIRTYPE),
    "pipe": member("results/mine/a.csv", tarfile.FIFOTYPE),
    "device": member("results/mine/a.csv", tarfile.CHRTYPE, devmajor=1, devminor=3),
    "twice": member(CSV, content=b"y"),
    "note on another file": member(note_on("src/nucleation/api.py")),
    "record of no result": member("results/mine/.made/evil.py.json"),
    "program among records": member("results/mine/.made/lengths.csv.py"),
    "record of a record": member("results/mine/.made/.made/lengths.csv.json.json"),
    "record of the reference set": member("results/mine/.made/reference/lengths.csv.json"),
    "note outside": member(note_on("results/mine/../../a.csv")),
    "no note": member(f"{NOTES}/a.json"),
    "beside the notes": member(".snakemake/scripts/a.py"),
    "lock": member(".snakemake/locks/0.input.lock"),
}


@pytest.mark.parametrize("foreign", FOREIGN.values(), ids=FOREIGN.keys())
def test_foreign_file_is_refused_by_name(foreign, tmp_path):
    archive = packed(tmp_path / "evil.tar", foreign)
    with pytest.raises(BundleError, match="nothing was put in place") as caught:
        bundle.restore(archive, "results/mine", tmp_path / "checkout")
    assert repr(foreign[0].name) in str(caught.value)
    assert not list((tmp_path / "checkout").rglob("*"))


def test_plain_results_are_put_in_place_and_can_not_be_run(tmp_path):
    future = member("results/mine/logs/a.log", mtime=2**40)
    records = [member("results/mine/.made/lengths.csv.json", content=b"{}"),
               member("results/mine/quick/.made/figures/a.png.json", content=b"{}")]  # fmt: skip
    archive = packed(tmp_path / "good.tar", future, *records)
    old = os.umask(0o027)
    try:
        assert bundle.restore(archive, "./results/mine/", tmp_path / "checkout") == 5
    finally:
        os.umask(old)
    put = tmp_path / "checkout" / CSV
    assert stat.S_IMODE(put.stat().st_mode) == 0o640
    log = tmp_path / "checkout" / "results/mine/logs/a.log"
    assert log.stat().st_mtime <= (tmp_path / "good.tar").stat().st_mtime + 60.0


def test_links_that_are_there_are_not_followed_out(tmp_path):
    (tmp_path / "checkout" / "results").mkdir(parents=True)
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "checkout" / "results" / "mine").symlink_to(tmp_path / "elsewhere")
    with pytest.raises(BundleError, match="leads out of"):
        bundle.restore(packed(tmp_path / "a.tar"), "results/mine", tmp_path / "checkout")
    assert not list((tmp_path / "elsewhere").iterdir())


@pytest.mark.parametrize(
    "results",
    ["", ".", "..", "/tmp/a", "../a", "a/../../b", ".git", "src", "src/nucleation", "workflow",
     "./tests", "a/.git", ".snakemake", "a\nb"],
)  # fmt: skip
def test_place_of_code_is_no_place_for_results(results, tmp_path):
    with pytest.raises(BundleError, match="results ="):
        bundle.restore(packed(tmp_path / "a.tar"), results, tmp_path / "checkout")
    assert not (tmp_path / "checkout").exists()


def test_files_and_their_checksums_are_the_same_set(tmp_path):
    for name, listed in (("more", CSV), ("fewer", f"{CSV} results/mine/b.csv results/mine/c.csv")):
        lines = "".join(f"{hashlib.sha256(b'x').hexdigest()}  {n}\n" for n in listed.split())
        with tarfile.open(tmp_path / name, "w") as tar:
            for entry, content in (
                member(CSV), member("results/mine/b.csv"),
                member(CHECKSUMS, content=lines.encode()),
            ):  # fmt: skip
                tar.addfile(entry, io.BytesIO(content))
        with pytest.raises(BundleError, match=r"damaged: results/mine/[bc]\.csv"):
            bundle.restore(tmp_path / name, "results/mine", tmp_path / "checkout")
    assert not list((tmp_path / "checkout").rglob("*"))


def test_bombs_are_refused(tmp_path):
    whole = packed(tmp_path / "a.tar").read_bytes()
    (tmp_path / "small.tar.gz").write_bytes(b"\x1f\x8b" + whole)  # no compression is undone
    with pytest.raises(BundleError, match="no archive of results"):
        bundle.restore(tmp_path / "small.tar.gz", "results/mine", tmp_path / "checkout")
    with pytest.raises(BundleError, match="larger than itself"):
        archives.refuse_foreign([member(CSV, content=b"x" * 99)[0]], "results/mine", 98)
    huge = tarfile.TarInfo("config.yaml")
    huge.size = archives.LARGEST_DESCRIPTION + 1
    with pytest.raises(BundleError, match="it is too large"):
        archives.refuse_foreign([huge], "results/mine", 2**40)


def test_too_little_space_is_said_before(tmp_path, monkeypatch):
    usage = type("Usage", (), {"free": 2})
    monkeypatch.setattr("shutil.disk_usage", lambda path: usage)
    with pytest.raises(BundleError, match="No space left on device"):
        bundle.restore(packed(tmp_path / "a.tar"), "results/mine", tmp_path / "checkout")


def test_name_of_a_note_is_the_path_in_pieces():
    path = "results/" + "long" * 100 + ".csv"
    text = base64.urlsafe_b64encode(path.encode()).decode()
    assert archives.subject_of(f"{NOTES}/@{text[:254]}/@{text[254:508]}/{text[508:]}") == path
    assert archives.subject_of(f"{NOTES}/@{text[:254]}/../{text[254:]}") is None
    assert archives.subject_of(f"{NOTES}/a.json") is None
